use crate::effect::simulator::SettingsError;
use crate::factor::LowRankError;
use crate::measured::MeasuredError;
use crate::table::TableError;

/// Why a surface or a pattern has no diffraction table.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DiffractionError {
    /// Measured data.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A table.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Factors of a table.
    #[error(transparent)]
    Factors(#[from] LowRankError),
    /// A setting.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A height map or a pattern that cannot be used.
    #[error("{origin}: {reason}")]
    Unusable {
        /// The file, or what made it.
        origin: String,
        /// What is wrong, with expected and got.
        reason: String,
    },
    /// A number outside its domain.
    #[error("{quantity} = {got} {unit}: expected {expected}")]
    OutOfRange {
        /// What it is.
        quantity: &'static str,
        /// The number.
        got: f64,
        /// Its unit.
        unit: &'static str,
        /// Its domain.
        expected: &'static str,
    },
}

impl DiffractionError {
    pub(super) fn unusable(origin: &str, reason: impl Into<String>) -> Self {
        Self::Unusable { origin: origin.into(), reason: reason.into() }
    }
}
