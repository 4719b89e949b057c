//! Why gates could not be judged at all, as opposed to failing.

use super::{Gate, GateFileError};
use crate::effect::FamilyError;
use crate::fit::FitError;
use crate::project::ProjectError;
use crate::render::RenderError;
use crate::table::TableError;
use crate::validate::ValidateError;

/// Why gates could not be judged. None of these is ever a pass.
#[derive(Debug, thiserror::Error)]
pub enum GateError {
    /// The gate file is unusable.
    #[error(transparent)]
    File(#[from] GateFileError),
    /// The gate does not fit its subject, or there is no such subject.
    #[error("fits/gates.toml:{line}: gate {gate}{of}: {what}")]
    Mismatch {
        /// Position of the gate, from 1.
        gate: usize,
        /// Its line, from 1.
        line: usize,
        /// ` on subject`, or `, key subject` where it is the subject that is wrong.
        of: String,
        /// Expected and got.
        what: String,
    },
    /// A spec or a result is unusable.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Something of the project could not be had.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// A form or a reference could not be evaluated, or the device failed.
    #[error(transparent)]
    Validate(Box<ValidateError>),
    /// A scene is unusable, or cannot be rendered.
    #[error("{0}")]
    Render(#[source] Box<RenderError>),
    /// A table is unusable.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A family could not be made.
    #[error(transparent)]
    Family(#[from] FamilyError),
}

impl From<ValidateError> for GateError {
    fn from(error: ValidateError) -> Self {
        Self::Validate(Box::new(error))
    }
}

impl From<RenderError> for GateError {
    fn from(error: RenderError) -> Self {
        Self::Render(Box::new(error))
    }
}

impl Gate {
    /// That the gate does not fit its subject.
    pub(super) fn fault(&self, what: String) -> GateError {
        let of = format!(" on {}", self.subject);
        GateError::Mismatch { gate: self.index, line: self.line, of, what }
    }

    /// That there is no such subject.
    pub(super) fn unknown(&self, what: String) -> GateError {
        let of = ", key subject".to_owned();
        GateError::Mismatch { gate: self.index, line: self.line, of, what }
    }

    /// That the subject has no such member.
    pub(super) fn no_member(&self, known: &str) -> GateError {
        self.unknown(format!("`{}` is no member; there are: {known}", self.subject))
    }
}
