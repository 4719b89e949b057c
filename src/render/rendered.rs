//! A scene rendered: the reference, Monte Carlo, every approximation, and how they compare.

use std::path::Path;

use crate::measured::spectra::Spectra;
use crate::numeric::measured::Measured;

use super::backend::{Backend, Painter};
use super::compare::error_map::ErrorMap;
use super::compare::flip::{STANDARD_PIXELS_PER_DEGREE, ldr_flip};
use super::compare::metrics::{ImageDifference, Place};
use super::compare::z_test::{Pooling, ZTest};
use super::error::RenderError;
use super::illumination::{Illumination, directions};
use super::image::Image;
use super::kernel::{self, Kernel};
use super::light_form::{LightForm, LightKind};
use super::monte_carlo::{self, Sampled};
use super::reference;
use super::scene::{self, Budget, MonteCarlo, ReferenceMethod, Scene};
use super::speed::{self, Convergence, EqualError, Timings};
use super::tiles::{self, Event};

/// Where fits and measured data are found.
#[derive(Debug, Clone, Copy)]
pub struct Resources<'a> {
    /// Folder of the results of fits.
    pub fits: &'a Path,
    /// Folder of measured data, with `spectra/` in it.
    pub data: &'a Path,
}

/// An approximation, ready to shade.
#[derive(Debug, Clone)]
pub struct ShadedBy {
    /// Name in tables and files.
    pub name: String,
    /// The form for spheres, where the scene has one.
    pub sphere: Option<LightForm>,
    /// The form for polygons, where the scene has one.
    pub polygon: Option<LightForm>,
}

/// Everything that a scene asks for.
#[derive(Debug, Clone)]
pub struct RenderedScene {
    /// The reference; standard errors beside it if it is Monte Carlo.
    pub reference: Image,
    /// How it was made.
    pub method: ReferenceMethod,
    /// Monte Carlo, where the scene asks for it.
    pub monte_carlo: Option<Sampled>,
    /// How it differs from the reference, if that is another image.
    pub monte_carlo_metrics: Option<Metrics>,
    /// How Monte Carlo's error falls against a quadrature reference.
    pub convergence: Measured<Convergence>,
    /// One per approximation of the scene, in its order.
    pub approximations: Vec<RenderedApproximation>,
    /// What the kernels cost on the device.
    pub timings: Measured<Timings>,
    /// Where the kernels ran.
    pub backend: String,
}

/// How an image differs from the reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Metrics {
    /// Root mean square error over pixels and channels.
    pub rms: f64,
    /// The same over the root mean square of the reference.
    pub relative_rms: f64,
    /// Mean error: mean of the test image less that of the reference.
    pub mean: f64,
    /// Largest magnitude of the error.
    pub max: f64,
    /// Where that is.
    pub at: Place,
    /// Mean LDR-FLIP at the exposure of the scene.
    pub flip: f64,
    /// Against the noise of a Monte Carlo image, if one of the two is one.
    pub z_test: Option<ZTest>,
}

impl Metrics {
    pub(super) fn of(test: &Image, reference: &Image, exposure: f64) -> Result<Self, RenderError> {
        let difference = ImageDifference::of(test, reference)?;
        let noisy = [test, reference].iter().any(|image| image.standard_error("R").is_some());
        Ok(Self {
            rms: difference.all.rms,
            relative_rms: difference.all.relative_rms,
            mean: difference.all.mean - difference.all.reference_mean,
            max: difference.all.max,
            at: difference.max_place(),
            flip: ldr_flip(test, reference, exposure.log2(), STANDARD_PIXELS_PER_DEGREE)?.mean,
            z_test: noisy.then(|| ZTest::of(test, reference, Pooling::default())).transpose()?,
        })
    }
}

/// An approximation, rendered and compared.
#[derive(Debug, Clone)]
pub struct RenderedApproximation {
    /// Name.
    pub name: String,
    /// The fits or forms that shaded it.
    pub shaded_by: Vec<String>,
    /// Its image.
    pub image: Image,
    /// Where it errs, relative to the root mean square of the reference, on a scale of its own.
    pub error: ErrorMap,
    /// How it differs from the reference.
    pub metrics: Metrics,
    /// ns per pixel on the device.
    pub pixel_ns: Measured<f64>,
    /// Monte Carlo at its RMS error.
    pub equal_error: Measured<EqualError>,
    /// Its budget.
    pub budget: Option<Budget>,
}

impl RenderedApproximation {
    /// What of its budget is exceeded, in words.
    pub fn over_budget(&self) -> Vec<String> {
        over_budget(&self.name, &self.metrics, self.budget.as_ref())
    }
}

