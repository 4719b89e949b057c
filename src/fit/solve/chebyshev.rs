//! Linear Chebyshev approximation over points: minimise max |e + A c|, by Stiefel's exchange.
//!
//! A reference of n + 1 points carries a levelled error that is a lower bound of the minimum; each
//! exchange brings in the point with the largest error and drops the one that keeps the signs
//! consistent, which raises the bound. It is the single exchange of Remez's second algorithm, with
//! the alternation of signs replaced by those of the null vector of Aᵀ, so that it needs no order of
//! the points and works for several arguments. (Stiefel 1959, Numer. Math. 1, 1.)

use nalgebra::{DMatrix, DVector};

/// The solution of the linear problem.
#[derive(Debug, Clone)]
pub(super) struct Level {
    /// c.
    pub(super) coefficients: DVector<f64>,
    /// The levelled error, a lower bound of the minimum and equal to it at the solution.
    pub(super) error: f64,
}

/// Exchanges per point of the reference before giving up.
const EXCHANGES: usize = 60;
/// Relative excess over the levelled error that counts as rounding.
const ROUNDING: f64 = 1e-11;
/// Iterations after which the singular values of a reference are given up.
const SVD_ITERATIONS: usize = 1000;
/// A multiplier below this part of the largest is 0.
const DEGENERATE: f64 = 1e-13;

/// Solves the problem for columns `a` of about unit length and independent, errors `e`. `None` if a
/// reference is degenerate or the exchanges run out.
pub(super) fn approximate(a: &DMatrix<f64>, e: &DVector<f64>) -> Option<Level> {
    let n = a.ncols();
    if n == 0 || a.nrows() <= n {
        return None;
    }
    let mut reference = first_reference(a, e)?;
    for _ in 0..EXCHANGES * (n + 1) {
        let rows = a.select_rows(&reference);
        let lambda = null_vector(&rows)?;
        let errors = DVector::from_iterator(n + 1, reference.iter().map(|i| e[*i]));
        let orientation = if lambda.dot(&errors) < 0.0 { -1.0 } else { 1.0 };
        let lambda = lambda * orientation;
        let mut levelled = rows.clone().insert_column(n, 0.0);
        for (row, multiplier) in lambda.iter().enumerate() {
            levelled[(row, n)] = -1.0_f64.copysign(*multiplier);
        }
        let solution = levelled.lu().solve(&-errors)?;
        let coefficients = solution.rows(0, n).clone_owned();
        let error = solution[n];
        let all = e + a * &coefficients;
        let worst = all.icamax();
        if all[worst].abs() <= error * (1.0 + ROUNDING) || reference.contains(&worst) {
            return Some(Level { coefficients, error });
        }
        let leaving = leaving(&rows, &lambda, &a.row(worst).transpose(), all[worst].signum())?;
        *reference.get_mut(leaving)? = worst;
    }
    None
}

/// Which point of the reference gives way to a point with row `entering` and error sign `sign`.
fn leaving(
    rows: &DMatrix<f64>,
    lambda: &DVector<f64>,
    entering: &DVector<f64>,
    sign: f64,
) -> Option<usize> {
    let n = rows.ncols();
    let mut system = rows.transpose().insert_row(n, 0.0);
    system.row_mut(n).copy_from(&lambda.transpose());
    let mut right = -sign * entering;
    right = right.insert_row(n, 0.0);
    let change = system.lu().solve(&right)?;
    let negligible = DEGENERATE * lambda.amax();
    let ratio = |j: &usize| change[*j] / lambda[*j];
    (0..=n).filter(|j| lambda[*j].abs() > negligible).min_by(|j, k| ratio(j).total_cmp(&ratio(k)))
}

/// The unit vector λ with λᵀ rows = 0, if there is only one.
fn null_vector(rows: &DMatrix<f64>) -> Option<DVector<f64>> {
    let n = rows.ncols();
    let square = rows.clone().insert_column(n, 0.0);
    let svd = square.try_svd(true, false, f64::EPSILON, SVD_ITERATIONS)?;
    let (smallest, _) = svd.singular_values.argmin();
    let second = (0..=n)
        .filter(|i| *i != smallest)
        .map(|i| svd.singular_values[i])
        .fold(f64::INFINITY, f64::min);
    if second <= DEGENERATE * svd.singular_values.max() {
        return None;
    }
    Some(svd.u?.column(smallest).clone_owned())
}

/// n rows that are far from dependent among the points with large errors, and the largest error
/// among the others.
fn first_reference(a: &DMatrix<f64>, e: &DVector<f64>) -> Option<Vec<usize>> {
    let n = a.ncols();
    let worst = e.amax();
    let mut rest = a.clone();
    for (mut row, error) in rest.row_iter_mut().zip(e.iter()) {
        row *= (error.abs() / worst).powi(2) + 1e-6;
    }
    let mut reference = Vec::with_capacity(n + 1);
    for _ in 0..n {
        let norms = DVector::from_iterator(rest.nrows(), rest.row_iter().map(|r| r.norm_squared()));
        let (pivot, norm) = norms.argmax();
        if norm.is_nan() || norm <= 0.0 || reference.contains(&pivot) {
            return None;
        }
        let direction = rest.row(pivot).transpose() / norm.sqrt();
        let along = &rest * &direction;
        rest.ger(-1.0, &along, &direction, 1.0);
        rest.row_mut(pivot).fill(0.0);
        reference.push(pivot);
    }
    let last = (0..e.len())
        .filter(|i| !reference.contains(i))
        .max_by(|i, j| e[*i].abs().total_cmp(&e[*j].abs()))?;
    reference.push(last);
    Some(reference)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The best line to x² on [0, 1] is x − 1/8, with error 1/8 at 0, 1/2 and 1.
    #[test]
    fn the_best_line_to_a_parabola() {
        let x: Vec<f64> = (0..101).map(|i| f64::from(i) / 100.0).collect();
        let a = DMatrix::from_fn(x.len(), 2, |i, j| if j == 0 { 1.0 } else { x[i] });
        let e = DVector::from_iterator(x.len(), x.iter().map(|x| -x * x));
        let level = approximate(&a, &e).unwrap();
        assert!((level.error - 0.125).abs() < 1e-14);
        assert!((level.coefficients[0] + 0.125).abs() < 1e-13);
        assert!((level.coefficients[1] - 1.0).abs() < 1e-13);
    }
}
