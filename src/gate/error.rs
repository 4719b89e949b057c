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
    /// No spec has the name.
    #[error(
        "fits/gates.toml:{line}: gate {gate}, key subject: there is no spec and no form `{subject}`"
    )]
    UnknownSubject {
        /// Position of the gate, from 1.
        gate: usize,
        /// Its line, from 1.
        line: usize,
        /// The subject.
        subject: String,
    },
    /// The fit has no such member.
    #[error(
        "fits/gates.toml:{line}: gate {gate}, key subject: `{subject}` is no member; there are: \
         {known}"
    )]
    UnknownMember {
        /// Position of the gate, from 1.
        gate: usize,
        /// Its line, from 1.
        line: usize,
        /// The subject.
        subject: String,
        /// Labels of the members.
        known: String,
    },
    /// The gate does not fit its subject.
    #[error("fits/gates.toml:{line}: gate {gate} on {subject}: {what}")]
    Mismatch {
        /// Position of the gate, from 1.
        gate: usize,
        /// Its line, from 1.
        line: usize,
        /// The subject.
        subject: String,
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
    /// A [`GateError::Mismatch`] of this gate.
    pub(super) fn fault(&self, what: String) -> GateError {
        GateError::Mismatch {
            gate: self.index,
            line: self.line,
            subject: self.subject.clone(),
            what,
        }
    }
}