/// What of `budget` the picture called `name` exceeds, in words.
pub(super) fn over_budget(name: &str, metrics: &Metrics, budget: Option<&Budget>) -> Vec<String> {
    let Some(budget) = budget else { return Vec::new() };
    let limits = [
        ("relative RMS", metrics.relative_rms, budget.relative_rms),
        ("FLIP", metrics.flip, budget.flip),
    ];
    let over = limits.into_iter().filter_map(|(what, got, limit)| {
        // A NaN exceeds every limit.
        let limit = limit.filter(|limit| got.is_nan() || got > *limit)?;
        Some(format!("{name}: {what} {got:.4e} is over its budget of {limit:e}"))
    });
    over.collect()
}

/// Loads the forms that the approximations of `scene` name.
///
/// # Errors
/// As [`LightForm::load`].
pub fn approximations(scene: &Scene, fits: &Path) -> Result<Vec<ShadedBy>, RenderError> {
    let load = |name: &Option<String>, kind, lit: bool| match name {
        Some(name) if lit => LightForm::load(name, kind, fits).map(Some),
        _ => Ok(None),
    };
    let choices = scene.approximations.iter();
    choices
        .map(|choice| {
            Ok(ShadedBy {
                name: choice.name.clone(),
                sphere: load(&choice.sphere, LightKind::Sphere, scene.has_spheres())?,
                polygon: load(&choice.polygon, LightKind::Polygon, scene.has_polygons())?,
            })
        })
        .collect()
}

/// Renders the reference, Monte Carlo and the approximations of `scene`; `watch` sees tiles and
/// images as they are finished.
///
/// # Errors
/// [`RenderError`]: what does not load, and [`RenderError::Interrupted`] with what is finished of
/// an image that was cut short.
pub fn render_scene(
    scene: &Scene,
    resources: Resources<'_>,
    backend: Backend<'_>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<RenderedScene, RenderError> {
    let shaded_by = approximations(scene, resources.fits)?;
    let lit = Illumination::new(scene, || Spectra::load(&resources.data.join("spectra")))?;
    render_with(scene, &lit, &shaded_by, backend, watch)
}

/// The same with forms that need not be registered.
///
/// # Errors
/// As [`render_scene`].
pub fn render_with(
    scene: &Scene,
    lit: &Illumination,
    shaded_by: &[ShadedBy],
    backend: Backend<'_>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<RenderedScene, RenderError> {
    let kernels: Vec<Vec<Kernel>> = shaded_by
        .iter()
        .map(|by| kernel::shading(lit, by.sphere.as_ref(), by.polygon.as_ref()))
        .collect::<Result<_, _>>()?;
    let draws = match scene.monte_carlo {
        Some(options) => Some((options, monte_carlo::kernels(lit, options.seed)?)),
        None => None,
    };
    let quadrature = match scene.reference {
        ReferenceMethod::Quadrature => {
            Some(finished(scene::REFERENCE, reference::image(scene, lit, watch)?, watch))
        }
        ReferenceMethod::MonteCarlo => None,
    };
    let sampled = match &draws {
        Some((options, kernels)) => {
            let name = scene::MONTE_CARLO;
            let sampled = monte_carlo::sampled(name, scene, kernels, *options, backend, watch)?;
            watch(Event::Image { name, image: &sampled.image, whole: true });
            Some((*options, sampled))
        }
        None => None,
    };
    let mut images = Vec::with_capacity(shaded_by.len());
    for (by, kernels) in shaded_by.iter().zip(&kernels) {
        images.push(finished(&by.name, shaded(&by.name, scene, kernels, backend, watch)?, watch));
    }
    let timings = match backend {
        Backend::Device(device) => {
            let draws = draws.as_ref().map(|(_, kernels)| kernels.as_slice());
            // The pictures are there: a device that fails now costs the timings alone.
            match speed::timings(device, scene, &kernels, draws) {
                Ok(timings) => Measured::Value(timings),
                Err(error) => Measured::NotMeasured(error.to_string()),
            }
        }
        Backend::Lanes => Measured::NotMeasured("kernels are timed on the device".into()),
    };
    let convergence = convergence(quadrature.as_ref(), sampled.as_ref())?;
    let sampled = sampled.map(|(_, sampled)| sampled);
    let exposure = scene.view.exposure;
    let monte_carlo_metrics = match (&quadrature, &sampled) {
        (Some(reference), Some(sampled)) => Some(Metrics::of(&sampled.image, reference, exposure)?),
        _ => None,
    };
    let reference = match (quadrature, &sampled) {
        (Some(image), _) => image,
        (None, Some(sampled)) => sampled.image.clone(),
        // A checked scene has one or the other.
        (None, None) => Image::rgb(scene.view.width, scene.view.height, &[]),
    };
    let mut compared = Vec::with_capacity(images.len());
    for (at, (by, image)) in shaded_by.iter().zip(images).enumerate() {
        let metrics = Metrics::of(&image, &reference, exposure)?;
        let pixel_ns = match &timings {
            Measured::Value(timings) => timings.approximations_ns.get(at).cloned(),
            Measured::NotMeasured(reason) => Some(Measured::NotMeasured(reason.clone())),
        };
        let pixel_ns = pixel_ns.unwrap_or(Measured::NotMeasured("not timed".into()));
        let forms = [&by.sphere, &by.polygon].into_iter().flatten();
        compared.push(RenderedApproximation {
            name: by.name.clone(),
            shaded_by: forms.map(|form| form.name.clone()).collect(),
            error: ErrorMap::relative(&image, &reference, None)?,
            equal_error: equal_error(&convergence, &timings, &pixel_ns, metrics.rms),
            metrics,
            image,
            pixel_ns,
            budget: scene.budget.get(&by.name).copied(),
        });
    }
    Ok(RenderedScene {
        approximations: compared,
        method: scene.reference,
        monte_carlo: sampled,
        monte_carlo_metrics,
        convergence,
        timings,
        backend: backend.description(),
        reference,
    })
}

