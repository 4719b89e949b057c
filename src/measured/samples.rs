//! What is wrong with the samples of a map, how often, and where first.

use super::MeasuredError;

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
    /// [`MeasuredError::Length`] for another number of them.
    pub(super) fn filling(
        origin: &'a str,
        [width, height]: [usize; 2],
        values: &'a [T],
    ) -> Result<Self, MeasuredError> {
        let (got, expected) = (values.len() as u64, (width as u64).saturating_mul(height as u64));
        if got == expected {
            return Ok(Self { origin, width, values });
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

/// Passes if there are two or more `what` along both sides.
pub(super) fn require_two(
    origin: &str,
    [width, height]: [usize; 2],
    what: &'static str,
    expected: &'static str,
) -> Result<(), MeasuredError> {
    if width.min(height) >= 2 {
        return Ok(());
    }
    Err(MeasuredError::Size { origin: origin.into(), what, width, height, expected })
}
