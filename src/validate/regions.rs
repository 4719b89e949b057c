//! What forms are judged on, made once per run whoever asks: the points of a region and the values of
//! its reference there.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::effect::points::rounded;
use crate::effect::{Effect, Reference, Region};
use crate::form::Form;
use crate::table::Table;
use crate::validate::ValidateError;
use crate::validate::accuracy::{GroundTruth, Judged};

/// By reference and region; none where the region has not every argument of the reference.
type JudgedRegions = BTreeMap<(&'static str, &'static str), Option<Arc<Judged>>>;

/// Points and values of every region that was asked for.
#[derive(Debug, Default)]
pub struct Atlas {
    known: Mutex<JudgedRegions>,
}

/// The regions and the hard cases of one reference, for every form that approximates it.
#[derive(Debug, Clone)]
pub(super) struct Grounds {
    pub(super) regions: Vec<(&'static str, Arc<Judged>)>,
    pub(super) hard_cases: Vec<(&'static str, Arc<Judged>)>,
}

impl Atlas {
    /// The points of `region` with the values of `reference`; none if the region has not every argument
    /// of it.
    ///
    /// Points are numbers of f32, so that a form in f32 and a reference in f64 see the same argument.
    ///
    /// # Errors
    /// [`ValidateError::Unusable`] if a point is outside the domain.
    pub fn judged(
        &self,
        region: &'static Region,
        reference: &'static Reference,
    ) -> Result<Option<Arc<Judged>>, ValidateError> {
        let key = (reference.name, region.name);
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&key) {
            return Ok(found.clone());
        }
        let points = rounded((region.points)());
        let found = has_arguments(&points, reference)
            .then(|| Judged::new(reference, points, region.by, region.yardstick))
            .transpose()?
            .map(Arc::new);
        known().insert(key, found.clone());
        Ok(found)
    }

    pub(super) fn grounds(
        &self,
        effect: &Effect,
        reference: &'static Reference,
    ) -> Result<Grounds, ValidateError> {
        let judged = |regions: &'static [Region]| {
            let mut found = Vec::new();
            for region in regions {
                if let Some(judged) = self.judged(region, reference)? {
                    found.push((region.name, judged));
                }
            }
            Ok::<_, ValidateError>(found)
        };
        Ok(Grounds { regions: judged(effect.regions)?, hard_cases: judged(effect.hard_cases)? })
    }
}

impl Grounds {
    /// All regions together.
    pub(super) fn everywhere(&self, form: &Form) -> Result<Option<GroundTruth>, ValidateError> {
        Ok(GroundTruth::all(served(&self.regions, form)?.into_iter().map(|(_, target)| target)))
    }

    /// The arguments of the reference over all regions, or over the hard cases where there are none.
    pub(super) fn arguments(&self, reference: &Reference) -> Vec<Vec<f64>> {
        let from = if self.regions.is_empty() { &self.hard_cases } else { &self.regions };
        let column = |name: &str| {
            let columns = from.iter().filter_map(|(_, judged)| judged.points.column(name));
            columns.flat_map(|column| column.values.iter().copied()).collect()
        };
        reference.arguments.iter().map(|argument| column(argument.name)).collect()
    }
}

/// Those of `grounds` that have a column for every input of `form`.
pub(super) fn served(
    grounds: &[(&'static str, Arc<Judged>)],
    form: &Form,
) -> Result<Vec<(&'static str, GroundTruth)>, ValidateError> {
    let serving = grounds.iter().filter(|(_, judged)| judged.serves(form));
    serving.map(|(name, judged)| Ok((*name, judged.target(form)?))).collect()
}

fn has_arguments(points: &Table, reference: &Reference) -> bool {
    points.rows() > 0
        && reference.arguments.iter().all(|argument| points.column(argument.name).is_some())
}
