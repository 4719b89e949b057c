//! striae fits and validates the approximations that real-time renderers use for scratched,
//! glinting and diffractive surfaces, against measured or simulated data.
//!
//! The flow goes one way. Measured data and exact **references** become **tables**; a **form**,
//! an approximation written once as a WGSL function, is **fitted** to a table or a reference; the
//! result is **validated** (accuracy, laws, parity with the device, speed), **reported**, and held
//! by **gates**. The modules stand in the order of that flow: each may use those above it in this
//! list and none below (`tests/architecture.rs` enforces it).
//!
//! | to | begin with | an example that runs |
//! |---|---|---|
//! | load a form | [`form::Form::parse`] | [`form`](form#example) |
//! | fit it | [`fit::run_spec`] | [`fit`](fit#example) |
//! | judge it | [`validate::accuracy::accuracy`], [`validate::laws::judge`] | [`validate`](validate#example) |
//! | hold it to a limit | [`gate::Check::of`] | [`gate`](gate#example) |
//! | add an effect | [`registry::Registry::with_effect`] | `examples/own_effect.rs` |
//!
//! [`run::Run`] does all of it for a [`project::Project`].

pub mod numeric;
pub mod table;
pub mod document;
pub mod measured;
pub mod form;
pub mod gpu;
pub mod counted;
pub mod factor;
pub mod effect;
pub mod effects;
pub mod registry;
pub mod fit;
pub mod project;
pub mod validate;
pub mod render;
pub mod gate;
pub mod report;
pub mod run;
pub mod cli;
