//! Why a fit could not be run. How a fit that ran ended is `outcome::Status`.

use crate::effect::{DomainError, FamilyError};
use crate::form::FormError;
use crate::table::TableError;

/// Why a spec could not be read, or a fit not be run.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A file could not be read or written.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// A value in a spec makes no sense.
    #[error("{}: {key}: {what}", place(path, *line))]
    Spec {
        /// The spec, or `command line`.
        path: String,
        /// Line of the key, from 1, where there is a text.
        line: Option<usize>,
        /// The key, as in `parameters.a.lower`.
        key: String,
        /// Expected and got.
        what: String,
    },
    /// A name that is not registered.
    #[error("there is no {kind} called `{name}`; known: {known}")]
    Unknown {
        /// `form`, `reference` or `family`.
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The reference has no value at a point of the domain.
    #[error("{reference}: {source}")]
    Domain {
        /// The reference.
        reference: String,
        /// Argument, domain and value.
        source: DomainError,
    },
    /// The family could not be made.
    #[error(transparent)]
    Family(#[from] FamilyError),
    /// What cannot be fitted with: a text that is no spec, or a table.
    #[error("{origin}: {what}")]
    Unusable {
        /// Path or label.
        origin: String,
        /// Where in it, expected and got.
        what: String,
    },
    /// A table could not be read, or a file not be written.
    #[error(transparent)]
    Data(#[from] TableError),
    /// A result file has another version.
    #[error("{path}: expected schema {expected}, got {got}")]
    Schema {
        /// The file.
        path: String,
        /// The version that is read.
        expected: u32,
        /// The version of the file.
        got: u32,
    },
    /// A result file is not what [`crate::fit::outcome`] describes.
    #[error("{path}: {source}")]
    Result {
        /// The file.
        path: String,
        /// Line and column, expected and got.
        source: serde_json::Error,
    },
}

fn place(path: &str, line: Option<usize>) -> String {
    line.map_or_else(|| path.to_owned(), |line| format!("{path}:{line}"))
}
