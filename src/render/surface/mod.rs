//! Surfaces under an environment: a camera, a shape with a field of tangents, a diffraction table for
//! a material, and the ways to convolve the environment with it.
//!
//! [`Camera`] and [`Shape`] know nothing of diffraction: a shape gives a [`Point`] per pixel, a plan
//! of a method ([`Plan`]) turns points and maps into colours. Another shape, light or shading model
//! joins there.

mod angles;
mod camera;
pub mod findings;
mod integral;
mod material;
mod methods;
mod rendered;
pub mod scene;
mod scene_file;
mod shape;
mod speed;
mod sums;

pub use angles::AngleError;
pub use camera::Camera;
pub use integral::integrals;
pub use material::Material;
pub use methods::{Plan, Surroundings};
pub use rendered::{PreparedSurface, RenderedSurface, SurfaceApproximation, render_surface};
pub use scene::SurfaceScene;
pub use shape::{Frame, Point, Shape};
pub use speed::ConvolutionTimes;
pub use sums::{line_taps, surface_sums, table_taps};
