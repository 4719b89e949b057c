//! How one run of one solver ended.

use nalgebra::{DMatrix, DVector};

use super::gauss_newton::least_squares_step;
use crate::fit::loss::Loss;
use crate::fit::problem::{Best, Problem};
use crate::form::FormError;

/// How a solver ended, before rank and bounds are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Termination {
    /// A criterion on the gradient or the optimality holds.
    Converged,
    /// No progress, and no criterion holds.
    Stalled,
    /// The budget ran out.
    IterationLimit,
    /// The cost is not finite where the solver started.
    NonFinite,
}

/// One run of one solver from one start.
#[derive(Debug, Clone)]
pub struct Attempt {
    /// Where it ended.
    pub variables: DVector<f64>,
    /// The cost there.
    pub cost: f64,
    /// How it ended.
    pub termination: Termination,
    /// Iterations.
    pub iterations: u64,
}

/// Under which a point counts as optimal.
#[derive(Clone, Copy)]
pub(super) struct Tolerances {
    /// Bates & Watts' relative offset: the part of the residual that a first-order step can still
    /// remove, relative to the residual. 1e-3 is their advice for statistics; constants to six digits
    /// need less.
    offset: f64,
    /// What a first-order step can still remove, relative to the target: under this it is rounding.
    /// Without it a perfect fit, all of whose residuals are rounding, would never converge.
    removable: f64,
}

/// For solvers that use derivatives.
pub(super) const BY_DERIVATIVES: Tolerances = Tolerances { offset: 1e-6, removable: 1e-11 };
/// For solvers that see only the cost, whose minimum they find to the root of its rounding.
pub(super) const BY_COST: Tolerances = Tolerances { offset: 1e-5, removable: 1e-8 };

impl Attempt {
    /// The best point that `problem` has seen, with the termination that its first-order optimality
    /// allows: a solver's own word is not taken for it.
    pub(super) fn judged(
        problem: &Problem,
        start: &DVector<f64>,
        iterations: u64,
        exhausted: bool,
        within: Tolerances,
    ) -> Result<Self, FormError> {
        let Some(best) = problem.best() else {
            let (variables, termination) = (start.clone(), Termination::NonFinite);
            return Ok(Self { variables, cost: f64::NAN, termination, iterations });
        };
        let optimal = |residuals: &DVector<f64>, jacobian: &DMatrix<f64>| {
            tangent_part(residuals, jacobian) <= within.removable * problem.magnitude()
                || relative_offset(residuals, jacobian) <= within.offset
        };
        let (residuals, jacobian) = problem.linearise(&best.variables)?;
        let judge = |termination| Self {
            variables: best.variables.clone(),
            cost: best.cost,
            termination,
            iterations,
        };
        if !jacobian.iter().all(|x| x.is_finite()) {
            return Ok(judge(Termination::Stalled));
        }
        if optimal(&residuals, &jacobian) {
            return Ok(judge(Termination::Converged));
        }
        if exhausted {
            return Ok(judge(Termination::IterationLimit));
        }
        if problem.loss != Loss::Minimax
            && let Some(polished) = polish(problem, &best, residuals, jacobian, optimal)?
        {
            let Best { variables, cost } = polished;
            return Ok(Self { variables, cost, termination: Termination::Converged, iterations });
        }
        Ok(judge(Termination::Stalled))
    }
}

/// Gauss–Newton steps of a polish at most: near an optimum they shrink the gradient severalfold each.
const POLISHING_STEPS: usize = 12;

/// Rounding of the residuals, relative to the target: some hundred ulp, as forms cancel.
const ROUNDING: f64 = 1e-13;

/// Goes on from `best` by the gradient where the cost no longer tells points apart.
///
/// Residuals r with rounding errors e make the cost uncertain by ‖r‖‖e‖, and a solver that compares
/// costs gets no closer to the optimum than a relative offset of √(2‖e‖/‖r‖): more than the
/// criterion asks of a form that follows its target to four digits. The derivatives are exact, and
/// the gradient has no such floor. So full Gauss–Newton steps are taken, each of which has to shrink
/// what a first-order step can remove and to cost no more than rounding explains. The result is
/// given only if it is `optimal`, by the same criterion as everywhere.
fn polish(
    problem: &Problem,
    best: &Best,
    mut residuals: DVector<f64>,
    mut jacobian: DMatrix<f64>,
    optimal: impl Fn(&DVector<f64>, &DMatrix<f64>) -> bool,
) -> Result<Option<Best>, FormError> {
    let uncertainty = residuals.norm() * ROUNDING * problem.magnitude();
    let mut removable = tangent_part(&residuals, &jacobian);
    let mut variables = best.variables.clone();
    for _ in 0..POLISHING_STEPS {
        variables += least_squares_step(&jacobian, &residuals);
        let cost = problem.cost(&variables)?;
        (residuals, jacobian) = problem.linearise(&variables)?;
        if !(cost <= best.cost + uncertainty && jacobian.iter().all(|x| x.is_finite())) {
            return Ok(None);
        }
        if optimal(&residuals, &jacobian) {
            return Ok(Some(Best { variables, cost }));
        }
        let left = tangent_part(&residuals, &jacobian);
        if left >= removable {
            return Ok(None);
        }
        removable = left;
    }
    Ok(None)
}

/// ‖Qᵀr‖/√n over ‖r‖/√(m − n), Q an orthonormal basis of the columns of the Jacobian: free of units
/// and of the choice of variables. Without more points than variables, ‖Qᵀr‖ over ‖r‖.
pub(super) fn relative_offset(residuals: &DVector<f64>, jacobian: &DMatrix<f64>) -> f64 {
    let norm = residuals.norm();
    if norm == 0.0 {
        return 0.0;
    }
    let (points, variables) = jacobian.shape();
    let explained = tangent_part(residuals, jacobian);
    let freedom = points.saturating_sub(variables);
    if freedom == 0 || variables == 0 {
        return explained / norm;
    }
    let normal = (norm * norm - explained * explained).max(0.0).sqrt().max(norm * 1e-12);
    explained / normal * (freedom as f64 / variables as f64).sqrt()
}

/// ‖Qᵀr‖ with Q from Gram–Schmidt, run twice; columns that depend on earlier ones drop out.
fn tangent_part(residuals: &DVector<f64>, jacobian: &DMatrix<f64>) -> f64 {
    let mut basis: Vec<DVector<f64>> = Vec::with_capacity(jacobian.ncols());
    let mut explained = 0.0;
    for column in jacobian.column_iter() {
        let mut q = column.clone_owned();
        let length = q.norm();
        if length == 0.0 {
            continue;
        }
        for _ in 0..2 {
            for b in &basis {
                let along = b.dot(&q);
                q.axpy(-along, b, 1.0);
            }
        }
        let rest = q.norm();
        if rest > 1e-13 * length {
            q /= rest;
            explained += q.dot(residuals).powi(2);
            basis.push(q);
        }
    }
    explained.sqrt()
}
