//! Dense matrices as this module needs them: a table's channel, thin singular value decomposition,
//! symmetric solves, products of factors. Rows are y, columns are x.
//!
//! All of it runs on one thread, so that a sum never depends on how many there are; channels run
//! beside one another.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::matmul::matmul;
use faer::linalg::{cholesky::llt, evd, svd};
use faer::{Accum, Mat, MatRef, Par};

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

/// A b.
pub(super) fn times(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut product = Mat::zeros(a.nrows(), b.ncols());
    matmul(product.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    product
}

/// Σ of the squares, column by column.
pub(super) fn norm_squared(a: MatRef<'_, f64>) -> f64 {
    a.squared_norm_l2()
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
/// [`LowRankError::NotConverged`], naming `what`; the iteration only fails on values that are not
/// finite.
pub(super) fn thin_svd(a: MatRef<'_, f64>, what: &str) -> Result<ThinSvd, LowRankError> {
    let (m, n) = a.shape();
    let size = m.min(n);
    let mut left = Mat::zeros(m, size);
    let mut right = Mat::zeros(n, size);
    let mut values = Diag::zeros(size);
    let compute = svd::ComputeSvdVectors::Thin;
    let scratch = svd::svd_scratch::<f64>(m, n, compute, compute, Par::Seq, Default::default());
    svd::svd(
        a,
        values.as_mut(),
        Some(left.as_mut()),
        Some(right.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    )
    .map_err(|_| LowRankError::NotConverged { what: what.into() })?;
    let values = values.column_vector().iter().copied().collect();
    Ok(ThinSvd { left, values, right })
}

/// Eigenvalues, ascending, and eigenvectors, one per column, of a symmetric matrix.
///
/// # Errors
/// [`LowRankError::NotConverged`], naming `what`.
pub(super) fn symmetric_eigen(
    a: MatRef<'_, f64>,
    what: &str,
) -> Result<(Vec<f64>, Mat<f64>), LowRankError> {
    let n = a.nrows();
    let mut vectors = Mat::zeros(n, n);
    let mut values = Diag::zeros(n);
    let scratch = evd::self_adjoint_evd_scratch::<f64>(
        n,
        evd::ComputeEigenvectors::Yes,
        Par::Seq,
        Default::default(),
    );
    evd::self_adjoint_evd(
        a,
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    )
    .map_err(|_| LowRankError::NotConverged { what: what.into() })?;
    Ok((values.column_vector().iter().copied().collect(), vectors))
}

/// Solves a symmetric positive definite system in place of `right` by Cholesky; only the lower
/// triangle of `system` is read. `None`, and `right` as it was, if a pivot is not positive.
pub(super) fn solve_spd(mut system: Mat<f64>, right: &mut Mat<f64>) -> Option<()> {
    let n = system.nrows();
    let scratch = llt::factor::cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default());
    llt::factor::cholesky_in_place(
        system.as_mut(),
        Default::default(),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    )
    .ok()?;
    let scratch = llt::solve::solve_in_place_scratch::<f64>(n, right.ncols(), Par::Seq);
    llt::solve::solve_in_place(
        system.as_ref(),
        right.as_mut(),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
    );
    Some(())
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
    match solve_spd(system, &mut right) {
        Some(()) if right.is_all_finite() => right,
        _ => towards.to_owned(),
    }
}
