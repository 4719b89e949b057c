//! argmin's Nelder–Mead, restarted at its best point until that no longer helps.

use argmin::core::IterState;
use argmin::solver::neldermead::NelderMead;
use nalgebra::DVector;

use super::attempt::{Attempt, BY_COST, Termination};
use super::scaled::{self, Scaled, give_up};
use crate::fit::loss::Loss;
use crate::fit::problem::Problem;
use crate::form::FormError;

type Iteration = IterState<DVector<f64>, (), (), (), (), f64>;

/// Edges of the first simplices relative to the size of the residual; each restart a smaller one.
const EDGES: [f64; 6] = [0.3, 0.1, 3e-2, 3e-3, 1e-4, 1e-6];

/// Runs Nelder–Mead from `start`. Each iteration of the spec's budget buys as many of its own
/// cheap ones as there are variables, times ten.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let budget = max_iterations.saturating_mul(10 * start.len() as u64);
    let mut iterations = 0;
    let mut at = start.clone();
    for edge in EDGES {
        let scaled = Scaled::orthonormal(problem, at.clone())?;
        let Some(best) = problem.best() else { break };
        let n = scaled.variables();
        let size = edge * residual_size(problem, best.cost);
        if size == 0.0 || iterations >= budget {
            break;
        }
        let mut simplex = vec![DVector::zeros(n)];
        for axis in 0..n {
            let mut corner = DVector::zeros(n);
            corner[axis] = size;
            simplex.push(corner);
        }
        let solver = NelderMead::new(simplex).with_sd_tolerance(1e-14 * best.cost);
        let Some(solver) = give_up(solver)? else { break };
        let begin = |state: Iteration| state.max_iters(budget - iterations);
        iterations += scaled::iterations(scaled, solver, begin)?.unwrap_or(0);
        let Some(best) = problem.best() else { break };
        at = best.variables;
    }
    let exhausted = iterations >= budget;
    let mut attempt = Attempt::judged(problem, start, iterations, exhausted, BY_COST)?;
    // A simplex that has closed says nothing about a gradient; under a loss that is not smooth no
    // criterion holds, and the fit may not call itself converged.
    if problem.loss == Loss::Minimax && attempt.termination == Termination::Converged {
        attempt.termination = Termination::Stalled;
    }
    Ok(attempt)
}

/// Norm of the residuals, from the cost; for the minimax loss as if all were the largest.
fn residual_size(problem: &Problem, cost: f64) -> f64 {
    match problem.loss {
        Loss::Minimax => cost * (problem.points() as f64).sqrt(),
        _ => (2.0 * cost).sqrt(),
    }
}
