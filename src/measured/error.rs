use std::path::PathBuf;

use crate::table::TableError;

/// Why measured data could not be read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// A table or a provenance record.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A file whose extension says no known format.
    #[error("{}: unknown format; known formats: {known}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The formats with their extensions.
        known: String,
    },
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
    /// A wavelength outside the measured range.
    #[error("{origin}: {quantity} is known from {from_nm} to {to_nm} nm, asked for {got_nm} nm")]
    OutOfRange {
        /// The record.
        origin: String,
        /// The quantity asked for.
        quantity: &'static str,
        /// Start of the range, nm.
        from_nm: f64,
        /// End of the range, nm.
        to_nm: f64,
        /// Wavelength asked for, nm.
        got_nm: f64,
    },
    /// A quantity that the record does not hold.
    #[error("{origin}: the record has no {quantity}")]
    Missing {
        /// The record.
        origin: String,
        /// The quantity asked for.
        quantity: &'static str,
    },
    /// A dispersion formula without a finite real value at this wavelength.
    #[error("{origin}: the dispersion formula has no finite real value at {at_nm} nm")]
    Undefined {
        /// The record.
        origin: String,
        /// Wavelength, nm.
        at_nm: f64,
    },
    /// Numbers that read well but cannot be what they are said to be.
    #[error("{origin}: {reason}")]
    Implausible {
        /// The file or the argument.
        origin: String,
        /// What is wrong, with expected and got.
        reason: String,
    },
}
