//! Which candidates of an effect are timed together, and on what points.

use std::collections::BTreeMap;

use crate::effect::{Effect, Member};
use crate::project::{Approximated, Project, Subject};
use crate::validate::ValidateError;
use crate::validate::accuracy::GroundTruth;
use crate::validate::cost::{Timed, TimedReference};
use crate::validate::regions::Atlas;

/// Key of what is fitted to families; sorts before every reference.
const FAMILIES: &str = "";
/// Members of a family that a form is timed on.
const MEMBERS: usize = 16;

/// Candidates of `effect`, grouped by what they approximate: ratios of cost are within a group, to its
/// first entry, the baseline. `members` holds the held-out members of each family, in the order of
/// `effect.families`.
///
/// # Errors
/// If a form or a reference fails.
pub fn timed(
    effect: &Effect,
    subjects: &[Subject],
    members: &[Vec<Member>],
    project: &Project,
    atlas: &Atlas,
) -> Result<Vec<Vec<Timed>>, ValidateError> {
    let mut groups: BTreeMap<&str, Vec<Timed>> = BTreeMap::new();
    for subject in subjects {
        let Some(mut candidate) = subject.candidates.first().cloned() else { continue };
        candidate.name.clone_from(&subject.name);
        let Some(group) = group(subject) else { continue };
        let target = match &subject.approximates {
            Approximated::Reference(name) => {
                let Some((_, reference)) = project.registry().reference(name) else { continue };
                let grounds = atlas.grounds(effect, reference)?;
                grounds.everywhere(&candidate.form)?
            }
            Approximated::Family(name) => {
                let at = effect.families.iter().position(|family| family.name == name);
                let Some(held_out) = at.and_then(|at| members.get(at)) else { continue };
                let targets = held_out
                    .iter()
                    .step_by(held_out.len().div_ceil(MEMBERS).max(1))
                    .map(|member| GroundTruth::of_table(&member.table, &candidate.form))
                    .collect::<Result<Vec<_>, _>>()?;
                GroundTruth::all(targets)
            }
            Approximated::Table => continue,
        };
        if let Some(target) = target {
            groups.entry(group).or_default().push(Timed { candidate, target });
        }
    }
    let order = effect.references.iter().map(|reference| reference.name).chain([FAMILIES]);
    let mut ordered: Vec<Vec<Timed>> = order.filter_map(|name| groups.remove(name)).collect();
    for group in &mut ordered {
        if let Some(at) = group.iter().position(|timed| is_baseline(effect, &timed.candidate.name))
        {
            group.swap(0, at);
        }
    }
    Ok(ordered)
}

/// What candidates are compared with whose ratios of cost have one baseline; none for what approximates
/// a table of the user's.
fn group(subject: &Subject) -> Option<&str> {
    match &subject.approximates {
        Approximated::Reference(name) => Some(name),
        Approximated::Family(_) => Some(FAMILIES),
        Approximated::Table => None,
    }
}

fn is_baseline(effect: &Effect, name: &str) -> bool {
    effect.baselines.contains(&name)
}

/// The subject to which ratios of cost of `subject` refer, among the `subjects` of `effect`.
pub fn baseline<'s>(
    effect: &Effect,
    subjects: &'s [Subject],
    subject: &Subject,
) -> Option<&'s Subject> {
    let wanted = group(subject)?;
    let comparable = || {
        let own = subjects.iter().filter(|other| other.is_of(effect.name));
        own.filter(|other| group(other) == Some(wanted))
    };
    comparable().find(|other| is_baseline(effect, &other.name)).or_else(|| comparable().next())
}

/// The references of `effect` with the points they are timed on.
///
/// # Errors
/// If a reference has no value at a point of its regions.
pub fn timed_references(
    effect: &Effect,
    atlas: &Atlas,
) -> Result<Vec<TimedReference>, ValidateError> {
    let mut found = Vec::new();
    for reference in effect.references {
        let inputs = atlas.grounds(effect, reference)?.arguments(reference);
        if inputs.first().is_some_and(|column| !column.is_empty()) {
            found.push(TimedReference { reference, inputs });
        }
    }
    Ok(found)
}
