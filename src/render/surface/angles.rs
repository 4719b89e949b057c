//! What n = ω_o = r_v costs: the convolution against eq. 3, by incidence angle.

use nalgebra::Vector3;
use serde::Serialize;

use super::integral::integrals;
use super::material::Material;
use super::methods::Surroundings;
use super::shape::Point;
use super::sums::table_taps;
use crate::render::RenderError;
use crate::render::backend::Backend;
use crate::render::sphere_map::{AzimuthalOperator, looked_up};

/// Angles of incidence, degrees.
const ANGLES_DEG: [f64; 8] = [2.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 75.0];
/// Azimuths at each.
const AZIMUTHS: usize = 24;
/// Share of the table's energy that the sums leave out.
const LEFT_OUT: f64 = 1e-4;

/// The convolution under n = ω_o = r_v against eq. 3 at one angle of incidence.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AngleError {
    /// Between the normal and the direction of view, degrees.
    pub angle_deg: f64,
    /// Root mean square of the error over azimuths and channels, over that of eq. 3.
    pub relative_rms: f64,
    /// Mean of the convolution over that of eq. 3.
    pub mean_ratio: f64,
}

/// Compares at [`AZIMUTHS`] azimuths per angle on a plane.
///
/// # Errors
/// As [`looked_up`].
pub(super) fn by_angle(
    surroundings: &Surroundings,
    material: &Material,
    operator: &AzimuthalOperator,
    backend: Backend<'_>,
) -> Result<Vec<AngleError>, RenderError> {
    let (taps, _) = table_taps(&material.table).thinned(LEFT_OUT);
    // In the frame of the surface, in whose map both look: neither is blurred more than the other.
    let (normal, along) = (Vector3::x(), Vector3::y());
    let convolved = operator.apply(&surroundings.object);
    let directions = |points: &[Point]| -> Vec<Vec<f32>> {
        let column = |axis: usize| points.iter().map(|p| p.reflection[axis] as f32).collect();
        (0..3).map(column).collect()
    };
    ANGLES_DEG
        .iter()
        .map(|&angle_deg| {
            let (sin, cos) = angle_deg.to_radians().sin_cos();
            let points: Vec<Point> = (0..AZIMUTHS)
                .map(|at| {
                    let azimuth = std::f64::consts::TAU * (at as f64 + 0.5) / AZIMUTHS as f64;
                    let (beside, ahead) = azimuth.sin_cos();
                    let reflection = Vector3::new(cos, sin * ahead, sin * beside);
                    Point { normal, along, reflection }
                })
                .collect();
            let exact = integrals(&surroundings.object, &points, &taps);
            let found = looked_up(&convolved, &directions(&points), backend)?;
            let (mut errors, mut squares, mut sums) = (0.0, 0.0, [0.0; 2]);
            for (at, exact) in exact.iter().enumerate() {
                for (channel, exact) in exact.iter().enumerate() {
                    let value = found.get(channel).and_then(|column| column.get(at));
                    let value = value.map_or(f64::NAN, |value| f64::from(*value));
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
