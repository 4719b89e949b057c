use std::path::PathBuf;

/// Why a table, a grid or a provenance record could not be read, used or written.
///
/// Every message names the file and, where there is one, the line and the column. Lines and rows
/// count from 1; the row is the row of data, without header and comments.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file could not be read.
    #[error("{}: cannot read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The file could not be written.
    #[error("{}: cannot write: {reason}", path.display())]
    Unwritable {
        /// The file that was to be written.
        path: PathBuf,
        /// What stood in the way.
        reason: String,
    },
    /// What a file, or a table made in memory, holds is not what it is read or used as.
    #[error("{place}: {reason}")]
    Content {
        /// The file with the line, where there are such, or the origin of the table.
        place: String,
        /// What is wrong: the row, the column, the unit, what was expected and what is there.
        reason: String,
    },
}

impl TableError {
    /// [`TableError::Content`].
    pub(crate) fn content(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Content { place: place.into(), reason: reason.into() }
    }

    /// A file of another structure than its format says.
    pub(super) fn malformed(place: impl Into<String>, reason: impl std::fmt::Display) -> Self {
        Self::content(place, format!("malformed: {reason}"))
    }

    /// A grid that is larger than this crate reads, or than its file can hold: bytes that its header
    /// declares, the limit that applies, and where that comes from.
    pub(crate) fn too_large(origin: &str, declared: u128, limit: u128, why: &str) -> Self {
        let reason = format!("declares {declared} bytes of pixels, the limit is {limit} ({why})");
        Self::content(origin, reason)
    }

    /// A column or channel that is not among the `known` ones.
    pub(super) fn unknown_column<'a>(
        origin: &str,
        name: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known = known.into_iter().collect::<Vec<_>>().join(", ");
        Self::content(origin, format!("no column {name:?}; it has: {known}"))
    }

    /// Columns of different lengths, or a grid whose values do not fill its axes.
    pub(super) fn length(origin: &str, column: &str, expected: usize, got: usize) -> Self {
        Self::content(origin, format!("column {column:?} has {got} values, expected {expected}"))
    }

    /// A standard uncertainty below zero in a row of a table.
    pub(super) fn negative(place: String, row: usize, column: &str, got: f64) -> Self {
        Self::content(place, format!("row {row}: \"u({column})\" is negative: {got}"))
    }

    /// NaN or an infinity, in a row or in a texel in words.
    pub(super) fn non_finite(place: &str, row: &str, column: &str, got: f64) -> Self {
        let reason = format!("row {row}, column {column:?}: expected a finite number, got {got}");
        Self::content(place, reason)
    }
}
