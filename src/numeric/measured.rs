//! A figure that may not have been measured, with the reason.

use serde::{Deserialize, Serialize};

/// A measured figure, or why there is none. It is never a default and never counts as a pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measured<T> {
    /// The figure.
    Value(T),
    /// Why it was not measured.
    NotMeasured(String),
}

impl<T> Measured<T> {
    /// The figure, if there is one.
    pub fn value(&self) -> Option<&T> {
        match self {
            Self::Value(value) => Some(value),
            Self::NotMeasured(_) => None,
        }
    }

    /// This figure replaced by one of its parts, or the reason why there is none.
    pub fn map<U>(&self, part: impl FnOnce(&T) -> U) -> Measured<U> {
        match self {
            Self::Value(value) => Measured::Value(part(value)),
            Self::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
        }
    }
}
