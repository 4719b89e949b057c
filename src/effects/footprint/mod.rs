//! The camera footprint: what a pixel that covers an ellipse of surface sees of a scratch.
//!
//! # Symbols
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | σ | | µm | radius of the coherence area, 60 in velinov2018 |
//! | A_C | | σ² | coherence area π σ² |
//! | A_P | | σ² | area of the footprint, an ellipse |
//! | A_P/A_C | `area_ratio` | 1 | h times the half-chord along the scratch through the centre, both over σ |
//! | h | `h` | σ | half-extent of the ellipse across the scratch |
//! | s | `s` | σ | offset of the scratch from the centre of the footprint, across it |
//! | l | `l_contained` | σ | length of the scratch inside the footprint |
//!
//! # What depends on what
//!
//! At a point at the distance y from an infinite scratch |η_s|² = 2A_C exp(−y²/σ²) (eq. 10) and
//! ρ_c = √(2π) σ W/A_C · exp(−y²/(2σ²)) (eq. 17): both depend on the position across the scratch alone.
//! Across it an ellipse of any orientation is the unit disc stretched by h, whose chords have
//! lengths in proportion to √(1 − u²), u = y/h. With lengths in units of σ the means are
//!
//! footprint_response(h, s) = (2/π) ∫₋₁¹ √(1 − u²) exp(−(s − hu)²) du,
//! footprint_coverage(h, s) = (2/π) ∫₋₁¹ √(1 − u²) exp(−(s − hu)²/2) du
//!                          = footprint_response(h/√2, s/√2),
//!
//! and neither the area nor the eccentricity enters. Both are 1 at h = s = 0, even in s, and their
//! integrals over s are √π and √(2π) for every h. At s = 0 the response is e^(−h²/2) (I₀ + I₁)(h²/2).
//! For h → 0 they are the Gaussians; for h → ∞ the Gaussian is short against the ellipse and the
//! response becomes √π times the chord density (2/π) √(h² − s²)/h², the coverage √2 times that.
//!
//! # The paper's forms in these terms
//!
//! A_P = π h·(half-chord through the centre)·σ², so that l/A_P = 2 √(h² − s²)/(π h² σ): the contained
//! length that eq. 15, 16 and 18 take from a line–ellipse intersection is a function of h and s too.
//! Eq. 16 approximates A_P⁻¹ ∫ |η_s|² = 2A_C · footprint_response; divided by 2A_C = 2πσ² it reads
//! α (2/√π) √(h² − s²)/h² + (1 − α) e^(−s²)/π, whose second term lacks a π. Eq. 18 divided by
//! √(2π) σ W/A_C reads √(8/π) √(h² − s²)/h². Only α = min(A_P/(2A_C), 1) knows the area.
//!
//! # The soft chord
//!
//! Squared, the response is a parabola in s inside a large footprint and exp(−2s²) for a small one.
//! Both are c·ln(1 + exp(a − b s²)): the parabola for a ≫ 1, the Gaussian for a ≪ −1. With free a, b
//! and c the relative L2 error over s stays below 0.6 % for every h; the forms make a, b and c
//! rational in h over powers of one cubic, with the large limit built in, for one division.

mod claims;
mod end;
mod exhibits;
mod laws;
mod line;
mod pixels;
mod reference;
mod regions;

pub use end::{ScratchEnd, response_at_end};
pub use reference::{coverage, response};

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions, Scalar, arguments};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/footprint/forms");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    let functions = Functions {
        forms: || FormText::embedded("src/effects/footprint/forms", &FORMS),
        references: REFERENCES,
        regions: regions::REGIONS,
        hard_cases: regions::HARD_CASES,
        laws: laws::LAWS,
        claims: claims::CLAIMS,
        exhibits: exhibits::exhibits,
        ..Functions::NONE
    };
    Effect::of_text(include_str!("effect.toml"), functions)
});

const REFERENCES: &[(&str, Scalar)] = &[
    ("footprint_response", |point| arguments(point).and_then(|[h, s]| response(h, s))),
    ("footprint_coverage", |point| arguments(point).and_then(|[h, s]| coverage(h, s))),
    ("footprint_end", |point| {
        let [half_extent, half_length, shear, offset, end] = arguments(point)?;
        response_at_end(ScratchEnd { half_extent, half_length, shear, offset, end })
    }),
];

#[cfg(test)]
mod tests;
