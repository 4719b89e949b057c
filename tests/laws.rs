//! Every law of every effect against every committed fit: what does not hold is registered with its
//! reason, and what is registered as a violation still is one.

use striae::project::Project;
use striae::registry::Registry;
use striae::validate::laws::{LawStanding, judge};

#[test]
fn every_violation_of_a_law_is_registered() {
    let registry = Registry::builtin();
    let project = Project::at(env!("CARGO_MANIFEST_DIR"), registry);
    let mut judged = 0;
    let mut faults = Vec::new();
    for subject in project.subjects().expect("the project's results") {
        let form = registry.form(&subject.form).expect("a registered form");
        let effect = subject.name.split('/').next().and_then(|name| registry.effect(name));
        let effect = effect.expect("a registered effect");
        let candidate = subject.candidates.first().expect("a candidate");
        for law in
            judge(effect, &subject.form, form.reference.as_deref().unwrap_or_default(), candidate)
        {
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
    assert!(judged > 50, "only {judged} laws were judged");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
