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
//! The exact reflectance is in [`reference`]. A renderer knows F₀ per colour channel and wants the
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
mod hard_cases;
mod laws;
pub mod materials;
pub mod reference;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, Evaluate, FormText, Quantity, Reference, Region, arguments};
use crate::table::{Column, Table};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/fresnel/forms");

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "fresnel",
    title: "Fresnel reflectance",
    description: "How much light a smooth interface reflects, against the angle of incidence: the \
                  colour of a metal and of its edges, the sheen of glass. Every microfacet model \
                  evaluates it once per light and colour channel.",
    references: &[CONDUCTOR, DIELECTRIC, SCHLICK_WEIGHT],
    forms: || FormText::embedded("src/effects/fresnel/forms", &FORMS),
    families: &[materials::FAMILY],
    regions: &[ALL_ANGLES],
    hard_cases: &[hard_cases::HARD_CASES],
    laws: laws::LAWS,
    baselines: &["fresnel/schlick"],
    claims: claims::CLAIMS,
    ..Effect::EMPTY
};

const MU: Quantity = Quantity { name: "mu", unit: "1", domain: "[0, 1]" };

const CONDUCTOR: Reference = Reference {
    name: "fresnel_conductor",
    description: "unpolarised power reflectance of a smooth conductor of index n + ik",
    arguments: &[
        MU,
        Quantity { name: "n", unit: "1", domain: "(0, 1e30]" },
        Quantity { name: "k", unit: "1", domain: "[0, 1e30]" },
    ],
    unit: "1",
    accuracy: "relative error <= 1e-13 (tests/fresnel.rs; 1.8e-15 at most against mpmath)",
    source: "Born & Wolf, Principles of Optics, 1.5.2 and 14.2",
    evaluate: Evaluate::Scalar(|point| {
        let [mu, n, k] = arguments(point)?;
        reference::conductor(mu, n, k).map(reference::Reflectance::mean)
    }),
};

const DIELECTRIC: Reference = Reference {
    name: "fresnel_dielectric",
    description: "unpolarised power reflectance between two dielectrics, eta = n_far/n_near",
    arguments: &[MU, Quantity { name: "eta", unit: "1", domain: "(0, 1e30]" }],
    unit: "1",
    accuracy: "relative error <= 1e-13 (tests/fresnel.rs; 1.8e-15 at most against mpmath)",
    source: "Born & Wolf, Principles of Optics, 1.5.2 to 1.5.4",
    evaluate: Evaluate::Scalar(|point| {
        let [mu, eta] = arguments(point)?;
        reference::dielectric(mu, eta).map(reference::Reflectance::mean)
    }),
};

const SCHLICK_WEIGHT: Reference = Reference {
    name: "schlick_weight",
    description: "weight (1 - mu)^5 of the edge colour in Schlick's approximation",
    arguments: &[MU],
    unit: "1",
    accuracy: "relative error <= 1e-15 (five roundings)",
    source: "Schlick, Computer Graphics Forum 13(3), 1994, eq. 15",
    evaluate: Evaluate::Scalar(|point| {
        let [mu] = arguments(point)?;
        reference::schlick_weight(mu)
    }),
};

/// Forms that take F₀ are judged on the held-out points of their family; only the weight, which
/// takes mu alone, has a region.
const ALL_ANGLES: Region = Region {
    name: "[0, 1]",
    description: "every cosine of incidence, evenly, off the fitted points, and down to 1e-4",
    points: || {
        let even = (0..1000).map(|i| (f64::from(i) + 0.5) / 1000.0);
        let grazing = (0..=12).map(|i| 10f64.powf(-4.0 + f64::from(i) / 4.0));
        let mu = even.chain(grazing).chain([0.0, 1.0]).collect();
        let columns = vec![Column::new("mu", "1", mu)];
        Table { columns, origin: "region [0, 1] of fresnel".into() }
    },
    ..Region::EMPTY
};
