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
    /// The file is not UTF-8 text.
    #[error("{origin}:{line}: not UTF-8 text (byte {byte} of the file)")]
    NotText {
        /// The file.
        origin: String,
        /// Line of the first bad byte.
        line: usize,
        /// Offset of the first bad byte, from 0.
        byte: usize,
    },
    /// There is no header or no row under it.
    #[error("{origin}: {what}")]
    Empty {
        /// The file.
        origin: String,
        /// What is missing.
        what: &'static str,
    },
    /// A header cell is not `name [unit]` or `u(name) [unit]`.
    #[error("{origin}:{line}: column {position}: header {header:?}: {reason}")]
    Header {
        /// The file.
        origin: String,
        /// Line of the header.
        line: u64,
        /// Number of the column, from 1.
        position: usize,
        /// The cell as written.
        header: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Two columns have one name.
    #[error("{origin}:{line}: column {name:?} appears twice")]
    DuplicateColumn {
        /// The file.
        origin: String,
        /// Line of the header.
        line: u64,
        /// The name.
        name: String,
    },
    /// A unit that this crate does not know.
    #[error("{origin}: column {column:?}: unknown unit {unit:?}; known units: {known}")]
    UnknownUnit {
        /// The file.
        origin: String,
        /// The column.
        column: String,
        /// The unit as written.
        unit: String,
        /// All known units.
        known: String,
    },
    /// A known unit where another dimension is needed.
    #[error("{origin}: column {column:?}: expected a unit of {expected}, got {got:?}")]
    UnitMismatch {
        /// The file.
        origin: String,
        /// The column.
        column: String,
        /// The unit or the dimension that is needed.
        expected: String,
        /// The unit that is there.
        got: String,
    },
    /// `u(name)` without a column `name`.
    #[error("{origin}: uncertainty column \"u({column})\" has no column {column:?}")]
    OrphanUncertainty {
        /// The file.
        origin: String,
        /// The column that is missing.
        column: String,
    },
    /// A standard uncertainty below zero.
    #[error("{origin}:{line}: row {row}: \"u({column})\" is negative: {got}")]
    NegativeUncertainty {
        /// The file.
        origin: String,
        /// The line.
        line: u64,
        /// The row.
        row: usize,
        /// The column that the uncertainty belongs to.
        column: String,
        /// The value.
        got: f64,
    },
    /// A row with more or fewer cells than the header.
    #[error("{origin}:{line}: row {row} has {got} cells, the header has {expected}{hint}")]
    RaggedRow {
        /// The file.
        origin: String,
        /// The line.
        line: u64,
        /// The row.
        row: usize,
        /// Cells in the header.
        expected: usize,
        /// Cells in the row.
        got: usize,
        /// Extra words where the row is the last one and not ended.
        hint: &'static str,
    },
    /// A cell that is not a number.
    #[error("{origin}:{line}: row {row}, column {column:?}: expected a number, got {got:?}")]
    NotANumber {
        /// The file.
        origin: String,
        /// The line.
        line: u64,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// The cell as written.
        got: String,
    },
    /// NaN or an infinity where the caller did not allow it.
    #[error("{origin}: row {row}, column {column:?}: expected a finite number, got {got}")]
    NonFinite {
        /// The file.
        origin: String,
        /// The row, or the texel in words.
        row: String,
        /// The column or channel.
        column: String,
        /// The value.
        got: f64,
    },
    /// Columns of different lengths, or a grid whose values do not fill its axes.
    #[error("{origin}: column {column:?} has {got} values, expected {expected}")]
    Length {
        /// The table.
        origin: String,
        /// The column or channel.
        column: String,
        /// Number of values that is needed.
        expected: usize,
        /// Number of values that is there.
        got: usize,
    },
    /// A grid of another number of axes than its use asks for.
    #[error("{origin}: {got} axes, expected {expected}")]
    Dimension {
        /// The grid.
        origin: String,
        /// Number of axes that is needed.
        expected: usize,
        /// Number of axes that is there.
        got: usize,
    },
    /// A column or channel that is not there.
    #[error("{origin}: no column {name:?}; it has: {known}")]
    UnknownColumn {
        /// The table.
        origin: String,
        /// The name asked for.
        name: String,
        /// The names that are there.
        known: String,
    },
    /// A file of another structure than its format says.
    #[error("{origin}: malformed: {reason}")]
    Malformed {
        /// The file, with the line where it is known.
        origin: String,
        /// What is wrong.
        reason: String,
    },
    /// A grid that is larger than this crate reads, or than its file can hold.
    #[error("{origin}: declares {declared} bytes of pixels, the limit is {limit} ({why})")]
    TooLarge {
        /// The file.
        origin: String,
        /// Bytes that the header declares.
        declared: u128,
        /// The limit that applies.
        limit: u128,
        /// Where the limit comes from.
        why: &'static str,
    },
    /// A file of a data set and its provenance record disagree.
    #[error("{}: {name}: {reason}", folder.display())]
    Provenance {
        /// The folder of the data set.
        folder: PathBuf,
        /// The file.
        name: String,
        /// How they disagree.
        reason: String,
    },
}
