//! Lanes: a compiled form run over many points at once.
//!
//! A chunk of `LANES` points runs through the program together, one instruction at a time, so
//! that decoding an instruction costs little and its arithmetic uses the processor's vectors.
//! Where control flow diverges, execution masks say for which lanes a store takes effect; a block
//! that no lane enters is skipped.

mod control;
mod dual;
mod elementary;
mod evaluate;
mod integer;
mod machine;
mod mask;
mod precision;
mod real;

pub(crate) use evaluate::override_values;
pub use evaluate::{DualEvaluator, Evaluator};
pub(crate) use real::Real;

/// Points per chunk. Registers of this length keep a form of some thirty registers in the
/// first-level cache.
pub(crate) const LANES: usize = 128;

/// A loop that runs more often than this for some lane is an error.
pub const MAX_LOOP_ITERATIONS: u32 = 65_536;

/// An evaluation that spends more than this many instructions on one chunk is an error; an
/// elementary function counts for sixteen. It bounds nested loops: reached in about 0.2 s.
pub const MAX_CHUNK_COST: u64 = 2_000_000;
