//! A scene rendered: the reference, Monte Carlo, every approximation, how they compare, what they
//! cost, and which is the cheapest that will do.

use std::sync::Arc;

use rayon::prelude::*;
use serde::Serialize;

use super::backend::Backend;
use super::compare::error_map::ErrorMap;
use super::compare::metrics::ImageDifference;
use super::error::RenderError;
use super::image::Image;
use super::monte_carlo::{self, Sampled};
use super::prepared::{Metrics, Picture, PreparedScene};
use super::scene::{self, Budget, Method, MonteCarlo, ReferenceMethod};
use super::shading::Details;
use super::tiles::Event;
use super::times::{self, Convergence, EqualError, Times};
use crate::numeric::measured::Measured;

/// Everything that a scene asks for; as JSON its figures.
#[derive(Debug, Clone, Serialize)]
pub struct Rendered {
    /// Name of the scene.
    #[serde(rename = "scene")]
    pub name: String,
    /// The reference, frames beside each other; standard errors beside it if it is Monte Carlo.
    #[serde(skip)]
    pub reference: Image,
    /// How it was made.
    #[serde(rename = "reference")]
    pub method: ReferenceMethod,
    /// Where the kernels ran.
    pub backend: String,
    /// One per approximation of the scene, in its order.
    pub approximations: Vec<RenderedApproximation>,
    /// Monte Carlo, where the scene asks for it.
    pub monte_carlo: Option<RenderedMonteCarlo>,
    /// What a frame costs on the device.
    pub times: Measured<Times>,
    /// The cheapest within the limits of the scene, or why there is none.
    #[serde(rename = "cheapest_within_limits")]
    pub choice: Option<Result<String, String>>,
    /// What only scenes of its material show.
    #[serde(flatten)]
    pub details: Details,
}

/// An approximation, rendered and compared.
#[derive(Debug, Clone, Serialize)]
pub struct RenderedApproximation {
    /// Name.
    pub name: String,
    /// How it shades.
    pub method: Method,
    /// The candidates that it shades with, if any.
    pub shaded_by: Vec<String>,
    /// Its picture, and how that differs from the reference in f64.
    #[serde(skip)]
    pub picture: Arc<Picture>,
    /// How it differs from the reference of the scene.
    #[serde(flatten)]
    pub metrics: Metrics,
    /// Where it errs, relative to the root mean square of the reference, on a scale of its own.
    #[serde(skip)]
    pub error: ErrorMap,
    /// ms of one frame on the device.
    pub frame_ms: Measured<f64>,
    /// ms of all frames.
    pub image_ms: Measured<f64>,
    /// The time in full, without the approximation, over it.
    pub full_over: Measured<f64>,
    /// Monte Carlo at its RMS error.
    pub equal_error: Measured<EqualError>,
    /// What of its budget is exceeded, in words.
    pub over_budget: Vec<String>,
}

/// Monte Carlo, rendered and compared.
#[derive(Debug, Clone, Serialize)]
pub struct RenderedMonteCarlo {
    /// Samples and seed.
    #[serde(flatten)]
    pub options: MonteCarlo,
    /// Its images.
    #[serde(skip)]
    pub sampled: Sampled,
    /// How it differs from the reference, if that is another image.
    #[serde(flatten)]
    pub metrics: Option<Metrics>,
    /// How its error falls against the reference.
    pub convergence: Measured<Convergence>,
    /// ms of all frames with all samples on the device.
    pub image_ms: Measured<f64>,
}

/// Where a scene is rendered, and how long its kernels are timed.
#[derive(Debug, Clone, Copy)]
pub struct RenderOptions<'d> {
    /// Where approximations and Monte Carlo are drawn, and kernels timed if it is a device.
    pub backend: Backend<'d>,
    /// Whether a picture that was drawn on lanes before, for a gate, is not drawn again.
    pub reuse: bool,
    /// Time after which no further round of timing begins, s.
    pub budget_s: f64,
}

impl RenderOptions<'_> {
    /// A picture that is not drawn again.
    fn reused(&self, prepared: &PreparedScene, at: usize) -> Option<Arc<Picture>> {
        self.reuse.then(|| prepared.drawn_on_lanes(at)).flatten()
    }
}

impl<'d> From<Backend<'d>> for RenderOptions<'d> {
    /// Everything drawn there, and timed for 2 s.
    fn from(backend: Backend<'d>) -> Self {
        Self { backend, reuse: false, budget_s: 2.0 }
    }
}

