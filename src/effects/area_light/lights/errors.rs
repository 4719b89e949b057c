//! Candidates against their references over tables of points, for exhibits and claims.

use rayon::prelude::*;

use crate::effect::{Candidate, Candidates, ClaimError, DomainError, Reference};
use crate::effects::area_light::EFFECT;
use crate::numeric::statistics;
use crate::table::Table;

/// The light whose arguments the columns are, and its reference.
pub(super) fn light_of(points: &Table) -> (&'static str, &'static Reference) {
    let light = if points.column("radius").is_some() { "sphere" } else { "triangle" };
    (light, EFFECT.reference(&format!("{light}_light")))
}

/// The candidate `area_light/light_across`.
pub(super) fn named<'a>(
    candidates: &'a Candidates,
    light: &str,
    across: &str,
) -> Result<&'a Candidate, ClaimError> {
    Ok(candidates.get(&format!("area_light/{light}_{across}"))?)
}

/// Values in f32, widened.
pub(super) fn single(candidate: &Candidate, points: &Table) -> Result<Vec<f64>, ClaimError> {
    Ok(candidate.values_f32_at(points)?.into_iter().map(f64::from).collect())
}

/// The arguments at one point.
pub(super) fn row(points: &Table, row: usize) -> Vec<f64> {
    points.columns.iter().map(|column| column.values[row]).collect()
}

/// Values of the reference.
pub(super) fn exact(reference: &Reference, points: &Table) -> Result<Vec<f64>, DomainError> {
    let value = |at| reference.value(&row(points, at));
    (0..points.rows()).into_par_iter().map(value).collect()
}

/// Relative error in the L2 norm.
pub(super) fn relative_l2(values: &[f64], exact: &[f64]) -> f64 {
    statistics::relative_l2(values.iter().copied().zip(exact.iter().copied()))
}
