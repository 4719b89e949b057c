//! The singular value decomposition, its signs and its repeated values.

use striae::factor::{Alignment, Decomposition, LowRank, LowRankError};
use striae::table::Grid;

use super::tables::{cross, display, holographic, noisy, rows, table};

/// ‖S − Ŝ‖/‖S‖ from the texels, by nothing of the crate.
fn direct_error(table: &Grid, kernel: &LowRank, channel: usize) -> f64 {
    let values = &table.channels[channel].values;
    let factors = &kernel.channels[channel];
    let (mut error, mut whole) = (0.0, 0.0);
    for (index, value) in values.iter().enumerate() {
        let (ix, iy) = (index % table.x().count, index / table.x().count);
        let terms = factors.vertical.iter().zip(&factors.horizontal);
        let sum: f64 = terms.map(|(v, h)| v[iy] * h[ix]).sum();
        error += (f64::from(*value) - sum).powi(2);
        whole += f64::from(*value).powi(2);
    }
    if whole == 0.0 { 0.0 } else { (error / whole).sqrt() }
}

#[test]
fn errors_of_every_rank_are_those_of_the_reconstruction() {
    for table in
        [display(24, [0.2, 1.7], 8.0), noisy(cross(24, [0.1, 1.5]), 0.1, 1), holographic(24, 2)]
    {
        let decomposition = Decomposition::of(&table).expect("finite");
        for (channel, spectrum) in decomposition.spectra().enumerate() {
            assert_eq!(spectrum.relative_errors.len(), 25);
            assert_eq!(spectrum.relative_errors[0], 1.0);
            for rank in 1..=24 {
                let kernel = decomposition.low_rank(rank).expect("a rank it has");
                let (told, direct) =
                    (spectrum.relative_errors[rank], direct_error(&table, &kernel, channel));
                // Measured 2e-13 at most, where values below 1e-12 of the largest are taken as
                // one repeated value; 4e-14 elsewhere.
                assert!((told - direct).abs() < 1e-12, "rank {rank}: {told} against {direct}");
            }
        }
    }
}

#[test]
fn a_table_of_known_rank_is_given_back_at_it_and_not_below() {
    let t = table(40, 1.0, |x, y| {
        let sum =
            (2.0 * x).cos() * y.exp() + 0.5 * (3.0 * x).sin() * (y * y) + 0.2 * x * (5.0 * y).cos();
        [sum, 2.0 * sum, 1.0]
    });
    let decomposition = Decomposition::of(&t).expect("finite");
    let errors: Vec<_> = decomposition.spectra().map(|s| s.relative_errors.clone()).collect();
    // The table is in f32: 6e-8 of each value is its rounding.
    assert!(errors[0][2] > 1e-2 && errors[0][3] < 1e-7, "{:?}", &errors[0][..5]);
    assert!(errors[2][1] < 1e-14, "a constant is of rank 1");
    assert_eq!(decomposition.rank_for_error(1e-6).expect("in range"), 3);
    assert_eq!(decomposition.rank_for_error(1.0).expect("in range"), 1);
    assert!(
        decomposition.rank_for_error(-0.1).is_err()
            && decomposition.rank_for_error(f64::NAN).is_err()
    );
}

#[test]
fn hard_tables() {
    let zero = rows(&[&[0.0; 5], &[0.0; 5], &[0.0; 5]]);
    let spike = rows(&[&[0.0, 0.0, 0.0, 0.0], &[0.0, 0.0, 7.0, 0.0], &[0.0; 4]]);
    let constant = rows(&[&[2.0f32; 6] as &[f32]; 4]);
    for (name, table, rank) in [("zero", zero, 0), ("spike", spike, 1), ("constant", constant, 1)] {
        let decomposition = Decomposition::of(&table).expect("finite");
        let spectrum = decomposition.spectra().next().expect("a channel").clone();
        let positive = spectrum.singular_values.iter().filter(|s| **s > 0.0).count();
        assert_eq!(positive, rank, "{name}: {:?}", spectrum.singular_values);
        let kernel = decomposition.low_rank(decomposition.largest_rank()).expect("its rank");
        assert!(direct_error(&table, &kernel, 0) < 1e-14, "{name}");
        let beyond = kernel.channels[0].vertical.iter().skip(rank);
        assert!(beyond.flatten().all(|v| *v == 0.0), "{name}: terms that are not there are 0");
    }
}

