//! Every law of every effect against every committed fit: what does not hold is registered with its
//! reason, and what is registered as a violation still is one.

use std::path::PathBuf;

use striae::fit::FitResult;
use striae::registry::{self, EFFECTS};
use striae::validate::accuracy::Shipped;
use striae::validate::laws::{LawStanding, judge};

#[test]
fn every_violation_of_a_law_is_registered() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut judged = 0;
    let mut faults = Vec::new();
    for effect in EFFECTS {
        let folder = root.join("fits").join(effect.name);
        for entry in std::fs::read_dir(&folder).expect("the effect's fits") {
            let path = entry.expect("a folder entry").path();
            if path.extension().is_none_or(|extension| extension != "json") {
                continue;
            }
            let result = FitResult::read(&path).expect("a committed result");
            let outcome = &result.outcomes()[0];
            assert!(registry::form(&outcome.form).is_some(), "{} names no form", outcome.name);
            let shipped = Shipped::of(outcome, &root).expect("a form");
            for law in judge(effect, &outcome.form, &shipped) {
                judged += 1;
                let registered = effect.laws.iter().find(|l| l.name == law.law).expect("a law");
                let known = registered.known_violations.iter().any(|(name, _)| *name == law.fit);
                if known && law.verdict == LawStanding::Holds {
                    faults.push(format!("{}: {} holds, registered as broken", law.fit, law.law));
                }
                if law.verdict == LawStanding::Violated {
                    faults.push(format!("{}: {} by {:e}", law.fit, law.law, law.violation));
                }
            }
        }
    }
    assert!(judged > 50, "only {judged} laws were judged");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
