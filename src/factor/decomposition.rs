//! Singular value decomposition of every channel: the smallest Frobenius error at each rank
//! (toisoul2017 §4.1; Eckart & Young 1936).

use rayon::prelude::*;

use super::matrix::{ThinSvd, of_channel, thin_svd};
use super::terms::{Terms, canonical, orient};
use super::{Alignment, LowRank, LowRankError};
use crate::table::{Axis, Grid};

/// S = U Σ Vᵀ of every channel of a table, whole.
#[derive(Debug, Clone)]
pub struct Decomposition {
    x: Axis,
    y: Axis,
    origin: String,
    alignment: Alignment,
    channels: Vec<(SingularSpectrum, ThinSvd)>,
}

/// What the singular values of one channel say.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SingularSpectrum {
    /// Name of the channel.
    pub channel: String,
    /// min(nx, ny) values in the channel's unit, descending; those within rounding of 0 are 0.
    pub singular_values: Vec<f64>,
    /// ‖S − Ŝ‖/‖S‖ (Frobenius) at rank = index, from rank 0 to min(nx, ny): the tail of Σσ², summed
    /// from its small end. All 0 for a channel that is 0.
    pub relative_errors: Vec<f64>,
}

impl SingularSpectrum {
    fn of(channel: &str, values: &[f64]) -> Self {
        let mut tails = vec![0.0; values.len() + 1];
        let mut tail = 0.0;
        for (slot, value) in tails.iter_mut().rev().skip(1).zip(values.iter().rev()) {
            tail += value * value;
            *slot = tail;
        }
        let relative = |t: &f64| if tail > 0.0 { (t / tail).sqrt() } else { 0.0 };
        Self {
            channel: channel.into(),
            singular_values: values.to_vec(),
            relative_errors: tails.iter().map(relative).collect(),
        }
    }
}

impl Decomposition {
    /// Decomposes every channel of a table, one beside the other; the result is the same for any
    /// number of threads. Repeated values and signs as [`super`] says.
    ///
    /// # Errors
    /// As [`Grid::check_plane`]; [`LowRankError::Unusable`] if singular values do not converge.
    pub fn of(table: &Grid) -> Result<Self, LowRankError> {
        Self::of_aligned(table, Alignment::identity())
    }

    /// [`Decomposition::of`] for a table in the coordinates a = `alignment` · h
    /// ([`super::aligned`]).
    ///
    /// # Errors
    /// As [`Decomposition::of`].
    pub fn of_aligned(table: &Grid, alignment: Alignment) -> Result<Self, LowRankError> {
        table.check_plane()?;
        let channels = table
            .channels
            .par_iter()
            .map(|channel| {
                let what = format!("{}: channel {:?}", table.origin, channel.name);
                let mut svd = thin_svd(of_channel(table, channel).as_ref(), &what)?;
                canonical(&mut svd);
                Ok((SingularSpectrum::of(&channel.name, &svd.values), svd))
            })
            .collect::<Result<_, LowRankError>>()?;
        let (x, y) = (table.x().clone(), table.y().clone());
        Ok(Self { x, y, origin: table.origin.clone(), alignment, channels })
    }

    /// What the singular values say, in the order of the channels.
    pub fn spectra(&self) -> impl Iterator<Item = &SingularSpectrum> {
        self.channels.iter().map(|(spectrum, _)| spectrum)
    }

    /// The largest rank, min(nx, ny).
    pub fn largest_rank(&self) -> usize {
        self.x.count.min(self.y.count)
    }

    /// The smallest rank, at least 1, at which no channel's relative Frobenius error is above
    /// `error`.
    ///
    /// # Errors
    /// [`LowRankError::Setting`] unless `error` is in [0, 1].
    pub fn rank_for_error(&self, error: f64) -> Result<usize, LowRankError> {
        if !(0.0..=1.0).contains(&error) {
            let expected = "a relative error from 0 to 1";
            return Err(LowRankError::setting("error", expected, error.to_string()));
        }
        let enough = |s: &SingularSpectrum| s.relative_errors.iter().position(|e| *e <= error);
        let ranks = self.spectra().map(|s| enough(s).unwrap_or_else(|| self.largest_rank()));
        Ok(ranks.max().unwrap_or(1).max(1))
    }

    /// The factors of the first `rank` terms: U Σ^½ and Σ^½ Vᵀ, signed by the rule of [`super`].
    ///
    /// # Errors
    /// [`LowRankError::Rank`] if `rank` is 0 or above [`Decomposition::largest_rank`].
    pub fn low_rank(&self, rank: usize) -> Result<LowRank, LowRankError> {
        let terms = self.terms(rank)?;
        let named = self.channels.iter().zip(&terms);
        Ok(LowRank {
            x: self.x.clone(),
            y: self.y.clone(),
            channels: named.map(|((s, _), terms)| terms.named(&s.channel)).collect(),
            alignment: self.alignment,
        })
    }

    /// The same, as other methods start from them.
    pub(super) fn terms(&self, rank: usize) -> Result<Vec<Terms>, LowRankError> {
        require_rank(&self.origin, &self.x, &self.y, rank)?;
        let mut all: Vec<Terms> = Vec::with_capacity(self.channels.len());
        for (_, svd) in &self.channels {
            let mut terms = Terms::of_svd(svd, rank);
            orient(&mut terms, all.first());
            all.push(terms);
        }
        Ok(all)
    }
}

/// Whether a table with these axes has rank `rank`.
pub(super) fn require_rank(
    origin: &str,
    x: &Axis,
    y: &Axis,
    rank: usize,
) -> Result<(), LowRankError> {
    if (1..=x.count.min(y.count)).contains(&rank) {
        return Ok(());
    }
    Err(LowRankError::Rank { origin: origin.into(), rank, nx: x.count, ny: y.count })
}
