//! Shading: what differs from material to material. Everything else about a scene (tiles, noise,
//! comparison, time, budgets, the choice of the cheapest) is the same for all of them.

use std::fmt::Debug;
use std::ops::Range;

use serde::Serialize;
use serde_json::{Map, Value};

use super::backend::Backend;
use super::error::RenderError;
use super::geometry::Shape;
use super::lobe::Lobe;
use super::scene::{Material, Scene};
use super::surface::Surface;
use super::times::TimedPass;
use super::view::Projection;
use crate::document::Block;
use crate::gpu::TimingOptions;
use crate::project::Project;

/// R, G, B of some pixels.
pub type Columns = Vec<Vec<f32>>;

/// Colours as columns R, G, B.
pub(super) fn rgb_columns(colours: &[[f64; 3]]) -> Columns {
    let channel = |at: usize| colours.iter().map(|rgb| rgb[at] as f32).collect();
    (0..3).map(channel).collect()
}

/// Shades pixels of the picture, counted row by row. A pixel does not depend on its neighbours.
pub type Shader<'a> = Box<dyn Fn(Range<usize>) -> Result<Columns, RenderError> + 'a>;

/// One pass of Monte Carlo over pixels of the picture, from the sample with this number on.
pub type Sampler<'a> = Box<dyn Fn(Range<usize>, u32) -> Result<Columns, RenderError> + 'a>;

/// A constant moved from what ships, to see what notices.
#[derive(Debug, Clone, Copy)]
pub struct Moved<'a> {
    /// Its name, in whichever form has it.
    pub constant: &'a str,
    /// Relative step; from 0 the step itself.
    pub step: f64,
}

/// What only scenes of one material show.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Details {
    /// For readers.
    #[serde(skip)]
    pub blocks: Vec<Block>,
    /// For programs, by name.
    #[serde(flatten)]
    pub figures: Map<String, Value>,
}

/// A material seen and lit as a scene has it, ready to shade. Approximations are told by their place in
/// the scene.
pub trait Shading: Debug + Send + Sync {
    /// The reference in f64, on the CPU: Monte Carlo excepted, by the method of the scene.
    ///
    /// # Errors
    /// [`RenderError`] if what it needs cannot be made.
    fn exact(&self) -> Result<Shader<'_>, RenderError>;

    /// An approximation, with a constant moved if one is given.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile or what it needs cannot be made.
    fn picture<'a>(
        &'a self,
        at: usize,
        moved: Option<Moved<'_>>,
        backend: Backend<'a>,
    ) -> Result<Shader<'a>, RenderError>;

    /// Passes of Monte Carlo.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile.
    fn sampler<'a>(&'a self, seed: u64, backend: Backend<'a>) -> Result<Sampler<'a>, RenderError>;

    /// Names of the constants of an approximation that can be moved.
    fn constants(&self, _at: usize) -> Vec<String> {
        Vec::new()
    }

    /// The kernels that one frame of an approximation costs.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel cannot be made.
    fn timed(&self, at: usize) -> Result<Vec<TimedPass>, RenderError>;

    /// The kernels that one frame costs without an approximation; none where no device does that.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel cannot be made.
    fn timed_in_full(&self) -> Result<Vec<TimedPass>, RenderError> {
        Ok(Vec::new())
    }

    /// The kernels of one pass of Monte Carlo over one frame.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel cannot be made.
    fn timed_sampler(&self, seed: u64) -> Result<Vec<TimedPass>, RenderError>;

    /// How its kernels are timed.
    fn timing(&self) -> TimingOptions;

    /// What only its scenes show.
    ///
    /// # Errors
    /// [`RenderError`] if it cannot be measured.
    fn details(&self) -> Result<Details, RenderError> {
        Ok(Details::default())
    }
}

/// Loads and makes what the material of `scene` needs.
///
/// # Errors
/// [`RenderError`]: what does not load or does not suit; [`RenderError::Value`] for view, geometry and
/// material that are not of one kind of scene.
pub fn prepare(scene: &Scene, project: &Project) -> Result<Box<dyn Shading>, RenderError> {
    match (&scene.material, scene.geometry.shape, scene.view.projection) {
        (Material::Scratch(scratch, spectrum), Shape::Point { direction_deg }, _) => {
            Ok(Box::new(Lobe::prepare(scene, (scratch, spectrum), direction_deg, project)?))
        }
        (Material::Diffraction(surface, convolution), _, Projection::Camera(camera)) => {
            Ok(Box::new(Surface::prepare(scene, (surface, *convolution), &camera, project)?))
        }
        _ => Err(RenderError::Value {
            path: scene.origin.clone(),
            key: "material".into(),
            what: "nothing shades it with this view and geometry".into(),
        }),
    }
}
