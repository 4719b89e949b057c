//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod exhibit;
pub mod fresnel;
pub mod registry;
pub mod sine_integral;
