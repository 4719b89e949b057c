//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod area_light;
pub mod diffraction;
pub mod exhibit;
pub mod fitted_form;
pub mod footprint;
pub mod fresnel;
pub mod registry;
pub mod scratch_response;
pub mod simulator;
pub mod sine_integral;
