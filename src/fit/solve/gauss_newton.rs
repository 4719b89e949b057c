//! Gauss–Newton with a step by orthogonal decomposition and a backtracking line search.
//!
//! argmin's inverts JᵀJ, which squares the condition number, and stops on an absolute difference of the
//! cost, which has a unit.

use argmin::core::Error;
use nalgebra::{DMatrix, DVector, Dyn, SVD};

use super::attempt::{Attempt, BY_DERIVATIVES, relative_offset};
use super::scaled::{Scaled, divide_columns, give_up};
use crate::fit::problem::Problem;
use crate::form::FormError;

/// Relative offset at which iterating stops; the digits left are below those of the constants.
const ENOUGH: f64 = 1e-10;
/// Halvings of a step before it is given up.
const HALVINGS: u32 = 40;
/// Armijo's fraction of the predicted decrease.
const SUFFICIENT: f64 = 1e-4;
/// Iterations after which the singular values are given up, and with them the step.
const SVD_ITERATIONS: usize = 1000;
/// Singular values below this part of the largest are left out of the step.
const RANK: f64 = 1e-13;

/// Runs Gauss–Newton from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let scaled = Scaled::columns(problem, start.clone())?;
    let iterations = give_up(iterate(&scaled, max_iterations))?.unwrap_or(0);
    let exhausted = iterations >= max_iterations;
    Attempt::judged(problem, start, iterations, exhausted, BY_DERIVATIVES)
}

/// Iterations until none goes on.
fn iterate(scaled: &Scaled, max_iterations: u64) -> Result<u64, Error> {
    let mut at = DVector::zeros(scaled.variables());
    for iteration in 1..=max_iterations {
        match next(scaled, &at)? {
            Some(next) => at = next,
            None => return Ok(iteration),
        }
    }
    Ok(max_iterations)
}

/// The point after `at`; none where the form is not finite, at the optimum, and if no step helps.
fn next(scaled: &Scaled, at: &DVector<f64>) -> Result<Option<DVector<f64>>, Error> {
    let (residuals, jacobian) = scaled.linearised(at, |r, j| (r.clone(), j.clone()))?;
    let cost = 0.5 * residuals.norm_squared();
    let finite = cost.is_finite() && jacobian.iter().all(|x| x.is_finite());
    if !finite || relative_offset(&residuals, &jacobian) <= ENOUGH {
        return Ok(None);
    }
    let step = least_squares_step(&jacobian, &residuals);
    let decrease = -jacobian.tr_mul(&residuals).dot(&step);
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let next = at + &step * length;
        let next_cost = 0.5 * scaled.linearised(&next, |residuals, _| residuals.norm_squared())?;
        if next_cost <= cost - SUFFICIENT * length * decrease && next != *at {
            return Ok(Some(next));
        }
        length *= 0.5;
    }
    Ok(None)
}

/// −J⁺r, of least norm in the column-scaled variables where J is singular.
pub(super) fn least_squares_step(
    jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
) -> DVector<f64> {
    let norms = jacobian.column_iter().map(|column| column.norm());
    let lengths = norms.map(|norm| if norm > 0.0 { norm } else { 1.0 });
    let lengths = DVector::from_iterator(jacobian.ncols(), lengths);
    let mut unit = jacobian.clone();
    divide_columns(&mut unit, &lengths);
    let solve =
        |svd: SVD<f64, Dyn, Dyn>| svd.solve(residuals, RANK * svd.singular_values.max()).ok();
    let svd = unit.try_svd(true, true, f64::EPSILON, SVD_ITERATIONS);
    let mut step = svd.and_then(solve).unwrap_or_else(|| DVector::zeros(lengths.len()));
    step.component_div_assign(&-lengths);
    step
}