/// Draws the approximations of a scene side by side, so that [`render`] finds them drawn.
///
/// # Errors
/// [`RenderError`] if a form cannot be evaluated, or the device fails.
pub fn draw(prepared: &PreparedScene, options: RenderOptions<'_>) -> Result<(), RenderError> {
    let drawn = (0..prepared.scene.approximations.len()).into_par_iter().map(|at| {
        match options.reused(prepared, at) {
            Some(_) => Ok(()),
            None => prepared.picture(at, options.backend, &mut |_| ()).map(drop),
        }
    });
    drawn.collect::<Vec<_>>().into_iter().collect()
}

/// Renders the reference, Monte Carlo and the approximations of a scene, compares and times them;
/// `watch` sees tiles and images as they are finished.
///
/// # Errors
/// [`RenderError`]: what cannot be made, and [`RenderError::Interrupted`] with what is finished of an
/// image that was cut short.
pub fn render<'d>(
    prepared: &PreparedScene,
    options: impl Into<RenderOptions<'d>>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<Rendered, RenderError> {
    let options = options.into();
    let RenderOptions { backend, budget_s, .. } = options;
    let PreparedScene { scene, shading, .. } = prepared;
    let exposure = scene.view.exposure;
    let exact = match scene.reference {
        ReferenceMethod::MonteCarlo => None,
        _ => {
            let image = prepared.exact(watch)?;
            watch(Event::Image { name: scene::REFERENCE, image, whole: true });
            Some(image)
        }
    };
    let mut sampled = None;
    if let Some(options) = scene.monte_carlo {
        let sampler = shading.sampler(options.seed, backend)?;
        let name = scene::MONTE_CARLO;
        let found = monte_carlo::sampled(name, scene.size(), &sampler, options, watch)?;
        watch(Event::Image { name, image: &found.image, whole: true });
        sampled = Some((options, found));
    }
    let mut pictures = Vec::with_capacity(scene.approximations.len());
    let mut reused = 0;
    for (at, approximation) in scene.approximations.iter().enumerate() {
        let known = options.reused(prepared, at);
        reused += usize::from(known.is_some());
        let picture = known.map_or_else(|| prepared.picture(at, backend, watch), Ok)?;
        watch(Event::Image { name: &approximation.name, image: &picture.image, whole: true });
        pictures.push(picture);
    }
    let times = match backend {
        Backend::Device(device) => {
            let seed = scene.monte_carlo.map(|options| options.seed);
            // The pictures are there: a device that fails now costs the times alone.
            match times::times(device, shading.as_ref(), pictures.len(), seed, budget_s) {
                Ok(times) => Measured::Value(times),
                Err(error) => Measured::NotMeasured(error.to_string()),
            }
        }
        Backend::Lanes => Measured::NotMeasured("kernels are timed on the device".into()),
    };
    let frames = scene.frames() as f64;
    let mut monte_carlo = None;
    if let Some((options, sampled)) = sampled {
        let ms = part(&times, |times| Some(times.sample_ms.clone()));
        monte_carlo = Some(RenderedMonteCarlo {
            options,
            metrics: exact.map(|exact| Metrics::of(&sampled.image, exact, exposure)).transpose()?,
            convergence: convergence(exact, options, &sampled)?,
            image_ms: ms.map(|ms| ms * frames * f64::from(options.samples)),
            sampled,
        });
    }
    let noisy = monte_carlo.as_ref().map(|of| &of.sampled.image);
    let Some(reference) = exact.or(noisy) else {
        let what = "reference.method = \"monte_carlo\" needs a section [monte_carlo]";
        let (path, key) = (scene.origin.clone(), "monte_carlo".into());
        return Err(RenderError::Value { path, key, what: what.into() });
    };
    let law = match &monte_carlo {
        Some(of) => of.convergence.clone(),
        None => Measured::NotMeasured("the scene has no section [monte_carlo]".into()),
    };
    let mut approximations = Vec::with_capacity(pictures.len());
    for (at, (of, picture)) in scene.approximations.iter().zip(pictures).enumerate() {
        let metrics = match exact {
            Some(_) => picture.metrics.clone(),
            None => Metrics::of(&picture.image, reference, exposure)?,
        };
        let budget = scene.budget.get(&of.name).copied().unwrap_or_default();
        let frame_ms = part(&times, |times| times.approximations_ms.get(at).cloned());
        approximations.push(RenderedApproximation {
            name: of.name.clone(),
            method: of.method.clone(),
            error: ErrorMap::relative(&picture.image, reference, None)?,
            shaded_by: of.method.candidates(),
            equal_error: equal_error(&law, &times, &frame_ms, metrics.rms),
            image_ms: frame_ms.map(|ms| ms * frames),
            full_over: part(&times, |times| Some(times.full_over(at))),
            over_budget: budget.exceeded(&of.name, metrics.relative_rms, metrics.flip),
            frame_ms,
            metrics,
            picture,
        });
    }
    Ok(Rendered {
        name: scene.name.clone(),
        choice: scene.choice.as_ref().map(|limits| choice(&approximations, limits)),
        approximations,
        method: scene.reference,
        times,
        details: shading.details()?,
        backend: match reused {
            0 => backend.description(),
            _ => format!(
                "{}; {reused} of {} as gates judged them on {}",
                backend.description(),
                scene.approximations.len(),
                Backend::Lanes.description()
            ),
        },
        reference: reference.clone(),
        monte_carlo,
    })
}

