//! Why a table could not be factorised.

use crate::table::TableError;

/// What went wrong; every message says what was expected and what was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LowRankError {
    /// The table, or a file of factors, could not be read, used or written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A rank that the table does not have.
    #[error("{origin}: rank {rank}; a table of {nx} × {ny} texels has ranks 1 to {largest}", largest = nx.min(ny))]
    Rank {
        /// The table.
        origin: String,
        /// The rank asked for.
        rank: usize,
        /// Texels along x.
        nx: usize,
        /// Texels along y.
        ny: usize,
    },
    /// An option outside its range.
    #[error("{name}: expected {expected}, got {got}")]
    Setting {
        /// The option.
        name: &'static str,
        /// What it may be.
        expected: String,
        /// What it is.
        got: String,
    },
    /// A table without a value above or below zero.
    #[error("{origin}: every value is 0; there is nothing to factorise")]
    AllZero {
        /// The table.
        origin: String,
    },
    /// What cannot be worked with: files of factors that do not belong together, a table of another size
    /// or with negative values, an environment without light, values that do not converge.
    #[error("{origin}: {what}")]
    Unusable {
        /// File, folder, table or environment.
        origin: String,
        /// Expected and got.
        what: String,
    },
}

impl LowRankError {
    /// [`LowRankError::Setting`].
    pub(super) fn setting(
        name: &'static str,
        expected: impl Into<String>,
        got: impl Into<String>,
    ) -> Self {
        Self::Setting { name, expected: expected.into(), got: got.into() }
    }

    /// [`LowRankError::Unusable`].
    pub(super) fn unusable(origin: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Unusable { origin: origin.into(), what: what.into() }
    }
}
