//! Minimax: a continuation from least squares, then Newton on the levelled error.
//!
//! The continuation is Lawson's: least squares with weights multiplied by |error| each time, run on
//! the Levenberg–Marquardt solver, which moves the largest errors towards each other. The end is
//! Remez' idea for any form: the errors are linearised with exact derivatives, the linear Chebyshev
//! problem is solved by exchange ([`super::chebyshev`]), and the constants step there, which
//! converges quadratically. It has converged when the linear problem cannot lower the largest error
//! any further: a certificate of first-order optimality on the points.

use argmin::core::{
    Error, Executor, Gradient, IterState, KV, Problem as Counted, Solver, State, TerminationReason,
};
use nalgebra::{DMatrix, DVector};

use super::attempt::{Attempt, Termination};
use super::chebyshev;
use super::levenberg_marquardt;
use super::scaled::give_up;
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

/// The errors and their Jacobian, as argmin passes them to [`Exchange`].
struct Errors<'p, 'a>(&'p Problem<'a>);

impl Gradient for Errors<'_, '_> {
    type Param = DVector<f64>;
    type Gradient = (DVector<f64>, DMatrix<f64>);

    fn gradient(&self, at: &DVector<f64>) -> Result<Self::Gradient, Error> {
        Ok(self.0.linearise(at)?)
    }
}

type Iteration = IterState<DVector<f64>, (), (), (), (), f64>;

/// Newton's method on the levelled error.
struct Exchange<'p, 'a> {
    problem: &'p Problem<'a>,
    converged: bool,
}

impl Solver<Errors<'_, '_>, Iteration> for Exchange<'_, '_> {
    fn name(&self) -> &str {
        "exchange on the linearised errors"
    }

    fn next_iter(
        &mut self,
        problem: &mut Counted<Errors<'_, '_>>,
        mut state: Iteration,
    ) -> Result<(Iteration, Option<KV>), Error> {
        let at = state.take_param().unwrap_or_default();
        let (errors, jacobian) = problem.gradient(&at)?;
        let cost = errors.amax();
        let rounding = ROUNDING * self.problem.magnitude() / (self.problem.points() as f64).sqrt();
        if cost <= rounding {
            self.converged = true;
            let done = state.param(at).cost(cost);
            return Ok((done.terminate_with(TerminationReason::SolverConverged), None));
        }
        let Some((step, bound)) = step(&errors, &jacobian) else {
            let done = state.param(at).cost(cost);
            return Ok((
                done.terminate_with(TerminationReason::SolverExit("singular".into())),
                None,
            ));
        };
        if cost - bound <= (GAP * cost).max(rounding) {
            self.converged = true;
            let done = state.param(at).cost(cost);
            return Ok((done.terminate_with(TerminationReason::SolverConverged), None));
        }
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            let next = &at + &step * length;
            let next_cost = self.problem.cost(&next)?;
            if next_cost < cost {
                return Ok((state.param(next).cost(next_cost), None));
            }
            length *= 0.5;
        }
        let done = state.param(at).cost(cost);
        Ok((done.terminate_with(TerminationReason::SolverExit("no step".into())), None))
    }
}

/// The step to the solution of the linearised problem, and its levelled error.
fn step(errors: &DVector<f64>, jacobian: &DMatrix<f64>) -> Option<(DVector<f64>, f64)> {
    if jacobian.nrows() <= jacobian.ncols() || !jacobian.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut unit = jacobian.clone();
    let mut lengths = Vec::with_capacity(unit.ncols());
    for mut column in unit.column_iter_mut() {
        let length = column.norm();
        if length == 0.0 {
            return None;
        }
        column /= length;
        lengths.push(length);
    }
    let qr = unit.qr();
    let level = chebyshev::approximate(&qr.q(), errors)?;
    let mut step = qr.r().solve_upper_triangular(&level.coefficients)?;
    step.iter_mut().zip(&lengths).for_each(|(s, length)| *s /= length);
    step.iter().all(|s| s.is_finite()).then_some((step, level.error))
}

/// Runs the minimax fit from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let mut iterations = continuation(problem, start, max_iterations)?;
    let Some(best) = problem.best() else {
        return Attempt::judged(problem, start, iterations, false);
    };
    let exchange = Exchange { problem, converged: false };
    let run = Executor::new(Errors(problem), exchange)
        .configure(|state: Iteration| state.param(best.variables).max_iters(max_iterations))
        .ctrlc(false)
        .run();
    let (converged, exhausted) = match give_up(run)? {
        None => (false, false),
        Some(result) => {
            let count = result.state().get_iter();
            iterations += count;
            (result.solver().converged, count >= max_iterations)
        }
    };
    let mut attempt = Attempt::judged(problem, start, iterations, exhausted)?;
    attempt.termination = match (converged, exhausted) {
        (true, _) => Termination::Converged,
        (false, true) => Termination::IterationLimit,
        (false, false) => Termination::Stalled,
    };
    Ok(attempt)
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
        let factors = problem.factors().iter().zip(&weights).map(|(f, w)| f * f64::sqrt(*w));
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
