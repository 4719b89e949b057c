//! What is printed about these approximations, beside what is found.

use crate::effect::{Finding, FittedConstants};
use crate::effects::fresnel::reference::{Reflectance, conductor};

/// Karis' constants, as printed: 2^((A mu − B) mu).
const KARIS: (f64, f64) = (-5.55473, 6.98316);
/// The first of them with two digits exchanged, as it shipped in three.js until PR #7625.
const TRANSPOSED_A: f64 = -5.55437;
/// Fit of the weight, whose constants stand beside Karis'.
const WEIGHT_FIT: &str = "fresnel/spherical_gaussian_weight";
/// Half of what an 8-bit channel resolves.
const HALF_STEP: f64 = 0.5 / 255.0;

pub(super) fn findings(fitted: &FittedConstants) -> Vec<Finding> {
    vec![spherical_gaussian(fitted), transposition(), high_index()]
}

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

/// Largest magnitude of `difference` and where it is.
fn largest(difference: impl Fn(f64) -> f64) -> (f64, f64) {
    cosines()
        .map(|mu| (difference(mu).abs(), mu))
        .fold((0.0, 0.0), |worst, here| if here.0 > worst.0 { here } else { worst })
}

fn root_mean_square(difference: impl Fn(f64) -> f64) -> f64 {
    let count = cosines().count() as f64;
    (cosines().map(|mu| difference(mu).powi(2)).sum::<f64>() / count).sqrt()
}

fn spherical_gaussian(fitted: &FittedConstants) -> Finding {
    let against = |constants| move |mu| weight(mu, constants) - schlick_weight(mu);
    let (error, at) = largest(against(KARIS));
    let rms = root_mean_square(against(KARIS));
    let refit = fitted.0.get(WEIGHT_FIT).and_then(|fit| Some((*fit.get("a")?, *fit.get("b")?)));
    let beside = refit.map_or_else(String::new, |constants| {
        format!(
            "; least squares over even mu gives {:.5} and {:.5}, {}",
            constants.0,
            -constants.1,
            if reproduces(constants) { "the printed constants" } else { "other constants" }
        )
    });
    let visible = error > HALF_STEP;
    Finding {
        place: "Karis, Real Shading in Unreal Engine 4 (2013), Fresnel".into(),
        printed: "2^((-5.55473 mu - 6.98316) mu) for (1 - mu)^5: the difference is imperceptible"
            .into(),
        found: format!(
            "RMS {rms:.2e}, largest difference {error:.2e} at mu = {at:.3}, {:.1} steps of an \
             8-bit linear channel{beside}",
            error * 255.0
        ),
        verdict: if visible { "holds to a step of 8 bits" } else { "holds" }.into(),
        command: "striae fit fresnel/spherical_gaussian_weight".into(),
    }
}

/// Whether fitted constants agree with the printed ones to all printed digits.
fn reproduces((a, b): (f64, f64)) -> bool {
    let last_digit = 1e-5;
    (a - KARIS.0).abs() <= last_digit && (b - KARIS.1).abs() <= last_digit
}

fn transposition() -> Finding {
    let transposed = (TRANSPOSED_A, KARIS.1);
    let (difference, at) = largest(|mu| weight(mu, transposed) - weight(mu, KARIS));
    let (error, _) = largest(|mu| weight(mu, KARIS) - schlick_weight(mu));
    Finding {
        place: "three.js before PR #7625".into(),
        printed: "-5.55437 in place of -5.55473".into(),
        found: format!(
            "moves the weight by {difference:.1e} at most (mu = {at:.2}), {:.0} times less than \
             the approximation is off: no image shows it, only the constant itself does",
            error / difference
        ),
        verdict: "differs".into(),
        command: "striae check".into(),
    }
}

fn high_index() -> Finding {
    let gap = |n: f64, k: f64| {
        largest(|mu| {
            let exact = conductor(mu, n, k).map_or(f64::NAN, Reflectance::mean);
            limit_of_high_index(mu, n, n.mul_add(n, k * k)) - exact
        })
    };
    let (gold, silicon, glass) = (gap(0.2, 3.0), gap(4.1, 0.05), gap(1.5, 0.0));
    Finding {
        place: "Gulbrandsen, Artist friendly metallic Fresnel (2014), listing".into(),
        printed:
            "r_s = (n^2 + k^2 - 2 n c + c^2)/(n^2 + k^2 + 2 n c + c^2), and r_p alike, as the \
                  reflectance of a conductor"
                .into(),
        found: format!(
            "the limit of a high index: off by {:.1e} for n = 0.2, k = 3 (mu = {:.2}), {:.1e} for \
             n = 4.1, k = 0.05, and {:.1e} for glass, n = 1.5 (mu = {:.2})",
            gold.0, gold.1, silicon.0, glass.0, glass.1
        ),
        verdict: "holds for metals, not for glass".into(),
        command: "striae fit fresnel/gulbrandsen fresnel/gulbrandsen_exact".into(),
    }
}

/// The listing's formula, `modulus` = n² + k².
fn limit_of_high_index(mu: f64, n: f64, modulus: f64) -> f64 {
    let cross = 2.0 * n * mu;
    let s = (modulus - cross + mu * mu) / (modulus + cross + mu * mu);
    let even = modulus * mu * mu + 1.0;
    f64::midpoint(s, (even - cross) / (even + cross))
}
