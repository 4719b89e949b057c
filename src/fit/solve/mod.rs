//! Solvers, all behind [`solve_from`]: Gauss–Newton; argmin's trust region, L-BFGS, Nelder–Mead and
//! Brent; and MINPACK's Levenberg–Marquardt, which argmin has not.
//!
//! `auto` chooses
//! - Levenberg–Marquardt for least squares, relative and Huber losses (Huber through
//!   [`crate::fit::loss::Loss::pseudo`]); if that does not converge, the trust region and then
//!   Gauss–Newton from the same start, of which the lowest cost is kept;
//! - the continuation and exchange of `minimax` for the minimax loss.
//!
//! A constant that ends on a bound is pinned there and the others are fitted again: at a bound the
//! transformation is flat, and a solver approaches it more and more slowly. A fit that stalls next
//! to a bound is finished in the constants themselves.
//! One that stalls because rounding hides what is left of the cost goes on by its gradient; it is
//! held to the same criterion as every other ([`Attempt`]).

mod attempt;
mod brent;
mod chebyshev;
mod gauss_newton;
mod lbfgs;
mod levenberg_marquardt;
mod minimax;
mod nelder_mead;
mod scaled;
mod trust_region;

pub use attempt::{Attempt, Termination};
pub(super) use scaled::divide_columns;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::bounds::{Bounds, Transform};
use super::loss::Loss;
use super::problem::Problem;
use crate::form::FormError;

/// Which solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SolverKind {
    /// Chosen by the loss; see the module.
    #[default]
    Auto,
    /// Gauss–Newton with backtracking.
    GaussNewton,
    /// Trust region with Steihaug's conjugate gradients.
    TrustRegion,
    /// MINPACK's Levenberg–Marquardt.
    LevenbergMarquardt,
    /// Nelder–Mead's simplex.
    NelderMead,
    /// L-BFGS with Moré–Thuente's line search.
    Lbfgs,
    /// Brent, for one free constant.
    Brent,
}

impl SolverKind {
    /// Name as in a spec.
    pub fn name(self) -> &'static str {
        match self {
            SolverKind::Auto => "auto",
            SolverKind::GaussNewton => "gauss_newton",
            SolverKind::TrustRegion => "trust_region",
            SolverKind::LevenbergMarquardt => "levenberg_marquardt",
            SolverKind::NelderMead => "nelder_mead",
            SolverKind::Lbfgs => "lbfgs",
            SolverKind::Brent => "brent",
        }
    }

    /// Why this solver cannot be used for `loss` and `free` constants.
    pub fn objection(self, loss: Loss, free: usize) -> Option<String> {
        let smooth = matches!(
            self,
            Self::GaussNewton | Self::TrustRegion | Self::LevenbergMarquardt | Self::Lbfgs
        );
        if smooth && loss == Loss::Minimax {
            return Some(format!(
                "{} needs a smooth loss; for minimax expected auto, nelder_mead or brent",
                self.name()
            ));
        }
        if self == Self::Brent && free != 1 {
            return Some(format!("brent expects 1 free parameter, got {free}"));
        }
        None
    }
}

/// Where a fit from one start ended.
#[derive(Debug, Clone)]
pub struct Solution {
    /// All free constants.
    pub constants: Vec<f64>,
    /// Their cost; NaN if the form is not finite at the start.
    pub cost: f64,
    /// How the solver ended.
    pub termination: Termination,
    /// Iterations of the solver that won.
    pub iterations: u64,
    /// Evaluations over all points, of every solver that was tried.
    pub evaluations: u64,
    /// Indices of the constants that ended on a bound.
    pub at_bound: Vec<usize>,
    /// The solver that won, and why if that was left open.
    pub solver: String,
}

impl Solution {
    fn of(problem: &Problem, attempt: Attempt, solver: String) -> Self {
        let Attempt { cost, termination, iterations, .. } = attempt;
        let (constants, evaluations) =
            (problem.constants(&attempt.variables), problem.evaluations());
        Self { constants, cost, termination, iterations, evaluations, at_bound: Vec::new(), solver }
    }

    /// What `next` made of it if that is kept, else itself; the evaluations of both count.
    fn then(self, next: Self, kept: bool) -> Self {
        let evaluations = self.evaluations + next.evaluations;
        if !kept {
            return Self { evaluations, ..self };
        }
        let (iterations, solver) = (self.iterations + next.iterations, self.solver);
        Self { iterations, evaluations, solver, ..next }
    }
}

/// Distance to a bound, relative to the width, from which pinning is tried.
const NEAR_BOUND: f64 = 1e-3;

/// Fits from the start of `problem`.
///
/// # Errors
/// [`FormError`] if the form cannot be evaluated.
pub fn solve_from(
    problem: &Problem,
    kind: SolverKind,
    max_iterations: u64,
) -> Result<Solution, FormError> {
    let solution = solved(problem, kind, max_iterations)?;
    if solution.termination == Termination::NonFinite {
        return Ok(solution);
    }
    let solution = pin_to_bounds(problem, solution, kind, max_iterations)?;
    let bounded = problem.transforms.iter().any(|t| *t != Transform::Identity);
    if bounded && solution.termination == Termination::Stalled && solution.at_bound.is_empty() {
        return finish_unbounded(problem, solution, max_iterations);
    }
    Ok(solution)
}

