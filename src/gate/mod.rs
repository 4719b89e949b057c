//! Gates: budgets on numbers of a fit, each with the reason for it, in `fits/gates.toml`.
//!
//! A gate names a subject (a fit, a family of fits, one member, a picture), a metric and a limit. It passes
//! only on a number that was measured in this run, on points that were not fitted, with the
//! constants that are committed. Whatever stands in the way of measuring it fails it, except a
//! missing device, which is shown as not measured.
//!
//! # Example
//!
//! ```
//! use striae::counted::Counter;
//! use striae::document::Verdict;
//! use striae::fit::Context;
//! use striae::gate::{self, Check, Sources};
//! use striae::numeric::measured::Measured;
//! use striae::project::Project;
//! use striae::registry::Registry;
//! use striae::render::Scenes;
//! use striae::validate::regions::Atlas;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let gates = gate::parse(
//!     "gates.toml",
//!     r#"[[gate]]
//!     subject = "sine_integral/published"
//!     metric = "max_abs"
//!     domain = "[-10, 10]"
//!     limit = 0.05105
//!     why = "velinov2018 eq. 29 and fig. 7"
//!
//!     [[gate]]
//!     subject = "sine_integral/published"
//!     metric = "max_abs"
//!     domain = "[-10, 10]"
//!     limit = 0.05
//!     why = "less than eq. 29 reaches: it fails"
//!     "#,
//! )?;
//! // No spec stands in this folder, so that the form is judged as printed.
//! let project = Project::at("a/folder/without/specs", Registry::builtin());
//! let (atlas, scenes) = (Atlas::default(), Scenes::default());
//! let fits = Context::new(project.root(), project.registry());
//! let counter = Counter::default();
//! let (project, scenes, fits, counter) = (&project, &scenes, &fits, &counter);
//! let sources = Sources { project, atlas: &atlas, scenes, fits, counter };
//! let device = Measured::NotMeasured("no gate needs a device".to_owned());
//! let check = Check::of(sources, &gates, &[], &device, false)?;
//! let verdicts: Vec<Verdict> = check.gates.iter().map(|gate| gate.verdict).collect();
//! assert_eq!(verdicts, [Verdict::Pass, Verdict::Fail]);
//! assert!(!check.passed());
//! # Ok(())
//! # }
//! ```

mod annotation;
mod budget;
mod check;
mod cost;
mod domain;
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
pub use domain::Domain;
pub use error::GateError;
use evidence::Evidence;
pub use file::{GateFileError, parse, read};
use judge::judge;
pub use junit::junit;
use prove::prove;
pub use prove::{Proof, Proofs};
use reproduce::{Refits, refit};
pub use reproduce::{Reproduction, stands};
pub use scene::SCENES;
use shipped::ShippedConstants;
pub use verdict::{Judgement, Reached};
