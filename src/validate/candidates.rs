//! What is timed: every fit of an effect, over the points on which it is judged.

use std::path::Path;

use crate::effects::registry::{self, Effect, Member, Reference};
use crate::fit::outcome::{FamilyOutcome, Outcome};
use crate::validate::ValidateError;
use crate::validate::accuracy::{Shipped, Target};
use crate::validate::cost::{Candidate, TimedReference};
use crate::validate::study::{has_arguments, rounded};

/// Members whose points are joined to time a form of a family.
const MEMBERS: usize = 16;

/// The fits of `effect` to be timed, the effect's baseline first.
///
/// Fits of one form share its cost: of several fits only the first is taken, except that a fit to a
/// reference and a fit to a family are both kept when their forms differ. `members` holds the
/// held-out members of each family, in the order of `effect.families`.
///
/// # Errors
/// If a form does not load or a reference has no value at a point of its region.
pub fn candidates(
    effect: &Effect,
    singles: &[Outcome],
    families: &[FamilyOutcome],
    members: &[Vec<Member>],
    root: &Path,
) -> Result<Vec<Candidate>, ValidateError> {
    let mut found = Vec::new();
    for outcome in singles {
        let Some((_, reference)) = registry::reference(&outcome.target) else { continue };
        if let Some(target) = everywhere(effect, reference)? {
            found.push(Candidate { shipped: Shipped::of(outcome, root)?, target });
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
        let mut target: Option<Target> = None;
        for member in held_out.iter().step_by(held_out.len().div_ceil(MEMBERS).max(1)) {
            let more = Target::of_table(&member.table, &shipped.form)?;
            target = Some(match target {
                Some(all) => all.joined(more),
                None => more,
            });
        }
        if let Some(target) = target {
            found.push(Candidate { shipped, target });
        }
    }
    if let Some(at) = found.iter().position(|candidate| candidate.shipped.name == effect.baseline) {
        found.swap(0, at);
    }
    Ok(found)
}

/// The references of `effect` with the points over which they are timed.
///
/// # Errors
/// If a reference has no value at a point of its region.
pub fn timed_references(effect: &Effect) -> Result<Vec<TimedReference>, ValidateError> {
    let mut found = Vec::new();
    for reference in effect.references {
        let target = match everywhere(effect, reference)? {
            Some(target) => Some(target),
            None => hard(effect, reference)?,
        };
        if let Some(target) = target {
            found.push(TimedReference { reference, inputs: target.inputs });
        }
    }
    Ok(found)
}

fn everywhere(effect: &Effect, reference: &Reference) -> Result<Option<Target>, ValidateError> {
    let mut target: Option<Target> = None;
    for region in effect.regions {
        let points = rounded((region.points)());
        if has_arguments(&points, reference) {
            let more = Target::of_reference(reference, &points)?;
            target = Some(match target {
                Some(all) => all.joined(more),
                None => more,
            });
        }
    }
    Ok(target)
}

fn hard(effect: &Effect, reference: &Reference) -> Result<Option<Target>, ValidateError> {
    let points = (effect.hard_cases)();
    if has_arguments(&points, reference) {
        return Target::of_reference(reference, &points).map(Some);
    }
    Ok(None)
}
