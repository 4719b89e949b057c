//! Diffraction by the relief of a surface: tables of where light goes, and the powers of orders.
//!
//! # Symbols
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | ω_i, ω_o, n | | 1 | unit vectors to the light, to the eye, and the normal |
//! | h | `h_x`, `h_y` | 1 | ω_i + ω_o projected onto tangent and bitangent, not normalised |
//! | w | `w` | 1 | ω_i·n + ω_o·n, in (0, 2] |
//! | λ, k | `wavelength_nm`, 2π/λ | nm | wavelength |
//! | z(x) | `height_nm` | nm | height of the surface |
//! | a(x) | `amplitude` | 1 | amplitude of reflection: window and mask |
//! | p(x) | | 1 | phase screen a e^(−ikwz) |
//! | P(f) | | µm² | ∫∫ p e^(−2πi f·x) dx |
//! | A | | µm² | ∫∫ \|a\|² dx, the area of the patch |
//! | S_d(h) | the table | sr⁻¹ | share of the power per area of h |
//! | F, G | | 1 | Fresnel's amplitude, and Stam's factor (1 + ω_i·ω_o)²/(cos θ_i cos θ_o) |
//!
//! # The table
//!
//! A wave from −ω_i and one to ω_o give a point r of the surface the phase −k (ω_i + ω_o)·r
//! = −k h·x − k w z. So the light at h is P(h/λ). Parseval: ∫∫ |P(f)|² df = A, and df = dh/λ², so
//!
//! S_d(h) = |P(h/λ)|²/(A λ²), ∫∫ S_d dh = 1
//!
//! for a surface that reflects everything. Its colour channels are Σ_λ w_c(λ) S_d,λ(h), the weights of
//! linear sRGB with Σ_λ w_c = 1 ([`IlluminantChoice`]): they may be negative outside the gamut.
//!
//! The sign of the phase: stationary phase sends light to h = −w ∇z, where a facet mirrors it. Stam's
//! (u, v, w) has the signs of both turned over, which is the same; +kwz beside e^(−2πi f·x) would turn the
//! pattern of a blazed surface by 180°.
//!
//! # Shading with it
//!
//! Stam 1999 in these terms: f_r = F² G/w² · S_d(h), where S_d is taken at that w. With ω_o = n,
//! w = 1 + cos θ_i and G/w² = 1/cos θ_i exactly, so
//!
//! L = F₀² ∫ S_d^w(h) L_i dω_i.
//!
//! A table is made at w = 2. Where k w z is small, p ≈ a (1 − ikwz), and away from the mirror
//! S_d^w ≈ (w/2)² S_d², the factor (1 + ω_i·ω_o)²/4 of renderers:
//!
//! L ≈ F₀² ∫ ((1 + ω_i·ω_o)²/4) S_d(h) L_i dω_i, dω_i = dh/cos θ_i.
//!
//! Against the exact w the error in an order of a rectangular grating of depth D is
//! ((w/2) sin(kD)/sin(kwD/2))² − 1 whatever the order: none for a shallow one, and what it costs a disc
//! is measured in the exhibits.
//!
//! # Wavelengths from one
//!
//! A pattern I at λ₀ tells |P(f)|² at λ₀. If the screen were the same at every wavelength (an amplitude
//! grating), S_λ(h) = (λ₀/λ)² S_λ₀(h λ₀/λ). For a shallow relief |P|² ∝ k², so (λ₀/λ)⁴. In between no power
//! holds: sin²(2πD/λ) of a disc has a maximum in the blue.

mod claims;
mod error;
mod exhibits;
mod far_field;
mod growth;
mod illuminant;
mod laws;
mod orders;
mod preparation;
mod reference;
mod regions;
mod resample;
mod simulate;
mod simulation;
mod surfaces;
mod table;

pub use error::DiffractionError;
pub use far_field::{FarField, FarFieldTransform};
pub use growth::OrderGrowth;
pub use illuminant::IlluminantChoice;
pub use orders::{
    Order, SinusoidAmplitude, fundamental, orders, predicted_power, sinusoid_amplitude,
};
pub use preparation::{
    Detrend, MOST_SAMPLES, Missing, Preparation, PreparedHeights, Trend, USUAL, Window, prepared,
};
pub use reference::{MOST_ORDER, MOST_PHASE, rectangular_order_power, sinusoid_order_power};
pub use resample::{Cells, gathered};
pub use simulate::{settings, simulated_heights, simulated_table};
pub use surfaces::{
    CompactDisc, Grating, HolographicPaper, Patch, PixelLattice, Profile, compact_disc, grating,
    holographic_paper, pixel_lattice,
};
pub use table::{
    Channels, DiffractionTable, NORMAL, PatternPlacing, PowerShares, TableShape, of_pattern,
    of_surface, relative_l2,
};

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions, Scalar, arguments};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/diffraction/forms");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    let functions = Functions {
        forms: || FormText::embedded("src/effects/diffraction/forms", &FORMS),
        references: REFERENCES,
        simulators: &[("diffraction", simulate::run)],
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
    ("sinusoid_order_power", |point| {
        let [order, phase] = arguments(point)?;
        sinusoid_order_power(reference::whole(order)?, phase)
    }),
    // Of the amplitude of the phase alone: what forms approximate.
    ("sinusoid_zero_order", |point| arguments(point).and_then(|[a]| sinusoid_order_power(0, a))),
    ("sinusoid_first_order", |point| arguments(point).and_then(|[a]| sinusoid_order_power(1, a))),
    ("rectangular_order_power", |point| {
        let [order, duty, phase] = arguments(point)?;
        rectangular_order_power(reference::whole(order)?, duty, phase)
    }),
];

#[cfg(test)]
mod tests;
