//! Rendering: scenes, reference and approximations of them as images, and how images compare.
//!
//! [`Scene::read`] checks a TOML file ([`scene`] documents its keys); [`PreparedScene`] keeps what is
//! made of it once, whoever asks; [`render`] makes the reference, Monte Carlo where it is asked for, and
//! each approximation, compares and times them, and picks the cheapest. What differs from material to
//! material is behind [`Shading`]: [`lobe`] is the lobe of a scratch, [`surface`] a diffraction table
//! under environments. Kernels are forms with the scene around them, run on the device or on the CPU's
//! lanes ([`Backend`]).

mod backend;
pub mod claims;
pub mod compare;
mod error;
pub mod geometry;
pub mod image;
mod lobe;
mod monte_carlo;
pub mod polygon;
mod prepared;
mod rendered;
pub mod scene;
mod scene_file;
mod section;
pub mod shading;
pub mod sheet;
pub mod sphere_map;
pub mod surface;
mod tiles;
pub mod times;
pub mod view;

pub use backend::{Backend, Kernel};
pub use error::RenderError;
pub use monte_carlo::Sampled;
pub use prepared::{Metrics, Picture, PreparedScene, Scenes};
pub use rendered::{RenderOptions, Rendered, RenderedApproximation, RenderedMonteCarlo, render};
pub use scene::Scene;
pub use shading::Shading;
pub use tiles::Event;
