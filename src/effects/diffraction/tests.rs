//! What the effect shows, and what it finds, against the derivations.

use super::EFFECT;
use super::exhibits::{cosine_error, disc_in_white_sky, even_table, mirror_by_stam, rule_errors};
use crate::measured::spectra::Spectra;

#[test]
fn findings_are_all_evaluated() {
    assert_eq!(crate::effects::found(&EFFECT).len(), 8);
}

#[test]
fn shallow_reliefs_follow_the_fourth_power_and_the_square_of_the_cosine() {
    let spectra = Spectra::built_in().expect("the built-in spectra");
    let rules = rule_errors(1.0, &spectra).expect("a grating");
    println!("{rules:?}");
    for (square, fourth) in rules.square.iter().zip(rules.fourth) {
        // 0.012, 0.014 and 0.065 measured in R, G, B, of the resampling; 0.207, 0.103 and 0.339.
        assert!(fourth < 0.07 && *square > 0.1, "{rules:?}");
    }
    assert!(cosine_error(1.0, 1.0).abs() < 1e-3);
    assert!(cosine_error(120.0, 0.0).abs() < 1e-15);
}

#[test]
fn factors_in_a_white_sky() {
    let (narrow, whole) = (even_table(1e-4), even_table(1.0));
    for value in [narrow.printed, narrow.with_solid_angle] {
        assert!((value - 1.0).abs() < 1e-8);
    }
    // ∫ ((1 + c)/2)² dμ over the hemisphere, with dμ = 2c dc and 2 dc.
    assert!((whole.printed - 17.0 / 24.0).abs() < 1e-15);
    assert!((whole.with_solid_angle - 7.0 / 6.0).abs() < 1e-15);
    let disc = disc_in_white_sky(&[0.9]).expect("a disc")[0];
    assert!(disc.printed < 1.0 && disc.with_solid_angle > 1.0, "{disc:?}");
    assert!((mirror_by_stam(std::f64::consts::FRAC_PI_4) - 0.5).abs() < 1e-15);
}
