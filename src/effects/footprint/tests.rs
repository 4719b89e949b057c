//! Every form, with the constants written in its text, at the hard points; the paper's numbers.

use super::EFFECT;
use crate::effects::{found, registered, written};

#[test]
fn forms_are_finite_and_not_negative_at_every_hard_point() {
    let mut judged = 0;
    let candidates = written(&EFFECT);
    for candidate in candidates.iter() {
        for region in EFFECT.hard_cases {
            let Ok(values) = candidate.values_f32_at(&(region.points)()) else { continue };
            judged += 1;
            for (row, value) in values.into_iter().enumerate() {
                let at = format!("{} {} row {row}", candidate.name, region.name);
                assert!(value.is_finite() && value >= 0.0, "{at}: {value}");
            }
        }
    }
    assert_eq!(judged, registered().of(EFFECT.name).count());
}

#[test]
fn findings_agree_with_the_derivations() {
    let found = found(&EFFECT);
    // velinov2018 eq. 16 with and without π, circles of 0.1, 1 and 1.4σ.
    assert!(found[0].contains("0.676 and 0.018 at 0.1σ"), "{}", found[0]);
}
