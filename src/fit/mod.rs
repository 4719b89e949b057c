//! Fits: a spec (hand-written TOML) and a result (generated JSON).
//!
//! [`run_spec`] is the way in. A spec is resolved to points and target values (`target`),
//! the form to a [`model`] of its free constants, both to a [`problem`] in unbounded variables,
//! which [`solve`] minimises; `statistics`, `round_to_f32` and `residuals` say what the
//! optimum is worth, and [`outcome`] is what is written.
//!
//! # Example
//!
//! A form fitted to a table in memory:
//!
//! ```
//! use striae::fit::outcome::Status;
//! use striae::fit::spec::{FormChoice, Target, Weighting};
//! use striae::fit::{Context, Spec, run_spec};
//! use striae::registry::Registry;
//! use striae::table::{Column, Table};
//!
//! // y = 3 exp(-2 x).
//! let x: Vec<f64> = (0..32).map(|i| f64::from(i) / 16.0).collect();
//! let y = x.iter().map(|x| 3.0 * (-2.0 * x).exp()).collect();
//! let columns = vec![Column::new("x", "1", x), Column::new("y", "1", y)];
//! let table = Table { columns, origin: "decay".into() };
//!
//! let form = FormChoice::Text {
//!     origin: "decay.wgsl".into(),
//!     source: "override height: f32 = 1.0;
//!         override rate: f32 = 1.0;
//!         fn decay(x: f32) -> f32 { return height * exp(-rate * x); }"
//!         .into(),
//!     function: "decay".into(),
//! };
//! let (column, weight) = ("y".into(), Weighting::Equal);
//! let target = Target::Table { label: "decay".into(), table, column, weight };
//!
//! // Relative paths of a spec are looked up below the context's folder; here there are none.
//! let context = Context::new(".", Registry::builtin());
//! let result = run_spec(&Spec::ad_hoc("own/decay", form, target), &context)?;
//! let outcome = &result.outcomes()[0];
//! assert_eq!(outcome.status, Status::Converged);
//! assert!((outcome.parameters["height"].value - 3.0).abs() < 1e-6);
//! assert_eq!(outcome.parameters["rate"].f32, 2.0);
//! # Ok::<(), striae::fit::FitError>(())
//! ```

pub mod error;
pub mod outcome;
pub mod sampling;
pub mod spec;
mod spec_file;
pub mod model;
mod context;
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

pub use context::Context;
pub use error::FitError;
pub use result_file::FitResult;
pub use run::run_spec;
pub use spec::Spec;