#[test]
fn repeated_values_give_the_most_localised_vectors_whatever_the_order_of_the_rows() {
    // 3 · identity beside 1 · identity: every basis of each space is a set of singular vectors.
    let t = rows(&[
        &[0.0, 3.0, 0.0, 0.0],
        &[3.0, 0.0, 0.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 1.0, 0.0],
    ]);
    let kernel = Decomposition::of(&t).expect("finite").low_rank(4).expect("rank 4");
    let root = 3f64.sqrt();
    let expected = [
        (vec![root, 0.0, 0.0, 0.0], vec![0.0, root, 0.0, 0.0]),
        (vec![0.0, root, 0.0, 0.0], vec![root, 0.0, 0.0, 0.0]),
        (vec![0.0, 0.0, 1.0, 0.0], vec![0.0, 0.0, 0.0, 1.0]),
        (vec![0.0, 0.0, 0.0, 1.0], vec![0.0, 0.0, 1.0, 0.0]),
    ];
    for (m, (v, h)) in expected.iter().enumerate() {
        let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        let factors = &kernel.channels[0];
        assert!(close(&factors.vertical[m], v) && close(&factors.horizontal[m], h), "{factors:?}");
    }
}

#[test]
fn signs_are_the_same_in_all_channels_and_for_any_number_of_threads() {
    let table = noisy(display(48, [0.15, 1.6], 8.0), 0.02, 3);
    let with_threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool");
        pool.install(|| Decomposition::of(&table).expect("finite").low_rank(8).expect("rank 8"))
    };
    let kernel = with_threads(1);
    assert_eq!(kernel, with_threads(2));
    assert_eq!(kernel, with_threads(5));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut compared = 0;
    for m in 0..8 {
        let first = &kernel.channels[0].vertical[m];
        let sum: f64 = first.iter().sum();
        assert!(
            sum >= -1e-9 * first.iter().map(|v| v.abs()).sum::<f64>(),
            "term {m} sums to {sum}"
        );
        for channel in &kernel.channels[1..] {
            let other = &channel.vertical[m];
            let cosine = dot(first, other) / (dot(first, first) * dot(other, other)).sqrt();
            assert!(cosine > -0.5, "term {m} of {}: cosine {cosine}", channel.name);
            compared += usize::from(cosine > 0.5);
        }
    }
    assert!(compared >= 4, "{compared} terms were alike enough to compare");
    // A small change of the table changes no sign.
    let changed = noisy(table.clone(), 1e-5, 9);
    let again = Decomposition::of(&changed).expect("finite").low_rank(3).expect("rank 3");
    for (a, b) in kernel.channels.iter().zip(&again.channels) {
        for m in 0..3 {
            assert!(dot(&a.vertical[m], &b.vertical[m]) > 0.0, "term {m} of {}", a.name);
        }
    }
}

#[test]
fn ranks_that_a_table_does_not_have_are_refused() {
    let decomposition =
        Decomposition::of(&rows(&[&[1.0, 2.0, 3.0], &[4.0, 5.0, 7.0]])).expect("finite");
    for rank in [0, 3, 1000] {
        let error = decomposition.low_rank(rank).expect_err("no such rank");
        assert!(matches!(error, LowRankError::Rank { .. }), "{error}");
        assert!(error.to_string().contains("ranks 1 to 2"), "{error}");
    }
    assert_eq!(decomposition.low_rank(2).expect("rank 2").alignment, Alignment::identity());
}
