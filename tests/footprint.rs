//! References of the footprint against an oracle made with mpmath, against second methods and at
//! their limits.

use std::f64::consts::{FRAC_2_SQRT_PI, PI, SQRT_2};
use std::path::Path;

use striae::effects::footprint::{ScratchEnd, coverage, response, response_at_end};
use striae::numeric::quadrature::GaussLegendre;

/// Relative error stated in the documentation of `response` and `coverage`.
const MEAN_ERROR: f64 = 1e-10;
/// Error relative to the response stated in the documentation of `response_at_end`.
const END_ERROR: f64 = 1e-9;
/// Values below are not judged: the statement ends there.
const SMALLEST: f64 = 1e-300;

/// Rows of an oracle in `tests/oracles`.
fn oracle<const N: usize>(name: &str) -> Vec<[f64; N]> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles").join(name);
    let mut reader = csv::Reader::from_path(&path).expect("the oracle is committed");
    let rows = reader.records().map(|row| {
        let row = row.expect("an oracle is well-formed");
        std::array::from_fn(|at| row[at].parse().expect("an oracle holds numbers"))
    });
    rows.collect()
}

fn relative_error(got: f64, expected: f64) -> f64 {
    if got == expected { 0.0 } else { ((got - expected) / expected).abs() }
}

#[test]
fn means_match_mpmath() {
    let rows = oracle::<4>("footprint.csv");
    assert!(rows.len() > 500, "only {} rows", rows.len());
    let mut worst = (0.0, [0.0; 4]);
    for row in rows {
        let [h, s, of_response, of_coverage] = row;
        let got = [response(h, s), coverage(h, s)].map(|value| value.expect("in the domain"));
        for (got, expected) in got.into_iter().zip([of_response, of_coverage]) {
            if expected > SMALLEST {
                let error = relative_error(got, expected);
                assert!(!error.is_nan(), "{row:?}");
                if error > worst.0 {
                    worst = (error, row);
                }
            }
        }
    }
    println!("largest relative error {:e} at {:?}", worst.0, worst.1);
    assert!(worst.0 <= MEAN_ERROR, "{worst:?}");
}

#[test]
fn scratch_ends_match_mpmath() {
    let rows = oracle::<6>("footprint_end.csv");
    assert!(rows.len() > 40, "only {} rows", rows.len());
    let mut worst = (0.0, [0.0; 6]);
    for row in rows {
        let [half_extent, half_length, shear, offset, end, expected] = row;
        let scratch = ScratchEnd { half_extent, half_length, shear, offset, end };
        let got = response_at_end(scratch).expect("in the domain");
        let without_end = response(half_extent, offset).expect("in the domain");
        let error = (got - expected).abs() / without_end;
        assert!(!error.is_nan(), "{row:?}");
        if error > worst.0 {
            worst = (error, row);
        }
    }
    println!("largest error over the response {:e} at {:?}", worst.0, worst.1);
    assert!(worst.0 <= END_ERROR, "{worst:?}");
}

/// The defining integral over u by Gauss–Legendre panels, after u = 1 − v² at the near rim and
/// u = v² − 1 at the far one: another path than the trapezoidal sum.
#[test]
fn means_match_quadrature_in_panels() {
    let rule = GaussLegendre::new(32);
    let mut worst = 0.0_f64;
    for h in [0.0, 0.01, 0.3, 1.0, 1.4, 2.65, 5.0, 12.0, 30.0] {
        for part in [0.0, 0.2, 0.7, 1.0, 1.1] {
            let s = part * h + 0.3;
            let half = |side: f64| {
                let integrand = |v: f64| {
                    let u = side * (1.0 - v * v);
                    2.0 * v * v * (2.0 - v * v).sqrt() * (-(s - h * u).powi(2)).exp()
                };
                rule.integral_in_panels(integrand, 0.0, 1.0, 40)
            };
            let value = (half(1.0) + half(-1.0)) * 2.0 / PI;
            worst = worst.max(relative_error(response(h, s).expect("in the domain"), value));
        }
    }
    println!("largest relative difference {worst:e}");
    assert!(worst <= 1e-12, "{worst:e}");
}

