//! Gates: budgets on numbers of a fit, each with the reason for it, in `fits/gates.toml`.
//!
//! A gate names a subject (a fit, a family of fits, one member, a picture), a metric and a limit. It passes
//! only on a number that was measured in this run, on points that were not fitted, with the
//! constants that are committed. Whatever stands in the way of measuring it fails it, except a
//! missing device, which is shown as not measured.

mod annotation;
mod budget;
mod check;
mod committed;
mod domain;
mod drift;
mod error;
mod evidence;
mod file;
mod judge;
mod junit;
mod prove;
mod reproduce;
mod scene;
mod shipped;
mod subject;
mod verdict;

use crate::document::Verdict;

pub use annotation::annotations;
pub use budget::{Gate, Metric, Precision};
pub use check::{Check, Sources};
pub use committed::stands;
pub use domain::Domain;
pub use error::GateError;
pub use evidence::Evidence;
pub use file::{GateFileError, parse, read};
pub use judge::judge;
pub use junit::junit;
pub use prove::{Proof, Proofs, prove};
pub use reproduce::{Refits, Reproduction, refit, reproduce};
pub use scene::SCENES;
pub use shipped::{ShippedConstants, ShippedError};
pub use verdict::{Judgement, Reached};
