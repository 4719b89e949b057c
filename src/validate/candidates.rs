//! What is timed: every fit of an effect, over the points on which it is judged.

use std::collections::BTreeMap;
use std::path::Path;

use crate::effect::{Effect, Member};
use crate::fit::outcome::{FamilyOutcome, Outcome};
use crate::registry;
use crate::validate::ValidateError;
use crate::validate::accuracy::{Shipped, Target};
use crate::validate::cost::{Candidate, TimedReference};
use crate::validate::regions::{Atlas, Grounds};

/// Key of the group of fits to families: no reference is called so.
const FAMILIES: &str = "";
/// Members whose points are joined to time a form of a family.
const MEMBERS: usize = 16;

/// The fits of `effect` to be timed, in groups that are compared: those to one reference, and those
/// to families. The baseline of a group comes first.
///
/// A fit to a family stands for all of its members with the constants of the first. `members` holds
/// the held-out members of each family, in the order of `effect.families`.
///
/// # Errors
/// If a form does not load or a reference has no value at a point of its region.
pub fn candidates(
    effect: &Effect,
    singles: &[Outcome],
    families: &[FamilyOutcome],
    members: &[Vec<Member>],
    root: &Path,
) -> Result<Vec<Vec<Candidate>>, ValidateError> {
    let mut groups: BTreeMap<&str, Vec<Candidate>> = BTreeMap::new();
    let mut atlas = Atlas::new(effect);
    for outcome in singles {
        let Some((_, reference)) = registry::reference(&outcome.target) else { continue };
        let shipped = Shipped::of(outcome, root)?;
        if let Some(target) = atlas.of(reference)?.everywhere(&shipped.form)? {
            groups.entry(reference.name).or_default().push(Candidate { shipped, target });
        }
    }
    for outcome in families {
        let held_out = effect
            .families
            .iter()
            .position(|family| family.name == outcome.family)
            .and_then(|at| members.get(at));
        let (Some(first), Some(held_out)) = (outcome.members.first(), held_out) else { continue };
        let mut shipped = Shipped::of(first, root)?;
        shipped.name.clone_from(&outcome.name);
        let targets = held_out
            .iter()
            .step_by(held_out.len().div_ceil(MEMBERS).max(1))
            .map(|member| Target::of_table(&member.table, &shipped.form))
            .collect::<Result<Vec<_>, _>>()?;
        if let Some(target) = Target::all(targets) {
            groups.entry(FAMILIES).or_default().push(Candidate { shipped, target });
        }
    }
    let order = effect.references.iter().map(|reference| reference.name).chain([FAMILIES]);
    let mut ordered: Vec<Vec<Candidate>> = order.filter_map(|name| groups.remove(name)).collect();
    for group in &mut ordered {
        let baseline =
            |candidate: &Candidate| effect.baselines.contains(&candidate.shipped.name.as_str());
        if let Some(at) = group.iter().position(baseline) {
            group.swap(0, at);
        }
    }
    Ok(ordered)
}

/// The references of `effect` with the points over which they are timed.
///
/// # Errors
/// If a reference has no value at a point of its region.
pub fn timed_references(effect: &Effect) -> Result<Vec<TimedReference>, ValidateError> {
    let mut found = Vec::new();
    for reference in effect.references {
        let grounds = Grounds::of(effect, reference)?;
        let inputs = grounds.arguments(reference);
        if inputs.first().is_some_and(|column| !column.is_empty()) {
            found.push(TimedReference { reference, inputs });
        }
    }
    Ok(found)
}
