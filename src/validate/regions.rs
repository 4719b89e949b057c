//! Where an effect's forms are judged, with the true values of one reference there.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::effects::registry::{Effect, Reference};
use crate::table::Table;
use crate::validate::ValidateError;
use crate::validate::accuracy::Target;

/// The points of an effect that a reference takes, and its values there.
#[derive(Debug, Clone)]
pub(super) struct Grounds {
    /// Region name and target, in the effect's order.
    pub(super) regions: Vec<(&'static str, Target)>,
    /// The hard cases, if they have the reference's arguments.
    pub(super) hard_cases: Option<Target>,
}

impl Grounds {
    /// Evaluates `reference` wherever `effect` judges it.
    ///
    /// # Errors
    /// If the reference has no value at a point.
    pub(super) fn of(effect: &Effect, reference: &Reference) -> Result<Self, ValidateError> {
        let target = |points: Table| -> Result<Option<Target>, ValidateError> {
            let points = rounded(points);
            if !has_arguments(&points, reference) {
                return Ok(None);
            }
            Target::of_reference(reference, &points).map(Some)
        };
        let mut regions = Vec::new();
        for region in effect.regions {
            if let Some(target) = target((region.points)())? {
                regions.push((region.name, target));
            }
        }
        Ok(Self { regions, hard_cases: target((effect.hard_cases)())? })
    }

    /// All regions as one target; none if no region is the reference's.
    pub(super) fn everywhere(&self) -> Option<Target> {
        Target::all(self.regions.iter().map(|(_, target)| target.clone()))
    }
}

/// The grounds of one effect, each reference evaluated when it is first asked for.
#[derive(Debug)]
pub(super) struct Atlas<'e> {
    effect: &'e Effect,
    known: BTreeMap<&'static str, Grounds>,
}

impl<'e> Atlas<'e> {
    /// Nothing evaluated yet.
    pub(super) fn new(effect: &'e Effect) -> Self {
        Self { effect, known: BTreeMap::new() }
    }

    /// The grounds of `reference`.
    ///
    /// # Errors
    /// If the reference has no value at a point.
    pub(super) fn of(&mut self, reference: &Reference) -> Result<&Grounds, ValidateError> {
        Ok(match self.known.entry(reference.name) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(Grounds::of(self.effect, reference)?),
        })
    }
}

fn has_arguments(points: &Table, reference: &Reference) -> bool {
    points.rows() > 0
        && reference.arguments.iter().all(|argument| points.column(argument.name).is_some())
}

/// The table with every number rounded to f32, so that all precisions see the same points.
fn rounded(mut table: Table) -> Table {
    for value in table.columns.iter_mut().flat_map(|column| &mut column.values) {
        *value = f64::from(*value as f32);
    }
    table
}
