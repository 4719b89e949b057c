//! The lobe of a scratch at a point, over directions of view: forms shade spheres and polygons,
//! wavelength by wavelength.

mod illumination;
mod kernel;
mod sampling;
mod spectrum;
mod suited;

use std::ops::Range;

use illumination::Illumination;
pub(super) use illumination::turned;
use suited::LightKind;

use super::backend::{Backend, Kernel, Painter};
use super::error::RenderError;
use super::scene::{Method, Scene, Scratch, Spectrum};
use super::shading::{Moved, Sampler, Shader, Shading};
use super::times::TimedPass;
use crate::effect::Candidate;
use crate::gpu::TimingOptions;
use crate::project::Project;

/// A scratch under its lights, with the directions of view of every pixel.
#[derive(Debug)]
pub(super) struct Lobe {
    lit: Illumination,
    views: [Vec<f32>; 2],
    approximations: Vec<Forms>,
}

/// The candidates of an approximation, by the lights that they shade.
#[derive(Debug, Clone)]
struct Forms(Vec<(LightKind, Candidate)>);

impl Lobe {
    /// Loads what `scene` names for a scratch with the azimuth `direction_deg`.
    ///
    /// # Errors
    /// [`RenderError`]: candidates that are not there or do not suit their light, spectra that do not
    /// load.
    pub(super) fn prepare(
        scene: &Scene,
        (scratch, spectrum): (&Scratch, &Spectrum),
        direction_deg: f64,
        project: &Project,
    ) -> Result<Self, RenderError> {
        let approximations = scene.approximations.iter().map(|of| Forms::load(&of.method, project));
        let approximations = approximations.collect::<Result<_, _>>()?;
        let waves = spectrum::waves(scratch, spectrum, &project.data().join("spectra"))?;
        Ok(Self {
            lit: Illumination::new(scene, direction_deg, waves)?,
            views: scene.view.directions(direction_deg, 0..scene.view.pixels()),
            approximations,
        })
    }

    fn at(&self, pixels: Range<usize>) -> Vec<Vec<f32>> {
        let part = |column: &Vec<f32>| column.get(pixels.clone()).unwrap_or_default().to_vec();
        self.views.iter().map(part).collect()
    }

    fn forms(&self, at: usize) -> Result<&Forms, RenderError> {
        self.approximations.get(at).ok_or_else(|| RenderError::no_approximation(at))
    }

    /// Directions of view, numbers of pixels, and the first sample.
    fn draws(&self, pixels: Range<usize>, first: u32) -> Vec<Vec<f32>> {
        let mut inputs = self.at(pixels.clone());
        inputs.push(pixels.clone().map(|pixel| pixel as f32).collect());
        inputs.push(vec![first as f32; pixels.len()]);
        inputs
    }

    fn timed(&self, kernels: Vec<Kernel>, inputs: &[Vec<f32>]) -> Vec<TimedPass> {
        let evaluations = self.views[0].len();
        let pass = |kernel| TimedPass { kernel, inputs: inputs.to_vec(), evaluations };
        kernels.into_iter().map(pass).collect()
    }

    fn pixels(&self) -> Range<usize> {
        0..self.views[0].len()
    }
}

impl Forms {
    fn load(method: &Method, project: &Project) -> Result<Self, RenderError> {
        let Method::Forms { sphere, polygon } = method else { return Ok(Self(Vec::new())) };
        let mut forms = Vec::new();
        for (kind, name) in [(LightKind::Sphere, sphere), (LightKind::Polygon, polygon)] {
            let Some(name) = name else { continue };
            let found = project.candidate(name);
            let found = found.map_err(|error| kind.unsuited(name, &error.to_string()))?;
            kind.suits(&found)?;
            forms.push((kind, found));
        }
        Ok(Self(forms))
    }

    fn of(&self, kind: LightKind) -> Option<&Candidate> {
        self.0.iter().find(|(of, _)| *of == kind).map(|(_, candidate)| candidate)
    }

    /// The same with a constant moved wherever it is.
    fn moved(&self, by: Moved<'_>) -> Self {
        let mut forms = self.clone();
        for (_, form) in &mut forms.0 {
            let parameters = form.form.parameters().iter().zip(&mut form.constants_f32);
            for (_, value) in parameters.filter(|(parameter, _)| parameter.name == by.constant) {
                let wide = f64::from(*value);
                *value = (if wide == 0.0 { by.step } else { wide * (1.0 + by.step) }) as f32;
            }
        }
        forms
    }
}

impl Shading for Lobe {
    fn exact(&self) -> Result<Shader<'_>, RenderError> {
        Ok(Box::new(|pixels| self.lit.colours(&self.at(pixels))))
    }

    fn picture<'a>(
        &'a self,
        at: usize,
        moved: Option<Moved<'_>>,
        backend: Backend<'a>,
    ) -> Result<Shader<'a>, RenderError> {
        let forms = self.forms(at)?;
        let forms = moved.map_or_else(|| forms.clone(), |moved| forms.moved(moved));
        let painter = Painter::new(kernel::shading(&self.lit, &forms)?, backend)?;
        Ok(Box::new(move |pixels| painter.colours(&self.at(pixels))))
    }

    fn sampler<'a>(&'a self, seed: u64, backend: Backend<'a>) -> Result<Sampler<'a>, RenderError> {
        let painter = Painter::new(sampling::kernels(&self.lit, seed)?, backend)?;
        Ok(Box::new(move |pixels, first| painter.colours(&self.draws(pixels, first))))
    }

    fn constants(&self, at: usize) -> Vec<String> {
        let Ok(forms) = self.forms(at) else { return Vec::new() };
        let mut names: Vec<String> = Vec::new();
        for parameter in forms.0.iter().flat_map(|(_, of)| of.form.parameters()) {
            if !names.contains(&parameter.name) {
                names.push(parameter.name.clone());
            }
        }
        names
    }

    fn timed(&self, at: usize) -> Result<Vec<TimedPass>, RenderError> {
        let kernels = kernel::shading(&self.lit, self.forms(at)?)?;
        Ok(self.timed(kernels, &self.at(self.pixels())))
    }

    fn timed_sampler(&self, seed: u64) -> Result<Vec<TimedPass>, RenderError> {
        let kernels = sampling::kernels(&self.lit, seed)?;
        Ok(self.timed(kernels, &self.draws(self.pixels(), 0)))
    }

    fn timing(&self) -> TimingOptions {
        TimingOptions { points: 1024, ..TimingOptions::default() }
    }
}
