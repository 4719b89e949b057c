//! Dense matrices as this module needs them: a table's channel, thin singular value decomposition,
//! symmetric solves. Rows are y, columns are x.
//!
//! faer is built without threads, so that a sum never depends on how many there are; channels run
//! beside one another.

use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef, Side};

use super::LowRankError;
use crate::table::{Grid, GridChannel};

/// One channel of a table, ny × nx.
pub(super) fn of_channel(table: &Grid, channel: &GridChannel) -> Mat<f64> {
    let nx = table.x().count;
    let value =
        |iy: usize, ix: usize| channel.values.get(iy * nx + ix).map_or(0.0, |v| f64::from(*v));
    Mat::from_fn(table.y().count, nx, value)
}

/// The texels of a matrix, row by row.
pub(super) fn texels(matrix: MatRef<'_, f64>) -> Vec<f32> {
    (0..matrix.nrows())
        .flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)))
        .map(|(i, j)| matrix[(i, j)] as f32)
        .collect()
}

/// ⟨a, b⟩, element by element.
pub(super) fn inner(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> f64 {
    (0..a.ncols()).map(|j| (0..a.nrows()).map(|i| a[(i, j)] * b[(i, j)]).sum::<f64>()).sum()
}

/// a = left · diag(values) · rightᵀ, values descending.
#[derive(Debug, Clone)]
pub(super) struct ThinSvd {
    pub(super) left: Mat<f64>,
    pub(super) values: Vec<f64>,
    pub(super) right: Mat<f64>,
}

/// The thin singular value decomposition.
///
/// # Errors
/// [`LowRankError::Unusable`], naming `what`; the iteration only fails on values that are not
/// finite.
pub(super) fn thin_svd(a: MatRef<'_, f64>, what: &str) -> Result<ThinSvd, LowRankError> {
    let svd = a.thin_svd().map_err(|_| not_converged(what))?;
    let values = svd.S().column_vector().iter().copied().collect();
    Ok(ThinSvd { left: svd.U().to_owned(), values, right: svd.V().to_owned() })
}

fn not_converged(what: &str) -> LowRankError {
    LowRankError::unusable(what, "the singular values did not converge")
}

/// Eigenvalues, ascending, and eigenvectors, one per column, of a symmetric matrix.
///
/// # Errors
/// [`LowRankError::Unusable`], naming `what`.
pub(super) fn symmetric_eigen(
    a: MatRef<'_, f64>,
    what: &str,
) -> Result<(Vec<f64>, Mat<f64>), LowRankError> {
    let eigen = a.self_adjoint_eigen(Side::Lower).map_err(|_| not_converged(what))?;
    Ok((eigen.S().column_vector().iter().copied().collect(), eigen.U().to_owned()))
}

/// Solves `system` X = `right` for a small symmetric system that may be singular, plus
/// `anchor`, a relative ridge that pulls X towards `towards`: (A + εI) X = B + ε X₀ with
/// ε = `anchor` · the largest diagonal element. Where A says nothing, X stays at X₀; no step of an
/// alternating minimisation can then raise its cost.
pub(super) fn solve_towards(
    mut system: Mat<f64>,
    mut right: Mat<f64>,
    towards: MatRef<'_, f64>,
    anchor: f64,
) -> Mat<f64> {
    let n = system.nrows();
    let largest = (0..n).map(|i| system[(i, i)]).fold(0.0, f64::max);
    if largest <= 0.0 {
        return towards.to_owned();
    }
    let ridge = anchor * largest;
    for i in 0..n {
        system[(i, i)] += ridge;
        for j in 0..right.ncols() {
            right[(i, j)] += ridge * towards[(i, j)];
        }
    }
    let Ok(factors) = system.llt(Side::Lower) else { return towards.to_owned() };
    factors.solve_in_place(&mut right);
    if right.is_all_finite() { right } else { towards.to_owned() }
}
