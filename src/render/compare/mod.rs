//! How images compare: errors ([`metrics`]), what an observer sees of them ([`flip`]), whether the
//! noise explains them ([`z_test`]), and pictures of them ([`error_map`]); and how tables do
//! ([`columns`]).

mod colour_difference;
mod colour_map;
mod convolution;
mod error;
mod exposures;
mod legend;
pub mod columns;
pub mod error_map;
pub mod flip;
pub mod metrics;
pub mod z_test;

pub use error::CompareError;
pub use exposures::{ExposureRule, Exposures};
