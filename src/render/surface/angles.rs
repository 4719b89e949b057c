//! What n = ω_o = r_v costs: the convolution against the sum over the table at every point, by incidence angle.

use nalgebra::Vector3;
use serde::Serialize;

use super::LEFT_OUT;
use super::kernels::DiffractionKernels;
use super::sums::{columns, integrals};
use crate::render::RenderError;
use crate::render::backend::Backend;
use crate::render::geometry::{Frame, Hit};
use crate::render::sphere_map::{AzimuthalOperator, SphereMap, lookup};

/// Angles of incidence, degrees.
const ANGLES_DEG: [f64; 8] = [2.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 75.0];
/// Azimuths at each.
const AZIMUTHS: usize = 24;
/// The convolution under n = ω_o = r_v against the sum at a point, at one angle of incidence.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AngleError {
    /// Between the normal and the direction of view, degrees.
    pub angle_deg: f64,
    /// Root mean square of the error over azimuths and channels, over that of the sum.
    pub relative_rms: f64,
    /// Mean of the convolution over that of the sum.
    pub mean_ratio: f64,
}

/// Compares at [`AZIMUTHS`] azimuths per angle on a plane under `object`, in its frame.
///
/// # Errors
/// [`RenderError`] if the lookup does not compile.
pub(super) fn by_angle(
    object: &SphereMap,
    kernels: &DiffractionKernels,
    operator: &AzimuthalOperator,
) -> Result<Vec<AngleError>, RenderError> {
    let orders = kernels.orders.thinned(LEFT_OUT);
    // In whose map both look: neither is blurred more than the other.
    let frame = Frame::of(Vector3::x(), Vector3::y());
    let convolved = lookup(&operator.apply(object), Backend::Lanes)?;
    ANGLES_DEG
        .iter()
        .map(|&angle_deg| {
            let (sin, cos) = angle_deg.to_radians().sin_cos();
            let hits: Vec<Hit> = (0..AZIMUTHS)
                .map(|at| {
                    let azimuth = std::f64::consts::TAU * (at as f64 + 0.5) / AZIMUTHS as f64;
                    let (beside, ahead) = azimuth.sin_cos();
                    let reflection = Vector3::new(cos, sin * ahead, sin * beside);
                    Hit::of_directions(frame, reflection)
                })
                .collect();
            let exact = integrals(object, &hits, &orders);
            let found = convolved.colours(&columns(&hits, |hit| hit.reflection))?;
            let (mut errors, mut squares, mut sums) = (0.0, 0.0, [0.0; 2]);
            for (at, exact) in exact.iter().enumerate() {
                for (column, exact) in found.iter().zip(exact) {
                    let value = f64::from(column[at]);
                    errors += (value - exact) * (value - exact);
                    squares += exact * exact;
                    sums[0] += value;
                    sums[1] += exact;
                }
            }
            Ok(AngleError {
                angle_deg,
                relative_rms: (errors / squares).sqrt(),
                mean_ratio: sums[0] / sums[1],
            })
        })
        .collect()
}
