//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod area_light;
pub mod diffraction;
pub mod footprint;
pub mod fresnel;
pub mod scratch_response;
pub mod sine_integral;

use std::sync::LazyLock;

use crate::effect::{FormEntry, FormLibrary};
use crate::form::FormError;

/// The form called `name`, for findings and exhibits of effects whose forms they evaluate.
fn form(name: &str) -> Result<&'static FormEntry, FormError> {
    static FORMS: LazyLock<FormLibrary> = LazyLock::new(|| {
        let effects = [
            &sine_integral::EFFECT,
            &scratch_response::EFFECT,
            &footprint::EFFECT,
            &area_light::EFFECT,
        ];
        FormLibrary::new(&effects).unwrap_or_else(|error| panic!("built in: {error}"))
    });
    FORMS.get(name).ok_or_else(|| FormError::NoFunction {
        origin: "the registered forms".to_owned(),
        function: name.to_owned(),
        available: FORMS.iter().map(|form| form.name.as_str()).collect::<Vec<_>>().join(", "),
    })
}
