//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod area_light;
pub mod diffraction;
pub mod footprint;
pub mod fresnel;
pub mod scratch_response;
pub mod sine_integral;
