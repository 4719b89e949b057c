//! Error along one argument, for plots.

use serde::{Deserialize, Serialize};

use crate::effect::{Candidate, Member, Reference};
use crate::table::{Column, Table};
use crate::validate::ValidateError;
use crate::validate::accuracy::{GroundTruth, values_f32};

/// Error of one form along its argument.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The fit.
    pub name: String,
    /// Argument and error (form in f32 minus target), in increasing order of the argument.
    pub points: Vec<(f64, f64)>,
}

/// Error of `candidate` at `arguments` against a reference of one argument.
///
/// # Errors
/// If the reference takes another number of arguments, or either has no value there.
pub fn against_reference(
    candidate: &Candidate,
    reference: &Reference,
    arguments: &[f64],
) -> Result<Curve, ValidateError> {
    let values = arguments.iter().map(|value| f64::from(*value as f32)).collect();
    let name = reference.arguments.first().map_or("", |argument| argument.name);
    let points = Table {
        columns: vec![Column::new(name, "1", values)],
        origin: format!("points of {}", reference.name),
    };
    error(candidate, &GroundTruth::of_reference(reference, points, &candidate.form)?)
}

/// Error of `candidate` over a family member's held-out table, along the first argument.
///
/// # Errors
/// If the table lacks a column, or the form cannot be evaluated.
pub fn over_member(candidate: &Candidate, member: &Member) -> Result<Curve, ValidateError> {
    error(candidate, &GroundTruth::of_table(&member.table, &candidate.form)?)
}

fn error(candidate: &Candidate, target: &GroundTruth) -> Result<Curve, ValidateError> {
    let values = values_f32(candidate, target)?;
    let errors = values.iter().zip(&target.values).map(|(value, truth)| f64::from(*value) - truth);
    let along = target.inputs.first().into_iter().flatten().copied();
    let mut points: Vec<(f64, f64)> = along.zip(errors).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(Curve { name: candidate.name.clone(), points })
}