/// e^(−x) (I₀(x) + I₁(x)), x = h²/2, by the series of A&S 9.6.10: what the response is at s = 0.
#[test]
fn centred_response_matches_bessel_functions() {
    let mut worst = 0.0_f64;
    for h in [0.0_f64, 1e-3, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 15.0, 30.0] {
        let half = 0.25 * h * h;
        // Terms scaled by e^(−x), summed from the first one on; all are positive.
        let (mut log_zero, mut sum) = (-2.0 * half, 0.0);
        for k in 0..4000 {
            let k = f64::from(k);
            let zero = log_zero.exp();
            sum += zero + zero * half / (k + 1.0);
            log_zero += 2.0 * (half.ln() - (k + 1.0).ln());
        }
        worst = worst.max(relative_error(response(h, 0.0).expect("in the domain"), sum));
    }
    println!("largest relative difference {worst:e}");
    // The logarithms of 4000 terms cost a few hundred ulp.
    assert!(worst <= 1e-11, "{worst:e}");
}

#[test]
fn means_at_their_limits() {
    for s in [0.0_f64, 0.5, 3.0, -3.0, 20.0] {
        let point = response(0.0, s).expect("in the domain");
        assert!(relative_error(point, (-s * s).exp()) < 1e-13, "{s}");
        let point = coverage(0.0, s).expect("in the domain");
        assert!(relative_error(point, (-0.5 * s * s).exp()) < 1e-13, "{s}");
    }
    // Far inside a large footprint the Gaussian is short against the ellipse; the next term is
    // relative to it by 1/(4h²) at the centre, from the curvature of the chord.
    let h = 1000.0;
    let centre = response(h, 0.0).expect("in the domain") * h / FRAC_2_SQRT_PI;
    assert!((1.0 - centre - 0.25 / (h * h)).abs() < 1e-11, "{centre}");
    assert_eq!(response(1.0, 1e6), Ok(0.0));
    for h in [0.0, 0.7, 3.0, 300.0] {
        let s = 0.8 * h + 0.4;
        assert_eq!(response(h, s), response(h, -s));
        let scaled = response(h / SQRT_2, s / SQRT_2).expect("in the domain");
        assert!(relative_error(coverage(h, s).expect("in the domain"), scaled) < 1e-12, "{h}");
    }
}

/// ∫ response ds = √π and ∫ coverage ds = √(2π), whatever the footprint.
#[test]
fn means_keep_their_integrals() {
    let rule = GaussLegendre::new(24);
    for h in [0.0, 0.5, 2.0, 9.0] {
        let end = h + 12.0;
        let integral = |mean: fn(f64, f64) -> _| {
            let value = |s| Result::unwrap_or(mean(h, s), f64::NAN);
            2.0 * rule.integral_in_panels(value, 0.0, end, 30)
        };
        assert!(relative_error(integral(response), PI.sqrt()) < 1e-12, "{h}");
        assert!(relative_error(integral(coverage), (2.0 * PI).sqrt()) < 1e-12, "{h}");
    }
}

#[test]
fn scratch_ends_at_their_limits() {
    let at = |shear, offset, end| {
        let scratch = ScratchEnd { half_extent: 2.0, half_length: 3.0, shear, offset, end };
        response_at_end(scratch).expect("in the domain")
    };
    let whole = response(2.0, 0.7).expect("in the domain");
    assert!(relative_error(at(1.0, 0.7, -50.0), whole) < 1e-12);
    assert!(at(1.0, 0.7, 50.0) < 1e-100);
    // Turned by half a turn the footprint is the same.
    assert!(relative_error(at(1.0, 0.7, 0.4), at(-1.0, -0.7, 0.4)) < 1e-13);
    // A point footprint at the end of a scratch: Φ(0)² = 1/4.
    let point =
        ScratchEnd { half_extent: 0.0, half_length: 0.0, shear: 0.0, offset: 0.0, end: 0.0 };
    assert!((response_at_end(point).expect("in the domain") - 0.25).abs() < 1e-15);
}

#[test]
fn arguments_outside_the_domain_are_refused() {
    for (h, s) in [(-1.0, 0.0), (f64::NAN, 0.0), (f64::INFINITY, 0.0), (1.0, f64::NAN)] {
        assert!(response(h, s).is_err() && coverage(h, s).is_err(), "{h} {s}");
    }
    assert_eq!(response(-1.0, 0.0).map_err(|e| e.quantity), Err("h"));
    assert_eq!(coverage(1.0, f64::INFINITY).map_err(|e| e.quantity), Err("s"));
}
