//! Gauss–Newton with a step by orthogonal decomposition and a backtracking line search.
//!
//! argmin drives it; the iteration is ours because argmin's inverts JᵀJ, which squares the condition
//! number, and stops on an absolute difference of the cost, which has a unit.

use argmin::core::{
    Error, Executor, IterState, Jacobian, KV, Operator, Problem as Counted, Solver, State,
    TerminationReason, TerminationStatus,
};
use nalgebra::{DMatrix, DVector, Dyn, SVD};

use super::attempt::{Attempt, relative_offset};
use super::scaled::{Scaled, give_up};
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

type Iteration = IterState<DVector<f64>, (), DMatrix<f64>, (), DVector<f64>, f64>;

struct GaussNewton;

impl<O> Solver<O, Iteration> for GaussNewton
where
    O: Operator<Param = DVector<f64>, Output = DVector<f64>>
        + Jacobian<Param = DVector<f64>, Jacobian = DMatrix<f64>>,
{
    fn name(&self) -> &str {
        "Gauss-Newton with backtracking"
    }

    fn next_iter(
        &mut self,
        problem: &mut Counted<O>,
        mut state: Iteration,
    ) -> Result<(Iteration, Option<KV>), Error> {
        let at = state.take_param().unwrap_or_default();
        let residuals = problem.apply(&at)?;
        let jacobian = problem.jacobian(&at)?;
        let cost = 0.5 * residuals.norm_squared();
        let finite = cost.is_finite() && jacobian.iter().all(|x| x.is_finite());
        if !finite || relative_offset(&residuals, &jacobian) <= ENOUGH {
            let done = state.param(at).cost(cost);
            return Ok((done.terminate_with(TerminationReason::SolverConverged), None));
        }
        let step = least_squares_step(&jacobian, &residuals);
        let decrease = -jacobian.tr_mul(&residuals).dot(&step);
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            let next = &at + &step * length;
            let next_cost = 0.5 * problem.apply(&next)?.norm_squared();
            if next_cost <= cost - SUFFICIENT * length * decrease && next != at {
                return Ok((state.param(next).cost(next_cost), None));
            }
            length *= 0.5;
        }
        let done = state.param(at).cost(cost);
        Ok((done.terminate_with(TerminationReason::SolverExit("no step".into())), None))
    }

    fn terminate(&mut self, _state: &Iteration) -> TerminationStatus {
        TerminationStatus::NotTerminated
    }
}

/// −J⁺r, of least norm in the column-scaled variables where J is singular.
pub(super) fn least_squares_step(
    jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
) -> DVector<f64> {
    let lengths: Vec<f64> = jacobian
        .column_iter()
        .map(|column| Some(column.norm()).filter(|l| *l > 0.0).unwrap_or(1.0))
        .collect();
    let mut unit = jacobian.clone();
    for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let solve =
        |svd: SVD<f64, Dyn, Dyn>| svd.solve(residuals, RANK * svd.singular_values.max()).ok();
    let svd = unit.try_svd(true, true, f64::EPSILON, SVD_ITERATIONS);
    let mut step = svd.and_then(solve).unwrap_or_else(|| DVector::zeros(lengths.len()));
    for (s, length) in step.iter_mut().zip(&lengths) {
        *s /= -length;
    }
    step
}

/// Runs Gauss–Newton from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let scaled = Scaled::columns(problem, start.clone())?;
    let origin = DVector::zeros(scaled.variables());
    let run = Executor::new(scaled, GaussNewton)
        .configure(|state: Iteration| state.param(origin).max_iters(max_iterations))
        .ctrlc(false)
        .run();
    let iterations = give_up(run)?.map_or(0, |result| result.state().get_iter());
    Attempt::judged(problem, start, iterations, iterations >= max_iterations)
}
