//! Factors of least error after the convolution with environments.
//!
//! The cost ⟨D, R ⋆ D⟩ with D = S − V Hᵀ ([`ConvolutionNorm`]) is quadratic in either side with the
//! other held. For V it is the system M vec(V) = vec((R ⋆ S) H) of ny·r unknowns with
//!
//! M(i m, i' m') = T_mm'(i − i'),  T_mm'(d) = Σ_jj' h_m(j) R(d, j − j') h_m'(j'),
//!
//! symmetric, positive semi-definite and block Toeplitz. The sides alternate, and L-BFGS then moves
//! both at once. Where R is flat in frequency this is the singular value decomposition; where R is
//! a product of one function along x and one along y it is that decomposition of the table whitened
//! by their roots, from which the alternation starts if it is the better start.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, Gradient, IterState, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use faer::{Mat, MatRef};
use nalgebra::DVector;

use super::convolution_norm::ConvolutionNorm;
use super::matrix::{inner, solve_towards, symmetric_eigen, thin_svd};
use super::methods::{Stopping, per_channel};
use super::terms::Terms;
use super::{Alignment, LowRank, LowRankError};
use crate::table::Grid;

/// Relative ridge that holds what the norm does not see where it was: light smooths, and M has
/// eigenvalues down to rounding.
const ANCHOR: f64 = 1e-9;
/// Unknowns of one side above which it is not solved directly (0.6 s a step here); L-BFGS is then
/// alone.
const MOST_UNKNOWNS: usize = 3072;
/// Eigenvalues of a whitening matrix below this part of the largest are raised to it.
const WHITENING_FLOOR: f64 = 1e-6;
/// Pairs that L-BFGS keeps.
const MEMORY: usize = 10;

/// When the search for factors ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvolvedOptions {
    /// Of the alternation.
    pub stopping: Stopping,
    /// Iterations of L-BFGS at most.
    pub polish: u64,
}

impl Default for ConvolvedOptions {
    fn default() -> Self {
        Self { stopping: Stopping { sweeps: 60, decrease: 1e-6 }, polish: 60 }
    }
}

/// How the error of one channel went down: ‖S − Ŝ‖_R/‖S‖_R, 0 for a channel that is 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ConvolvedReport {
    /// Of the singular value decomposition at the same rank.
    pub svd: f64,
    /// Of the start that was taken, it or the whitened one.
    pub start: f64,
    /// After the alternation.
    pub alternating: f64,
    /// After L-BFGS, and of what is given out.
    pub polished: f64,
    /// Sweeps of the alternation.
    pub sweeps: usize,
    /// Iterations of L-BFGS.
    pub iterations: u64,
}

/// Fits factors of rank `rank` to every channel under `norm`; never worse under it than the
/// singular value decomposition, from which it may start.
///
/// # Errors
/// As [`Grid::check`]; [`LowRankError::Rank`]; [`LowRankError::Unusable`] if the norm was made for
/// another size, or singular values do not converge.
pub fn convolved(
    table: &Grid,
    alignment: Alignment,
    rank: usize,
    norm: &ConvolutionNorm,
    options: &ConvolvedOptions,
) -> Result<(LowRank, Vec<ConvolvedReport>), LowRankError> {
    norm.require(table)?;
    per_channel(table, alignment, rank, |_, s, start| fit(norm, s, start, options, &table.origin))
}

