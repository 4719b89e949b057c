//! The levenberg-marquardt crate, a port of MINPACK's `lmder`, behind the same interface.
//!
//! argmin has no Levenberg–Marquardt method. Its step control (a trust region whose metric follows
//! the largest column norms seen) is what reaches the certified values of the NIST problems from the
//! far starts, so `auto` begins with it for every smooth loss.

use std::cell::RefCell;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector, Dyn, storage::Owned};

use super::attempt::{Attempt, BY_DERIVATIVES};
use crate::fit::problem::Problem;
use crate::form::FormError;

/// Residual of every point where the form is not finite: a step there is refused and shortened.
const NOT_FINITE: f64 = 1e100;
/// Relative change of the sum of squares under which it stops.
const COST: f64 = 1e-15;
/// Relative change of the variables under which it stops.
const STEP: f64 = 1e-13;
/// Cosine between residual and columns under which it stops.
const GRADIENT: f64 = 1e-9;

struct Minpack<'p, 'a> {
    problem: &'p Problem<'a>,
    at: DVector<f64>,
    linear: RefCell<Option<DMatrix<f64>>>,
    error: RefCell<Option<FormError>>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Minpack<'_, '_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.at.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.at.clone()
    }

    /// Most steps are accepted, and then the Jacobian is asked for: both are made in one pass.
    fn residuals(&self) -> Option<DVector<f64>> {
        match self.problem.linearise(&self.at) {
            Ok((mut residuals, jacobian)) => {
                if !residuals.iter().all(|r| r.is_finite() && r.abs() < NOT_FINITE) {
                    residuals.fill(NOT_FINITE);
                }
                *self.linear.borrow_mut() = Some(jacobian);
                Some(residuals)
            }
            Err(error) => {
                *self.error.borrow_mut() = Some(error);
                None
            }
        }
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.linear.borrow_mut().take()
    }
}

/// Runs Levenberg–Marquardt from `start`; its iterations are its evaluations.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let minpack = Minpack {
        problem,
        at: start.clone(),
        linear: RefCell::new(None),
        error: RefCell::new(None),
    };
    let per_variable = max_iterations.div_ceil(start.len() as u64 + 1);
    let (minpack, report) = LevenbergMarquardt::new()
        .with_ftol(COST)
        .with_xtol(STEP)
        .with_gtol(GRADIENT)
        .with_patience(usize::try_from(per_variable).unwrap_or(usize::MAX).max(1))
        .minimize(minpack);
    if let Some(error) = minpack.error.into_inner() {
        return Err(error);
    }
    let exhausted = report.termination == TerminationReason::LostPatience;
    let iterations = report.number_of_evaluations as u64;
    Attempt::judged(problem, start, iterations, exhausted, BY_DERIVATIVES)
}
