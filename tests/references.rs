//! References against a second method and against an oracle made with mpmath.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use striae::effects::sine_integral::{auxiliary, sine_integral};
use striae::numeric::quadrature::GaussLegendre;

/// Relative error stated in the documentation of `sine_integral`.
const SINE_INTEGRAL_ERROR: f64 = 1e-14;

/// Rows (x, value) of a two-column oracle in `tests/oracles`.
fn oracle(name: &str) -> Vec<(f64, f64)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles").join(name);
    let mut reader = csv::Reader::from_path(&path).expect("the oracle is committed");
    let number = |text: &str| text.parse::<f64>().expect("an oracle holds numbers");
    reader
        .records()
        .map(|row| {
            let row = row.expect("an oracle is well-formed");
            (number(&row[0]), number(&row[1]))
        })
        .collect()
}

fn relative_error(got: f64, expected: f64) -> f64 {
    if got == expected { 0.0 } else { ((got - expected) / expected).abs() }
}

#[test]
fn sine_integral_matches_mpmath() {
    let rows = oracle("sine_integral.csv");
    assert!(rows.len() > 500, "only {} rows", rows.len());
    let (error, x) = rows
        .iter()
        .map(|&(x, value)| (relative_error(sine_integral(x), value), x))
        .fold((0.0, 0.0), |worst, here| if here.0 > worst.0 { here } else { worst });
    println!("largest relative error {error:e} at {x:e}");
    assert!(error <= SINE_INTEGRAL_ERROR, "{error:e} at {x:e}");
}

/// The defining integral, panel by panel: an independent path to every branch of the reference.
#[test]
fn sine_integral_matches_quadrature() {
    let rule = GaussLegendre::new(24);
    let sinc = |t: f64| if t == 0.0 { 1.0 } else { core_math::sin(t) / t };
    // Panels of length 1/2 are integrated to rounding by 24 nodes; 400 of them reach x = 200.
    let (mut integral, mut worst) = (0.0, 0.0_f64);
    for k in 0..400 {
        let (a, b) = (0.5 * f64::from(k), 0.5 * f64::from(k + 1));
        for part in [0.1, 0.35, 0.8] {
            let x = a + part * (b - a);
            let value = integral + rule.integral(sinc, a, x);
            worst = worst.max(relative_error(sine_integral(x), value));
        }
        integral += rule.integral(sinc, a, b);
    }
    println!("largest relative difference {worst:e}");
    // The running sum of 400 panels costs a few ulp of its own: measured 1.1e-15.
    assert!(worst <= SINE_INTEGRAL_ERROR, "{worst:e}");
}

#[test]
fn sine_integral_at_its_ends() {
    assert_eq!(sine_integral(f64::INFINITY), FRAC_PI_2);
    assert_eq!(sine_integral(f64::NEG_INFINITY), -FRAC_PI_2);
    assert!(sine_integral(f64::NAN).is_nan() && sine_integral(-f64::NAN).is_nan());
    assert_eq!(sine_integral(0.0).to_bits(), 0.0_f64.to_bits());
    assert_eq!(sine_integral(-0.0).to_bits(), (-0.0_f64).to_bits());
    assert_eq!(sine_integral(5e-324), 5e-324);
    assert_eq!(sine_integral(f64::MAX), FRAC_PI_2);
}

#[test]
fn sine_integral_is_odd_to_the_bit() {
    let mut rng = ChaCha12Rng::seed_from_u64(5);
    for _ in 0..20_000 {
        let x = f64::from_bits(rng.random::<u64>());
        if !x.is_nan() {
            assert_eq!(sine_integral(-x).to_bits(), (-sine_integral(x)).to_bits(), "{x:e}");
        }
    }
}

/// f and g against Laplace's integrals, A&S 5.2.12–13: f = ∫₀^∞ e^(−xt)/(1 + t²) dt and
/// g = ∫₀^∞ t e^(−xt)/(1 + t²) dt, cut where the exponential is below 1e-18.
#[test]
fn auxiliary_functions_match_their_laplace_integrals() {
    let rule = GaussLegendre::new(32);
    let mut worst = 0.0_f64;
    for x in [0.5, 1.0, 2.0, 3.0, 3.9, 4.0, 4.1, 5.0, 8.0, 20.0, 39.9, 40.0, 41.0, 100.0, 1e3, 1e6]
    {
        let end = 42.0 / x;
        let decay = |t: f64| core_math::exp(-x * t) / (1.0 + t * t);
        let panels = 40 + (end * 8.0) as usize;
        let f = rule.integral_in_panels(decay, 0.0, end, panels);
        let g = rule.integral_in_panels(|t| t * decay(t), 0.0, end, panels);
        let (got_f, got_g) = auxiliary(x);
        worst = worst.max((got_f - f).abs() / f).max((got_g - g).abs() / f);
    }
    println!("largest difference relative to f {worst:e}");
    // Stated: 1e-14 f(x), of either.
    assert!(worst <= 1e-14, "{worst:e}");
}

#[test]
fn auxiliary_functions_at_pi_and_at_their_ends() {
    // At π the sine vanishes and the cosine is −1: Si(π) = π/2 + f(π), A&S 5.2.8.
    let (f, _) = auxiliary(PI);
    assert!((f - (sine_integral(PI) - FRAC_PI_2)).abs() < 1e-15);
    assert_eq!(auxiliary(0.0), (FRAC_PI_2, f64::INFINITY));
    let (f, g) = auxiliary(1e300);
    assert_eq!((f, g), (1e-300, 0.0));
    for outside in [-1.0, f64::NEG_INFINITY, f64::NAN] {
        assert!(auxiliary(outside).0.is_nan() && auxiliary(outside).1.is_nan());
    }
}
