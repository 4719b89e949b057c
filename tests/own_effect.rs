//! `examples/own_effect.rs` as a test: an effect from outside the crate is fitted, judged and reported
//! like those that are built in.

#[path = "../examples/own_effect.rs"]
#[allow(dead_code, reason = "the program's entry is not used here")]
mod own_effect;

use std::fs;

use own_effect::{EFFECT, make, smith_masking};
use striae::document::number;
use striae::fit::outcome::Status;
use striae::numeric::quadrature::GaussLegendre;
use striae::registry::{Registry, RegistryError};
use striae::validate::laws::LawStanding;

/// G₁ from what it means: μ over the projected area that is seen, by quadrature over the visible slopes p
/// in the plane of incidence, whose density is α² / (2 (α² + p²)^{3/2}); p = α tan t.
fn masking_by_quadrature(mu: f64, alpha: f64) -> f64 {
    let sine = (1.0 - mu * mu).sqrt();
    let seen = |t: f64| 0.5 * (mu * t.cos() - alpha * sine * t.sin());
    let edge = mu.atan2(alpha * sine);
    let rule = GaussLegendre::new(32);
    mu / rule.integral_in_panels(seen, -std::f64::consts::FRAC_PI_2, edge, 4)
}

#[test]
fn the_reference_agrees_with_what_masking_means() {
    let mut worst = 0.0_f64;
    for mu in [1e-3, 0.05, 0.3, 0.7, 0.99, 1.0] {
        for alpha in [1e-2, 0.1, 0.5, 1.0] {
            let exact = smith_masking(mu, alpha).expect("in the domain");
            worst = worst.max((masking_by_quadrature(mu, alpha) / exact - 1.0).abs());
        }
    }
    println!("largest relative difference {worst:e}");
    assert!(worst <= 1e-14, "relative difference {worst:e}");
    assert!(smith_masking(-0.1, 0.5).is_err() && smith_masking(0.5, 0.0).is_err());
    assert_eq!(smith_masking(0.0, 1e-4), Ok(0.0));
}

#[test]
fn an_effect_from_outside_is_judged_and_reported() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let made = make(folder.path()).expect("an effect that can be judged");

    let [outcome] = made.fitted.outcomes() else { panic!("one fit") };
    assert_eq!((outcome.name.as_str(), outcome.status), ("masking/refit", Status::Converged));
    let slope = outcome.parameters["slope"].value;
    assert!((slope / 0.402_771_02 - 1.0).abs() < 1e-6, "slope {slope}");

    // RMS and maximal error over the region in f32, as measured; grazing errors are smaller throughout.
    let page = fs::read_to_string(folder.path().join("reports/latest/masking.html")).expect("page");
    for (name, rms, largest) in [
        ("masking/schlick", 0.046_116_421, 0.154_246_840),
        ("masking/refit", 0.031_816_423, 0.110_761_139),
    ] {
        let all = &made.studied.study.candidates;
        let judged = all.iter().find(|judged| judged.name == name).expect("judged");
        let [(region, found)] = &judged.regions[..] else { panic!("one region") };
        let [(hard, grazing)] = &judged.hard_cases[..] else { panic!("one set of hard cases") };
        assert_eq!((region.as_str(), hard.as_str()), ("every roughness", "grazing"));
        assert!((found.f32.rms / rms - 1.0).abs() < 1e-6, "{name}: {:?}", found.f32);
        assert!((found.f32.max_abs / largest - 1.0).abs() < 1e-6, "{name}: {:?}", found.f32);
        assert!(grazing.f32.max_abs < 0.05, "{name}: {:?}", grazing.f32);
        let shown = number(found.f32.max_abs, 4);
        assert!(page.contains(&shown), "the page does not show {name}'s error {shown}");
    }
    let laws = &made.studied.study.laws;
    assert_eq!(laws.len(), 2, "{laws:?}");
    assert!(laws.iter().all(|law| law.verdict == LawStanding::Holds), "{laws:?}");
    let [finding] = &made.studied.study.findings[..] else { panic!("one claim") };
    assert_eq!(finding.found, "RMS error 0.0461 with 1/2, 0.0318 at the least squares");
    assert_eq!(finding.verdict, "differs");
    assert!(made.check.passed() && made.check.gates.is_empty());
    assert_eq!(made.check.constants.len(), 1, "the fit is made again");

    for shown in
        [EFFECT.title, "every roughness", "grazing", "end points", "holds", "Error by roughness"]
    {
        assert!(page.contains(shown), "the page does not show {shown:?}");
    }
    assert!(page.contains("No gate holds this"));
}

#[test]
fn names_of_an_effect_from_outside_are_its_own() {
    let with = Registry::builtin().clone().with_effect(&EFFECT).expect("registered");
    assert!(with.form("masking/schlick").is_some() && with.reference("smith_masking").is_some());
    let twice = with.with_effect(&EFFECT).expect_err("refused");
    assert_eq!(twice, RegistryError::Taken { kind: "effect", name: "masking" });
}
