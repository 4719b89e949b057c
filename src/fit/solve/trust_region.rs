//! argmin's trust region with Steihaug's conjugate gradients.
//!
//! The Hessian is Gauss–Newton's JᵀJ. The first round runs in variables scaled by the columns of
//! the Jacobian; further rounds in variables that make its columns orthonormal at the best point so
//! far, in which the last digits come quickly however ill-conditioned the problem is.

use argmin::core::IterState;
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use nalgebra::{DMatrix, DVector};

use super::attempt::{Attempt, BY_DERIVATIVES, Termination};
use super::scaled::{self, Scaled, give_up};
use crate::fit::problem::Problem;
use crate::form::FormError;

type Iteration = IterState<DVector<f64>, DVector<f64>, (), DMatrix<f64>, (), f64>;

/// Most rounds after the first.
const ROUNDS: u64 = 12;
/// Iterations of each round after the first.
const ROUND: u64 = 20;

/// Runs the trust region from `start`.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let judged = |iterations: u64| {
        Attempt::judged(problem, start, iterations, iterations >= max_iterations, BY_DERIVATIVES)
    };
    let first = Scaled::columns(problem, start.clone())?;
    let mut iterations = round(problem, first, max_iterations.min(8 * ROUND))?;
    let mut attempt = judged(iterations)?;
    for _ in 0..ROUNDS {
        if attempt.termination != Termination::Stalled || iterations >= max_iterations {
            break;
        }
        let before = attempt.cost;
        let scaled = Scaled::orthonormal(problem, attempt.variables.clone())?;
        iterations += round(problem, scaled, ROUND.min(max_iterations - iterations))?;
        attempt = judged(iterations)?;
        if attempt.cost >= before {
            break;
        }
    }
    Ok(attempt)
}

fn round(problem: &Problem, scaled: Scaled, max_iterations: u64) -> Result<u64, FormError> {
    let origin = DVector::zeros(scaled.variables());
    let cost = problem.best().map_or(f64::NAN, |best| best.cost);
    let radius = (2.0 * cost).sqrt();
    if !radius.is_finite() || radius == 0.0 {
        return Ok(0);
    }
    let solver = TrustRegion::new(Steihaug::new().with_max_iters(200))
        .with_max_radius(1e3 * radius)
        .and_then(|solver| solver.with_radius(radius));
    let Some(solver) = give_up(solver)? else { return Ok(0) };
    let begin = |state: Iteration| state.param(origin).max_iters(max_iterations);
    Ok(scaled::iterations(scaled, solver, begin)?.unwrap_or(0))
}
