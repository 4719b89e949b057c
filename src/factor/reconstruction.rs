//! Kernels from their factors.

use super::matrix::{of_channel, relative_error, texels, times};
use super::terms::Terms;
use super::{LowRank, LowRankError};
use crate::table::{Axis, Channel, Grid};

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
        let (Some(x), Some(y)) = (between(&self.x, ax), between(&self.y, ay)) else { return 0.0 };
        factors.vertical.iter().zip(&factors.horizontal).map(|(v, h)| y.of(v) * x.of(h)).sum()
    }

    /// The kernel on a table of h with these axes, each texel at its centre.
    ///
    /// # Errors
    /// As [`Grid::check`].
    pub fn to_grid(&self, x: &Axis, y: &Axis) -> Result<Grid, LowRankError> {
        let (xs, ys) = (x.centres(), y.centres());
        self.grid(x, y, |channel| {
            let rows = ys.iter().flat_map(|hy| xs.iter().map(move |hx| [*hx, *hy]));
            rows.map(|h| self.evaluate(channel, h) as f32).collect()
        })
    }

    /// The kernel on its own axes, in aligned coordinates: V Hᵀ texel by texel.
    ///
    /// # Errors
    /// As [`Grid::check`].
    pub fn product(&self) -> Result<Grid, LowRankError> {
        self.grid(&self.x, &self.y, |channel| {
            let Some(factors) = self.channels.get(channel) else { return Vec::new() };
            let terms = Terms::of(factors, self.y.count, self.x.count);
            texels(times(terms.vertical.as_ref(), terms.horizontal.transpose()).as_ref())
        })
    }

    fn grid(
        &self,
        x: &Axis,
        y: &Axis,
        values: impl Fn(usize) -> Vec<f32>,
    ) -> Result<Grid, LowRankError> {
        let channels = self.channels.iter().enumerate().map(|(index, channel)| Channel {
            name: channel.name.clone(),
            unit: "1".into(),
            values: values(index),
        });
        let grid = Grid {
            x: x.clone(),
            y: y.clone(),
            channels: channels.collect(),
            origin: format!("factors of rank {}", self.rank()),
        };
        grid.check()?;
        Ok(grid)
    }

    /// ‖S − Ŝ‖/‖S‖ (Frobenius) per channel of a table in aligned coordinates; 0 for a channel that
    /// is 0 and given as 0.
    ///
    /// # Errors
    /// [`LowRankError::Mismatch`] if the table has other channels or another size.
    pub fn relative_errors(&self, aligned: &Grid) -> Result<Vec<f64>, LowRankError> {
        let pairs = self.matched(aligned)?;
        let error = |(channel, terms): (&Channel, Terms)| {
            let s = of_channel(aligned, channel);
            relative_error(s.as_ref(), terms.vertical.as_ref(), terms.horizontal.as_ref())
        };
        Ok(pairs.into_iter().map(error).collect())
    }

    /// The channels of a table of the same size with the terms of the same name.
    pub(super) fn matched<'g>(
        &self,
        table: &'g Grid,
    ) -> Result<Vec<(&'g Channel, Terms)>, LowRankError> {
        let mismatch = |what: String| LowRankError::Mismatch { origin: table.origin.clone(), what };
        if (table.x.count, table.y.count) != (self.x.count, self.y.count) {
            return Err(mismatch(format!(
                "{} × {} texels, the factors have {} × {}",
                table.x.count, table.y.count, self.x.count, self.y.count
            )));
        }
        let named = |channel: &'g Channel| {
            let factors =
                self.channels.iter().find(|f| f.name == channel.name).ok_or_else(|| {
                    mismatch(format!("no factors for channel {:?}", channel.name))
                })?;
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

/// Two neighbouring texels and the way between them.
struct Between {
    low: usize,
    high: usize,
    part: f64,
}

impl Between {
    fn of(&self, values: &[f64]) -> f64 {
        let at = |i: usize| values.get(i).copied().unwrap_or(0.0);
        at(self.low) * (1.0 - self.part) + at(self.high) * self.part
    }
}

/// Where `value` lies on `axis`; `None` beyond its edges.
fn between(axis: &Axis, value: f64) -> Option<Between> {
    let last = axis.count.checked_sub(1)?;
    let at = axis.texel(value);
    if !(-0.5..=last as f64 + 0.5).contains(&at) {
        return None;
    }
    let at = at.clamp(0.0, last as f64);
    let low = at.floor() as usize;
    Some(Between { low, high: (low + 1).min(last), part: at.fract() })
}
