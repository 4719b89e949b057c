//! Validation: accuracy on points that were not fitted, laws, parity with the device, and cost.

pub mod accuracy;
pub mod candidates;
pub mod cheapest;
pub mod cost;
pub mod curves;
pub mod family;
pub mod goals;
pub mod laws;
pub mod parity;
pub(crate) mod regions;
pub mod sampling;
pub mod study;

use crate::effect::{CandidateError, ClaimError, DomainError};
use crate::form::FormError;
use crate::gpu::GpuError;

/// Why something could not be validated.
#[derive(Debug, thiserror::Error)]
pub enum ValidateError {
    /// The form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] GpuError),
    /// The reference has no value at a point.
    #[error("reference `{reference}`, row {row}: {source}")]
    Reference {
        /// The reference.
        reference: &'static str,
        /// Row of the points, from 1.
        row: usize,
        /// The fault.
        source: DomainError,
    },
    /// A table lacks a column that a form or reference takes.
    #[error("{table}: no column `{column}`; there are: {}", known.join(", "))]
    MissingColumn {
        /// Origin of the table.
        table: String,
        /// The column.
        column: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// What the effect shows beyond its fits could not be made.
    #[error(transparent)]
    Exhibit(#[from] ClaimError),
    /// There is no candidate where one is needed.
    #[error(transparent)]
    Candidate(#[from] CandidateError),
    /// A form's file cannot be read.
    #[error("form `{name}` is not registered, and no readable file: {source}")]
    UnreadableForm {
        /// Name or path.
        name: String,
        /// The fault.
        source: std::io::Error,
    },
    /// A result lacks a constant of its form.
    #[error(
        "fit `{fit}` has no constant `{constant}`, which its form needs: run `striae fit {fit}`"
    )]
    NoConstant {
        /// The fit.
        fit: String,
        /// The constant.
        constant: String,
    },
    /// A result lacks a member of its family.
    #[error("fit `{fit}` has no member `{member}`: run `striae fit {fit}`")]
    NoMember {
        /// The fit.
        fit: String,
        /// The member.
        member: String,
    },
}
