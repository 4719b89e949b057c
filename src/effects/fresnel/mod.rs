//! Fresnel reflectance of smooth interfaces: metals and dielectrics.
//!
//! # Symbols
//!
//! | symbol | name | meaning |
//! |---|---|---|
//! | μ | `mu` | cosine of the angle of incidence; in a microfacet model, between view and half vector |
//! | m = n + ik | `n`, `k` | index of the far side relative to the near side |
//! | η | `eta` | the same for k = 0 |
//! | F₀ | `f_normal` | reflectance at μ = 1 |
//! | F₈₂ | `f_edge` | reflectance at μ = 1/7 (82°) |
//!
//! The exact reflectance is in [`mod@reference`]. A renderer knows F₀ per colour channel and wants the
//! rest of the curve for a few operations: every form here takes μ and F₀ and is 1 at grazing.
//!
//! # The shape of the curve
//!
//! At μ = 1 the changes of R_s and R_p of first order in sin² cancel, so R − F₀ vanishes with
//! (1 − μ)². With |w| → |m| and Re w → n, the limit of a high index, R_s = (q − 2nμ + μ²)/(q + 2nμ +
//! μ²) and R_p = (qμ² − 2nμ + 1)/(qμ² + 2nμ + 1), q = n² + k², go into one another under μ → 1/μ, and
//! their mean is
//!
//! R = F₀ + (1 − F₀)(1 − μ)² (1 + βμ + μ²) / ((1 + 2nμ + qμ²)(1 + (2n/q) μ + μ²/q)),
//! β = 2 − 2n (1 + 1/q) F₀/(1 − F₀).
//!
//! Metals have large q: the last factor of the denominator is close to 1, and so is what μ² adds
//! to the numerator where it matters. What is left, with its three constants free, is the form
//! `rational`,
//!
//! R ≈ F₀ + (1 − F₀)(1 − μ)² (1 + aμ)/(1 + bμ + cμ²),
//!
//! which for a < −1 has the dip that metals show before grazing and for a > −1 the monotone rise
//! of glass. Eliminating n between b = 2n, c = q and a = β leaves one relation between the three;
//! the fitted constants of all materials keep close to a linear one, c = 11/4 b − 2a − 3, and
//! `rational_tied` makes use of that.

mod claims;
mod laws;
pub mod materials;
pub mod reference;
mod regions;

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions, Scalar, arguments};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/fresnel/forms");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    let functions = Functions {
        forms: || FormText::embedded("src/effects/fresnel/forms", &FORMS),
        references: REFERENCES,
        families: &[materials::FAMILY],
        regions: regions::REGIONS,
        hard_cases: regions::HARD_CASES,
        laws: laws::LAWS,
        claims: claims::CLAIMS,
        ..Functions::NONE
    };
    Effect::of_text(include_str!("effect.toml"), functions)
});

const REFERENCES: &[(&str, Scalar)] = &[
    ("fresnel_conductor", |point| {
        let [mu, n, k] = arguments(point)?;
        reference::conductor(mu, n, k).map(reference::Reflectance::mean)
    }),
    ("fresnel_dielectric", |point| {
        let [mu, eta] = arguments(point)?;
        reference::dielectric(mu, eta).map(reference::Reflectance::mean)
    }),
    ("schlick_weight", |point| arguments(point).and_then(|[mu]| reference::schlick_weight(mu))),
];
