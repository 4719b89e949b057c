//! Properties that a form of a light should have whatever its error.

use super::hard_cases::HARD_CASES;
use crate::effect::{FormValues, Violation};

/// Laws of lights, by name.
pub(in super::super) const LAWS: &[(&str, Violation)] = &[
    // Radiance is not negative, and finite.
    ("light is not negative", negative),
];

fn negative(form: FormValues<'_>) -> f64 {
    let mut worst = 0.0_f64;
    let mut judged = false;
    for (_, points) in HARD_CASES {
        let values = form(&points());
        // The other light's arguments are not the form's: all NaN.
        if values.iter().all(|value| value.is_nan()) {
            continue;
        }
        judged = true;
        for value in values {
            worst = if value.is_finite() { worst.max(-f64::from(value)) } else { f64::INFINITY };
        }
    }
    if judged { worst } else { f64::NAN }
}
