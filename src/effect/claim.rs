//! Claims: what a paper prints, and the check that gives the number of this run.

use serde::{Deserialize, Serialize};

use super::{CandidateError, DomainError};
use crate::form::FormError;
use crate::measured::MeasuredError;

/// The command that shows what a claim of an effect comes to, where there is no narrower one.
pub const REPORT: &str = "striae report";

/// What is found of a claim.
pub type ClaimCheck<E> = fn(&E) -> Result<Found, ClaimError>;

/// What a paper prints, and how it is checked against evidence `E` (the candidates of an effect, a
/// picture of a scene).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub struct Claim<E> {
    /// Short name, by which a scene names the claims it checks.
    pub name: &'static str,
    /// Where it is printed: paper, equation or figure.
    pub place: &'static str,
    /// As printed.
    pub printed: &'static str,
    /// The command that shows it.
    #[serde(default = "report")]
    pub command: &'static str,
    /// What is found in this run.
    #[serde(skip, default = "not_checked")]
    pub check: ClaimCheck<E>,
}

fn report() -> &'static str {
    REPORT
}

/// Of a claim whose text alone is known.
fn not_checked<E>() -> ClaimCheck<E> {
    |_| Err(ClaimError::new("there is no check"))
}

impl<E> Clone for Claim<E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Claim<E> {}

/// What a check finds.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// With numbers of this run.
    pub found: String,
    /// `holds`, `does not hold`, `differs` …
    pub verdict: String,
}

impl Found {
    /// A finding in words, and the verdict.
    pub fn new(found: impl Into<String>, verdict: impl Into<String>) -> Self {
        Self { found: found.into(), verdict: verdict.into() }
    }
}

/// Why a claim could not be checked, or an exhibit not made.
#[derive(Debug, thiserror::Error)]
pub enum ClaimError {
    /// There is no such candidate.
    #[error(transparent)]
    Candidate(#[from] CandidateError),
    /// A form does not evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// A reference has no value at a point.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// Measured data does not load.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// What the effect or the scene itself could not compute.
    #[error(transparent)]
    Other(Box<dyn std::error::Error + Send + Sync>),
}

impl ClaimError {
    /// Wraps the error that kept the check from a number.
    pub fn new(error: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        Self::Other(error.into())
    }
}

/// A claim as printed, beside what is found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Where it is printed: paper, equation or figure.
    pub place: String,
    /// As printed.
    pub printed: String,
    /// What is found, with numbers of this run.
    pub found: String,
    /// `holds`, `does not hold`, `differs` …
    pub verdict: String,
    /// The command that shows it.
    pub command: String,
}

impl Finding {
    /// A claim beside what its check found; one that cannot be checked is `not evaluated`, with the
    /// reason.
    pub fn of(
        place: impl Into<String>,
        printed: impl Into<String>,
        command: impl Into<String>,
        found: Result<Found, ClaimError>,
    ) -> Self {
        let found = found.unwrap_or_else(|error| Found::new(error.to_string(), "not evaluated"));
        Self {
            place: place.into(),
            printed: printed.into(),
            found: found.found,
            verdict: found.verdict,
            command: command.into(),
        }
    }
}

/// Checks every claim.
pub fn check<E>(claims: &[Claim<E>], evidence: &E) -> Vec<Finding> {
    let of = |claim: &Claim<E>| {
        Finding::of(claim.place, claim.printed, claim.command, (claim.check)(evidence))
    };
    claims.iter().map(of).collect()
}
