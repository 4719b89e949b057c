//! Forms of lights against their references over tables of points, for exhibits and findings.

use rayon::prelude::*;

use crate::effect::exhibit::ExhibitError;
use crate::effect::fitted_form::FittedForm;
use crate::effect::{FittedConstants, Reference};
use crate::effects;
use crate::numeric::statistics;
use crate::table::Table;

/// A form with the constants of its fit, or those of its text where it has no fit.
pub(super) struct Loaded(FittedForm);

impl Loaded {
    /// The form `area_light/name`.
    pub(super) fn new(name: &str, fitted: &FittedConstants) -> Result<Self, ExhibitError> {
        let full = format!("area_light/{name}");
        effects::form(&full)
            .and_then(|entry| FittedForm::new(entry, &full, fitted))
            .map(Self)
            .map_err(|error| ExhibitError(error.to_string()))
    }

    /// Values at the points, in f32.
    pub(super) fn single(&self, points: &Points) -> Result<Vec<f64>, ExhibitError> {
        let columns: Vec<Vec<f32>> =
            points.columns.iter().map(|c| c.iter().map(|&v| v as f32).collect()).collect();
        let columns: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
        let values = self.0.single(&columns).map_err(|error| ExhibitError(error.to_string()))?;
        Ok(values.into_iter().map(f64::from).collect())
    }

    /// Values at the points, in f64.
    pub(super) fn double(&self, points: &Points) -> Result<Vec<f64>, ExhibitError> {
        let columns: Vec<&[f64]> = points.columns.iter().map(Vec::as_slice).collect();
        self.0.double(&columns).map_err(|error| ExhibitError(error.to_string()))
    }
}

/// Columns of arguments.
pub(super) struct Points {
    pub columns: Vec<Vec<f64>>,
}

impl Points {
    pub(super) fn new(table: Table) -> Self {
        Self { columns: table.columns.into_iter().map(|column| column.values).collect() }
    }

    /// Number of points.
    pub(super) fn count(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// The arguments at one point.
    pub(super) fn row(&self, row: usize) -> Vec<f64> {
        self.columns.iter().map(|column| column[row]).collect()
    }

    /// Values of the reference.
    pub(super) fn exact(&self, reference: &Reference) -> Result<Vec<f64>, ExhibitError> {
        (0..self.count())
            .into_par_iter()
            .map(|row| (reference.evaluate)(&self.row(row)))
            .collect::<Result<_, _>>()
            .map_err(|error| ExhibitError(error.to_string()))
    }
}

/// Relative error in the L2 norm.
pub(super) fn relative_l2(values: &[f64], exact: &[f64]) -> f64 {
    statistics::relative_l2(values.iter().copied().zip(exact.iter().copied()))
}
