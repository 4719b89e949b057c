//! What is wrong with the samples of a map, how often, and where first.

use super::MeasuredError;
use super::error::require;

/// The samples of a map, row by row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Samples<'a, T> {
    pub(super) origin: &'a str,
    pub(super) width: usize,
    pub(super) values: &'a [T],
}

impl<'a, T> Samples<'a, T> {
    /// `width` × `height` values.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] for another number of them.
    pub(super) fn filling(
        origin: &'a str,
        [width, height]: [usize; 2],
        values: &'a [T],
    ) -> Result<Self, MeasuredError> {
        let (got, expected) = (values.len() as u64, (width as u64).saturating_mul(height as u64));
        require(got == expected, origin, || {
            format!("{got} values, expected {expected} for {width} × {height}")
        })?;
        Ok(Self { origin, width, values })
    }

    /// Passes unless `wrong` finds a value, in some sample, that is not as `expected`; `what` says
    /// what is wrong with it.
    pub(super) fn refuse(
        &self,
        what: &str,
        expected: &str,
        wrong: impl Fn(&T) -> Option<f64>,
    ) -> Result<(), MeasuredError> {
        let mut faults = self.values.iter().enumerate().filter_map(|(i, v)| Some((i, wrong(v)?)));
        let Some((index, got)) = faults.next() else { return Ok(()) };
        let (count, total) = (1 + faults.count(), self.values.len());
        let (column, row) = (index % self.width.max(1), index / self.width.max(1));
        let reason = format!(
            "{count} of {total} {what}, expected {expected}; the first, at column {column}, row \
             {row} (from 0), is {got}"
        );
        Err(MeasuredError::unusable(self.origin, reason))
    }
}

/// A map of a size that it cannot have: `what` it is made of, and what is `expected`.
pub(super) fn size_fault(
    origin: &str,
    [width, height]: [usize; 2],
    what: &str,
    expected: &str,
) -> MeasuredError {
    let reason = format!("{width} × {height} {what}, expected {expected}");
    MeasuredError::unusable(origin, reason)
}
