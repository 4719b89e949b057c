//! Low-rank factors: against direct reconstruction, on tables of known rank, on hard tables, and
//! what each method promises over the decomposition.

mod align;
mod convolution;
mod decomposition;
mod files;
mod kernels;
mod methods;
mod tables;
mod verb;
#[path = "../project/mod.rs"]
#[allow(dead_code)]
mod project;