fn finished(name: &str, image: Image, watch: &mut dyn FnMut(Event<'_>)) -> Image {
    watch(Event::Image { name, image: &image, whole: true });
    image
}

/// The image that the kernels make together.
pub(super) fn shaded(
    name: &str,
    scene: &Scene,
    kernels: &[Kernel],
    backend: Backend<'_>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<Image, RenderError> {
    let painter = Painter::new(kernels, backend)?;
    tiles::image(name, &scene.view, &["R", "G", "B"], watch, |pixels| {
        painter.colours(&directions(&scene.view, scene.scratch.direction_deg, pixels))
    })
}

fn convergence(
    reference: Option<&Image>,
    sampled: Option<&(MonteCarlo, Sampled)>,
) -> Result<Measured<Convergence>, RenderError> {
    let Some((options, sampled)) = sampled else {
        return Ok(Measured::NotMeasured("the scene has no section [monte_carlo]".into()));
    };
    let Some(reference) = reference else {
        return Ok(Measured::NotMeasured("the reference is Monte Carlo itself".into()));
    };
    let rms = |image: &Image| -> Result<f64, RenderError> {
        Ok(ImageDifference::of(image, reference)?.all.rms)
    };
    let samples = [sampled.early_samples, options.samples];
    let errors = [rms(&sampled.early)?, rms(&sampled.image)?];
    Ok(Measured::Value(Convergence::new(samples, errors)))
}

fn equal_error(
    convergence: &Measured<Convergence>,
    timings: &Measured<Timings>,
    pixel_ns: &Measured<f64>,
    rms: f64,
) -> Measured<EqualError> {
    if !(rms.is_finite() && rms > 0.0) {
        return Measured::NotMeasured(format!("Monte Carlo never reaches an RMS error of {rms}"));
    }
    let timings = match timings {
        Measured::Value(timings) => timings,
        Measured::NotMeasured(reason) => return Measured::NotMeasured(reason.clone()),
    };
    match (convergence, pixel_ns, &timings.sample_ns) {
        (Measured::Value(law), Measured::Value(pixel), Some(Measured::Value(sample))) => {
            Measured::Value(law.equal_error(rms, *pixel, *sample))
        }
        (Measured::NotMeasured(reason), _, _)
        | (_, Measured::NotMeasured(reason), _)
        | (_, _, Some(Measured::NotMeasured(reason))) => Measured::NotMeasured(reason.clone()),
        (_, _, None) => Measured::NotMeasured("Monte Carlo was not timed".into()),
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

    #[test]
    fn an_error_that_monte_carlo_never_reaches_has_no_ratio() {
        let law = Measured::Value(Convergence::new([256, 1024], [0.02, 0.01]));
        let timings = Measured::Value(Timings {
            device: "test".into(),
            approximations_ns: vec![Measured::Value(1.0)],
            sample_ns: Some(Measured::Value(1.0)),
        });
        let ratio = |rms| {
            let equal = equal_error(&law, &timings, &Measured::Value(1.0), rms);
            equal.value().map(|equal| equal.ratio)
        };
        assert_eq!(ratio(0.01), Some(1024.0));
        assert_eq!((ratio(0.0), ratio(f64::NAN)), (None, None));
    }
}