fn fit(
    norm: &ConvolutionNorm,
    s: &Mat<f64>,
    svd: Terms,
    options: &ConvolvedOptions,
    what: &str,
) -> Result<(Terms, ConvolvedReport), LowRankError> {
    let seen = norm.convolved(s);
    let whole = inner(s.as_ref(), seen.as_ref());
    if whole <= 0.0 {
        return Ok((svd, ConvolvedReport::default()));
    }
    let cost = |t: &Terms| norm.squared(&t.residual(s)) / whole;
    let svd_cost = cost(&svd);
    let mut best = (svd_cost, svd.clone());
    let better = |best: &mut (f64, Terms), candidate: Terms| {
        let candidate = (cost(&candidate), candidate);
        if candidate.0 < best.0 {
            *best = candidate;
        }
    };
    better(&mut best, whitened(norm, s, svd.rank(), what)?);
    let start = best.0;

    let mut sweeps = 0;
    let unknowns = s.nrows().max(s.ncols()) * svd.rank();
    if unknowns <= MOST_UNKNOWNS {
        let mut terms = best.1.clone();
        let turned = norm.lags().transpose().to_owned();
        options.stopping.alternate(start, || {
            terms.vertical = side(norm.lags(), seen.as_ref(), &terms.horizontal, &terms.vertical);
            terms.horizontal = side(&turned, seen.transpose(), &terms.vertical, &terms.horizontal);
            sweeps += 1;
            let after = cost(&terms);
            if after < best.0 {
                best = (after, terms.clone());
            }
            after
        });
    }
    let alternating = best.0;
    let mut iterations = 0;
    if options.polish > 0 && alternating > 0.0 {
        let (polished, taken) = polish(norm, s, whole, &best.1.orthogonal(what)?, options.polish);
        iterations = taken;
        better(&mut best, polished);
    }
    let terms = best.1.orthogonal(what)?;
    let report = ConvolvedReport {
        svd: svd_cost.sqrt(),
        start: start.sqrt(),
        alternating: alternating.sqrt(),
        polished: best.0.sqrt(),
        sweeps,
        iterations,
    };
    Ok((terms, report))
}

/// The side of least cost with `other` held; `seen` is R ⋆ S with this side along its rows, and the
/// rows of `lags` are lags of this side.
fn side(lags: &Mat<f64>, seen: MatRef<'_, f64>, other: &Mat<f64>, now: &Mat<f64>) -> Mat<f64> {
    let (n, rank) = now.shape();
    let blocks = toeplitz_blocks(lags, other, n);
    let block =
        |d: usize, m: usize, k: usize| blocks.get((m * rank + k) * n + d).copied().unwrap_or(0.0);
    // Lower triangle: row i ≥ i', and for i = i' both orders agree.
    let system = Mat::from_fn(n * rank, n * rank, |a, b| {
        let (i, m, j, k) = (a / rank, a % rank, b / rank, b % rank);
        if i >= j { block(i - j, m, k) } else { 0.0 }
    });
    let projected = seen * other.as_ref();
    let stacked =
        |matrix: &Mat<f64>| Mat::from_fn(n * rank, 1, |a, _| matrix[(a / rank, a % rank)]);
    let solved = solve_towards(system, stacked(&projected), stacked(now).as_ref(), ANCHOR);
    Mat::from_fn(n, rank, |i, m| solved[(i * rank + m, 0)])
}

/// T_mk(d) for d = 0 … n − 1, at (m · rank + k) · n + d.
fn toeplitz_blocks(lags: &Mat<f64>, other: &Mat<f64>, n: usize) -> Vec<f64> {
    let (length, rank) = other.shape();
    let columns: Vec<Vec<f64>> =
        (0..rank).map(|m| other.col(m).iter().copied().collect()).collect();
    // Rows of lags from 0 on, contiguous.
    let rows: Vec<Vec<f64>> =
        (0..n).map(|d| lags.row(n - 1 + d).iter().copied().collect()).collect();
    let mut blocks = Vec::with_capacity(rank * rank * n);
    for a in &columns {
        for b in &columns {
            // Σ_j a(j) b(j − d) for d = −(length − 1) … length − 1.
            let mut correlation = vec![0.0; 2 * length - 1];
            for (j, x) in a.iter().enumerate() {
                // d = j − k runs downwards as k runs upwards.
                let window = correlation.get_mut(j..j + length).unwrap_or_default();
                for (slot, y) in window.iter_mut().rev().zip(b) {
                    *slot += x * y;
                }
            }
            let sum =
                |row: &Vec<f64>| row.iter().zip(&correlation).map(|(r, c)| r * c).sum::<f64>();
            blocks.extend(rows.iter().map(sum));
        }
    }
    blocks
}

