//! Where an effect's forms are judged, with the true values of one reference there.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::{Arc, Mutex, PoisonError};

use crate::effect::{Effect, Reference, Region};
use crate::form::Form;
use crate::table::Table;
use crate::validate::ValidateError;
use crate::validate::accuracy::{Judged, Target};

/// The points of an effect that a reference takes, and its values there.
#[derive(Debug, Clone)]
pub(super) struct Grounds {
    regions: Vec<(&'static str, Arc<Judged>)>,
    hard_cases: Vec<(&'static str, Arc<Judged>)>,
}

/// Regions whose points and values are known, by reference and region. Both are fixed when the
/// program is built, and a reference may take milliseconds, so they are evaluated once per process.
static KNOWN: Mutex<BTreeMap<(&'static str, &'static str), Arc<Judged>>> =
    Mutex::new(BTreeMap::new());

/// The points of `region` as f32 numbers, so that all precisions see the same, with the values of
/// `reference`; none if the region lacks an argument of the reference.
///
/// # Errors
/// If the reference has no value at a point.
pub(crate) fn judged(
    region: &'static Region,
    reference: &'static Reference,
) -> Result<Option<Arc<Judged>>, ValidateError> {
    let key = (reference.name, region.name);
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
    if known.is_some() {
        return Ok(known);
    }
    let points = rounded((region.points)());
    if !has_arguments(&points, reference) {
        return Ok(None);
    }
    let found = Arc::new(Judged::new(reference, points, region.by, region.yardstick)?);
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner).insert(key, Arc::clone(&found));
    Ok(Some(found))
}

impl Grounds {
    /// Evaluates `reference` wherever `effect` judges it.
    ///
    /// # Errors
    /// If the reference has no value at a point.
    pub(super) fn of(
        effect: &Effect,
        reference: &'static Reference,
    ) -> Result<Self, ValidateError> {
        let judged = |regions: &'static [Region]| {
            let mut found = Vec::new();
            for region in regions {
                if let Some(judged) = judged(region, reference)? {
                    found.push((region.name, judged));
                }
            }
            Ok::<_, ValidateError>(found)
        };
        Ok(Self { regions: judged(effect.regions)?, hard_cases: judged(effect.hard_cases)? })
    }

    /// The regions in which `form` can be judged, by name, in the effect's order.
    ///
    /// # Errors
    /// If a table has columns of different lengths.
    pub(super) fn regions(
        &self,
        form: &Form,
    ) -> Result<Vec<(&'static str, Target)>, ValidateError> {
        served(&self.regions, form)
    }

    /// The sets of hard cases on which `form` can be judged, likewise.
    ///
    /// # Errors
    /// If a table has columns of different lengths.
    pub(super) fn hard_cases(
        &self,
        form: &Form,
    ) -> Result<Vec<(&'static str, Target)>, ValidateError> {
        served(&self.hard_cases, form)
    }

    /// All regions as one target; none if no region is the form's.
    ///
    /// # Errors
    /// If a table has columns of different lengths.
    pub(super) fn everywhere(&self, form: &Form) -> Result<Option<Target>, ValidateError> {
        Ok(Target::all(self.regions(form)?.into_iter().map(|(_, target)| target)))
    }

    /// The arguments of `reference` over all regions, or over the hard cases where it has none.
    pub(super) fn arguments(&self, reference: &Reference) -> Vec<Vec<f64>> {
        let from = if self.regions.is_empty() { &self.hard_cases } else { &self.regions };
        let column = |name: &str| {
            let columns = from.iter().filter_map(|(_, judged)| judged.points.column(name));
            columns.flat_map(|column| column.values.iter().copied()).collect()
        };
        reference.arguments.iter().map(|argument| column(argument.name)).collect()
    }
}

fn served(
    grounds: &[(&'static str, Arc<Judged>)],
    form: &Form,
) -> Result<Vec<(&'static str, Target)>, ValidateError> {
    let serving = grounds.iter().filter(|(_, judged)| judged.serves(form));
    serving.map(|(name, judged)| Ok((*name, judged.target(form)?))).collect()
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
    pub(super) fn of(&mut self, reference: &'static Reference) -> Result<&Grounds, ValidateError> {
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
