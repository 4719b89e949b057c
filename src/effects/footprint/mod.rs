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
mod hard_cases;
mod laws;
mod line;
mod pixels;
mod reference;
mod regions;

pub use end::{ScratchEnd, response_at_end};
pub use reference::{coverage, response};

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, Evaluate, FormText, Goal, Quantity, Reference, arguments};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/footprint/forms");

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "footprint",
    title: "Camera footprint",
    description: "What a pixel sees of a scratch: the means of the scratch's response and of its \
                  area density over the ellipse of surface that the pixel covers. A renderer takes \
                  both once per scratch and pixel; they make thin scratches connected lines \
                  instead of dotted ones.",
    references: &[RESPONSE, COVERAGE, END],
    forms: || FormText::embedded("src/effects/footprint/forms", &FORMS),
    regions: regions::REGIONS,
    hard_cases: hard_cases::HARD_CASES,
    laws: laws::LAWS,
    goals: &[
        Goal {
            fit: "footprint/soft_chord",
            region: "every half-extent",
            error: 0.02,
            cost: 2.0,
            why: "2 % over the offset for every half-extent from 0.05 to 30, at no more than twice \
                  the corrected eq. 16",
        },
        Goal {
            fit: "footprint/coverage_soft_chord",
            region: "every half-extent",
            error: 0.02,
            cost: 2.0,
            why: "the same for the coverage, at no more than twice eq. 18 blended as eq. 16 is",
        },
    ],
    baselines: &["footprint/eq16", "footprint/coverage_blend_area", "footprint/end_contained"],
    claims: claims::CLAIMS,
    exhibits: exhibits::exhibits,
    ..Effect::EMPTY
};

const H: Quantity = Quantity { name: "h", unit: "1", domain: "[0, 1e4]" };
const S: Quantity = Quantity { name: "s", unit: "1", domain: "any finite" };

const RESPONSE: Reference = Reference {
    name: "footprint_response",
    description: "mean of exp(-s^2) over an ellipse of half-extent h across the scratch, centred at \
                  the offset s, both over sigma",
    arguments: &[H, S],
    unit: "1",
    accuracy: "relative error <= 1e-10 for h <= 1000 where the value exceeds 1e-300 \
               (tests/footprint.rs)",
    source: "velinov2018 eq. 10 and 13, integrated exactly",
    evaluate: Evaluate::Scalar(|point| {
        let [h, s] = arguments(point)?;
        response(h, s)
    }),
};

const COVERAGE: Reference = Reference {
    name: "footprint_coverage",
    description: "mean of exp(-s^2/2) over an ellipse of half-extent h across the scratch, centred \
                  at the offset s, both over sigma",
    arguments: &[H, S],
    unit: "1",
    accuracy: "relative error <= 1e-10 for h <= 1000 where the value exceeds 1e-300 \
               (tests/footprint.rs)",
    source: "velinov2018 eq. 17 and 18, integrated exactly",
    evaluate: Evaluate::Scalar(|point| {
        let [h, s] = arguments(point)?;
        coverage(h, s)
    }),
};

const SIGNED: &str = "[-1e4, 1e4]";

const END: Reference = Reference {
    name: "footprint_end",
    description: "mean over an ellipse of the response of a scratch that begins inside it, over that \
                  of an infinite scratch through the point",
    arguments: &[
        Quantity { name: "half_extent", unit: "1", domain: "[0, 1e4]" },
        Quantity { name: "half_length", unit: "1", domain: "[0, 1e4]" },
        Quantity { name: "shear", unit: "1", domain: SIGNED },
        Quantity { name: "offset", unit: "1", domain: "any finite" },
        Quantity { name: "end", unit: "1", domain: "any finite" },
    ],
    unit: "1",
    accuracy: "error <= 1e-9 of footprint_response (tests/footprint.rs)",
    source: "velinov2018 eq. 5 with xi_1 = 0, integrated over the footprint",
    evaluate: Evaluate::Scalar(|point| {
        let [half_extent, half_length, shear, offset, end] = arguments(point)?;
        response_at_end(ScratchEnd { half_extent, half_length, shear, offset, end })
    }),
};

#[cfg(test)]
mod tests;
