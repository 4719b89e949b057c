//! Factors of least weighted error: Σ_ij W_ij (S − Ŝ)²_ij.
//!
//! A weight that is no product of one along x and one along y leaves no decomposition in closed
//! form (Srebro & Jaakkola 2003, ICML). With one side held, the other's rows are independent small
//! least-squares problems; the two sides alternate.

use faer::Mat;

use super::matrix::solve_towards;
use super::methods::{Stopping, per_channel, require_size};
use super::terms::Terms;
use super::{Alignment, LowRank, LowRankError};
use crate::table::{Axis, Grid, centres};

/// Relative ridge that holds a row of a side where its weights leave it open.
const ANCHOR: f64 = 1e-12;

/// A weight per texel, rows of constant y one after the other; finite and not negative.
#[derive(Debug, Clone, PartialEq)]
pub struct Weight {
    size: [usize; 2],
    values: Vec<f64>,
}

impl Weight {
    /// Any weight.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] unless there are `x.count · y.count` values;
    /// [`LowRankError::Setting`] if one is negative or not finite.
    pub fn new(x: &Axis, y: &Axis, values: Vec<f64>) -> Result<Self, LowRankError> {
        let expected = x.count.saturating_mul(y.count);
        if values.len() != expected {
            let what = format!("{} values, expected {expected}", values.len());
            return Err(LowRankError::unusable("weight", what));
        }
        match values.iter().find(|w| !(w.is_finite() && **w >= 0.0)) {
            Some(bad) => {
                let expected = "finite values that are not negative";
                Err(LowRankError::setting("weight", expected, bad.to_string()))
            }
            None => Ok(Self { size: [x.count, y.count], values }),
        }
    }

    /// The square of what a texel of a diffraction table is multiplied by under illumination from
    /// ω_i seen along the normal: ((1 + ω_i·ω_o)²/4)² with ω_o = n and ω_i·n = √(1 − h_x² − h_y²),
    /// 0 outside the unit disc, which no light reaches (toisoul2017 eq. 6).
    pub fn of_incidence(x: &Axis, y: &Axis, alignment: &Alignment) -> Self {
        let inverse = alignment.inverse();
        let weight = |a: [f64; 2]| {
            let [hx, hy] = inverse.apply(a);
            let sine_squared = hx * hx + hy * hy;
            if sine_squared > 1.0 {
                return 0.0;
            }
            ((1.0 + (1.0 - sine_squared).sqrt()).powi(2) / 4.0).powi(2)
        };
        Self { size: [x.count, y.count], values: centres(x, y).map(weight).collect() }
    }

    fn at(&self, iy: usize, ix: usize) -> f64 {
        self.values.get(iy * self.size[0] + ix).copied().unwrap_or(0.0)
    }

    /// √W.
    pub(super) fn root(&self, iy: usize, ix: usize) -> f64 {
        self.at(iy, ix).sqrt()
    }

    fn squared(&self, d: &Mat<f64>) -> f64 {
        let row = |i: usize| (0..d.ncols()).map(|j| self.at(i, j) * d[(i, j)].powi(2)).sum::<f64>();
        (0..d.nrows()).map(row).sum()
    }

    /// √(Σ W (S − Ŝ)²/Σ W S²) per channel; 0 for a channel that is 0 under the weight.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] if table, weight and factors have different sizes or channels.
    pub fn relative_errors(
        &self,
        table: &Grid,
        factors: &LowRank,
    ) -> Result<Vec<f64>, LowRankError> {
        self.require(table)?;
        factors.relative_errors_by(table, |d| self.squared(d))
    }

    fn require(&self, table: &Grid) -> Result<(), LowRankError> {
        require_size(table, self.size, "the weight has")
    }
}

/// Fits factors of rank `rank` to every channel under one weight, from the singular value
/// decomposition: never worse than it under the weight.
///
/// # Errors
/// As [`Grid::check_plane`]; [`LowRankError::Rank`]; [`LowRankError::Unusable`] if the weight has another
/// size than the table, or singular values do not converge.
pub fn weighted(
    table: &Grid,
    alignment: Alignment,
    rank: usize,
    weight: &Weight,
    stopping: Stopping,
) -> Result<LowRank, LowRankError> {
    table.check_plane()?;
    weight.require(table)?;
    let fit = |_: usize, s: &Mat<f64>, mut terms: Terms| {
        let cost = |terms: &Terms| weight.squared(&terms.residual(s));
        stopping.alternate(cost(&terms), || {
            terms.vertical =
                side(&terms.horizontal, &terms.vertical, |i, j| (weight.at(i, j), s[(i, j)]));
            terms.horizontal =
                side(&terms.vertical, &terms.horizontal, |j, i| (weight.at(i, j), s[(i, j)]));
            cost(&terms)
        });
        Ok((terms.orthogonal(&table.origin)?, ()))
    };
    Ok(per_channel(table, alignment, rank, fit)?.0)
}

/// The rows of one side of least error, the other held; `texel` gives weight and value at (row of
/// this side, row of the other).
fn side(other: &Mat<f64>, now: &Mat<f64>, texel: impl Fn(usize, usize) -> (f64, f64)) -> Mat<f64> {
    let rank = other.ncols();
    let mut next = now.clone();
    for i in 0..now.nrows() {
        let mut normal = Mat::<f64>::zeros(rank, rank);
        let mut right = Mat::<f64>::zeros(rank, 1);
        for j in 0..other.nrows() {
            let (w, s) = texel(i, j);
            if w == 0.0 {
                continue;
            }
            for m in 0..rank {
                let weighted = w * other[(j, m)];
                right[(m, 0)] += weighted * s;
                for k in 0..=m {
                    normal[(m, k)] += weighted * other[(j, k)];
                }
            }
        }
        let towards = now.as_ref().subrows(i, 1).transpose().to_owned();
        let row = solve_towards(normal, right, towards.as_ref(), ANCHOR);
        for m in 0..rank {
            next[(i, m)] = row[(m, 0)];
        }
    }
    next
}