/// The decomposition of A^½ S B^½ brought back, with A and B the Toeplitz matrices of R along y and
/// x: optimal if R is the product of the two.
fn whitened(
    norm: &ConvolutionNorm,
    s: &Mat<f64>,
    rank: usize,
    what: &str,
) -> Result<Terms, LowRankError> {
    let (ny, nx) = s.shape();
    let lags = norm.lags();
    let along_y = Mat::from_fn(ny, ny, |i, k| lags[(ny - 1 + i.abs_diff(k), nx - 1)]);
    let along_x = Mat::from_fn(nx, nx, |j, k| lags[(ny - 1, nx - 1 + j.abs_diff(k))]);
    let (y_root, y_inverse) = roots(&along_y, what)?;
    let (x_root, x_inverse) = roots(&along_x, what)?;
    let white = (&y_root * s).as_ref() * x_root.as_ref();
    let terms = Terms::of_svd(&thin_svd(white.as_ref(), what)?, rank);
    Ok(Terms { vertical: &y_inverse * &terms.vertical, horizontal: &x_inverse * &terms.horizontal })
}

/// A^½ and A^−½, eigenvalues floored.
fn roots(a: &Mat<f64>, what: &str) -> Result<(Mat<f64>, Mat<f64>), LowRankError> {
    let (values, vectors) = symmetric_eigen(a.as_ref(), what)?;
    let floor = WHITENING_FLOOR * values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let power = |exponent: f64| {
        let scaled = Mat::from_fn(vectors.nrows(), vectors.ncols(), |i, k| {
            let value = values.get(k).copied().unwrap_or(0.0).max(floor);
            vectors[(i, k)] * value.powf(exponent)
        });
        scaled.as_ref() * vectors.transpose()
    };
    Ok((power(0.5), power(-0.5)))
}

/// Point, cost and gradient.
type Evaluated = (DVector<f64>, f64, DVector<f64>);

/// Both sides at once, as argmin sees them: their [`Terms::entries`].
struct Both<'a> {
    norm: &'a ConvolutionNorm,
    s: &'a Mat<f64>,
    whole: f64,
    size: [usize; 3],
    last: RefCell<Option<Evaluated>>,
}

impl Both<'_> {
    fn evaluated(&self, z: &DVector<f64>) -> (f64, DVector<f64>) {
        if let Some((at, cost, gradient)) = self.last.borrow().as_ref()
            && at == z
        {
            return (*cost, gradient.clone());
        }
        let t = Terms::of_entries(z.as_slice(), self.size);
        let d = t.residual(self.s);
        let seen = self.norm.convolved(&d);
        let cost = inner(d.as_ref(), seen.as_ref()) / self.whole;
        let slopes = Terms {
            vertical: &seen * &t.horizontal,
            horizontal: seen.transpose() * t.vertical.as_ref(),
        };
        let gradient = DVector::from(slopes.entries()).map(|slope| -2.0 * slope / self.whole);
        *self.last.borrow_mut() = Some((z.clone(), cost, gradient.clone()));
        (cost, gradient)
    }
}

impl CostFunction for Both<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, z: &DVector<f64>) -> Result<f64, Error> {
        Ok(self.evaluated(z).0)
    }
}

impl Gradient for Both<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, z: &DVector<f64>) -> Result<DVector<f64>, Error> {
        Ok(self.evaluated(z).1)
    }
}

/// Where L-BFGS ends, and its iterations; the start if it gives up.
fn polish(
    norm: &ConvolutionNorm,
    s: &Mat<f64>,
    whole: f64,
    start: &Terms,
    most: u64,
) -> (Terms, u64) {
    let z = DVector::from(start.entries());
    // In units of the largest entry, so that a first step along the gradient has a sensible length.
    let unit = z.amax();
    if unit == 0.0 {
        return (start.clone(), 0);
    }
    let scaled = Mat::from_fn(s.nrows(), s.ncols(), |i, j| s[(i, j)] / (unit * unit));
    let size = [s.nrows(), s.ncols(), start.rank()];
    let problem =
        Both { norm, s: &scaled, whole: whole / unit.powi(4), size, last: RefCell::new(None) };
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY)
        .with_tolerance_grad(0.0)
        .and_then(|solver| solver.with_tolerance_cost(1e-12));
    type Iteration = IterState<DVector<f64>, DVector<f64>, (), (), (), f64>;
    let run = solver.and_then(|solver| {
        Executor::new(problem, solver)
            .configure(|state: Iteration| state.param(z / unit).max_iters(most))
            .ctrlc(false)
            .run()
    });
    let Ok(result) = run else { return (start.clone(), 0) };
    let iterations = result.state().get_iter();
    let Some(z) = result.state().get_best_param() else { return (start.clone(), iterations) };
    (Terms::of_entries((z * unit).as_slice(), size), iterations)
}
