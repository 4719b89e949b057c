//! One pair of spatial factors for all channels: S_c ≈ Σ_m g_cm v_m h_mᵀ.
//!
//! A canonical polyadic decomposition of the table as a tensor of ny × nx × channels (Kolda & Bader
//! 2009, SIAM Review 51, 455, §3.4), by alternating least squares: each step solves for one of the
//! three factors exactly, with the normal matrix as the elementwise product of the Gram matrices of
//! the two others. It stores and fetches one vector where a decomposition per channel has three;
//! its error at equal rank is never below theirs.

use faer::{Mat, MatRef};

use super::decomposition::require_rank;
use super::matrix::{of_channel, solve_towards, thin_svd};
use super::methods::Stopping;
use super::terms::{Terms, canonical, orient};
use super::{Alignment, LowRank, LowRankError};
use crate::table::Grid;

/// Relative ridge that holds a step where its normal matrix is singular.
const ANCHOR: f64 = 1e-12;

/// Shared spatial factors and their colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Shared {
    /// `colours[c][m]`: g_cm, the weight of term m in channel c; the largest magnitude of a term's
    /// weights is 1.
    pub colours: Vec<Vec<f64>>,
    /// The factors per channel: `horizontal[m]` is the same in all, `vertical[m]` is the same times
    /// g_cm.
    pub low_rank: LowRank,
}

/// Fits shared factors of rank `rank`, from the singular value decomposition of the sum of the
/// channels.
///
/// # Errors
/// As [`Grid::check_plane`]; [`LowRankError::Rank`]; [`LowRankError::Unusable`] if singular
/// values do not converge.
pub fn shared(
    table: &Grid,
    alignment: Alignment,
    rank: usize,
    stopping: Stopping,
) -> Result<Shared, LowRankError> {
    table.check_plane()?;
    require_rank(&table.origin, table.x(), table.y(), rank)?;
    let tables: Vec<Mat<f64>> = table.channels.iter().map(|c| of_channel(table, c)).collect();
    let (ny, nx) = (table.y().count, table.x().count);
    let sum = Mat::from_fn(ny, nx, |i, j| tables.iter().map(|t| t[(i, j)]).sum());
    let mut svd = thin_svd(sum.as_ref(), &table.origin)?;
    canonical(&mut svd);
    let mut terms = Terms::of_svd(&svd, rank);
    orient(&mut terms, None);

    let mut colours = Mat::from_fn(tables.len(), rank, |_, _| 1.0 / tables.len() as f64);
    colours = colour_step(&tables, &terms, &colours);
    stopping.alternate(cost(&tables, &terms, &colours), || {
        sweep(&tables, &mut terms, &mut colours);
        cost(&tables, &terms, &colours)
    });
    Ok(given_out(table, alignment, &terms, &colours))
}

fn sweep(tables: &[Mat<f64>], terms: &mut Terms, colours: &mut Mat<f64>) {
    terms.vertical = side_step(
        tables.iter().map(Mat::as_ref),
        terms.horizontal.as_ref(),
        colours,
        &terms.vertical,
    );
    terms.horizontal = side_step(
        tables.iter().map(Mat::transpose),
        terms.vertical.as_ref(),
        colours,
        &terms.horizontal,
    );
    *colours = colour_step(tables, terms, colours);
}

/// The side v of least error, the other side and the colours held.
fn side_step<'a>(
    tables: impl Iterator<Item = MatRef<'a, f64>>,
    other: MatRef<'_, f64>,
    colours: &Mat<f64>,
    now: &Mat<f64>,
) -> Mat<f64> {
    let rank = other.ncols();
    let mut right = Mat::<f64>::zeros(rank, now.nrows());
    for (c, table) in tables.enumerate() {
        let projected = table * other;
        for m in 0..rank {
            for i in 0..now.nrows() {
                right[(m, i)] += colours[(c, m)] * projected[(i, m)];
            }
        }
    }
    let gram = elementwise(&(other.transpose() * other), &(colours.transpose() * colours.as_ref()));
    solve_towards(gram, right, now.transpose(), ANCHOR).transpose().to_owned()
}

fn colour_step(tables: &[Mat<f64>], terms: &Terms, now: &Mat<f64>) -> Mat<f64> {
    let (v, h) = (terms.vertical.as_ref(), terms.horizontal.as_ref());
    let mut right = Mat::<f64>::zeros(terms.rank(), tables.len());
    for (c, table) in tables.iter().enumerate() {
        let projected = table.as_ref() * h;
        for m in 0..terms.rank() {
            right[(m, c)] = v.col(m).iter().zip(projected.col(m).iter()).map(|(a, b)| a * b).sum();
        }
    }
    let gram = elementwise(&(v.transpose() * v), &(h.transpose() * h));
    solve_towards(gram, right, now.transpose(), ANCHOR).transpose().to_owned()
}

fn elementwise(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)] * b[(i, j)])
}

/// The terms in one channel.
fn coloured(terms: &Terms, colours: &Mat<f64>, channel: usize) -> Terms {
    let mut terms = terms.clone();
    for m in 0..terms.rank() {
        terms.vertical.col_mut(m).iter_mut().for_each(|entry| *entry *= colours[(channel, m)]);
    }
    terms
}

fn cost(tables: &[Mat<f64>], terms: &Terms, colours: &Mat<f64>) -> f64 {
    let one = |(c, table): (usize, &Mat<f64>)| {
        coloured(terms, colours, c).residual(table).squared_norm_l2()
    };
    tables.iter().enumerate().map(one).sum()
}

/// Colours scaled to a largest magnitude of 1, that one positive; terms balanced and signed.
fn given_out(table: &Grid, alignment: Alignment, terms: &Terms, colours: &Mat<f64>) -> Shared {
    let rank = terms.rank();
    let peak = |m: usize| {
        let weights = colours.col(m).iter().copied();
        weights.fold(0.0f64, |most, g| if g.abs() > most.abs() { g } else { most })
    };
    let size = |m: usize| {
        let length = |side: &Mat<f64>| side.as_ref().subcols(m, 1).squared_norm_l2().sqrt();
        peak(m).abs() * length(&terms.vertical) * length(&terms.horizontal)
    };
    let mut order: Vec<usize> = (0..rank).collect();
    order.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
    let at = |k: usize| order.get(k).copied().unwrap_or(k);
    let scaled = Terms {
        vertical: Mat::from_fn(terms.vertical.nrows(), rank, |i, k| {
            terms.vertical[(i, at(k))] * peak(at(k))
        }),
        horizontal: Mat::from_fn(terms.horizontal.nrows(), rank, |j, k| {
            terms.horizontal[(j, at(k))]
        }),
    };
    let mut scaled = scaled.balanced();
    orient(&mut scaled, None);
    let relative = |c: usize, k: usize| {
        let most = peak(at(k));
        if most == 0.0 { 0.0 } else { colours[(c, at(k))] / most }
    };
    let weights: Vec<Vec<f64>> =
        (0..colours.nrows()).map(|c| (0..rank).map(|k| relative(c, k)).collect()).collect();
    let matrix = Mat::from_fn(colours.nrows(), rank, relative);
    let channels = table
        .channels
        .iter()
        .enumerate()
        .map(|(c, channel)| coloured(&scaled, &matrix, c).named(&channel.name));
    let low_rank = LowRank {
        x: table.x().clone(),
        y: table.y().clone(),
        channels: channels.collect(),
        alignment,
    };
    Shared { colours: weights, low_rank }
}
