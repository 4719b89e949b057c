//! The response of straight scratches of rectangular cross-section to coherent light
//! (velinov2018 §3.1 and §3.3, after Werner et al. 2017).
//!
//! Light that is coherent over a spot w(x) = exp(−|x|²/2σ²) leaves a surface with reflected phase
//! φ(x) with the amplitude ∫ w e^{iφ} e^{−ikξ·x} dx, ξ the tangential part of ω_i + ω_o, k = 2π/λ. Write
//! e^{iφ} = 1 − (1 − e^{iφ}): the first part is the mirror ℬ, the second is zero outside scratches, 𝒮,
//! and f_r = |ℬ − 𝒮|²/(πσ²λ²) (eq. 1; the factor makes a mirror reflect 1, see below).
//!
//! * ℬ = 2πσ² exp(−σ²k²|ξ|²/2), the transform of w; ∫|ℬ|² dξ/(πσ²λ²) = 4π²/(k²λ²) = 1.
//! * A scratch of width W ≪ σ sees the window at its centre line, so its integral separates:
//!   across, ∫ e^{−ikξ₂b} db over [s_b − W/2, s_b + W/2] = W sinc(πWξ₂/λ) e^{−iks_bξ₂} (eq. 3,
//!   sinc u = sin u/u); along, ∫ exp(−t²/2σ² − ikξ₁t) dt = √(π/2) σ exp(−σ²k²ξ₁²/2) times the
//!   difference of erf((t/σ + iσkξ₁)/√2) over the ends (eq. 5), √(2π) σ exp(−σ²k²ξ₁²/2) without ends (eq. 8).
//! * The floor lies D deeper, a path of (γ + γᵢ)D more: 𝒟 = 1 − exp(i2π(γ + γᵢ)D/λ), and eq. 4 for γ + γᵢ = 2.
//!
//! **Energy.** By Parseval ∫|∫ g e^{−ikξ·x} dx|² dξ = λ² ∫|g|² dx. The light that falls into an
//! infinite scratch is a = W exp(−s_b²/σ²)/(√π σ) of the whole: the squared window, since w is an
//! amplitude. At a fixed depth phase the parts of f_r integrate to 1 (mirror), |𝒟|² a (scratch) and
//! −2 Re 𝒟 a = −|𝒟|² a (cross term), since |1 − e^{iφ}|² = 2 Re(1 − e^{iφ}): what a scratch shows, the
//! cross term takes from the mirror. So a blend (1 − ρ)|ℬ|² + |𝒮|² keeps energy if and only if
//! ρ = Σ |𝒟|² a, the form `energy_blend`. The printed ρ_c has the amplitude window and no depth: a scratch
//! at s_b counts √2 exp(s_b²/2σ²) times its a, integrated over s_b twice. As |𝒟|² is 2 on average over
//! depths, ρ_c keeps energy on average over depths and offsets, and only so.
//!
//! At the peak ξ = 0 the cross term is −|𝒟|² (ρ_c/2) |ℬ|², exactly: the form `peak_blend`.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | ξ₁, ξ₂ | `xi_along`, `xi_across` | 1 | ω_i + ω_o along and across the scratch |
//! | W, D | `width_um`, `depth_um` | µm | cross-section |
//! | λ | `wavelength_um` | µm | wavelength |
//! | σ | `sigma_um` | µm | radius of the coherence area A_C = πσ², 60 in the paper |
//! | s_b | `offset_um` | µm | offset of the scratch from the shaded point |
//! | s_t + l₁, s_t + l₂ | `begin_um`, `end_um` | µm | its ends along itself, from the shaded point |
//! | γ + γᵢ | `mu_sum` | 1 | sum of the cosines of incidence and exitance |
//! | ρ_c | [`StraightScratch::density`] | 1 | area density, eq. 17 |
//! | a | [`StraightScratch::light_share`] | 1 | share of the light that falls into the scratch |
//!
//! Reciprocity: everything depends on ω_i + ω_o alone, the depth phase through γ + γᵢ; exchanging the
//! directions changes nothing. The form `mirror_depth` gives that up (2γ in place of γ + γᵢ).

mod amplitude;
mod claims;
mod ensemble;
mod exhibits;
mod laws;
mod reference;
mod regions;
mod surface;

pub use amplitude::{along_factor, depth_factor, sinc_pi};
pub use surface::{
    Coherence, Directions, StraightScratch, coherent_amplitude, mirror_amplitude, svbrdf,
};

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/scratch_response/forms");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    let functions = Functions {
        forms: || FormText::embedded("src/effects/scratch_response/forms", &FORMS),
        references: reference::REFERENCES,
        regions: regions::REGIONS,
        hard_cases: regions::HARD_CASES,
        laws: laws::LAWS,
        claims: claims::CLAIMS,
        exhibits: exhibits::exhibits,
        ..Functions::NONE
    };
    Effect::of_text(include_str!("effect.toml"), functions)
});

#[cfg(test)]
mod tests;
