//! What every method is given and gives.

use faer::Mat;
use rayon::prelude::*;

use super::decomposition::Decomposition;
use super::matrix::of_channel;
use super::terms::{Terms, orient};
use super::{Alignment, LowRank, LowRankError};
use crate::table::Grid;

/// When an alternating minimisation ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stopping {
    /// Sweeps over both sides at most.
    pub sweeps: usize,
    /// Ends when a sweep lowers the error by less than this part of it.
    pub decrease: f64,
}

impl Default for Stopping {
    fn default() -> Self {
        Self { sweeps: 200, decrease: 1e-6 }
    }
}

impl Stopping {
    /// Whether going from the squared error `before` to `after` was the last sweep worth making.
    fn is_over(&self, before: f64, after: f64) -> bool {
        after <= 0.0 || (before - after) <= 2.0 * self.decrease * before
    }

    /// Sweeps, each from the squared error that the one before returned, until it is over.
    pub(super) fn alternate(&self, mut before: f64, mut sweep: impl FnMut() -> f64) {
        for _ in 0..self.sweeps {
            let after = sweep();
            if self.is_over(before, after) {
                break;
            }
            before = after;
        }
    }
}

/// Refuses a table of another size than `[nx, ny]`, which `what` of the error is about.
pub(super) fn require_size(
    table: &Grid,
    [nx, ny]: [usize; 2],
    what: &str,
) -> Result<(), LowRankError> {
    let (x, y) = (table.x().count, table.y().count);
    if (x, y) == (nx, ny) {
        return Ok(());
    }
    let what = format!("{x} × {y} texels, {what} {nx} × {ny}");
    Err(LowRankError::unusable(&table.origin, what))
}

/// Factorises every channel from its singular value decomposition, one channel beside the other.
pub(super) fn per_channel<R: Send>(
    table: &Grid,
    alignment: Alignment,
    rank: usize,
    method: impl Fn(usize, &Mat<f64>, Terms) -> Result<(Terms, R), LowRankError> + Sync,
) -> Result<(LowRank, Vec<R>), LowRankError> {
    let starts = Decomposition::of_aligned(table, alignment)?.terms(rank)?;
    let results: Vec<(Terms, R)> = table
        .channels
        .par_iter()
        .zip(starts)
        .enumerate()
        .map(|(index, (channel, start))| method(index, &of_channel(table, channel), start))
        .collect::<Result<_, LowRankError>>()?;
    let mut terms: Vec<Terms> = Vec::with_capacity(results.len());
    let mut reports = Vec::with_capacity(results.len());
    for (mut one, report) in results {
        orient(&mut one, terms.first());
        terms.push(one);
        reports.push(report);
    }
    let channels =
        table.channels.iter().zip(&terms).map(|(channel, t)| t.named(&channel.name)).collect();
    Ok((LowRank { x: table.x().clone(), y: table.y().clone(), channels, alignment }, reports))
}
