//! What `render` reports: one line per approximation, and Monte Carlo.

use serde::Serialize;

use super::output::{significant, table};
use crate::numeric::measured::Measured;
use crate::render::scene::{ReferenceMethod, Scene};
use crate::render::speed::{Convergence, EqualError, Timings};
use crate::render::{Metrics, RenderedApproximation, RenderedScene};

/// What goes to `scene.json` and, as a table, to stdout.
#[derive(Debug, Serialize)]
pub(super) struct Summary {
    scene: String,
    description: String,
    width: usize,
    height: usize,
    exposure: f64,
    reference: ReferenceMethod,
    backend: String,
    approximations: Vec<Line>,
    monte_carlo: Option<Noise>,
    timings: Measured<Timings>,
}

#[derive(Debug, Serialize)]
struct Line {
    name: String,
    shaded_by: Vec<String>,
    relative_rms: f64,
    rms: f64,
    mean: f64,
    max: f64,
    at: (usize, usize),
    channel: String,
    flip: f64,
    z_test: Option<Judged>,
    image_ms: Measured<f64>,
    equal_error: Measured<EqualError>,
    over_budget: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Noise {
    samples: u32,
    seed: u64,
    relative_rms: Option<f64>,
    z_test: Option<Judged>,
    convergence: Measured<Convergence>,
    image_ms: Measured<f64>,
}

/// The z-test against the noise of a Monte Carlo image.
#[derive(Debug, Serialize)]
struct Judged {
    cells: usize,
    worst_z: f64,
    p: f64,
}

fn judged(metrics: &Metrics) -> Option<Judged> {
    metrics.z_test.as_ref().map(|test| Judged {
        cells: test.cells,
        worst_z: test.worst_z,
        p: test.p,
    })
}

impl Summary {
    /// Of a rendered scene.
    pub(super) fn new(scene: &Scene, rendered: &RenderedScene) -> Self {
        let pixels = (scene.view.width * scene.view.height) as f64;
        let image_ms = |ns: &Measured<f64>| ns.map(|ns| ns * pixels * 1e-6);
        let line = |approximation: &RenderedApproximation| {
            let metrics = &approximation.metrics;
            Line {
                name: approximation.name.clone(),
                shaded_by: approximation.shaded_by.clone(),
                relative_rms: metrics.relative_rms,
                rms: metrics.rms,
                mean: metrics.mean,
                max: metrics.max,
                at: (metrics.at.x, metrics.at.y),
                channel: metrics.at.channel.clone(),
                flip: metrics.flip,
                z_test: judged(metrics),
                image_ms: image_ms(&approximation.pixel_ns),
                equal_error: approximation.equal_error.clone(),
                over_budget: approximation.over_budget(),
            }
        };
        let sample_ns = match &rendered.timings {
            Measured::Value(timings) => timings.sample_ns.clone(),
            Measured::NotMeasured(reason) => Some(Measured::NotMeasured(reason.clone())),
        };
        let monte_carlo = scene.monte_carlo.map(|options| Noise {
            samples: options.samples,
            seed: options.seed,
            relative_rms: rendered.monte_carlo_metrics.as_ref().map(|m| m.relative_rms),
            z_test: rendered.monte_carlo_metrics.as_ref().and_then(judged),
            convergence: rendered.convergence.clone(),
            image_ms: image_ms(
                &sample_ns
                    .unwrap_or(Measured::NotMeasured("not timed".into()))
                    .map(|ns| ns * f64::from(options.samples)),
            ),
        });
        Self {
            scene: scene.name.clone(),
            description: scene.description.clone(),
            width: scene.view.width,
            height: scene.view.height,
            exposure: scene.view.exposure,
            reference: rendered.method,
            backend: rendered.backend.clone(),
            approximations: rendered.approximations.iter().map(line).collect(),
            monte_carlo,
            timings: rendered.timings.clone(),
        }
    }
}

fn figure(value: &Measured<f64>) -> String {
    value.value().map_or("-".to_owned(), |value| significant(*value, 3))
}

/// As text.
pub(super) fn text(summary: &Summary) -> String {
    let mut text = format!(
        "{} ({} x {}), reference by {}, on {}\n",
        summary.scene,
        summary.width,
        summary.height,
        match summary.reference {
            ReferenceMethod::Quadrature => "quadrature",
            ReferenceMethod::MonteCarlo => "Monte Carlo",
        },
        summary.backend
    );
    let header = [
        "approximation",
        "relative RMS",
        "FLIP",
        "max",
        "at",
        "ms",
        "samples at equal error",
        "Monte Carlo time / ours",
    ];
    let rows = summary.approximations.iter().map(|line| {
        let equal = |part: fn(&EqualError) -> f64| figure(&line.equal_error.map(part));
        vec![
            line.name.clone(),
            significant(line.relative_rms, 4),
            significant(line.flip, 4),
            significant(line.max, 4),
            format!("{}, {} {}", line.at.0, line.at.1, line.channel),
            figure(&line.image_ms),
            equal(|e| e.samples),
            equal(|e| e.ratio),
        ]
    });
    text += &table(&header, rows.collect());
    if let Some(noise) = &summary.monte_carlo {
        text += &format!("Monte Carlo, {} samples per pixel and light", noise.samples);
        if let Measured::Value(law) = &noise.convergence {
            let [early, late] = law.rms.map(|rms| significant(rms, 4));
            text += &format!(
                ": RMS error {early} at {} and {late} at {} samples, as N^{:.3}",
                law.samples[0], law.samples[1], law.exponent
            );
        }
        if let Some(test) = &noise.z_test {
            text += &format!(
                "; z-test over {} cells: worst |z| {}, p = {}",
                test.cells,
                significant(test.worst_z.abs(), 3),
                significant(test.p, 3)
            );
        }
        text += &format!("; {} ms\n", figure(&noise.image_ms));
    }
    text
}
