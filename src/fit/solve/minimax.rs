//! Minimax: a continuation from least squares, then Newton on the levelled error.
//!
//! The continuation is Lawson's: least squares with weights multiplied by |error| each time, run on
//! the Levenberg–Marquardt solver, which moves the largest errors towards each other. The end is
//! Remez' idea for any form: the errors are linearised with exact derivatives, the linear Chebyshev
//! problem is solved by exchange ([`super::chebyshev`]), and the constants step there, which
//! converges quadratically. It has converged when the linear problem cannot lower the largest error
//! any further: a certificate of first-order optimality on the points.

use nalgebra::{DMatrix, DVector};

use super::attempt::{Attempt, BY_DERIVATIVES, Termination};
use super::scaled::divide_columns;
use super::{chebyshev, levenberg_marquardt};
use crate::fit::loss::Loss;
use crate::fit::problem::Problem;
use crate::form::FormError;

/// Rounds of Lawson's weights.
const LAWSON: usize = 12;
/// Evaluations of each of them.
const LAWSON_BUDGET: u64 = 40;
/// Relative gap between the largest error and its lower bound at which it has converged.
const GAP: f64 = 1e-9;
/// The same gap relative to the target, under which it is rounding.
const ROUNDING: f64 = 1e-13;
/// Halvings of a step before it is given up.
const HALVINGS: u32 = 30;

/// The step to the solution of the linearised problem, and its levelled error.
fn step(errors: &DVector<f64>, jacobian: &DMatrix<f64>) -> Option<(DVector<f64>, f64)> {
    if jacobian.nrows() <= jacobian.ncols() || !jacobian.iter().all(|x| x.is_finite()) {
        return None;
    }
    let norms = jacobian.column_iter().map(|column| column.norm());
    let lengths = DVector::from_iterator(jacobian.ncols(), norms);
    if lengths.iter().any(|length| *length == 0.0) {
        return None;
    }
    let mut unit = jacobian.clone();
    divide_columns(&mut unit, &lengths);
    let qr = unit.qr();
    let level = chebyshev::approximate(&qr.q(), errors)?;
    let mut step = qr.r().solve_upper_triangular(&level.coefficients)?;
    step.component_div_assign(&lengths);
    step.iter().all(|s| s.is_finite()).then_some((step, level.error))
}

/// Runs the minimax fit from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let smoothed = continuation(problem, start, max_iterations)?;
    let Some(best) = problem.best() else {
        return Attempt::judged(problem, start, smoothed, false, BY_DERIVATIVES);
    };
    let (iterations, converged) = exchange(problem, best.variables, max_iterations)?;
    let exhausted = iterations >= max_iterations;
    let total = smoothed + iterations;
    let mut attempt = Attempt::judged(problem, start, total, exhausted, BY_DERIVATIVES)?;
    attempt.termination = match (converged, exhausted) {
        (true, _) => Termination::Converged,
        (false, true) => Termination::IterationLimit,
        (false, false) => Termination::Stalled,
    };
    Ok(attempt)
}

/// Newton's method on the levelled error: its iterations, and whether it has converged.
fn exchange(
    problem: &Problem,
    mut at: DVector<f64>,
    max_iterations: u64,
) -> Result<(u64, bool), FormError> {
    let rounding = ROUNDING * problem.magnitude() / (problem.points() as f64).sqrt();
    for iteration in 1..=max_iterations {
        let (errors, jacobian) = problem.linearise(&at)?;
        let cost = errors.amax();
        if cost <= rounding {
            return Ok((iteration, true));
        }
        let Some((step, bound)) = step(&errors, &jacobian) else { return Ok((iteration, false)) };
        if cost - bound <= (GAP * cost).max(rounding) {
            return Ok((iteration, true));
        }
        match lower(problem, &at, &step, cost)? {
            Some(next) => at = next,
            None => return Ok((iteration, false)),
        }
    }
    Ok((max_iterations, false))
}

/// The first point that costs less than `cost` along `step`, halved as often as that takes.
fn lower(
    problem: &Problem,
    at: &DVector<f64>,
    step: &DVector<f64>,
    cost: f64,
) -> Result<Option<DVector<f64>>, FormError> {
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let next = at + step * length;
        if problem.cost(&next)? < cost {
            return Ok(Some(next));
        }
        length *= 0.5;
    }
    Ok(None)
}

/// Least squares, then Lawson's weights; returns the iterations. Every point on the way is offered
/// to `problem`, which remembers the one with the least largest error.
fn continuation(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<u64, FormError> {
    let mut weights = vec![1.0; problem.points()];
    let mut at = start.clone();
    let mut iterations = 0;
    for round in 0..=LAWSON {
        let factors = problem.factors.iter().zip(&weights).map(|(f, w)| f * f64::sqrt(*w));
        let smooth = problem.with_loss(Loss::LeastSquares, factors.collect());
        let budget = if round == 0 { max_iterations } else { LAWSON_BUDGET };
        let attempt = levenberg_marquardt::solve(&smooth, &at, budget)?;
        problem.count(smooth.evaluations());
        iterations += attempt.iterations;
        if attempt.termination == Termination::NonFinite {
            break;
        }
        at = attempt.variables;
        let errors = problem.residuals(&at)?;
        let total: f64 = weights.iter().zip(&errors).map(|(w, e)| w * e.abs()).sum();
        if !total.is_finite() || total == 0.0 {
            break;
        }
        let count = errors.len() as f64;
        for (weight, error) in weights.iter_mut().zip(&errors) {
            *weight *= error.abs() * count / total;
        }
    }
    Ok(iterations)
}
