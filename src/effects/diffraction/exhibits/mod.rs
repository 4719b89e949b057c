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
pub(super) use grating::PAPER;
pub(super) use jacobian::{disc_furnace, mean_over_disc};
pub(super) use wavelengths::rule_errors;

use super::DiffractionError;
use crate::document::Section;
use crate::effect::{Candidates, ClaimError};

/// What is said of the exhibits.
const TEXTS: &str = include_str!("../exhibits.toml");

/// Wavelength of what is shown at one, nm.
pub(super) const GREEN_NM: f64 = 550.0;

impl From<DiffractionError> for ClaimError {
    fn from(error: DiffractionError) -> Self {
        Self::new(error)
    }
}

/// What the effect shows beyond its fits.
pub(super) fn exhibits(_: &Candidates) -> Result<Vec<Section>, ClaimError> {
    Ok(vec![
        order_powers::exhibit()?,
        sections::exhibit()?,
        preparation::exhibit()?,
        wavelengths::exhibit()?,
        cosine::exhibit()?,
        jacobian::exhibit()?,
    ])
}
