//! The sine integral Si(x) = ∫₀ˣ sin t / t dt: what the diffraction of a scratch with rectangular
//! profile integrates to over a rectangular light.
//!
//! A scratch of width W scatters light of wavelength λ into a lobe sinc²(kWq/2), where q is the
//! difference of the direction sines across it. Its integral over a light that reaches from q₁ to
//! q₂ is a difference of ½ ∫ sinc²(u/2) du = Si(u) − (1 − cos u)/u at u = kWq₂ and kWq₁, so a renderer
//! needs Si at two points per light, scratch and wavelength (velinov2018 eq. 27).
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | W | width | µm | scratch width, 0.8 to 6 |
//! | λ, k | wavelength, 2π/λ | µm, 1/µm | 0.38 to 0.78 for light |
//! | q | | 1 | sum of the sines of incidence and exitance, in [−2, 2] |
//! | x = kWq | x | rad | argument of Si; |x| ≤ 2π·6·2/0.38 = 198.4 |
//! | a₀, b₀ | `tail`, `offset` | 1 | constants of velinov2018 eq. 29 |
//! | f, g | [`auxiliary`] | 1 | Si = π/2 − f cos x − g sin x, A&S 5.2.8 |
//!
//! For a given scratch and wavelength x is uniform where q is; over widths and wavelengths that are
//! uniform too its density falls towards the far end, half of it below |x| = 30 (region `scene`).

mod claims;
mod hard_cases;
mod laws;
mod lookup;
mod reference;

pub use reference::{auxiliary, sine_integral};

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, Evaluate, FormText, Quantity, Reference};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/sine_integral/forms");

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "sine_integral",
    title: "Sine integral",
    description: "Si(x), the integral of sin t / t. A scratch with a rectangular profile diffracts \
                  light into a sinc squared lobe; integrated over a rectangular light source it is \
                  a difference of two values of Si, taken per light, scratch and wavelength.",
    references: &[REFERENCE],
    forms: || {
        let mut texts = FormText::embedded("src/effects/sine_integral/forms", &FORMS);
        texts.extend([64, 256, 1024].map(lookup::text));
        texts
    },
    regions: hard_cases::REGIONS,
    hard_cases: &[hard_cases::HARD_CASES],
    laws: laws::LAWS,
    baselines: &["sine_integral/published"],
    claims: claims::CLAIMS,
    ..Effect::EMPTY
};

const REFERENCE: Reference = Reference {
    name: "sine_integral",
    description: "Si(x), the integral of sin t / t from 0 to x",
    arguments: &[Quantity { name: "x", unit: "1", domain: "any f64" }],
    unit: "1",
    accuracy: "relative error <= 1e-14 for every finite x, odd to the bit (tests/references.rs)",
    source: "Abramowitz & Stegun 5.2.14, 5.1.22, 5.2.34-35",
    // A call without its argument has no value.
    evaluate: Evaluate::Scalar(|arguments| {
        Ok(sine_integral(arguments.first().copied().unwrap_or(f64::NAN)))
    }),
};

#[cfg(test)]
mod tests;
