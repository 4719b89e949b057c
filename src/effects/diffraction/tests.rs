//! What the effect shows, and what it finds, against the derivations.

use super::EFFECT;
use super::exhibits::{cosine_error, disc_furnace, mean_over_disc, rule_errors};
use crate::measured::spectra::Spectra;

#[test]
fn findings_are_all_evaluated() {
    assert_eq!(crate::effects::found(&EFFECT).len(), 7);
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
fn the_solid_angle_of_an_even_table() {
    assert!((mean_over_disc(1.0) - 2.0).abs() < 1e-15);
    assert!((mean_over_disc(1e-4) - 1.0).abs() < 1e-8);
    let (_, printed, whole) = disc_furnace(&[0.9]).expect("a disc")[0];
    assert!(whole > printed && printed > 0.0);
}
