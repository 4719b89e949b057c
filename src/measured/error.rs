use std::path::{Path, PathBuf};

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
    /// A map or a picture of a size that it cannot have.
    #[error("{origin}: {width} × {height} {what}, expected {expected}")]
    Size {
        /// The file or what made it.
        origin: String,
        /// What it is made of, in the plural.
        what: &'static str,
        /// Number across.
        width: usize,
        /// Number down.
        height: usize,
        /// The rule that is broken.
        expected: &'static str,
    },
    /// More or fewer bytes or values than the size asks for.
    #[error("{origin}: {got} {what}, expected {expected} for {width} × {height}{hint}")]
    Length {
        /// The file or what made it.
        origin: String,
        /// What is counted, in the plural.
        what: &'static str,
        /// Number that is there.
        got: u64,
        /// Number that is needed; the largest number that fits if it is larger still.
        expected: u64,
        /// Number across.
        width: usize,
        /// Number down.
        height: usize,
        /// Where the size stands, if not in the same file.
        hint: String,
    },
    /// Samples that cannot be what they are said to be.
    #[error(
        "{origin}: {count} of {total} {what}, expected {expected}; the first, at column {column}, \
         row {row} (from 0), is {got}"
    )]
    Samples {
        /// The file or what made it.
        origin: String,
        /// Number of samples that are wrong.
        count: usize,
        /// Number of samples.
        total: usize,
        /// What is wrong with them.
        what: &'static str,
        /// What is expected, with the unit.
        expected: &'static str,
        /// Column of the first, from 0.
        column: usize,
        /// Row of the first, from 0.
        row: usize,
        /// The first value.
        got: f64,
    },
    /// A channel that is not there, or one that must be named.
    #[error("{origin}: {reason}; it has: {known}")]
    Channel {
        /// The file.
        origin: String,
        /// What is missing or unclear.
        reason: String,
        /// The channels that are there.
        known: String,
    },
    /// A file that its decoder refuses.
    #[error("{origin}: malformed {format}: {reason}")]
    Decoder {
        /// The file.
        origin: String,
        /// Name of the format.
        format: &'static str,
        /// What the decoder said, with expected and got.
        reason: String,
    },
    /// A file to be written whose extension is not that of what it would hold.
    #[error("{}: {what} is written as {expected}", path.display())]
    OutputFormat {
        /// The file to be written.
        path: PathBuf,
        /// What was to be written.
        what: &'static str,
        /// The extension that is expected.
        expected: &'static str,
    },
}

impl MeasuredError {
    pub(super) fn implausible(origin: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Implausible { origin: origin.into(), reason: reason.into() }
    }

    pub(super) fn unknown_format(path: &Path, known: impl Into<String>) -> Self {
        Self::UnknownFormat { path: path.into(), known: known.into() }
    }
}
