//! Properties that a form of a light should have whatever its error.

use super::hard_cases::HARD_CASES;
use crate::effect::{FormValues, Law};

/// Radiance is not negative, and finite.
pub(in super::super) const NOT_NEGATIVE: Law = Law {
    name: "light is not negative",
    description: "no value below 0 and none that is not finite: largest magnitude of a negative value \
                  over the hard cases of lights, infinite for a NaN or an infinity.",
    violation: negative,
    references: &["sphere_light", "triangle_light"],
    known_violations: &[
        ("area_light/sphere_line_printed", CANCELLED),
        ("area_light/disc_line_printed", CANCELLED),
        ("area_light/sphere_line_exact_si", CANCELLED),
        ("area_light/sphere_hermite_three_printed", CANCELLED),
        ("area_light/sphere_hermite_five_printed", CANCELLED),
        ("area_light/sphere_hermite_seven_printed", CANCELLED),
        ("area_light/triangle_line_printed", CANCELLED),
        ("area_light/triangle_line_exact_si", CANCELLED),
        ("area_light/triangle_hermite_three_printed", CANCELLED),
        ("area_light/triangle_hermite_five_printed", CANCELLED),
        ("area_light/triangle_hermite_seven_printed", CANCELLED),
    ],
    ..Law::EMPTY
};

const CANCELLED: &str = "eq. 27 takes the difference of two numbers near pi, which is negative where the \
                         tails are less apart than their rounding or the errors of eq. 29";

fn negative(form: FormValues<'_>) -> f64 {
    let mut worst = 0.0_f64;
    let mut judged = false;
    for set in &HARD_CASES {
        let values = form(&(set.points)());
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
