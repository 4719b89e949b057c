//! A scene with its reference, for judging one approximation at a time.

use std::path::Path;

use crate::measured::spectra::Spectra;

use super::backend::Backend;
use super::error::RenderError;
use super::illumination::Illumination;
use super::image::Image;
use super::kernel;
use super::reference;
use super::rendered::{Metrics, Resources, ShadedBy, approximations, shaded};
use super::scene::Scene;

/// A scene, its semi-analytic reference and the forms that shade it.
#[derive(Debug, Clone)]
pub struct JudgedScene {
    scene: Scene,
    lit: Illumination,
    reference: Image,
    shaded_by: Vec<ShadedBy>,
}

impl JudgedScene {
    /// Reads the scene in `path` and renders its reference, by quadrature whatever the scene says.
    ///
    /// # Errors
    /// [`RenderError`]: what does not load, or a reference without a value.
    pub fn read(path: &Path, resources: Resources<'_>) -> Result<Self, RenderError> {
        let scene = Scene::read(path)?;
        let shaded_by = approximations(&scene, resources.fits)?;
        let lit = Illumination::new(&scene, || Spectra::load(&resources.data.join("spectra")))?;
        let reference = reference::image(&scene, &lit, &mut |_| ())?;
        Ok(Self { scene, lit, reference, shaded_by })
    }

    /// The approximations of the scene, in its order.
    pub fn approximations(&self) -> &[ShadedBy] {
        &self.shaded_by
    }

    /// Number of values that are compared: pixels times channels.
    pub fn values(&self) -> usize {
        self.reference.width * self.reference.height * self.reference.channels.len()
    }

    /// How the picture that `by` makes differs from the reference.
    ///
    /// # Errors
    /// [`RenderError`] if a form cannot be evaluated, or the device fails.
    pub fn metrics(&self, by: &ShadedBy, backend: Backend<'_>) -> Result<Metrics, RenderError> {
        let kernels = kernel::shading(&self.lit, by.sphere.as_ref(), by.polygon.as_ref())?;
        let image = shaded(&by.name, &self.scene, &kernels, backend, &mut |_| ())?;
        Metrics::of(&image, &self.reference, self.scene.view.exposure)
    }
}
