//! argmin's L-BFGS with Moré–Thuente's line search, in variables in which the problem is round.

use argmin::core::IterState;
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use nalgebra::DVector;

use super::attempt::{Attempt, BY_DERIVATIVES, Termination};
use super::scaled::{self, Scaled, give_up};
use crate::fit::problem::Problem;
use crate::form::FormError;

type Iteration = IterState<DVector<f64>, DVector<f64>, (), (), (), f64>;

/// Pairs of steps and gradients that are kept.
const MEMORY: usize = 10;
/// Restarts, each in variables scaled at the best point so far.
const ROUNDS: usize = 8;

/// Runs L-BFGS from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let mut iterations = 0;
    let mut at = start.clone();
    let mut attempt = None;
    for _ in 0..ROUNDS {
        let scaled = Scaled::orthonormal(problem, at.clone())?;
        let Some(before) = problem.best().map(|best| best.cost) else { break };
        let origin = DVector::zeros(scaled.variables());
        let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY)
            .with_tolerance_grad(0.0)
            .and_then(|solver| solver.with_tolerance_cost(1e-16 * before));
        let Some(solver) = give_up(solver)? else { break };
        let left = max_iterations - iterations;
        let begin = |state: Iteration| state.param(origin).max_iters(left);
        iterations += scaled::iterations(scaled, solver, begin)?.unwrap_or(1).min(left);
        let exhausted = iterations >= max_iterations;
        let judged = Attempt::judged(problem, start, iterations, exhausted, BY_DERIVATIVES)?;
        at.copy_from(&judged.variables);
        let go_on = judged.termination == Termination::Stalled && judged.cost < before;
        attempt = Some(judged);
        if !go_on {
            break;
        }
    }
    let unseen = || Attempt::judged(problem, start, iterations, false, BY_DERIVATIVES);
    attempt.map_or_else(unseen, Ok)
}