/// A time, or why there is none.
fn part(
    times: &Measured<Times>,
    of: impl FnOnce(&Times) -> Option<Measured<f64>>,
) -> Measured<f64> {
    match times {
        Measured::Value(times) => of(times).unwrap_or(Measured::NotMeasured("not timed".into())),
        Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
    }
}

fn convergence(
    exact: Option<&Image>,
    options: MonteCarlo,
    sampled: &Sampled,
) -> Result<Measured<Convergence>, RenderError> {
    let Some(exact) = exact else {
        return Ok(Measured::NotMeasured("the reference is Monte Carlo itself".into()));
    };
    let rms = |image: &Image| -> Result<f64, RenderError> {
        Ok(ImageDifference::of(image, exact)?.all.rms)
    };
    let samples = [sampled.early_samples, options.samples];
    let errors = [rms(&sampled.early)?, rms(&sampled.image)?];
    Ok(Measured::Value(Convergence::new(samples, errors)))
}

fn equal_error(
    convergence: &Measured<Convergence>,
    times: &Measured<Times>,
    frame_ms: &Measured<f64>,
    rms: f64,
) -> Measured<EqualError> {
    if !(rms.is_finite() && rms > 0.0) {
        return Measured::NotMeasured(format!("Monte Carlo never reaches an RMS error of {rms}"));
    }
    let sample_ms = part(times, |times| Some(times.sample_ms.clone()));
    match (convergence, frame_ms, &sample_ms) {
        (Measured::Value(law), Measured::Value(frame), Measured::Value(sample)) => {
            Measured::Value(law.equal_error(rms, *frame, *sample))
        }
        (Measured::NotMeasured(reason), _, _)
        | (_, Measured::NotMeasured(reason), _)
        | (_, _, Measured::NotMeasured(reason)) => Measured::NotMeasured(reason.clone()),
    }
}

/// The cheapest approximation within `limits`; of those that were not timed the first.
fn choice(approximations: &[RenderedApproximation], limits: &Budget) -> Result<String, String> {
    let within = |a: &&RenderedApproximation| {
        limits.exceeded(&a.name, a.metrics.relative_rms, a.metrics.flip).is_empty()
    };
    let cost = |a: &RenderedApproximation| a.frame_ms.value().copied().unwrap_or(f64::INFINITY);
    let cheapest = approximations
        .iter()
        .filter(within)
        .min_by(|a, b| cost(a).total_cmp(&cost(b)))
        .map(|found| found.name.clone());
    cheapest.ok_or_else(|| "no approximation is within the limits of the scene".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_monte_carlo_never_reaches_has_no_ratio() {
        let law = Measured::Value(Convergence::new([256, 1024], [0.02, 0.01]));
        let times = Measured::Value(Times {
            device: "test".into(),
            approximations_ms: vec![Measured::Value(1.0)],
            full_ms: Measured::Value(4.0),
            sample_ms: Measured::Value(1.0),
        });
        let ratio = |rms| {
            let equal = equal_error(&law, &times, &Measured::Value(1.0), rms);
            equal.value().map(|equal| equal.ratio)
        };
        assert_eq!(ratio(0.01), Some(1024.0));
        assert_eq!((ratio(0.0), ratio(f64::NAN)), (None, None));
        assert_eq!(part(&times, |times| Some(times.full_over(0))), Measured::Value(4.0));
        assert!(part(&times, |times| Some(times.full_over(1))).value().is_none());
    }
}
