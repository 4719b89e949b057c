//! What convolutions cost, in one run on one device.

use serde::Serialize;

use crate::form::Input;
use crate::gpu::{self, Device, TimedForm, TimingOptions};
use crate::numeric::measured::Measured;
use crate::render::RenderError;
use crate::render::sphere_map::TimedPass;

/// Points at which passes are timed: each may take a thousand taps.
const POINTS: usize = 256;
/// Longest time for a kernel to compile, s.
const COMPILE_LIMIT_S: f64 = 60.0;

/// Milliseconds of the convolution of one frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConvolutionTimes {
    /// The device.
    pub device: String,
    /// Of each approximation.
    pub approximations_ms: Vec<Measured<f64>>,
    /// Of the sum over the whole table at every texel or point.
    pub full_ms: Measured<f64>,
}

/// Times the passes of all approximations, and those of the whole table, interleaved.
///
/// # Errors
/// [`RenderError::Gpu`] if the device fails.
pub(super) fn times(
    device: &Device,
    approximations: &[Vec<TimedPass>],
    full: &[TimedPass],
) -> Result<ConvolutionTimes, RenderError> {
    let groups: Vec<&[TimedPass]> =
        approximations.iter().map(Vec::as_slice).chain([full]).collect();
    let inputs: Vec<Vec<Vec<f32>>> =
        groups.iter().flat_map(|group| group.iter().map(thinned)).collect();
    let columns: Vec<Vec<Input<'_>>> =
        inputs.iter().map(|pass| pass.iter().map(Input::from).collect()).collect();
    let forms: Vec<TimedForm<'_>> = groups
        .iter()
        .flat_map(|group| group.iter())
        .zip(&columns)
        .map(|(pass, inputs)| TimedForm {
            name: pass.kernel.form.origin(),
            form: &pass.kernel.form,
            parameters: &pass.kernel.constants,
            inputs,
        })
        .collect();
    let options = TimingOptions {
        points: POINTS,
        repeats: 1,
        budget_s: 2.0,
        compile_limit_s: COMPILE_LIMIT_S,
        ..TimingOptions::default()
    };
    let mut timings = gpu::time(device, &forms, &options)?.into_iter();
    let mut sums = groups.iter().map(|group| {
        let mut ms = 0.0;
        for (pass, timing) in group.iter().zip(timings.by_ref().take(group.len())) {
            match &timing.cost {
                Measured::Value(found) => {
                    ms += found.net_ns.median * pass.evaluations as f64 * 1e-6;
                }
                Measured::NotMeasured(reason) => {
                    return Measured::NotMeasured(reason.clone());
                }
            }
        }
        Measured::Value(ms)
    });
    let approximations_ms = sums.by_ref().take(approximations.len()).collect();
    let full_ms = sums.next().unwrap_or(Measured::NotMeasured("not timed".into()));
    Ok(ConvolutionTimes { device: device.description().to_string(), approximations_ms, full_ms })
}

/// Some of the points, evenly.
fn thinned(pass: &TimedPass) -> Vec<Vec<f32>> {
    let rows = pass.inputs.first().map_or(0, Vec::len);
    let stride = rows.div_ceil(4 * POINTS).max(1);
    pass.inputs.iter().map(|column| column.iter().copied().step_by(stride).collect()).collect()
}
