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

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/sine_integral/forms");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    // A call without its argument has no value.
    let value = |point: &[f64]| Ok(sine_integral(point.first().copied().unwrap_or(f64::NAN)));
    let functions = Functions {
        forms: || {
            let mut texts = FormText::embedded("src/effects/sine_integral/forms", &FORMS);
            texts.extend([64, 256, 1024].map(lookup::text));
            texts
        },
        references: &[("sine_integral", value)],
        regions: hard_cases::REGIONS,
        hard_cases: hard_cases::HARD_CASES,
        laws: laws::LAWS,
        claims: claims::CLAIMS,
        ..Functions::NONE
    };
    Effect::of_text(include_str!("effect.toml"), functions)
});

#[cfg(test)]
mod tests;
