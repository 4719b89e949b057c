//! The exact mean over the offsets of a footprint, and the error of a candidate over them.

use rayon::prelude::*;

use super::regions::{spaced_offsets, table};
use crate::effect::{Candidate, DomainError};
use crate::form::FormError;
use crate::numeric::statistics::relative_l2;
use crate::table::Table;

/// An exact mean: a function of h and s.
pub(super) type Mean = fn(f64, f64) -> Result<f64, DomainError>;

/// Points in the columns `h`, `s` and `area_ratio`, and the exact mean there.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) points: Table,
    pub(super) exact: Vec<f64>,
}

impl Line {
    /// Rows of h, s and A_P/A_C.
    pub(super) fn new(mean: Mean, rows: &[[f64; 3]]) -> Result<Self, DomainError> {
        let exact = rows.iter().map(|&[h, s, _]| mean(h, s)).collect::<Result<_, _>>()?;
        Ok(Self { points: table(["h", "s", "area_ratio"], rows, "offsets"), exact })
    }

    /// `count` offsets over [0, h + 4.5] for every (h, A_P/A_C).
    pub(super) fn all(
        mean: Mean,
        footprints: &[(f64, f64)],
        count: u32,
    ) -> Result<Vec<Self>, DomainError> {
        let of = |&(h, area_ratio): &(f64, f64)| {
            let rows: Vec<_> = spaced_offsets(h, count, 0.5).map(|s| [h, s, area_ratio]).collect();
            Self::new(mean, &rows)
        };
        footprints.par_iter().map(of).collect()
    }
}

/// Relative L2 error over each line.
pub(super) fn errors(candidate: &Candidate, lines: &[Line]) -> Result<Vec<f64>, FormError> {
    let error = |line: &Line| {
        let values = candidate.values_at(&line.points)?;
        Ok(relative_l2(values.into_iter().zip(line.exact.iter().copied())))
    };
    lines.iter().map(error).collect()
}
