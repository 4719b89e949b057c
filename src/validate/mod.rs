//! Validation: accuracy on points that were not fitted, laws, parity with the device, and cost.
//!
//! # Example
//!
//! A registered form, judged in a region of its effect and by the effect's laws:
//!
//! ```
//! use striae::numeric::measured::Measured;
//! use striae::registry::Registry;
//! use striae::validate::accuracy::{GroundTruth, accuracy};
//! use striae::validate::laws::{LawStanding, judge};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let registry = Registry::builtin();
//! let published = registry.form("sine_integral/published").ok_or("no form")?.written()?;
//! let (effect, reference) = registry.reference("sine_integral").ok_or("no reference")?;
//!
//! let near = effect.regions.iter().find(|region| region.name == "[-10, 10]").ok_or("no region")?;
//! let target = GroundTruth::of_reference(reference, (near.points)(), &published.form)?;
//! let without = Measured::NotMeasured("no device was asked for".to_owned());
//! let found = accuracy(&published, &target, &without)?;
//! assert!((0.0509..0.0511).contains(&found.f32.max_abs), "velinov2018 fig. 7: {:?}", found.f32);
//!
//! let verdicts = judge(effect, "sine_integral/published", "sine_integral", &published);
//! let odd = verdicts.iter().find(|verdict| verdict.law == "odd").ok_or("no law")?;
//! assert_eq!(odd.verdict, LawStanding::Holds);
//! # Ok(())
//! # }
//! ```
//!
//! [`study::study`] does all of it for every candidate of an effect.

pub mod accuracy;
pub mod cost;
pub mod curves;
pub mod draws;
pub mod family;
pub mod laws;
pub mod parity;
pub mod regions;
pub mod sampling;
pub mod standing;
pub mod study;
pub mod timed;

use crate::effect::{CandidateError, ClaimError};
use crate::form::FormError;
use crate::gpu::GpuError;
use crate::project::ProjectError;

/// Why something could not be validated.
#[derive(Debug, thiserror::Error)]
pub enum ValidateError {
    /// The form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] GpuError),
    /// What cannot be judged: a reference outside its domain, a table without a column that a form or
    /// reference takes, a form that returns another number of values than its reference.
    #[error("{origin}: {what}")]
    Unusable {
        /// Reference and row, table or form.
        origin: String,
        /// Expected and got.
        what: String,
    },
    /// What the effect shows beyond its fits could not be made.
    #[error(transparent)]
    Exhibit(#[from] ClaimError),
    /// There is no candidate where one is needed.
    #[error(transparent)]
    Candidate(#[from] CandidateError),
    /// What a project names could not be had.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// A result lacks a member of its family.
    #[error("fit `{fit}` has no member `{member}`: run `striae fit {fit}`")]
    NoMember {
        /// The fit.
        fit: String,
        /// The member.
        member: String,
    },
}
