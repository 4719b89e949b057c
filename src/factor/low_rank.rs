//! Separable kernels: their factors, and the kernels that these give.

use faer::Mat;
use rayon::prelude::*;

use super::matrix::{of_channel, texels};
use super::methods::require_size;
use super::terms::Terms;
use super::{Alignment, LowRankError};
use crate::table::{Axis, Grid, GridChannel, centres};

/// A kernel as a sum of products: K(a) = Σ_m vertical\[m\](a_y) · horizontal\[m\](a_x), with
/// a = [`Alignment::matrix`] · h.
#[derive(Debug, Clone, PartialEq)]
pub struct LowRank {
    /// Axis of the horizontal factors, in aligned coordinates.
    pub x: Axis,
    /// Axis of the vertical factors, in aligned coordinates.
    pub y: Axis,
    /// One per channel of the table, in its order.
    pub channels: Vec<ChannelFactors>,
    /// From h to the coordinates of the axes.
    pub alignment: Alignment,
}

/// The factors of one channel, largest first.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelFactors {
    /// Name of the channel.
    pub name: String,
    /// `vertical[m][iy]`: one list of `y.count` values per term.
    pub vertical: Vec<Vec<f64>>,
    /// `horizontal[m][ix]`: one list of `x.count` values per term.
    pub horizontal: Vec<Vec<f64>>,
}

impl LowRank {
    /// The largest number of terms of a channel.
    pub fn rank(&self) -> usize {
        self.channels.iter().map(|c| c.vertical.len()).max().unwrap_or(0)
    }

    /// The first `rank` terms of every channel.
    pub fn truncated(&self, rank: usize) -> Self {
        let mut kernel = self.clone();
        for channel in &mut kernel.channels {
            channel.vertical.truncate(rank);
            channel.horizontal.truncate(rank);
        }
        kernel
    }

    /// K(h) of channel number `channel`, in the table's unit: each factor linear between the centres
    /// of its texels and constant from the outermost centre to the edge of its axis; 0 beyond the
    /// axes, and for a channel that is not there.
    pub fn evaluate(&self, channel: usize, h: [f64; 2]) -> f64 {
        let [ax, ay] = self.alignment.apply(h);
        let Some(factors) = self.channels.get(channel) else { return 0.0 };
        let (Some(x), Some(y)) = (self.x.between(ax), self.y.between(ay)) else { return 0.0 };
        let of = |values: &[f64], (low, high, part): (usize, usize, f64)| {
            let at = |i: usize| values.get(i).copied().unwrap_or(0.0);
            at(low) * (1.0 - part) + at(high) * part
        };
        factors.vertical.iter().zip(&factors.horizontal).map(|(v, h)| of(v, y) * of(h, x)).sum()
    }

    /// The kernel on a table of h with these axes, each texel at its centre.
    ///
    /// # Errors
    /// As [`Grid::check`].
    pub fn to_grid(&self, x: &Axis, y: &Axis) -> Result<Grid, LowRankError> {
        self.grid(x, y, |channel, _| {
            centres(x, y).map(|h| self.evaluate(channel, h) as f32).collect()
        })
    }

    /// The kernel on its own axes, in aligned coordinates: V Hᵀ texel by texel.
    ///
    /// # Errors
    /// As [`Grid::check`].
    pub fn product(&self) -> Result<Grid, LowRankError> {
        self.grid(&self.x, &self.y, |_, factors| {
            texels(Terms::of(factors, self.y.count, self.x.count).product().as_ref())
        })
    }

    fn grid(
        &self,
        x: &Axis,
        y: &Axis,
        values: impl Fn(usize, &ChannelFactors) -> Vec<f32>,
    ) -> Result<Grid, LowRankError> {
        let named = self.channels.iter().enumerate();
        let channels = named.map(|(at, c)| GridChannel::new(&c.name, "1", values(at, c))).collect();
        let origin = format!("factors of rank {}", self.rank());
        Ok(Grid::new([x.clone(), y.clone()], channels, origin)?)
    }

    /// ‖S − Ŝ‖/‖S‖ (Frobenius) per channel of a table in aligned coordinates; 0 for a channel that
    /// is 0 and given as 0.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] if the table has other channels or another size.
    pub fn relative_errors(&self, aligned: &Grid) -> Result<Vec<f64>, LowRankError> {
        self.relative_errors_by(aligned, |d| d.squared_norm_l2())
    }

    /// ‖S − Ŝ‖/‖S‖ per channel under a norm, `squared`; 0 for a channel that is 0 under it.
    pub(super) fn relative_errors_by(
        &self,
        aligned: &Grid,
        squared: impl Fn(&Mat<f64>) -> f64 + Sync,
    ) -> Result<Vec<f64>, LowRankError> {
        let error = |(channel, terms): (&GridChannel, Terms)| {
            let s = of_channel(aligned, channel);
            let whole = squared(&s);
            if whole == 0.0 { 0.0 } else { (squared(&terms.residual(&s)) / whole).sqrt() }
        };
        Ok(self.matched(aligned)?.into_par_iter().map(error).collect())
    }

    /// The channels of a table of the same size with the terms of the same name.
    pub(super) fn matched<'g>(
        &self,
        table: &'g Grid,
    ) -> Result<Vec<(&'g GridChannel, Terms)>, LowRankError> {
        require_size(table, [self.x.count, self.y.count], "the factors have")?;
        let named = |channel: &'g GridChannel| {
            let factors = self.channels.iter().find(|f| f.name == channel.name);
            let lacking = || format!("no factors for channel {:?}", channel.name);
            let factors =
                factors.ok_or_else(|| LowRankError::unusable(&table.origin, lacking()))?;
            Ok((channel, Terms::of(factors, self.y.count, self.x.count)))
        };
        table.channels.iter().map(named).collect()
    }

    /// What the two passes of toisoul2017 give as printed (eq. 10 and 11, algorithm 1).
    ///
    /// There each pass sums over the terms on its own, Σ_m f_v,m in one and Σ_n f_h,n in the other,
    /// and the intermediate image has no index of the term. The two sums multiply:
    /// Σ_m Σ_n v_m h_nᵀ = (Σ_m v_m)(Σ_n h_n)ᵀ, a kernel of rank 1 that holds every product of terms
    /// that do not belong together. It is the truncated decomposition only at rank 1; what a higher
    /// rank adds depends on the signs of the singular vectors, which are free. A correct pass keeps
    /// one intermediate image per term.
    pub fn cross_rank_printed(&self) -> Self {
        let sum = |lists: &[Vec<f64>], n: usize| -> Vec<Vec<f64>> {
            vec![(0..n).map(|i| lists.iter().filter_map(|list| list.get(i)).sum()).collect()]
        };
        let mut kernel = self.clone();
        for channel in &mut kernel.channels {
            channel.vertical = sum(&channel.vertical, self.y.count);
            channel.horizontal = sum(&channel.horizontal, self.x.count);
        }
        kernel
    }
}
