//! Values of references at points that several ask for: made once per run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::{DomainError, Reference};

/// A point at which a reference has no value.
#[derive(Debug, Clone, PartialEq)]
pub struct NoValue {
    /// Its row, from 0.
    pub row: usize,
    /// Why.
    pub source: DomainError,
}

/// Values of references by reference and name of the points. A light's integral takes up to
/// milliseconds; fits, validation, gates and the report of one run share them.
#[derive(Debug, Default)]
pub struct ReferenceValues {
    known: Mutex<BTreeMap<(&'static str, String), Arc<[f64]>>>,
}

impl ReferenceValues {
    /// Values of `reference` over `columns`, one per argument; made when `points`, a name that means
    /// the same points throughout a run, is asked for the first time.
    ///
    /// # Errors
    /// [`NoValue`] with the first row outside the domain.
    pub fn at(
        &self,
        reference: &'static Reference,
        points: &str,
        columns: &[&[f64]],
    ) -> Result<Arc<[f64]>, NoValue> {
        let key = (reference.name, points.to_owned());
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&key) {
            return Ok(Arc::clone(found));
        }
        let found: Arc<[f64]> = reference.over(columns)?.into();
        known().insert(key, Arc::clone(&found));
        Ok(found)
    }
}

impl Reference {
    /// Values over `columns`, one per argument in their order.
    ///
    /// # Errors
    /// [`NoValue`] with the first row outside the domain.
    pub fn over(&self, columns: &[&[f64]]) -> Result<Vec<f64>, NoValue> {
        let rows = columns.first().map_or(0, |column| column.len());
        let value = |row: usize| {
            let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
            (self.evaluate)(&point).map_err(|source| NoValue { row, source })
        };
        // Rayon returns any error: the first one is found again, so that a message does not depend on
        // the number of threads.
        (0..rows)
            .into_par_iter()
            .map(value)
            .collect::<Result<Vec<_>, _>>()
            .or_else(|error| Err((0..error.row).find_map(|row| value(row).err()).unwrap_or(error)))
    }
}
