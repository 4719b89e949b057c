//! Eq. 3 of toisoul2017 at points of a surface, as a sum over the cells of a table.

use super::shape::Point;
use crate::factor::DirectionalKernel;
use crate::render::RenderError;
use crate::render::backend::{Backend, Painter};
use crate::render::kernel::Kernel;
use crate::render::sphere_map::{SphereMap, Taps, TimedPass};
use crate::table::{Grid, centres};

/// The text of the kernel: lookups in maps, and the sum.
const TEXT: &str =
    concat!(include_str!("../sphere_map/sphere_map.wgsl"), "\n", include_str!("surface_sum.wgsl"));
/// The file of the sum.
const FILE: &str = "src/render/surface/surface_sum.wgsl";
/// Most taps of one evaluation.
const MOST_TAPS: usize = 1024;

/// One tap per cell of a table with channels R, G, B.
pub fn table_taps(grid: &Grid) -> Taps {
    let (dx, dy) = (grid.x().step().abs(), grid.y().step().abs());
    let channels = ["R", "G", "B"].map(|name| grid.channel(name));
    let mut taps = Taps::default();
    for (at, [h_x, h_y]) in centres(grid.x(), grid.y()).enumerate() {
        let weight = channels.map(|channel| {
            let value = channel.and_then(|channel| channel.values.get(at));
            value.map_or(0.0, |value| f64::from(*value) * dx * dy)
        });
        taps.push([h_x, h_y, dx.max(dy)], weight);
    }
    taps
}

/// The taps of kernels along lines.
pub fn line_taps(kernels: &[DirectionalKernel]) -> Taps {
    let mut taps = Taps::default();
    for kernel in kernels {
        let axis = &kernel.axis;
        let step = axis.step().abs();
        for at in 0..axis.count {
            let s = axis.centre(at);
            let weight = [0, 1, 2].map(|channel| {
                let values = kernel.channels.get(channel).map(|(_, values)| values);
                values.and_then(|values| values.get(at)).map_or(0.0, |value| value * step)
            });
            taps.push([s * kernel.direction[0], s * kernel.direction[1], step], weight);
        }
    }
    taps
}

/// Radiance at `points` lit by `map`, for F₀ = 1: columns R, G, B.
///
/// # Errors
/// [`RenderError`] if the kernel does not compile or the device fails.
pub fn surface_sums(
    map: &SphereMap,
    points: &[Point],
    taps: &Taps,
    backend: Backend<'_>,
) -> Result<Vec<Vec<f32>>, RenderError> {
    let per_evaluation = taps.count().clamp(1, MOST_TAPS);
    let kernels = [kernel(map, taps, per_evaluation)?];
    let painter = Painter::new(&kernels, backend)?;
    let mut columns = point_columns(points);
    columns.push(vec![0.0; points.len()]);
    let mut sums = vec![vec![0.0_f32; points.len()]; 3];
    for first in (0..taps.count()).step_by(per_evaluation) {
        if let Some(column) = columns.last_mut() {
            column.fill(first as f32);
        }
        for (sum, column) in sums.iter_mut().zip(painter.colours(&columns)?) {
            sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += value);
        }
    }
    Ok(sums)
}

/// The same as something to time.
///
/// # Errors
/// As [`surface_sums`].
pub(super) fn timed(
    map: &SphereMap,
    points: &[Point],
    taps: &Taps,
) -> Result<TimedPass, RenderError> {
    let per_evaluation = taps.count().clamp(1, MOST_TAPS);
    let mut inputs = point_columns(points);
    inputs.push(vec![0.0; points.len()]);
    Ok(TimedPass {
        kernel: kernel(map, taps, per_evaluation)?,
        inputs,
        evaluations: points.len() * taps.count().div_ceil(per_evaluation),
    })
}

fn kernel(map: &SphereMap, taps: &Taps, per_evaluation: usize) -> Result<Kernel, RenderError> {
    let still = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let layer = std::slice::from_ref(map);
    crate::render::sphere_map::kernel(TEXT, FILE, "surface_sum", layer, taps, per_evaluation, still)
}

fn point_columns(points: &[Point]) -> Vec<Vec<f32>> {
    let vectors = [|p: &Point| p.reflection, |p: &Point| p.normal, |p: &Point| p.along];
    vectors
        .iter()
        .flat_map(|vector| {
            (0..3).map(|axis| points.iter().map(|point| vector(point)[axis] as f32).collect())
        })
        .collect()
}
