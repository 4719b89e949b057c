//! A scratch that ends inside the footprint, in f64.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | h | `half_extent` | σ | half-extent of the footprint across the scratch |
//! | l | `half_length` | σ | half the chord of the footprint along the scratch through its centre |
//! | m | `shear` | σ | how far the chord's centre moves along the scratch from the centre to the rim |
//! | s | `offset` | σ | offset of the scratch, across it |
//! | e | `end` | σ | where the scratch begins along its tangent, from the footprint's centre |
//! | Φ | [`normal_cdf`] | 1 | ½ erfc(−x/√2) |
//!
//! At a point (x, y) of the footprint, x along the tangent t and y across, eq. 5 of velinov2018 with
//! ξ₁ = 0 and the scratch reaching from l₁ to ∞ along t is η = d (1 − erf((s_t + l₁ − x)/(√2 σ))): the
//! end lies at e − x from the point, and with d² = π σ²/2 · exp(−(s − y)²)
//!
//! |η|²/(2A_C) = exp(−(s − y)²) (½ erfc((e − x)/√2))² = exp(−(s − y)²) Φ(x − e)².
//!
//! An end towards −t is the mirror image: negate e and m. The points of an ellipse are y = hu,
//! x = mu + lv with u² + v² ≤ 1, whatever its orientation; area and chord are tied by
//! A_P = π h l σ². Along v the mean of Φ² has the primitive
//! K(x) = x Φ² + 2 φ Φ − Φ(√2 x)/√π (its derivative is Φ²: φ'(x) = −x φ and φ(x)² = φ(√2 x)/√(2π)), and across
//! it is the sum of [`super::reference`].

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use super::reference::{finite, length, mean_across, signed_length};
use crate::effect::DomainError;
use crate::numeric::quadrature::GaussLegendre;

/// Half-chord below which the mean along the chord is taken by quadrature, where the difference of
/// the primitive would cancel.
const SHORT_CHORD: f64 = 1.0;

/// The footprint and where the scratch lies in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScratchEnd {
    /// Half-extent of the footprint across the scratch, σ, in [0, 1e4].
    pub half_extent: f64,
    /// Half-chord of the footprint along the scratch through its centre, σ, in [0, 1e4].
    pub half_length: f64,
    /// Displacement of the chord's centre along the scratch from the centre to the rim, σ.
    pub shear: f64,
    /// Offset of the scratch from the centre of the footprint, σ.
    pub offset: f64,
    /// Where the scratch begins along its tangent, from the centre of the footprint, σ.
    pub end: f64,
}

/// Mean over the footprint of |η_s|²/(2A_C) for a scratch that begins at `end` and does not stop.
///
/// Returns a mean, 1, between 0 and [`super::response`]. Error ≤ 1e-9 of the response
/// (`tests/footprint.rs`; 5.8e-16 is the largest measured).
///
/// # Errors
/// [`DomainError`] for an argument outside its domain.
pub fn response_at_end(scratch: ScratchEnd) -> Result<f64, DomainError> {
    let h = length("half_extent", scratch.half_extent)?;
    let l = length("half_length", scratch.half_length)?;
    let shear = signed_length("shear", scratch.shear)?;
    let offset = finite("offset", scratch.offset)?;
    let end = finite("end", scratch.end)?;
    // The mean is even in the offset once the chord moves the other way.
    let shear = if offset < 0.0 { -shear } else { shear };
    let rule = GaussLegendre::new(20);
    Ok(mean_across(h, offset, l * l + shear * shear, |cos, sin| {
        mean_along(shear * cos - end, l * sin.abs(), &rule)
    }))
}

/// Mean of Φ² over [centre − half, centre + half].
fn mean_along(centre: f64, half: f64, rule: &GaussLegendre) -> f64 {
    let (from, to) = (centre - half, centre + half);
    if half < SHORT_CHORD {
        let square = |v: f64| normal_cdf(centre + half * v).powi(2);
        0.5 * rule.integral(square, -1.0, 1.0)
    } else {
        (primitive(to) - primitive(from)) / (2.0 * half)
    }
}

/// K(x), whose derivative is Φ(x)².
fn primitive(x: f64) -> f64 {
    let (cdf, density) = (normal_cdf(x), core_math::exp(-0.5 * x * x) / (2.0 * PI).sqrt());
    cdf * (x * cdf + 2.0 * density) - normal_cdf(SQRT_2 * x) / PI.sqrt()
}

/// Normal distribution function Φ(x) = ½ erfc(−x/√2).
fn normal_cdf(x: f64) -> f64 {
    0.5 * core_math::erfc(-x * FRAC_1_SQRT_2)
}
