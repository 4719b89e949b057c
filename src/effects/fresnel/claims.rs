//! What is printed about these approximations, beside what is found.

use crate::effect::claim::ClaimCheck;
use crate::effect::{Candidates, ClaimError, Found};
use crate::effects::fresnel::reference::{Reflectance, conductor};

/// Karis' constants, as printed: 2^((A mu − B) mu).
const KARIS: (f64, f64) = (-5.55473, 6.98316);
/// The first of them with two digits exchanged, as it shipped in three.js until PR #7625.
const TRANSPOSED_A: f64 = -5.55437;
/// Half of what an 8-bit channel resolves.
const HALF_STEP: f64 = 0.5 / 255.0;

/// Checks of the claims, by name.
pub(super) const CLAIMS: &[(&str, ClaimCheck<Candidates>)] = &[
    ("spherical_gaussian", spherical_gaussian),
    ("transposition", transposition),
    ("high_index", high_index),
];

/// Cosines at which differences are searched.
fn cosines() -> impl Iterator<Item = f64> {
    (0..=20_000).map(|i| f64::from(i) / 20_000.0)
}

fn weight(mu: f64, (a, b): (f64, f64)) -> f64 {
    ((a * mu - b) * mu).exp2()
}

fn schlick_weight(mu: f64) -> f64 {
    (1.0 - mu).powi(5)
}

/// What the weight as printed is off by.
fn printed_error(mu: f64) -> f64 {
    weight(mu, KARIS) - schlick_weight(mu)
}

/// Largest magnitude of `difference` and where it is.
fn largest(difference: impl Fn(f64) -> f64) -> (f64, f64) {
    cosines()
        .map(|mu| (difference(mu).abs(), mu))
        .fold((0.0, 0.0), |worst, here| if here.0 > worst.0 { here } else { worst })
}

fn spherical_gaussian(candidates: &Candidates) -> Result<Found, ClaimError> {
    let (error, at) = largest(printed_error);
    let count = cosines().count() as f64;
    let rms = (cosines().map(|mu| printed_error(mu).powi(2)).sum::<f64>() / count).sqrt();
    let fitted = candidates.get("fresnel/spherical_gaussian_weight")?;
    let of =
        |name| fitted.shipped().find(|found| found.0 == name).map_or(f64::NAN, |found| found.1);
    let (a, b) = (of("a"), of("b"));
    // To all printed digits.
    let reproduced = (a - KARIS.0).abs() <= 1e-5 && (b - KARIS.1).abs() <= 1e-5;
    let found = format!(
        "RMS {rms:.2e}, largest difference {error:.2e} at mu = {at:.3}, {:.1} steps of an 8-bit \
         linear channel; least squares over even mu gives {a:.5} and {:.5}, {}",
        error * 255.0,
        -b,
        if reproduced { "the printed constants" } else { "other constants" }
    );
    let visible = error > HALF_STEP;
    Ok(Found::new(found, if visible { "holds to a step of 8 bits" } else { "holds" }))
}

fn transposition(_: &Candidates) -> Result<Found, ClaimError> {
    let transposed = (TRANSPOSED_A, KARIS.1);
    let (difference, at) = largest(|mu| weight(mu, transposed) - weight(mu, KARIS));
    let found = format!(
        "moves the weight by {difference:.1e} at most (mu = {at:.2}), {:.0} times less than the \
         approximation is off: no image shows it, only the constant itself does",
        largest(printed_error).0 / difference
    );
    Ok(Found::new(found, "differs"))
}

fn high_index(_: &Candidates) -> Result<Found, ClaimError> {
    let gap = |n: f64, k: f64| {
        largest(|mu| {
            let exact = conductor(mu, n, k).map_or(f64::NAN, Reflectance::mean);
            limit_of_high_index(mu, n, n.mul_add(n, k * k)) - exact
        })
    };
    let (gold, silicon, glass) = (gap(0.2, 3.0), gap(4.1, 0.05), gap(1.5, 0.0));
    let found = format!(
        "the limit of a high index: off by {:.1e} for n = 0.2, k = 3 (mu = {:.2}), {:.1e} for \
         n = 4.1, k = 0.05, and {:.1e} for glass, n = 1.5 (mu = {:.2})",
        gold.0, gold.1, silicon.0, glass.0, glass.1
    );
    Ok(Found::new(found, "holds for metals, not for glass"))
}

/// The listing's formula, `modulus` = n² + k².
fn limit_of_high_index(mu: f64, n: f64, modulus: f64) -> f64 {
    let cross = 2.0 * n * mu;
    let s = (modulus - cross + mu * mu) / (modulus + cross + mu * mu);
    let even = modulus * mu * mu + 1.0;
    f64::midpoint(s, (even - cross) / (even + cross))
}
