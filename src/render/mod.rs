//! Rendering: scenes, reference and approximations of them as images, and how images compare.
//!
//! [`Scene::read`] checks a TOML file ([`scene`] documents its keys); [`PreparedScene`] keeps what is
//! made of it once, whoever asks; [`render`] makes the reference, Monte Carlo where it is asked for, and
//! each approximation, compares and times them, and picks the cheapest. What differs from material to
//! material is behind [`Shading`]: [`lobe`] is the lobe of a scratch, [`surface`] a diffraction table
//! under environments. Kernels are forms with the scene around them, run on the device or on the CPU's
//! lanes ([`Backend`]).
//!
//! # Example
//!
//! The lobe of a scratch under a sphere, by one slice with the printed Si and with an exact one:
//!
//! ```
//! use striae::project::Project;
//! use striae::registry::Registry;
//! use striae::render::{Backend, PreparedScene, Scene, render};
//!
//! let scene = Scene::parse(
//!     "lobe",
//!     "lobe.toml",
//!     r#"
//!     view = { kind = "equirectangular", width = 8, height = 4 }
//!     geometry = { shape = "point" }
//!     spectrum = { kind = "rgb", wavelengths_nm = [650, 532, 450] }
//!     reference = { method = "quadrature" }
//!     [material]
//!     kind = "scratch"
//!     width_um = 3
//!     depth_um = 0.133
//!     coherence_radius_um = 20
//!     [[light]]
//!     kind = "sphere"
//!     centre = [0.35, 0.1, 1.0]
//!     radius = 0.2
//!     [[approximation]]
//!     name = "printed"
//!     sphere = "area_light/sphere_line_printed"
//!     [[approximation]]
//!     name = "exact_si"
//!     sphere = "area_light/sphere_line_exact_si"
//!     "#,
//! )?;
//! // No fits stand in this folder: the forms have the constants of their texts.
//! let project = Project::at("a/folder/without/fits", Registry::builtin());
//! let prepared = PreparedScene::new(scene, &project)?;
//! let rendered = render(&prepared, Backend::Lanes, &mut |_| ())?;
//! let errors: Vec<f64> = rendered.approximations.iter().map(|a| a.metrics.relative_rms).collect();
//! assert!(errors[0] < 0.03 && errors[1] < 0.002, "{errors:?}");
//! # Ok::<(), striae::render::RenderError>(())
//! ```

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
pub use rendered::{
    RenderOptions, Rendered, RenderedApproximation, RenderedMonteCarlo, draw, render,
};
pub use scene::Scene;
pub use shading::Shading;
pub use tiles::Event;
