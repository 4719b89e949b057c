//! What the effect shows beyond its fits: orders against J_m², sections of tables, and what each step and
//! each assumption costs.

mod cosine;
mod grating;
mod jacobian;
mod order_powers;
mod preparation;
mod sections;
mod wavelengths;

pub(super) use cosine::{fixed_cosine_error, grating_error as cosine_error};
pub(super) use jacobian::{disc_furnace, mean_over_disc};
pub(super) use wavelengths::rule_errors;

use super::DiffractionError;
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitError, ExhibitSeries, ExhibitTable, Stroke,
};
use crate::effect::{DomainError, FittedConstants};

/// Wavelength of what is shown at one, nm.
pub(super) const GREEN_NM: f64 = 550.0;

impl From<DiffractionError> for ExhibitError {
    fn from(error: DiffractionError) -> Self {
        Self(error.to_string())
    }
}

impl From<DomainError> for ExhibitError {
    fn from(error: DomainError) -> Self {
        Self(error.to_string())
    }
}

/// What the effect shows beyond its fits.
pub(super) fn exhibits(_: &FittedConstants) -> Result<Vec<Exhibit>, ExhibitError> {
    Ok(vec![
        order_powers::exhibit()?,
        sections::exhibit()?,
        preparation::exhibit()?,
        wavelengths::exhibit()?,
        cosine::exhibit()?,
        jacobian::exhibit()?,
    ])
}

const H: ExhibitAxis = ExhibitAxis { label: "h along x", unit: "1", log: false };

fn series(name: &str, points: Vec<(f64, f64)>, stroke: Stroke) -> ExhibitSeries {
    ExhibitSeries { name: name.into(), points, stroke }
}

fn number(value: f64) -> ExhibitCell {
    ExhibitCell::Number(value)
}

fn table(
    caption: &str,
    columns: &[(&str, &'static str)],
    rows: Vec<Vec<ExhibitCell>>,
) -> ExhibitTable {
    ExhibitTable {
        caption: caption.into(),
        columns: columns.iter().map(|(name, unit)| ((*name).to_owned(), *unit)).collect(),
        rows,
    }
}
