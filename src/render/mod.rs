//! Rendering: scenes, reference and approximations of them as images, and how images compare.
//!
//! [`Scene::read`] checks a TOML file ([`scene`] documents its keys); [`render_scene`] makes the
//! reference, Monte Carlo where it is asked for, and each approximation, compares and times them.
//! [`surface`] is the other kind of scene: a surface under an environment, [`AnyScene`] either.
//! The shading kernels are the registered forms themselves with the scene around them ([`kernel`]),
//! run on the device or on the CPU's lanes ([`Backend`]). [`spectrum`] derives what is rendered.

mod any_scene;
mod backend;
pub mod compare;
mod error;
mod exr_file;
pub mod findings;
pub mod illumination;
pub mod image;
mod judged;
pub mod kernel;
pub mod light_form;
mod monte_carlo;
mod png_file;
pub mod polygon;
mod reference;
mod rendered;
pub mod scene;
mod scene_file;
mod scene_keys;
pub mod sheet;
pub mod spectrum;
pub mod speed;
pub mod sphere_map;
pub mod srgb;
pub mod surface;
mod tiles;

pub use any_scene::AnyScene;
pub use backend::Backend;
pub use error::RenderError;
pub use judged::JudgedScene;
pub use monte_carlo::Sampled;
pub use reference::radiance;
pub use rendered::{
    Metrics, RenderedApproximation, RenderedScene, Resources, ShadedBy, approximations,
    render_scene, render_with,
};
pub use scene::Scene;
pub use tiles::Event;
