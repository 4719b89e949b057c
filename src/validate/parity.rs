//! Parity: does the device return what f32 lanes return?
//!
//! The lanes round every elementary function correctly; WGSL grants the device a bound per
//! built-in (gpuweb/gpuweb, "Floating point accuracy"). What is reported is the distance in units
//! in the last place, so that a driver that takes more than its share stands out.

use serde::{Deserialize, Serialize};

use crate::effect::Candidate;
use crate::gpu::DeviceKernel;
use crate::numeric::ulp::ulp_distance_f32;
use crate::validate::ValidateError;
use crate::validate::accuracy::{GroundTruth, kernel_values, values_f32};

/// Upper ends of the histogram's bins, in units in the last place; the last bin is open.
pub const BINS: [u64; 8] = [0, 1, 2, 4, 16, 256, 65_536, u64::MAX];

/// Distance between the device and the f32 lanes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parity {
    /// Fit compared.
    pub name: String,
    /// Points compared.
    pub count: usize,
    /// Points per bin of [`BINS`].
    pub histogram: [usize; BINS.len()],
    /// Largest distance, in units in the last place of the lanes' value.
    pub max_ulp: u64,
    /// Arguments where that is.
    pub max_ulp_at: Vec<f64>,
    /// Largest absolute difference, in the form's unit.
    pub max_abs: f64,
    /// Points where exactly one of the two is not a number.
    pub nan_mismatches: usize,
}

/// Compares the form compiled for a device with the f32 lanes at the target's points.
///
/// # Errors
/// If the form cannot be evaluated, or the device fails.
pub fn parity(
    candidate: &Candidate,
    target: &GroundTruth,
    kernel: &DeviceKernel<'_>,
) -> Result<Parity, ValidateError> {
    let lanes = values_f32(candidate, target)?;
    let on_device = kernel_values(kernel, target)?;
    let mut found = Parity {
        name: candidate.name.clone(),
        count: lanes.len(),
        histogram: [0; BINS.len()],
        max_ulp: 0,
        max_ulp_at: Vec::new(),
        max_abs: 0.0,
        nan_mismatches: 0,
    };
    for (row, (lane, device)) in lanes.iter().zip(&on_device).enumerate() {
        if lane.is_nan() || device.is_nan() {
            found.nan_mismatches += usize::from(lane.is_nan() != device.is_nan());
            continue;
        }
        let distance = u64::from(ulp_distance_f32(*lane, *device));
        let bin = BINS.iter().position(|end| distance <= *end).unwrap_or(BINS.len() - 1);
        found.histogram[bin] += 1;
        found.max_abs = found.max_abs.max((f64::from(*lane) - f64::from(*device)).abs());
        if distance > found.max_ulp {
            found.max_ulp = distance;
            found.max_ulp_at =
                target.inputs.iter().map(|column| column[row % column.len()]).collect();
        }
    }
    Ok(found)
}
