use crate::table::TableError;

/// Why two images or tables could not be compared. "Test" is the first, "reference" the second.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The images have different sizes.
    #[error("the test image has {} × {} pixels, the reference has {} × {}",
        test.0, test.1, reference.0, reference.1)]
    Size {
        /// Width and height of the test image.
        test: (usize, usize),
        /// Width and height of the reference.
        reference: (usize, usize),
    },
    /// The images have different channels, standard errors aside.
    #[error("channels differ: the test image has {test}; the reference has {reference}")]
    Channels {
        /// Names in the test image.
        test: String,
        /// Names in the reference.
        reference: String,
    },
    /// A number that a comparison is asked for with makes no sense.
    #[error("{what}: expected {expected}, got {got}")]
    Setting {
        /// What the number sets.
        what: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        got: f64,
    },
    /// One of the images or tables cannot be used: which, expected and got.
    #[error("{0}")]
    Unusable(String),
    /// The tables have different numbers of rows.
    #[error("the test table has {test} rows, the reference has {reference}")]
    Rows {
        /// Rows of the test table.
        test: usize,
        /// Rows of the reference.
        reference: usize,
    },
    /// A column cannot be used.
    #[error(transparent)]
    Table(#[from] TableError),
}
