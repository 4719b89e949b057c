//! Scenes prepared, with their references and pictures, each made once, whoever asks.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use serde::Serialize;

use super::backend::Backend;
use super::compare::flip::{STANDARD_PIXELS_PER_DEGREE, ldr_flip};
use super::compare::metrics::{ImageDifference, Place};
use super::compare::z_test::{Pooling, ZTest};
use super::error::RenderError;
use super::image::Image;
use super::scene::{LightShape, REFERENCE, Scene};
use super::shading::{self, Moved, Shader, Shading};
use super::tiles::{self, Event};
use crate::project::Project;

/// A scene with everything that is made of it once.
#[derive(Debug)]
pub struct PreparedScene {
    /// The scene.
    pub scene: Scene,
    pub(super) shading: Box<dyn Shading>,
    exact: OnceLock<Image>,
    /// By place of the approximation, and whether a device drew it.
    pictures: Mutex<BTreeMap<(usize, bool), Arc<Picture>>>,
}

/// The picture of an approximation.
#[derive(Debug, Clone)]
pub struct Picture {
    /// The image.
    pub image: Image,
    /// How it differs from the reference in f64.
    pub metrics: Metrics,
}

/// How an image differs from the reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// Root mean square error over pixels and channels.
    pub rms: f64,
    /// Root mean square error over the root mean square of the reference.
    pub relative_rms: f64,
    /// Mean error: mean of the test image less that of the reference.
    pub mean: f64,
    /// Largest magnitude of the error.
    pub max: f64,
    /// Column and row of that.
    pub at: (usize, usize),
    /// And its channel.
    pub channel: String,
    /// Mean LDR-FLIP at the exposure of the scene.
    pub flip: f64,
    /// Against the noise of a Monte Carlo image, if one of the two is one.
    pub z_test: Option<ZTest>,
}

impl Metrics {
    /// Of `test` against `reference`, FLIP at `exposure`.
    ///
    /// # Errors
    /// [`RenderError::Compare`] if they do not match.
    pub fn of(test: &Image, reference: &Image, exposure: f64) -> Result<Self, RenderError> {
        let difference = ImageDifference::of(test, reference)?;
        let noisy = [test, reference].iter().any(|image| image.standard_error("R").is_some());
        let Place { x, y, channel } = difference.max_place();
        Ok(Self {
            rms: difference.all.rms,
            relative_rms: difference.all.relative_rms,
            mean: difference.all.mean - difference.all.reference_mean,
            max: difference.all.max,
            at: (x, y),
            channel,
            flip: ldr_flip(test, reference, exposure.log2(), STANDARD_PIXELS_PER_DEGREE)?.mean,
            z_test: noisy.then(|| ZTest::of(test, reference, Pooling::default())).transpose()?,
        })
    }
}

impl Scene {
    /// Width and height of its pictures: a frame per environment beside each other, else one.
    pub fn size(&self) -> [usize; 2] {
        [self.frames() * self.view.width, self.view.height]
    }

    /// Frames of its pictures.
    pub fn frames(&self) -> usize {
        self.environments().count().max(1)
    }

    /// Maps that light a frame each.
    pub fn environments(&self) -> impl Iterator<Item = &str> {
        self.lights.iter().filter_map(|light| match &light.shape {
            LightShape::Environment { map, .. } => Some(map.as_str()),
            LightShape::Sphere { .. } | LightShape::Polygon(_) => None,
        })
    }
}

impl PreparedScene {
    /// Loads and makes what `scene` names of `project`; nothing is rendered.
    ///
    /// # Errors
    /// [`RenderError`]: what does not load or does not suit.
    pub fn new(scene: Scene, project: &Project) -> Result<Self, RenderError> {
        let shading = shading::prepare(&scene, project)?;
        Ok(Self { scene, shading, exact: OnceLock::new(), pictures: Mutex::default() })
    }

