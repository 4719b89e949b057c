//! Fits: a spec (hand-written TOML) and a result (generated JSON).
//!
//! [`run::run_spec`] is the way in. A spec is resolved to points and target values ([`target`]),
//! the form to a [`model`] of its free constants, both to a [`problem`] in unbounded variables,
//! which [`solve`] minimises; [`statistics`], [`round_to_f32`] and [`residuals`] say what the
//! optimum is worth, and [`outcome`] is what is written.

pub mod error;
pub mod outcome;
pub mod sampling;
pub mod spec;
mod spec_file;
pub mod model;
mod inherit;
pub mod loss;
pub mod bounds;
pub mod problem;
pub mod solve;
pub mod statistics;
pub mod residuals;
pub mod round_to_f32;
pub mod target;
pub mod run;
mod assemble;
mod result_file;
mod worth;

pub use error::FitError;
pub use run::{Context, FitResult, run_spec};
pub use spec::Spec;
