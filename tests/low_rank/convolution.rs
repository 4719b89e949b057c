//! Errors after convolution, and factors made for them.

use striae::factor::{
    Alignment, ConvolutionNorm, ConvolvedOptions, Decomposition, LowRankError, NormOptions,
    convolved, seen_error,
};
use striae::measured::environment::Environment;
use striae::table::Grid;

use super::tables::{cross, disc, display, holographic, lamps, windows};

fn degrees(angles: [f64; 2]) -> [f64; 2] {
    angles.map(f64::to_radians)
}

fn norm(environment: Environment, table: &Grid, seed: u64) -> ConvolutionNorm {
    let options = NormOptions { seed, ..NormOptions::default() };
    ConvolutionNorm::from_environments(&[environment], table.x(), table.y(), &options)
        .expect("a lit environment")
}

fn root_mean_square(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Gains over the decomposition: under the norm, under that of another environment with other
/// orientations, and in what is seen under it.
fn gains(table: &Grid, train: Environment, held_out: Environment, rank: usize) -> [f64; 3] {
    let own = norm(train, table, 1);
    let other = norm(held_out.clone(), table, 77);
    let options = ConvolvedOptions::default();
    let (kernel, reports) =
        convolved(table, Alignment::identity(), rank, &own, &options).expect("fits");
    let svd = Decomposition::of(table).expect("finite").low_rank(rank).expect("rank");
    for report in &reports {
        assert!(report.polished <= report.alternating && report.alternating <= report.start);
        assert!(report.start <= report.svd, "{report:?}");
    }
    let told: Vec<f64> = reports.iter().map(|r| r.polished).collect();
    let errors =
        |norm: &ConvolutionNorm, kernel| norm.relative_errors(table, kernel).expect("same");
    let measured = errors(&own, &kernel);
    assert!(told.iter().zip(&measured).all(|(a, b)| (a - b).abs() < 1e-6), "{told:?} {measured:?}");
    let gain = |ours: f64, theirs: f64| 1.0 - ours / theirs;
    let under = |norm: &ConvolutionNorm| {
        gain(root_mean_square(&errors(norm, &kernel)), root_mean_square(&errors(norm, &svd)))
    };
    let seen = |kernel| seen_error(table, kernel, &held_out, 64, 5).expect("same");
    [under(&own), under(&other), gain(seen(&kernel), seen(&svd))]
}

#[test]
fn under_soft_light_the_error_falls_by_a_fifth_and_more() {
    // Measured under the norm, held out, seen: display 0.89 0.90 0.92 and 0.96 0.96 0.99; cross
    // 0.43 0.46 0.57 and 0.82 0.84 0.90; disc at 30° 0.33 0.33 0.43 and 0.28 0.28 0.35.
    for (name, table) in [
        ("display", display(96, degrees([8.0, 95.0]), 8.0)),
        ("cross", cross(96, degrees([12.0, 97.0]))),
        ("disc", disc(96, 30f64.to_radians())),
    ] {
        for rank in [1, 3] {
            let gains = gains(&table, windows(1), windows(2), rank);
            println!("{name}, rank {rank}: gains {gains:.3?}");
            assert!(gains.iter().all(|gain| *gain >= 0.2), "{name}, rank {rank}: {gains:?}");
        }
    }
}

#[test]
fn under_points_of_light_there_is_little_to_gain() {
    // R is then all but δ, for which the decomposition is the best there is. Measured 0.00 to 0.05.
    for table in [cross(64, degrees([12.0, 97.0])), holographic(64, 3)] {
        for rank in [1, 3] {
            let [own, held_out, _] = gains(&table, lamps(1), lamps(2), rank);
            println!("lamps, rank {rank}: {own:.3} {held_out:.3}");
            assert!((0.0..0.2).contains(&own), "{own}");
        }
    }
}

#[test]
fn a_point_light_weighs_errors_as_frobenius_does() {
    let t = holographic(32, 1);
    let norm = ConvolutionNorm::point_light(t.x(), t.y());
    let svd = Decomposition::of(&t).expect("finite").low_rank(3).expect("rank 3");
    let (seen, direct) =
        (norm.relative_errors(&t, &svd).expect("same"), svd.relative_errors(&t).expect("same"));
    assert!(seen.iter().zip(&direct).all(|(a, b)| (a - b).abs() < 1e-12), "{seen:?} {direct:?}");
    let options = ConvolvedOptions::default();
    let (kernel, _) = convolved(&t, Alignment::identity(), 3, &norm, &options).expect("fits");
    let ours = kernel.relative_errors(&t).expect("same");
    assert!(ours.iter().zip(&direct).all(|(a, b)| (a - b).abs() < 1e-8), "{ours:?} {direct:?}");
}

#[test]
fn the_norm_is_even_positive_and_the_same_for_any_number_of_threads() {
    let t = display(24, degrees([8.0, 95.0]), 8.0);
    let make = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| norm(windows(1), &t, 3))
    };
    let (one, three) = (make(1), make(3));
    assert!((one.correlation(0, 0) - 1.0).abs() < 1e-12);
    let lags = (-23..=23i64).flat_map(|dy| (-23..=23i64).map(move |dx| (dx, dy)));
    for (dx, dy) in lags {
        let r = one.correlation(dx, dy);
        assert_eq!(r, one.correlation(-dx, -dy));
        assert_eq!(r.to_bits(), three.correlation(dx, dy).to_bits());
        assert!(r.abs() <= 1.0 + 1e-12, "R({dx}, {dy}) = {r}");
    }
    assert_eq!(one.correlation(24, 0), 0.0);
}

#[test]
fn the_norm_is_the_autocorrelation_of_the_light() {
    // Light from one hemisphere of constant radiance over a small table: every patch is a constant,
    // or cut by the horizon, and R falls only by the overlap of the patches, (1 − |d|/2n).
    let mut environment = windows(1);
    environment.radiance.fill([1.0; 3]);
    let t = cross(16, degrees([0.0, 90.0]));
    let n = norm(environment, &t, 1);
    for d in [0i64, 1, 5, 15] {
        let expected = 1.0 - d as f64 / 32.0;
        assert!((n.correlation(d, 0) - expected).abs() < 1e-9, "{d}: {}", n.correlation(d, 0));
    }
}

#[test]
fn environments_that_cannot_weigh_are_refused() {
    let t = cross(16, degrees([0.0, 90.0]));
    let refused = |environments: &[Environment], options: NormOptions| {
        match ConvolutionNorm::from_environments(environments, t.x(), t.y(), &options) {
            Ok(_) => panic!("not refused"),
            Err(error) => error.to_string(),
        }
    };
    let options = NormOptions::default();
    let mut dark = windows(1);
    dark.radiance.fill([0.0; 3]);
    assert!(refused(&[dark.clone()], options).contains("dark"));
    dark.radiance[5][1] = f32::NAN;
    assert!(refused(&[dark.clone()], options).contains("texel (5, 0)"));
    dark.radiance.truncate(7);
    assert!(refused(&[dark], options).contains("7 texels"));
    assert!(refused(&[], options).contains("environments"));
    assert!(
        refused(&[windows(1)], NormOptions { orientations: 0, ..options }).contains("orientations")
    );
    let small = ConvolutionNorm::point_light(t.x(), t.y());
    let other = cross(20, degrees([0.0, 90.0]));
    let error = convolved(&other, Alignment::identity(), 1, &small, &ConvolvedOptions::default());
    assert!(matches!(error, Err(LowRankError::Unusable { .. })));
}
