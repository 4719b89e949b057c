//! The band integral B(x₀, x₁) = ∫ sinc²(t/2) dt, sinc u = sin u/u: what a scratch of width W makes of a
//! light that spans q₀ to q₁ across it.
//!
//! Along the bitangent the scratch scatters into the lobe sinc²(kWq/2) (velinov2018 eq. 25). With
//! t = kWq its integral over the light is B(kWq₀, kWq₁)/(kW); by parts ∫ sinc²(t/2) dt =
//! 2 Si(t) − 4 sin²(t/2)/t, which over kW is the bracket of eq. 27, term by term.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | W | width | µm | scratch width, 0.8 to 6 |
//! | k | 2π/λ | 1/µm | wavenumber |
//! | q₀, q₁ | | 1 | ends of the light: differences of direction cosines, in [−2, 2] |
//! | x₀, x₁ | `x0`, `x1` | rad | kWq₀, kWq₁ |
//! | n | | 1 | order of a lobe: kWq in [2πn, 2π(n + 1)]; n = 0 is half of the main lobe |
//! | P(x) | | 1 | B(0, x) = π − 2H(x); the whole axis holds 2π |
//! | H(u) | `excess` + 1/(u + `shift`) | 1 | (π − P)/2 = 1/u − (1/u − f) cos u + g sin u, A&S 5.2.6–7 |
//!
//! Two things are lost by eq. 27 as printed. Si by eq. 29 has a spurious tail 0.34/x, whose difference
//! is of the size of a side lobe. And with any Si the difference of two values near π has an error of
//! some 1e-6, where the lobe n holds 1/(πn²). The forms of striae take differences of what
//! decays, H, and for bands up to one period none at all: there the mean of sinc² is a sum of
//! squares, each relative to the nearest zero of the sine, so that no cancellation is possible and the
//! limits q → 0 and q₀ → q₁ are not special.
//!
//! Eq. 27 is registered with five forms of Si: eq. 29 and the auxiliary functions of 3, 6 and 8 constants
//! and to the rounding of f32. Refits of eq. 29 are left out: they share its text, so that their constants
//! can be passed to `band_printed`. Tables of Si are left out as well: to the rounding of f32 the
//! error of eq. 27 is already that of the difference, which no Si changes.

mod claims;
mod exhibits;
mod laws;
mod lobe_errors;
mod reference;
mod regions;

pub(super) use claims::CLAIMS;
pub(super) use exhibits::exhibits;
pub(super) use laws::LAWS;
pub use reference::sinc_squared_band;
pub(super) use regions::{HARD_CASES, REGIONS};

use crate::effect::Scalar;

/// The band integral, by name.
pub(super) const REFERENCES: &[(&str, Scalar)] = &[
    // A call without its arguments has no value.
    ("sinc_squared_band", |point| match *point {
        [x0, x1, ..] => Ok(sinc_squared_band(x0, x1)),
        _ => Ok(f64::NAN),
    }),
];

/// Eq. 27 with eq. 29: what ships, and what costs and errors are held against.
const PRINTED: &str = "area_light/band_printed";
/// Eq. 27 with Si to the rounding of f32: what is left is the cancellation.
const PRINTED_LARGE: &str = "area_light/band_printed_large";
/// Rule of four nodes; beyond one period the complement over a cubic.
const LEAN: &str = "area_light/band_lean";
/// Rule of four nodes; beyond one period the complement over a quartic.
const MEDIUM: &str = "area_light/band_medium";
/// Rule of five nodes; beyond one period the complement over a sextic.
const LARGE: &str = "area_light/band_large";

#[cfg(test)]
mod tests;
