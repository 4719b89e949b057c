//! What is wrong with the samples of a map, how often, and where first.

use super::MeasuredError;

/// The samples of a map, row by row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Samples<'a, T> {
    pub(super) origin: &'a str,
    pub(super) width: usize,
    pub(super) values: &'a [T],
}

impl<T> Samples<'_, T> {
    /// Passes unless `wrong` finds a value, in some sample, that is not as `expected`; `what` says
    /// what is wrong with it.
    pub(super) fn refuse(
        &self,
        what: &'static str,
        expected: &'static str,
        wrong: impl Fn(&T) -> Option<f64>,
    ) -> Result<(), MeasuredError> {
        let mut faults = self.values.iter().enumerate().filter_map(|(i, v)| Some((i, wrong(v)?)));
        let Some((index, got)) = faults.next() else { return Ok(()) };
        Err(MeasuredError::Samples {
            origin: self.origin.into(),
            count: 1 + faults.count(),
            total: self.values.len(),
            what,
            expected,
            column: index % self.width.max(1),
            row: index / self.width.max(1),
            got,
        })
    }
}

/// Passes if there are `width` × `height` values.
pub(super) fn require_count(
    origin: &str,
    width: usize,
    height: usize,
    got: usize,
) -> Result<(), MeasuredError> {
    let (got, expected) = (got as u64, (width as u64).saturating_mul(height as u64));
    if got == expected {
        return Ok(());
    }
    Err(MeasuredError::Length {
        origin: origin.into(),
        what: "values",
        got,
        expected,
        width,
        height,
        hint: String::new(),
    })
}
