//! A problem as argmin sees it, in variables scaled at a point.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, Gradient, Hessian, Solver, State};
use nalgebra::{DMatrix, DVector};

use crate::fit::problem::Problem;
use crate::form::FormError;

/// What a point costs where the form is not finite: worse than any other, and still a number, so
/// that interpolating line searches step back from it.
const NOT_FINITE: f64 = 1e150;

/// Evaluations after which a solver is stopped: a line search has no limit of its own.
const MOST_EVALUATIONS: u64 = 200_000;

/// Iterations after which the singular values of a small triangle are given up.
const SVD_ITERATIONS: usize = 1000;

/// Point, pseudo-residuals, Jacobian.
type Linearised = (DVector<f64>, DVector<f64>, DMatrix<f64>);

/// `problem` in z with u = origin + basis z.
pub(super) struct Scaled<'p, 'a> {
    problem: &'p Problem<'a>,
    origin: DVector<f64>,
    basis: DMatrix<f64>,
    last: RefCell<Option<Linearised>>,
    last_evaluation: u64,
}

impl<'p, 'a> Scaled<'p, 'a> {
    /// Scaled so that the Jacobian's columns have length 1 at `origin`.
    pub(super) fn columns(
        problem: &'p Problem<'a>,
        origin: DVector<f64>,
    ) -> Result<Self, FormError> {
        let (_, jacobian) = problem.linearise(&origin)?;
        let basis = DMatrix::from_diagonal(&lengths(&jacobian).map(|length| 1.0 / length));
        Ok(Self::new(problem, origin, basis))
    }

    /// Scaled so that the Jacobian's columns are orthonormal at `origin`; directions without
    /// effect keep the scale of their columns.
    pub(super) fn orthonormal(
        problem: &'p Problem<'a>,
        origin: DVector<f64>,
    ) -> Result<Self, FormError> {
        let (_, mut unit) = problem.linearise(&origin)?;
        let lengths = lengths(&unit);
        divide_columns(&mut unit, &lengths);
        let mut basis = DMatrix::from_diagonal(&lengths.map(|length| 1.0 / length));
        let finite = unit.iter().all(|x| x.is_finite());
        let triangle = unit.qr().r();
        if finite
            && triangle.is_square()
            && let Some(svd) = triangle.try_svd(false, true, f64::EPSILON, SVD_ITERATIONS)
            && let Some(rows) = svd.v_t
        {
            let largest = svd.singular_values.max();
            let mut rotation = rows.transpose();
            for (mut column, s) in rotation.column_iter_mut().zip(svd.singular_values.iter()) {
                column /= s.max(1e-12 * largest);
            }
            if rotation.iter().all(|x| x.is_finite()) {
                basis *= rotation;
            }
        }
        Ok(Self::new(problem, origin, basis))
    }

    fn new(problem: &'p Problem<'a>, origin: DVector<f64>, basis: DMatrix<f64>) -> Self {
        let last_evaluation = problem.evaluations() + MOST_EVALUATIONS;
        Self { problem, origin, basis, last: RefCell::new(None), last_evaluation }
    }

    fn require_budget(&self) -> Result<(), Error> {
        if self.problem.evaluations() < self.last_evaluation {
            return Ok(());
        }
        Err(Error::msg("too many evaluations"))
    }

    /// Number of variables.
    pub(super) fn variables(&self) -> usize {
        self.origin.len()
    }

    fn point(&self, z: &DVector<f64>) -> DVector<f64> {
        &self.origin + &self.basis * z
    }

    /// Pseudo-residuals and Jacobian at a point.
    pub(super) fn linearised<T>(
        &self,
        z: &DVector<f64>,
        take: impl FnOnce(&DVector<f64>, &DMatrix<f64>) -> T,
    ) -> Result<T, Error> {
        let mut last = self.last.borrow_mut();
        if let Some((at, residuals, jacobian)) = last.as_ref()
            && at == z
        {
            return Ok(take(residuals, jacobian));
        }
        self.require_budget()?;
        let (residuals, jacobian) = self.problem.linearise(&self.point(z))?;
        let jacobian = jacobian * &self.basis;
        let taken = take(&residuals, &jacobian);
        *last = Some((z.clone(), residuals, jacobian));
        Ok(taken)
    }
}

/// Column norms; 1 for a column without effect or not finite.
fn lengths(jacobian: &DMatrix<f64>) -> DVector<f64> {
    let length = |norm: f64| if norm.is_finite() && norm > 0.0 { norm } else { 1.0 };
    let columns = jacobian.column_iter().map(|column| length(column.norm()));
    DVector::from_iterator(jacobian.ncols(), columns)
}

/// Each column over its own of `lengths`.
pub(in crate::fit) fn divide_columns(matrix: &mut DMatrix<f64>, lengths: &DVector<f64>) {
    for (mut column, length) in matrix.column_iter_mut().zip(lengths.iter()) {
        column /= *length;
    }
}

impl CostFunction for Scaled<'_, '_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, z: &DVector<f64>) -> Result<f64, Error> {
        self.require_budget()?;
        let cost = self.problem.cost(&self.point(z))?;
        Ok(if cost.is_finite() { cost } else { NOT_FINITE })
    }
}

impl Gradient for Scaled<'_, '_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, z: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let gradient = self.linearised(z, |residuals, jacobian| jacobian.tr_mul(residuals))?;
        if gradient.iter().all(|g| g.is_finite()) {
            return Ok(gradient);
        }
        Err(Error::msg("the gradient is not finite"))
    }
}

impl Hessian for Scaled<'_, '_> {
    type Param = DVector<f64>;
    type Hessian = DMatrix<f64>;

    fn hessian(&self, z: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        self.linearised(z, |_, jacobian| jacobian.tr_mul(jacobian))
    }
}

/// What is left of an error of argmin: the form's own error is passed on; a solver that gave up (a
/// line search without a step, say) leaves the best point that the problem has seen.
pub(super) fn give_up<T>(result: Result<T, Error>) -> Result<Option<T>, FormError> {
    match result {
        Ok(value) => Ok(Some(value)),
        Err(error) => error.downcast().map_or(Ok(None), Err),
    }
}

/// Runs a solver of argmin on `problem`, from the state as `configure` makes it: its iterations, none if
/// it gave up.
pub(super) fn iterations<O, S, I: State>(
    problem: O,
    solver: S,
    configure: impl FnOnce(I) -> I,
) -> Result<Option<u64>, FormError>
where
    S: Solver<O, I>,
{
    let run = Executor::new(problem, solver).configure(configure).ctrlc(false).run();
    Ok(give_up(run)?.map(|result| result.state().get_iter()))
}
