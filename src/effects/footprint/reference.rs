//! Means over an elliptical footprint, in f64.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | h | `half_extent` | σ | half-extent of the ellipse across the scratch |
//! | s | `offset` | σ | offset of the scratch from the centre of the footprint, across it |
//! | θ | `angle` | rad | u = cos θ, position across the footprint over h |
//! | t = s − h cos θ | | σ | distance from the scratch |
//!
//! With u = cos θ the mean is (2/π) ∫₀^π sin²θ exp(−(s − h cos θ)²) dθ: half a period of an even,
//! entire function of period 2π, whose trapezoidal sum converges faster than geometrically once it
//! resolves the Gaussian. Every term is positive, so that the sum keeps its relative error however
//! far the scratch is outside. On the strip |Im θ| ≤ y the integrand grows by exp(G sinh² y) at
//! most, G = h² + 2h·max(s − h, 0); N points on the circle leave exp(G sinh² y − N y), which for
//! N = 64 + 15 √G is below 1e-17 at the best y. Points with t² more than 50 above its smallest
//! value are left out: together they are below 1e-19 of the sum.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use crate::effect::DomainError;
use crate::numeric::statistics::sum;

/// Largest half-extent, half-length and shear, in units of σ.
const LARGEST: f64 = 1e4;
/// How far t² may be above its smallest value before a point is left out.
const DEEPEST: f64 = 50.0;

/// Mean of exp(−s²) over the footprint, s the distance from the scratch over σ: the spatial part of
/// the response, eq. 10 of velinov2018 over 2A_C.
///
/// `half_extent`: h, σ, in [0, 1e4]. `offset`: s, σ, any finite. Returns a mean, 1, in [0, 1], even
/// in the offset. Relative error ≤ 1e-10 for h ≤ 1000 where the value exceeds 1e-300
/// (`tests/footprint.rs`; 9.3e-14 is the largest measured, 1.4e-12 that of [`coverage`]).
///
/// # Errors
/// [`DomainError`] for an argument outside its domain.
pub fn response(half_extent: f64, offset: f64) -> Result<f64, DomainError> {
    let h = length("h", half_extent)?;
    Ok(mean_across(h, finite("s", offset)?, 0.0, |_, _| 1.0))
}

/// Mean of exp(−s²/2) over the footprint: the spatial part of the area density, eq. 17 of
/// velinov2018. It is the response of a coherence area √2 times as wide.
///
/// Arguments, value and accuracy as of [`response`].
///
/// # Errors
/// [`DomainError`] for an argument outside its domain.
pub fn coverage(half_extent: f64, offset: f64) -> Result<f64, DomainError> {
    let h = length("h", half_extent)? * FRAC_1_SQRT_2;
    Ok(mean_across(h, finite("s", offset)? * FRAC_1_SQRT_2, 0.0, |_, _| 1.0))
}

/// (2/π) ∫₀^π sin²θ exp(−(s − h cos θ)²) f(cos θ, sin θ) dθ for an f that is even in sin θ and grows
/// on |Im θ| ≤ y by exp(`growth` sinh² y) at most.
pub(super) fn mean_across(
    half_extent: f64,
    offset: f64,
    growth: f64,
    f: impl Fn(f64, f64) -> f64,
) -> f64 {
    let (h, s) = (half_extent, offset.abs());
    // s − h cos θ = outside + 2h sin²(θ/2): no cancellation where the scratch is outside.
    let outside = s - h;
    let nearest = outside.max(0.0);
    let reach = (nearest * nearest + DEEPEST).sqrt();
    let growth = growth + h * h + 2.0 * h * nearest;
    // Beyond it the value is 0 in f64, and the count of points would be of no use.
    if nearest > 40.0 {
        return 0.0;
    }
    let points = (64.0 + 15.0 * growth.sqrt()).ceil();
    let step = TAU / points;
    let interior = (0.5 * points).ceil() - 1.0;
    let (first, last) = if h > 0.0 {
        let first = ((s + reach) / h).min(1.0).acos() / step;
        let last = ((s - reach) / h).max(-1.0).acos() / step;
        (first.floor().max(1.0), last.ceil().min(interior))
    } else {
        (1.0, interior)
    };
    let terms = (first as u64..=last as u64).map(|j| {
        let angle = j as f64 * step;
        let (sin, cos) = core_math::sincos(angle);
        let half_sin = core_math::sin(0.5 * angle);
        let t = outside + 2.0 * h * half_sin * half_sin;
        sin * sin * core_math::exp(-t * t) * f(cos, sin)
    });
    sum(terms) * step * (2.0 / PI)
}

/// A length in [0, [`LARGEST`]].
pub(super) fn length(quantity: &'static str, got: f64) -> Result<f64, DomainError> {
    DomainError::unless((0.0..=LARGEST).contains(&got), quantity, got, "[0, 1e4]")
}

/// A number in [−[`LARGEST`], [`LARGEST`]].
pub(super) fn signed_length(quantity: &'static str, got: f64) -> Result<f64, DomainError> {
    DomainError::unless(got.abs() <= LARGEST, quantity, got, "[-1e4, 1e4]")
}

/// Any finite number.
pub(super) fn finite(quantity: &'static str, got: f64) -> Result<f64, DomainError> {
    DomainError::unless(got.is_finite(), quantity, got, "any finite")
}
