//! The band integral against an oracle made with mpmath, against two other methods, and its symmetries.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use striae::effects::area_light::band::sinc_squared_band;
use striae::effects::sine_integral::sine_integral;

/// Relative error stated in the documentation of `sinc_squared_band`.
const BAND_ERROR: f64 = 1e-13;

/// Rows (x0, x1, value) of the oracle.
fn oracle() -> Vec<[f64; 3]> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/sinc_squared_band.csv");
    let mut reader = csv::Reader::from_path(&path).expect("the oracle is committed");
    let number = |text: &str| text.parse::<f64>().expect("an oracle holds numbers");
    let rows = reader.records().map(|row| row.expect("an oracle is well-formed"));
    rows.map(|row| [number(&row[0]), number(&row[1]), number(&row[2])]).collect()
}

fn relative_error(got: f64, expected: f64) -> f64 {
    if got == expected { 0.0 } else { ((got - expected) / expected).abs() }
}

#[test]
fn matches_mpmath() {
    let rows = oracle();
    assert!(rows.len() > 1000, "only {} rows", rows.len());
    let mut worst = (0.0, 0.0, 0.0);
    for [x0, x1, value] in rows {
        let error = relative_error(sinc_squared_band(x0, x1), value);
        // Below it a value has fewer digits than an error of 1e-13 needs.
        if value.abs() < f64::MIN_POSITIVE {
            assert!((sinc_squared_band(x0, x1) - value).abs() <= 5e-324, "{x0:e} {x1:e}");
        } else if error > worst.0 || error.is_nan() {
            worst = (error, x0, x1);
        }
    }
    println!("largest relative error {:e} on [{:e}, {:e}]", worst.0, worst.1, worst.2);
    assert!(worst.0 <= BAND_ERROR, "{worst:?}");
}

/// P by its power series, 2 Σ (−1)ᵏ x²ᵏ⁺¹/((2k + 2)! (2k + 1)): an independent path near 0.
fn series(x: f64) -> f64 {
    let (mut sum, mut term) = (0.0, x);
    for k in 0..40 {
        // term = 2 (−1)ᵏ x²ᵏ⁺¹/(2k + 2)!
        let odd = f64::from(2 * k + 1);
        sum += term / odd;
        term *= -x * x / ((odd + 2.0) * (odd + 3.0));
    }
    sum
}

#[test]
fn matches_its_power_series() {
    let mut worst = 0.0_f64;
    for i in 1..400 {
        let x = 0.01 * f64::from(i);
        worst = worst.max(relative_error(sinc_squared_band(0.0, x), series(x)));
        let across = sinc_squared_band(-0.5 * x, x);
        worst = worst.max(relative_error(across, series(x) + series(0.5 * x)));
    }
    println!("largest relative difference {worst:e}");
    // The terms of the series cancel by a factor of 3 at x = 4: measured 1.0e-15.
    assert!(worst <= 1e-14, "{worst:e}");
}

/// Eq. 27 with the reference's Si, where its cancellation leaves enough.
#[test]
fn matches_the_printed_primitive() {
    let primitive = |x: f64| {
        let sine = core_math::sin(0.5 * x);
        if x == 0.0 { 0.0 } else { 2.0 * sine_integral(x) - 4.0 * sine * sine / x }
    };
    let mut rng = ChaCha12Rng::seed_from_u64(27);
    let mut worst = 0.0_f64;
    for _ in 0..4000 {
        let (a, b) = (rng.random_range(-300.0..300.0), rng.random_range(-300.0..300.0));
        worst = worst.max((sinc_squared_band(a, b) - (primitive(b) - primitive(a))).abs());
    }
    println!("largest difference {worst:e}");
    // A few ulp of 2 pi, 8.9e-16.
    assert!(worst <= 5e-15, "{worst:e}");
}

/// On a band a few ulp wide about x the value is width times sinc², whose argument is known exactly.
#[test]
fn narrow_bands_are_width_times_the_integrand() {
    for x in [0.5, 3.0, 7.0, 31.0, 1e3 + 0.5, 1e5 + 0.5] {
        let next = f64::from_bits(f64::to_bits(x) + 3);
        let sinc = core_math::sin(0.5 * x) / (0.5 * x);
        let expected = (next - x) * sinc * sinc;
        assert!(relative_error(sinc_squared_band(x, next), expected) < 1e-10, "{x}");
    }
}

#[test]
fn bands_add_up() {
    let mut rng = ChaCha12Rng::seed_from_u64(28);
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        let a = 10_f64.powf(rng.random_range(-2.0..5.0));
        let b = a + 10_f64.powf(rng.random_range(-2.0..3.0));
        let c = b + 10_f64.powf(rng.random_range(-2.0..3.0));
        let parts = sinc_squared_band(a, b) + sinc_squared_band(b, c);
        worst = worst.max(relative_error(parts, sinc_squared_band(a, c)));
    }
    println!("largest relative seam {worst:e}");
    assert!(worst <= 2.0 * BAND_ERROR, "{worst:e}");
}

#[test]
fn odd_under_swapping_and_even_under_mirroring_to_the_bit() {
    let mut rng = ChaCha12Rng::seed_from_u64(29);
    for _ in 0..1000 {
        let (a, b) = (rng.random_range(-200.0..200.0), rng.random_range(-200.0..200.0));
        let value = sinc_squared_band(a, b);
        assert_eq!(sinc_squared_band(b, a).to_bits(), (-value).to_bits(), "{a} {b}");
        assert_eq!(sinc_squared_band(-b, -a).to_bits(), value.to_bits(), "{a} {b}");
        assert!(value * (b - a) > 0.0 && value.abs() < TAU);
    }
    assert!((sinc_squared_band(0.0, 1e15) - PI).abs() < 1e-14);
}
