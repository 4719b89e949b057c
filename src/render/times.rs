//! Times of one frame, in one run on one device: of each approximation, of what it approximates, and of
//! Monte Carlo at equal RMS error.
//!
//! Monte Carlo's error falls as N^(−1/2): it is measured at two numbers of samples, the exponent
//! between them is shown, and the number of samples at which its RMS error equals that of an
//! approximation follows from the larger run. Times are those of the kernels, net of an empty loop. A
//! number of samples below one is extrapolated by the same law: no image has so few, and the error of
//! one sample is already the smaller.

use serde::Serialize;

use super::backend::Kernel;
use super::error::RenderError;
use super::scene::SAMPLES_PER_PASS;
use super::shading::Shading;
use crate::form::Input;
use crate::gpu::{self, Device, TimedForm, TimingOptions};
use crate::numeric::measured::Measured;

/// Longest time for a kernel to compile, s: a scene names its forms because it wants them measured,
/// and a driver that is left compiling may not survive the end of the process.
const COMPILE_LIMIT_S: f64 = 60.0;

/// A kernel with the points of one pass over a frame.
#[derive(Debug, Clone)]
pub struct TimedPass {
    /// The kernel.
    pub kernel: Kernel,
    /// Points of the frame, as columns.
    pub inputs: Vec<Vec<f32>>,
    /// Evaluations of the whole pass.
    pub evaluations: usize,
}

/// Milliseconds that the kernels of one frame take.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Times {
    /// The device.
    pub device: String,
    /// Each approximation.
    pub approximations_ms: Vec<Measured<f64>>,
    /// Without an approximation.
    pub full_ms: Measured<f64>,
    /// One sample of Monte Carlo per pixel (and light).
    pub sample_ms: Measured<f64>,
}

impl Times {
    /// The time without an approximation over that of the one at a place.
    pub fn full_over(&self, at: usize) -> Measured<f64> {
        match (&self.full_ms, self.approximations_ms.get(at)) {
            (Measured::Value(full), Some(own)) => own.map(|own| full / own),
            (Measured::Value(_), None) => Measured::NotMeasured("not timed".into()),
            (not_measured, _) => not_measured.clone(),
        }
    }
}

/// Monte Carlo's error at two numbers of samples per pixel and light.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Convergence {
    /// The two numbers.
    pub samples: [u32; 2],
    /// RMS errors against the reference.
    pub rms: [f64; 2],
    /// Exponent of N between them: −1/2 by theory.
    pub exponent: f64,
}

/// What Monte Carlo needs for the error of an approximation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EqualError {
    /// Samples per pixel and light; below one an extrapolation.
    pub samples: f64,
    /// Time of Monte Carlo over that of the approximation.
    pub ratio: f64,
}

impl Convergence {
    /// From the errors of two runs.
    pub fn new(samples: [u32; 2], rms: [f64; 2]) -> Self {
        let exponent =
            (rms[1] / rms[0]).ln() / (f64::from(samples[1]) / f64::from(samples[0])).ln();
        Self { samples, rms, exponent }
    }

    /// Samples at which the error is `rms`, by the law N^(−1/2) from the larger run.
    pub fn samples_for(&self, rms: f64) -> f64 {
        f64::from(self.samples[1]) * (self.rms[1] / rms).powi(2)
    }

    /// Monte Carlo at the error `rms` of an approximation of known cost.
    pub fn equal_error(&self, rms: f64, approximation_ms: f64, sample_ms: f64) -> EqualError {
        let samples = self.samples_for(rms);
        EqualError { samples, ratio: samples * sample_ms / approximation_ms }
    }
}

/// Times `approximations` approximations, what they approximate, and Monte Carlo if it has a seed,
/// interleaved, with rounds for `budget_s` seconds.
///
/// # Errors
/// [`RenderError`] if a kernel cannot be made or the device fails.
pub(super) fn times(
    device: &Device,
    shading: &dyn Shading,
    approximations: usize,
    seed: Option<u64>,
    budget_s: f64,
) -> Result<Times, RenderError> {
    let options = TimingOptions { budget_s, compile_limit_s: COMPILE_LIMIT_S, ..shading.timing() };
    let mut groups =
        (0..approximations).map(|at| shading.timed(at)).collect::<Result<Vec<_>, _>>()?;
    groups.push(shading.timed_in_full()?);
    groups.push(seed.map_or(Ok(Vec::new()), |seed| shading.timed_sampler(seed))?);
    for pass in groups.iter_mut().flatten() {
        thin(&mut pass.inputs, options.points);
    }
    let passes: Vec<&TimedPass> = groups.iter().flatten().collect();
    let inputs: Vec<Vec<Input<'_>>> =
        passes.iter().map(|pass| pass.inputs.iter().map(Input::from).collect()).collect();
    let forms: Vec<TimedForm<'_>> = passes
        .iter()
        .zip(&inputs)
        .map(|(pass, inputs)| TimedForm {
            name: pass.kernel.form.origin(),
            form: &pass.kernel.form,
            parameters: &pass.kernel.constants,
            inputs,
        })
        .collect();
    let mut timings = gpu::time(device, &forms, &options)?.into_iter();
    let mut sums = groups.iter().map(|group| sum_ms(group, timings.by_ref().take(group.len())));
    let approximations_ms = sums
        .by_ref()
        .take(approximations)
        .map(|ms| ms.unwrap_or(Measured::NotMeasured("it has no kernel".into())))
        .collect();
    let mut rest = |why: &str| match sums.next() {
        Some(Some(ms)) => ms,
        _ => Measured::NotMeasured(why.into()),
    };
    Ok(Times {
        device: device.description().to_string(),
        approximations_ms,
        full_ms: rest("nothing is shaded without an approximation on a device"),
        sample_ms: rest("the scene has no section [monte_carlo]")
            .map(|pass| pass / f64::from(SAMPLES_PER_PASS)),
    })
}

/// Points evenly over the frame, more than are timed: `gpu::time` takes a random part of them.
fn thin(columns: &mut [Vec<f32>], points: usize) {
    for column in columns {
        let stride = column.len().div_ceil(16 * points).max(1);
        *column = column.iter().copied().step_by(stride).collect();
    }
}

/// The sum over passes of median times evaluations, if all were measured; none without a pass.
fn sum_ms(
    passes: &[TimedPass],
    timings: impl Iterator<Item = gpu::Timing>,
) -> Option<Measured<f64>> {
    let mut sum = None;
    for (pass, timing) in passes.iter().zip(timings) {
        match timing.cost {
            Measured::Value(found) => {
                let ms = found.net_ns.median * pass.evaluations as f64 * 1e-6;
                sum = Some(sum.unwrap_or(0.0) + ms);
            }
            Measured::NotMeasured(reason) => return Some(Measured::NotMeasured(reason)),
        }
    }
    sum.map(Measured::Value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundredth_of_the_error_takes_ten_thousand_times_the_samples() {
        let law = Convergence::new([256, 1024], [0.02, 0.01]);
        assert!((law.exponent + 0.5).abs() < 1e-12);
        assert!((law.samples_for(1e-4) - 1.024e7).abs() < 1.0);
        let equal = law.equal_error(1e-4, 512.0, 10.0);
        assert!((equal.ratio - 2e5).abs() < 0.1, "{equal:?}");
    }
}
