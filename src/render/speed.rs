//! Time of the closed forms against Monte Carlo at equal RMS error, in one run on one device.
//!
//! Monte Carlo's error falls as N^(−1/2): it is measured at two numbers of samples, the exponent
//! between them is shown, and the number of samples at which its RMS error equals that of an
//! approximation follows from the larger run. Times are those of the kernels, per pixel, net of an
//! empty loop; an image costs that times its pixels. A number of samples below one is extrapolated
//! by the same law: no image has so few, and the error of one sample is already the smaller.

use serde::Serialize;

use crate::form::Input;
use crate::gpu::{self, Device, TimedForm, TimingOptions};
use crate::numeric::measured::Measured;

use super::error::RenderError;
use super::illumination::directions;
use super::kernel::Kernel;
use super::scene::{SAMPLES_PER_PASS, Scene};

/// Points at which kernels are timed.
const POINTS: usize = 2048;
/// Longest time for a kernel to compile, s: a scene names its forms because it wants them measured,
/// and a driver that is left compiling may not survive the end of the process.
const COMPILE_LIMIT_S: f64 = 60.0;

/// Nanoseconds per pixel: of each approximation, and of one sample of Monte Carlo.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Timings {
    /// The device.
    pub device: String,
    /// Each approximation, ns per pixel.
    pub approximations_ns: Vec<Measured<f64>>,
    /// One sample per light, ns per pixel.
    pub sample_ns: Option<Measured<f64>>,
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
    pub fn equal_error(&self, rms: f64, approximation_ns: f64, sample_ns: f64) -> EqualError {
        let samples = self.samples_for(rms);
        EqualError { samples, ratio: samples * sample_ns / approximation_ns }
    }
}

/// Times the kernels of each approximation and those of Monte Carlo together.
///
/// # Errors
/// [`RenderError::Gpu`] if the device fails.
pub(super) fn timings(
    device: &Device,
    scene: &Scene,
    approximations: &[Vec<Kernel>],
    monte_carlo: Option<&[Kernel]>,
) -> Result<Timings, RenderError> {
    let total = scene.view.width * scene.view.height;
    // Every pixel up to a bound, evenly: `gpu::time` takes a random part of them.
    let stride = total.div_ceil(16 * POINTS).max(1);
    let [along, across] = directions(&scene.view, scene.scratch.direction_deg, 0..total);
    let thin = |column: Vec<f32>| column.into_iter().step_by(stride).collect::<Vec<f32>>();
    let (along, across) = (thin(along), thin(across));
    let numbers: Vec<f32> = (0..total).step_by(stride).map(|pixel| pixel as f32).collect();
    let firsts = vec![0.0_f32; along.len()];
    let views = [&along, &across].map(Input::from);
    let draws = [&along, &across, &numbers, &firsts].map(Input::from);
    let groups: Vec<(&[Kernel], &[Input<'_>])> = approximations
        .iter()
        .map(|kernels| (kernels.as_slice(), views.as_slice()))
        .chain(monte_carlo.map(|kernels| (kernels, draws.as_slice())))
        .collect();
    let timed: Vec<TimedForm<'_>> = groups
        .iter()
        .flat_map(|&(kernels, inputs)| {
            kernels.iter().map(move |kernel| TimedForm {
                name: kernel.form.origin(),
                form: &kernel.form,
                parameters: &kernel.constants,
                inputs,
            })
        })
        .collect();
    let options = TimingOptions {
        points: POINTS,
        budget_s: 2.0,
        compile_limit_s: COMPILE_LIMIT_S,
        ..TimingOptions::default()
    };
    let mut measured = gpu::time(device, &timed, &options)?.into_iter();
    let mut sums = groups.iter().map(|(kernels, _)| {
        let parts: Vec<gpu::Timing> = measured.by_ref().take(kernels.len()).collect();
        sum_ns(&parts)
    });
    let approximations_ns = sums.by_ref().take(approximations.len()).collect();
    let sample_ns = sums.next().map(|pass| pass.map(|ns| ns / f64::from(SAMPLES_PER_PASS)));
    Ok(Timings { device: device.description().to_string(), approximations_ns, sample_ns })
}

/// The sum of the medians, if all were measured.
fn sum_ns(timings: &[gpu::Timing]) -> Measured<f64> {
    let mut sum = 0.0;
    for timing in timings {
        match &timing.cost {
            Measured::Value(measurement) => sum += measurement.net_ns.median,
            Measured::NotMeasured(reason) => return Measured::NotMeasured(reason.clone()),
        }
    }
    Measured::Value(sum)
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
