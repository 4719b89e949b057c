//! Checks of values in a scene, which name the key of what is wrong.

use super::error::RenderError;

/// Checks values and names the key of what is wrong.
pub(super) struct Keys<'a> {
    pub(super) path: &'a str,
}

impl Keys<'_> {
    pub(super) fn wrong(&self, key: impl Into<String>, what: impl Into<String>) -> RenderError {
        RenderError::Value { path: self.path.to_owned(), key: key.into(), what: what.into() }
    }

    /// `value` if it lies in [from, to]; a NaN does not.
    pub(super) fn within(
        &self,
        key: &str,
        value: f64,
        from: f64,
        to: f64,
    ) -> Result<f64, RenderError> {
        if (from..=to).contains(&value) {
            return Ok(value);
        }
        Err(self.wrong(key, format!("expected a number in [{from}, {to}], got {value}")))
    }

    pub(super) fn needed<T>(&self, key: &str, value: Option<T>) -> Result<T, RenderError> {
        value.ok_or_else(|| self.wrong(key, "is needed here and missing"))
    }

    pub(super) fn unwanted<T>(
        &self,
        key: &str,
        value: &Option<T>,
        kind: &str,
    ) -> Result<(), RenderError> {
        match value {
            None => Ok(()),
            Some(_) => Err(self.wrong(key, format!("means nothing with kind = \"{kind}\""))),
        }
    }

    pub(super) fn unknown_kind(&self, key: &str, got: &str, known: &str) -> RenderError {
        self.wrong(key, format!("expected {known}, got \"{got}\""))
    }
}
