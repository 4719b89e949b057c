use crate::table::TableError;

/// Why measured data could not be read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// A table or a provenance record.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A file that is not what its format asks for.
    #[error("{origin}:{line}: {reason}")]
    Malformed {
        /// The file.
        origin: String,
        /// The line, from 1.
        line: u64,
        /// What is wrong, with expected and got.
        reason: String,
    },
    /// A file of no known format, one that its decoder refuses, one that lacks what is asked for, or
    /// numbers that read well but cannot be what they are said to be.
    #[error("{origin}: {reason}")]
    Unusable {
        /// The file, the record or the argument.
        origin: String,
        /// What is wrong, with expected and got.
        reason: String,
    },
}

/// Passes where what `origin` holds makes sense; `reason` says what is wrong, with expected and got.
pub(super) fn require(
    sense: bool,
    origin: &str,
    reason: impl FnOnce() -> String,
) -> Result<(), MeasuredError> {
    if sense { Ok(()) } else { Err(MeasuredError::unusable(origin, reason())) }
}

impl MeasuredError {
    pub(crate) fn unusable(origin: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Unusable { origin: origin.into(), reason: reason.into() }
    }

    /// A wavelength outside the measured range.
    pub(super) fn out_of_range(
        origin: &str,
        quantity: &str,
        (from_nm, to_nm): (f64, f64),
        got_nm: f64,
    ) -> Self {
        let known = format!("{quantity} is known from {from_nm} to {to_nm} nm");
        Self::unusable(origin, format!("{known}, asked for {got_nm} nm"))
    }
}