/// By the solver as it is; the only solution where nothing varies.
fn solved(problem: &Problem, kind: SolverKind, max_iterations: u64) -> Result<Solution, FormError> {
    if problem.variables() > 0 {
        let (attempt, solver) = attempt(problem, kind, max_iterations)?;
        return Ok(Solution::of(problem, attempt, solver));
    }
    let variables = problem.start();
    let cost = problem.cost(&variables)?;
    let termination =
        if cost.is_finite() { Termination::Converged } else { Termination::NonFinite };
    let only = Attempt { variables, cost, termination, iterations: 0 };
    Ok(Solution::of(problem, only, "none (nothing is free)".to_owned()))
}

/// Near a bound but not on it the transformation is so curved that a solver can stall: from there
/// Levenberg–Marquardt goes on in the constants themselves, and the result is kept if it is within
/// the bounds and converged.
fn finish_unbounded(
    problem: &Problem,
    stalled: Solution,
    max_iterations: u64,
) -> Result<Solution, FormError> {
    if problem.loss == Loss::Minimax {
        return Ok(stalled);
    }
    let rest = problem.unbounded(stalled.constants.clone());
    let found = solved(&rest, SolverKind::LevenbergMarquardt, max_iterations)?;
    let inside = problem.transforms.iter().zip(&found.constants).all(|(t, c)| t.contains(*c));
    let kept = inside && found.termination == Termination::Converged && found.cost <= stalled.cost;
    Ok(stalled.then(found, kept))
}

/// Puts the constants that are next to a bound on it, fits the others again, and keeps the result
/// if it costs no more.
fn pin_to_bounds(
    problem: &Problem,
    free: Solution,
    kind: SolverKind,
    max_iterations: u64,
) -> Result<Solution, FormError> {
    let mut constants = free.constants.clone();
    let mut pinned = Vec::new();
    for (i, (constant, transform)) in constants.iter_mut().zip(&problem.transforms).enumerate() {
        if let Some(bound) = transform.bound_at(*constant, NEAR_BOUND) {
            *constant = bound;
            pinned.push(i);
        }
    }
    if pinned.is_empty() {
        return Ok(free);
    }
    let kind = if kind == SolverKind::Brent { SolverKind::Auto } else { kind };
    let found = solved(&problem.pinned(constants, &pinned), kind, max_iterations)?;
    let kept = found.cost <= free.cost * (1.0 + 1e-9);
    Ok(free.then(Solution { at_bound: pinned, ..found }, kept))
}

type Solve = fn(&Problem, &nalgebra::DVector<f64>, u64) -> Result<Attempt, FormError>;

fn attempt(
    problem: &Problem,
    kind: SolverKind,
    max_iterations: u64,
) -> Result<(Attempt, String), FormError> {
    let start = problem.start();
    let solve: Solve = match kind {
        SolverKind::Auto => return automatic(problem, max_iterations),
        SolverKind::GaussNewton => gauss_newton::solve,
        SolverKind::TrustRegion => trust_region::solve,
        SolverKind::LevenbergMarquardt => levenberg_marquardt::solve,
        SolverKind::NelderMead => nelder_mead::solve,
        SolverKind::Lbfgs => lbfgs::solve,
        SolverKind::Brent => brent::solve,
    };
    Ok((solve(problem, &start, max_iterations)?, kind.name().to_owned()))
}

fn automatic(problem: &Problem, max_iterations: u64) -> Result<(Attempt, String), FormError> {
    let start = problem.start();
    if problem.loss == Loss::Minimax {
        let attempt = minimax::solve(problem, &start, max_iterations)?;
        let why = "minimax exchange (auto: the loss is not smooth; Lawson continuation by \
                   levenberg_marquardt first)";
        return Ok((attempt, why.into()));
    }
    let mut best = levenberg_marquardt::solve(problem, &start, max_iterations)?;
    let mut solver = "levenberg_marquardt (auto: smooth loss; argmin has no such method)";
    let others: [(Solve, &str); 2] = [
        (trust_region::solve, "trust_region (auto: levenberg_marquardt did not converge)"),
        (gauss_newton::solve, "gauss_newton (auto: levenberg_marquardt did not converge)"),
    ];
    for (solve, why) in others {
        if matches!(best.termination, Termination::Converged | Termination::NonFinite) {
            break;
        }
        // A problem remembers its best point: a fresh one, so that each solver is judged by its own.
        let fresh = problem.fresh();
        let other = solve(&fresh, &start, max_iterations)?;
        problem.count(fresh.evaluations());
        if other.cost < best.cost
            || other.termination == Termination::Converged && other.cost <= best.cost
        {
            (best, solver) = (other, why);
        }
    }
    Ok((best, solver.into()))
}

/// The given start and `count − 1` further ones, seeded.
///
/// Between two bounds they are uniform; beyond one bound the distance to it is multiplied by 10^t, t
/// uniform in [−1, 1]; without bounds they are within twice the start's magnitude (or 1, if that is
/// 0) of the start.
pub fn starts(start: &[f64], bounds: &[Bounds], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut all = vec![start.to_vec()];
    while all.len() < count {
        let next = start.iter().zip(bounds).map(|(s, b)| {
            let t: f64 = random.random_range(-1.0..1.0);
            let apart = |bound: f64| if *s == bound { 1.0 } else { *s - bound };
            match (b.lower, b.upper) {
                (Some(low), Some(high)) => low + (high - low) * 0.5 * (1.0 + t),
                (Some(bound), None) | (None, Some(bound)) => {
                    bound
                        + apart(bound).abs().copysign(if b.lower.is_some() { 1.0 } else { -1.0 })
                            * 10f64.powf(t)
                }
                (None, None) => s + 2.0 * t * if *s == 0.0 { 1.0 } else { s.abs() },
            }
        });
        all.push(next.collect());
    }
    all
}
