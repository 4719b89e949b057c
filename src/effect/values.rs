//! Values of references at points that several ask for: made once per run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::{Distribution, DomainError, Evaluate, Reference};

/// A point at which a reference has no value.
#[derive(Debug, Clone, PartialEq)]
pub struct NoValue {
    /// Its row, from 0.
    pub row: usize,
    /// Why.
    pub source: DomainError,
}

/// By reference and name of the points.
type KnownValues = BTreeMap<(&'static str, String), Arc<[f64]>>;

/// Values of references by reference and name of the points. A light's integral takes up to
/// milliseconds; fits, validation, gates and the report of one run share them.
#[derive(Debug, Default)]
pub struct ReferenceValues {
    known: Mutex<KnownValues>,
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
    /// Names of what it returns: `value`, the components of a vector, `mean` and `variance` of a
    /// distribution.
    pub fn outputs(&self) -> &'static [&'static str] {
        match self.evaluate {
            Evaluate::Scalar(_) => &["value"],
            Evaluate::Vector(names, _) => names,
            Evaluate::Distribution(_) => &["mean", "variance"],
        }
    }

    /// The value of a scalar at one point, arguments in their order; of a vector the first component, of a
    /// distribution the mean.
    ///
    /// # Errors
    /// [`DomainError`] outside the domain.
    pub fn value(&self, point: &[f64]) -> Result<f64, DomainError> {
        match self.evaluate {
            Evaluate::Scalar(value) => value(point),
            Evaluate::Vector(..) | Evaluate::Distribution(_) => {
                Ok(self.values(point)?.first().copied().unwrap_or(f64::NAN))
            }
        }
    }

    /// Everything it returns at one point, in the order of [`Self::outputs`].
    ///
    /// # Errors
    /// [`DomainError`] outside the domain.
    pub fn values(&self, point: &[f64]) -> Result<Vec<f64>, DomainError> {
        match self.evaluate {
            Evaluate::Scalar(value) => Ok(vec![value(point)?]),
            Evaluate::Vector(_, values) => values(point),
            Evaluate::Distribution(distribution) => {
                let Distribution { mean, variance, .. } = distribution(point)?;
                Ok(vec![mean, variance])
            }
        }
    }

    /// Values over `columns`, one per argument in their order: all rows of the first output, then those of
    /// the next.
    ///
    /// # Errors
    /// [`NoValue`] with the first row outside the domain.
    pub fn over(&self, columns: &[&[f64]]) -> Result<Vec<f64>, NoValue> {
        let rows = columns.first().map_or(0, |column| column.len());
        let point = |row: usize| -> Vec<f64> { columns.iter().map(|column| column[row]).collect() };
        if let Evaluate::Scalar(_) = self.evaluate {
            return in_order(rows, |row| self.value(&point(row)));
        }
        let all = in_order(rows, |row| self.values(&point(row)))?;
        let of = |output: usize| {
            all.iter().map(move |values| values.get(output).copied().unwrap_or(f64::NAN))
        };
        Ok((0..self.outputs().len()).flat_map(of).collect())
    }

    /// The distribution at every row of `columns`, one per argument in their order; none of a reference
    /// that returns numbers.
    ///
    /// # Errors
    /// [`NoValue`] with the first row outside the domain.
    pub fn distributions(&self, columns: &[&[f64]]) -> Result<Vec<Distribution>, NoValue> {
        let Evaluate::Distribution(distribution) = self.evaluate else { return Ok(Vec::new()) };
        let point = |row: usize| -> Vec<f64> { columns.iter().map(|column| column[row]).collect() };
        in_order(columns.first().map_or(0, |column| column.len()), |row| distribution(&point(row)))
    }
}

/// `value` of every row, in parallel; the fault of the first row that has one, whatever the number of
/// threads.
fn in_order<T: Send>(
    rows: usize,
    value: impl Fn(usize) -> Result<T, DomainError> + Sync,
) -> Result<Vec<T>, NoValue> {
    let value = |row: usize| value(row).map_err(|source| NoValue { row, source });
    (0..rows)
        .into_par_iter()
        .map(value)
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| (0..error.row).find_map(|row| value(row).err()).unwrap_or(error))
}
