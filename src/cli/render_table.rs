//! What `render` reports: figures for programs.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::numeric::measured::Measured;
use crate::render::scene::{LightShape, Method, ReferenceMethod, Scene};
use crate::render::times::{Convergence, EqualError, Times};
use crate::render::{Metrics, Rendered, RenderedApproximation};

/// What goes to `scene.json`.
#[derive(Debug, Serialize)]
pub(super) struct Summary<'a> {
    scene: &'a str,
    description: &'a str,
    width: usize,
    height: usize,
    exposure: f64,
    frames: Vec<&'a str>,
    reference: ReferenceMethod,
    backend: &'a str,
    approximations: Vec<Line<'a>>,
    monte_carlo: Option<Noise<'a>>,
    times: &'a Measured<Times>,
    timings: Measured<PerPixel>,
    cheapest_within_limits: Option<&'a Result<String, String>>,
    #[serde(flatten)]
    details: &'a Map<String, Value>,
}

#[derive(Debug, Serialize)]
struct Line<'a> {
    name: &'a str,
    shaded_by: Vec<&'a str>,
    method: &'a Method,
    relative_rms: f64,
    rms: f64,
    mean: f64,
    max: f64,
    at: (usize, usize),
    channel: &'a str,
    flip: f64,
    z_test: Option<Judged>,
    frame_ms: &'a Measured<f64>,
    image_ms: Measured<f64>,
    equal_error: &'a Measured<EqualError>,
    over_budget: &'a [String],
}

#[derive(Debug, Serialize)]
struct Noise<'a> {
    samples: u32,
    seed: u64,
    relative_rms: Option<f64>,
    z_test: Option<Judged>,
    convergence: &'a Measured<Convergence>,
    image_ms: Measured<f64>,
}

/// ns per pixel of the view.
#[derive(Debug, Serialize)]
struct PerPixel {
    device: String,
    approximations_ns: Vec<Measured<f64>>,
    sample_ns: Measured<f64>,
}

/// The z-test against the noise of a Monte Carlo image.
#[derive(Debug, Serialize)]
struct Judged {
    cells: usize,
    worst_z: f64,
    p: f64,
}

fn judged(metrics: &Metrics) -> Option<Judged> {
    let test = metrics.z_test.as_ref();
    test.map(|test| Judged { cells: test.cells, worst_z: test.worst_z, p: test.p })
}

impl<'a> Summary<'a> {
    /// Of a rendered scene.
    pub(super) fn new(scene: &'a Scene, rendered: &'a Rendered) -> Self {
        let frames = scene.frames() as f64;
        let per_pixel = |ms: &Measured<f64>| ms.map(|ms| ms * 1e6 / scene.view.pixels() as f64);
        let line = |found: &'a RenderedApproximation| {
            let metrics = &found.metrics;
            Line {
                name: &found.name,
                shaded_by: match &found.method {
                    Method::Forms { sphere, polygon } => {
                        [sphere, polygon].into_iter().flatten().map(String::as_str).collect()
                    }
                    _ => Vec::new(),
                },
                method: &found.method,
                relative_rms: metrics.relative_rms,
                rms: metrics.rms,
                mean: metrics.mean,
                max: metrics.max,
                at: (metrics.at.x, metrics.at.y),
                channel: &metrics.at.channel,
                flip: metrics.flip,
                z_test: judged(metrics),
                frame_ms: &found.frame_ms,
                image_ms: found.frame_ms.map(|ms| ms * frames),
                equal_error: &found.equal_error,
                over_budget: &found.over_budget,
            }
        };
        let sample_ms = match &rendered.times {
            Measured::Value(times) => times.sample_ms.clone(),
            Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
        };
        let monte_carlo = scene.monte_carlo.map(|options| Noise {
            samples: options.samples,
            seed: options.seed,
            relative_rms: rendered.monte_carlo_metrics.as_ref().map(|m| m.relative_rms),
            z_test: rendered.monte_carlo_metrics.as_ref().and_then(judged),
            convergence: &rendered.convergence,
            image_ms: sample_ms.map(|ms| ms * frames * f64::from(options.samples)),
        });
        let map = |light: &'a crate::render::scene::Light| match &light.shape {
            LightShape::Environment { map, .. } => Some(map.as_str()),
            _ => None,
        };
        Self {
            scene: &scene.name,
            description: &scene.description,
            width: scene.view.width,
            height: scene.view.height,
            exposure: scene.view.exposure,
            frames: scene.lights.iter().filter_map(map).collect(),
            reference: rendered.method,
            backend: &rendered.backend,
            approximations: rendered.approximations.iter().map(line).collect(),
            monte_carlo,
            times: &rendered.times,
            timings: rendered.times.map(|times| PerPixel {
                device: times.device.clone(),
                approximations_ns: times.approximations_ms.iter().map(per_pixel).collect(),
                sample_ns: per_pixel(&times.sample_ms),
            }),
            cheapest_within_limits: rendered.choice.as_ref(),
            details: &rendered.details.figures,
        }
    }
}