    /// The reference in f64, whether or not the scene is compared with Monte Carlo; `watch` sees its
    /// tiles when it is first made.
    ///
    /// # Errors
    /// [`RenderError::Interrupted`] with what is finished, if it has no value at a pixel.
    pub fn exact(&self, watch: &mut dyn FnMut(Event<'_>)) -> Result<&Image, RenderError> {
        if let Some(image) = self.exact.get() {
            return Ok(image);
        }
        let image = self.image(REFERENCE, &self.shading.exact()?, watch)?;
        Ok(self.exact.get_or_init(|| image))
    }

    /// The picture of the approximation at a place of the scene, and how it differs from
    /// [`PreparedScene::exact`]; `watch` sees its tiles when it is first made.
    ///
    /// # Errors
    /// [`RenderError`] if a form cannot be evaluated, or the device fails.
    pub fn picture(
        &self,
        at: usize,
        backend: Backend<'_>,
        watch: &mut dyn FnMut(Event<'_>),
    ) -> Result<Arc<Picture>, RenderError> {
        let key = (at, matches!(backend, Backend::Device(_)));
        if let Some(picture) = self.known(key) {
            return Ok(picture);
        }
        let name = self.scene.approximations.get(at).map_or("", |of| of.name.as_str());
        let image = self.image(name, &self.shading.picture(at, None, backend)?, watch)?;
        let picture = Arc::new(Picture { metrics: self.metrics(&image)?, image });
        let mut pictures = self.pictures.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(Arc::clone(pictures.entry(key).or_insert(picture)))
    }

    /// The picture of the approximation at a place of the scene, if lanes have drawn it already.
    pub fn drawn_on_lanes(&self, at: usize) -> Option<Arc<Picture>> {
        self.known((at, false))
    }

    fn known(&self, key: (usize, bool)) -> Option<Arc<Picture>> {
        let pictures = self.pictures.lock().unwrap_or_else(PoisonError::into_inner);
        pictures.get(&key).map(Arc::clone)
    }

    /// The picture of the approximation at a place with a constant of its forms moved, or all of its values where it has none.
    ///
    /// # Errors
    /// As [`PreparedScene::picture`].
    pub fn moved(
        &self,
        at: usize,
        moved: Moved<'_>,
        backend: Backend<'_>,
    ) -> Result<Picture, RenderError> {
        let image = if self.constants(at).is_empty() {
            let mut image = self.picture(at, backend, &mut |_| ())?.image.clone();
            let values = image.channels.iter_mut().flat_map(|channel| &mut channel.values);
            values.for_each(|value| *value *= (1.0 + moved.step) as f32);
            image
        } else {
            self.image("moved", &self.shading.picture(at, Some(moved), backend)?, &mut |_| ())?
        };
        Ok(Picture { metrics: self.metrics(&image)?, image })
    }

    /// Names of the constants of an approximation.
    pub fn constants(&self, at: usize) -> Vec<String> {
        self.shading.constants(at)
    }

    /// Number of values that are compared: pixels times channels.
    pub fn values(&self) -> usize {
        3 * self.scene.size().iter().product::<usize>()
    }

    fn metrics(&self, image: &Image) -> Result<Metrics, RenderError> {
        Metrics::of(image, self.exact(&mut |_| ())?, self.scene.view.exposure)
    }

    fn image(
        &self,
        name: &str,
        shader: &Shader<'_>,
        watch: &mut dyn FnMut(Event<'_>),
    ) -> Result<Image, RenderError> {
        tiles::image(name, self.scene.size(), &["R", "G", "B"], watch, shader)
    }
}

/// The prepared scenes of a run, by file.
#[derive(Debug, Default)]
pub struct Scenes(Mutex<BTreeMap<PathBuf, Arc<PreparedScene>>>);

impl Scenes {
    /// The scene in the file `path`, prepared when it is first asked for.
    ///
    /// # Errors
    /// As [`Scene::read`] and [`PreparedScene::new`].
    pub fn prepared(
        &self,
        path: &Path,
        project: &Project,
    ) -> Result<Arc<PreparedScene>, RenderError> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(scene) = known().get(path) {
            return Ok(Arc::clone(scene));
        }
        let scene = Arc::new(PreparedScene::new(Scene::read(path)?, project)?);
        Ok(Arc::clone(known().entry(path.to_path_buf()).or_insert(scene)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_error_is_test_less_reference() -> Result<(), RenderError> {
        let image = |value: f32| Image::rgb(2, 2, &[[value; 3]; 4]);
        assert_eq!(Metrics::of(&image(0.5), &image(0.5), 1.0)?.mean, 0.0);
        assert_eq!(Metrics::of(&image(0.5), &image(0.75), 1.0)?.mean, -0.25);
        Ok(())
    }
}
