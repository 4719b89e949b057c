use crate::render::image::ImageError;
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
    /// Neither image has standard errors of a channel.
    #[error(
        "neither image has standard errors of channel {channel:?}; expected \"stderr.{channel}\""
    )]
    NoStandardError {
        /// The channel.
        channel: String,
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
    /// One of the images cannot be used.
    #[error("the {which}: {source}")]
    Image {
        /// `test image` or `reference`.
        which: &'static str,
        /// What is wrong with it.
        source: Box<ImageError>,
    },
    /// The tables have different columns.
    #[error(
        "columns differ: not in the test table: {}; not in the reference: {}",
        listed(missing_in_test),
        listed(missing_in_reference)
    )]
    Columns {
        /// Names that only the reference has.
        missing_in_test: String,
        /// Names that only the test table has.
        missing_in_reference: String,
    },
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

fn listed(names: &str) -> &str {
    if names.is_empty() { "none" } else { names }
}
