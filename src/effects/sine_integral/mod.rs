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

use crate::effect::{Effect, Evaluate, FormEntry, Quantity, Reference, Source};

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "sine_integral",
    title: "Sine integral",
    description: "Si(x), the integral of sin t / t. A scratch with a rectangular profile diffracts \
                  light into a sinc squared lobe; integrated over a rectangular light source it is \
                  a difference of two values of Si, taken per light, scratch and wavelength.",
    references: &[REFERENCE],
    forms: FORMS,
    simulators: &[],
    families: &[],
    regions: hard_cases::REGIONS,
    hard_cases: &[hard_cases::HARD_CASES],
    laws: laws::LAWS,
    goals: &[],
    baselines: &["sine_integral/published"],
    claims: claims::CLAIMS,
    exhibits: |_| Ok(Vec::new()),
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

/// Name of the WGSL function in every form.
const FUNCTION: &str = "sine_integral";

const FORMS: &[FormEntry] = &[
    PUBLISHED,
    FormEntry {
        name: "sine_integral/auxiliary_small",
        description: "auxiliary functions rational in |x| over a quadratic, 3 constants, no branch",
        citation: "striae; the structure of Abramowitz & Stegun 5.2.8",
        path: "src/effects/sine_integral/forms/auxiliary_small.wgsl",
        source: Source::Written(include_str!("forms/auxiliary_small.wgsl")),
        function: FUNCTION,
        reference: REFERENCE.name,
    },
    FormEntry {
        name: "sine_integral/auxiliary_medium",
        description: "auxiliary functions rational in |x| over a cubic, 6 constants, no branch",
        citation: "striae; the structure of Abramowitz & Stegun 5.2.8",
        path: "src/effects/sine_integral/forms/auxiliary_medium.wgsl",
        source: Source::Written(include_str!("forms/auxiliary_medium.wgsl")),
        function: FUNCTION,
        reference: REFERENCE.name,
    },
    FormEntry {
        name: "sine_integral/auxiliary_lean",
        description: "auxiliary functions rational in |x| over a quintic that shares the numerator \
                      of f, 8 constants, no branch, to a few ulp of f32",
        citation: "striae; the structure of Abramowitz & Stegun 5.2.8",
        path: "src/effects/sine_integral/forms/auxiliary_lean.wgsl",
        source: Source::Written(include_str!("forms/auxiliary_lean.wgsl")),
        function: FUNCTION,
        reference: REFERENCE.name,
    },
    FormEntry {
        name: "sine_integral/auxiliary_large",
        description: "odd polynomial to 3, auxiliary functions rational in |x| over a quartic \
                      beyond, 15 constants, to f32 rounding",
        citation: "striae; the structure of Abramowitz & Stegun 5.2.8",
        path: "src/effects/sine_integral/forms/auxiliary_large.wgsl",
        // The form first, so that its lines keep their numbers in diagnostics.
        source: Source::Written(concat!(
            include_str!("forms/auxiliary_large.wgsl"),
            include_str!("forms/phase.wgsl")
        )),
        function: FUNCTION,
        reference: REFERENCE.name,
    },
    FormEntry {
        name: "sine_integral/lookup_64",
        source: Source::Generated(lookup::wgsl::<64>),
        ..LOOKUP
    },
    FormEntry {
        name: "sine_integral/lookup_256",
        source: Source::Generated(lookup::wgsl::<256>),
        ..LOOKUP
    },
    FormEntry {
        name: "sine_integral/lookup_1024",
        source: Source::Generated(lookup::wgsl::<1024>),
        ..LOOKUP
    },
];

/// Eq. 29, which every other form is held against.
const PUBLISHED: FormEntry = FormEntry {
    name: "sine_integral/published",
    description: "tanh, a Lorentzian tail and a cosine, 2 constants",
    citation: "velinov2018 eq. 29",
    path: "src/effects/sine_integral/forms/published.wgsl",
    source: Source::Written(include_str!("forms/published.wgsl")),
    function: FUNCTION,
    reference: REFERENCE.name,
};

/// What the lookups share.
const LOOKUP: FormEntry = FormEntry {
    name: "sine_integral/lookup",
    description: "table from the reference, linear between entries, asymptotic tail beyond",
    citation: "striae",
    path: "src/effects/sine_integral/forms/lookup.wgsl",
    source: Source::Generated(lookup::wgsl::<64>),
    function: FUNCTION,
    reference: REFERENCE.name,
};

#[cfg(test)]
mod tests;
