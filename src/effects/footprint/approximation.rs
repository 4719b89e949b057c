//! A registered form with constants, evaluated over columns by name: what exhibits and findings
//! hold against the references.

use rayon::prelude::*;

use crate::effect::exhibit::ExhibitError;
use crate::effect::fitted_form::FittedForm;
use crate::effect::{DomainError, FittedConstants};
use crate::effects;
use crate::form::FormError;
use crate::numeric::statistics;

/// An exact mean: a function of h and s.
pub(super) type Mean = fn(f64, f64) -> Result<f64, DomainError>;

/// Why a figure could not be measured.
#[derive(Debug, thiserror::Error)]
pub(super) enum NotMeasured {
    #[error(transparent)]
    Form(#[from] FormError),
    #[error(transparent)]
    Domain(#[from] DomainError),
}

impl From<NotMeasured> for ExhibitError {
    fn from(error: NotMeasured) -> Self {
        Self(error.to_string())
    }
}

/// A form and its constants: those of a fit, or of its text where there is none.
#[derive(Debug)]
pub(super) struct Approximation(FittedForm);

impl Approximation {
    /// The form and the constants of `footprint/fit`; `form` is the name of its form.
    pub(super) fn of(form: &str, fit: &str, fitted: &FittedConstants) -> Result<Self, NotMeasured> {
        let name = format!("footprint/{form}");
        Ok(Self(FittedForm::new(effects::form(&name)?, &format!("footprint/{fit}"), fitted)?))
    }

    /// The form of the fit of the same name.
    pub(super) fn named(name: &str, fitted: &FittedConstants) -> Result<Self, NotMeasured> {
        Self::of(name, name, fitted)
    }

    /// Values at named columns, in f64.
    pub(super) fn values(&self, columns: &[(&str, &[f64])]) -> Result<Vec<f64>, NotMeasured> {
        let inputs: Vec<&[f64]> = self
            .0
            .form()
            .input_columns()
            .iter()
            .filter_map(|input| columns.iter().find(|(name, _)| name == input))
            .map(|(_, values)| *values)
            .collect();
        Ok(self.0.double(&inputs)?)
    }

    /// Values over the offsets of one footprint.
    pub(super) fn over(&self, line: &Line) -> Result<Vec<f64>, NotMeasured> {
        let h = vec![line.half_extent; line.offsets.len()];
        let area_ratio = vec![line.area_ratio; line.offsets.len()];
        self.values(&[("h", &h), ("s", &line.offsets), ("area_ratio", &area_ratio)])
    }

    /// Relative L2 error over each line.
    pub(super) fn errors(&self, lines: &[Line]) -> Result<Vec<f64>, NotMeasured> {
        lines.iter().map(|line| Ok(relative_l2(&self.over(line)?, &line.exact))).collect()
    }
}

/// The exact mean over the offsets of one footprint.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) half_extent: f64,
    pub(super) area_ratio: f64,
    pub(super) offsets: Vec<f64>,
    pub(super) exact: Vec<f64>,
}

impl Line {
    pub(super) fn new(
        mean: Mean,
        half_extent: f64,
        area_ratio: f64,
        offsets: Vec<f64>,
    ) -> Result<Self, NotMeasured> {
        let exact = offsets.iter().map(|&s| mean(half_extent, s)).collect::<Result<_, _>>()?;
        Ok(Self { half_extent, area_ratio, offsets, exact })
    }

    /// `count` offsets over [0, h + 4.5] for every (h, A_P/A_C).
    pub(super) fn all(
        mean: Mean,
        footprints: &[(f64, f64)],
        count: u32,
    ) -> Result<Vec<Self>, NotMeasured> {
        footprints
            .par_iter()
            .map(|&(h, ratio)| {
                Self::new(mean, h, ratio, super::regions::offsets(h, count, 0.5).collect())
            })
            .collect()
    }
}

/// ‖values − exact‖ / ‖exact‖.
pub(super) fn relative_l2(values: &[f64], exact: &[f64]) -> f64 {
    statistics::relative_l2(values.iter().copied().zip(exact.iter().copied()))
}
