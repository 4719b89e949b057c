//! Eq. 3 of toisoul2017 at points of a surface, as a sum over the cells of a table: in f64, the
//! reference, and as kernels.

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::form::DataTable;
use crate::render::RenderError;
use crate::render::backend::{Backend, Kernel, Painter};
use crate::render::geometry::Hit;
use crate::render::shading::Columns;
use crate::render::sphere_map::{self, MOST_TAPS, STILL, SphereMap, Taps, summed};
use crate::render::times::TimedPass;
use crate::table::{Grid, centres};

/// The text of the kernel: lookups in maps, and the sum.
pub(super) const TEXT: &str =
    concat!(include_str!("../sphere_map/sphere_map.wgsl"), "\n", include_str!("surface_sum.wgsl"));
/// The file of the sum.
const FILE: &str = "src/render/surface/surface_sum.wgsl";

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

/// Radiance R, G, B at each hit, for F₀ = 1.
///
/// `taps`: displacement along the two directions of a hit, width of the cell, and the table times
/// the area of the cell. The sum over cells of ((1 + ω_i·ω_o)²/4)/((n·ω_o) μ_i), with the mean of
/// 1/μ_i over the ring of each cell; what lies beyond the horizon is left out. Bilinear in `map`.
pub fn integrals(map: &SphereMap, hits: &[Hit], taps: &Taps) -> Vec<[f64; 3]> {
    hits.par_iter().map(|hit| integral(map, hit, taps)).collect()
}

fn integral(map: &SphereMap, hit: &Hit, taps: &Taps) -> [f64; 3] {
    let Hit { frame, reflection, .. } = hit;
    let [first, beside] = frame.tangents;
    let mu_o = reflection.dot(&frame.normal).max(1e-4);
    let mirror = [reflection.dot(&first), reflection.dot(&beside)];
    let mut sum = [0.0; 3];
    for ([along, across, cell], weight) in taps.iter() {
        let (u, v) = (mirror[0] + along, mirror[1] + across);
        let radius = (u * u + v * v).sqrt();
        if radius >= 1.0 {
            continue;
        }
        let (inner, outer) = ((radius - 0.5 * cell).max(0.0), (radius + 0.5 * cell).min(1.0));
        let per_mu = 2.0 / ((1.0 - inner * inner).sqrt() + (1.0 - outer * outer).sqrt());
        let mu_i = (1.0 - radius * radius).sqrt();
        let cosine = mu_o * mu_i - mirror[0] * u - mirror[1] * v;
        let factor = 0.25 * (1.0 + cosine) * (1.0 + cosine) / mu_o * per_mu;
        let incident = first * u + beside * v + frame.normal * mu_i;
        let radiance = map.bilinear(incident.into());
        for ((sum, weight), radiance) in sum.iter_mut().zip(weight).zip(radiance) {
            *sum += weight * factor * radiance;
        }
    }
    sum
}

/// A sum over taps under one map, ready for hits.
pub struct Sums<'d> {
    painter: Painter<'d>,
    blocks: Vec<[f32; 1]>,
}

impl<'d> Sums<'d> {
    /// Makes the kernel.
    ///
    /// # Errors
    /// [`RenderError`] if it does not compile.
    pub fn new(map: &SphereMap, taps: &Taps, backend: Backend<'d>) -> Result<Self, RenderError> {
        let (kernel, blocks) = sum(map, taps)?;
        Ok(Self { painter: Painter::new(vec![kernel], backend)?, blocks })
    }

    /// Radiance for F₀ = 1: columns R, G, B.
    ///
    /// # Errors
    /// [`RenderError`] if the device fails.
    pub fn at(&self, hits: &[Hit]) -> Result<Columns, RenderError> {
        summed(&self.painter, &hit_columns(hits), &self.blocks)
    }
}

/// The sum over `taps` at `hits` as something to time.
///
/// # Errors
/// [`RenderError`] if the kernel does not parse.
pub(super) fn timed(map: &SphereMap, hits: &[Hit], taps: &Taps) -> Result<TimedPass, RenderError> {
    let (kernel, blocks) = sum(map, taps)?;
    Ok(TimedPass::summed(kernel, &hit_columns(hits), [0.0], blocks.len()))
}

/// The kernel of a sum, and the first tap of each block that one evaluation takes.
fn sum(map: &SphereMap, taps: &Taps) -> Result<(Kernel, Vec<[f32; 1]>), RenderError> {
    let per_evaluation = taps.count().clamp(1, MOST_TAPS);
    let blocks = (0..taps.count()).step_by(per_evaluation).map(|first| [first as f32]).collect();
    Ok((kernel(TEXT, "surface_sum", map, taps, per_evaluation, Vec::new())?, blocks))
}

/// A kernel over one map and its taps, and `more` tables.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub(super) fn kernel(
    text: &str,
    function: &str,
    map: &SphereMap,
    taps: &Taps,
    per_evaluation: usize,
    more: Vec<DataTable>,
) -> Result<Kernel, RenderError> {
    let (text, layer) = ((text, FILE, function), std::slice::from_ref(map));
    sphere_map::kernel(text, layer, taps, per_evaluation, STILL, more)
}

/// Reflection, normal and first direction of hits, as kernels take them.
pub(super) fn hit_columns(hits: &[Hit]) -> Columns {
    let mut columns = columns(hits, |hit| hit.reflection);
    columns.extend(self::columns(hits, |hit| hit.frame.normal));
    columns.extend(self::columns(hits, |hit| hit.frame.tangents[0]));
    columns
}

/// The three components of a vector of every hit.
pub(super) fn columns(hits: &[Hit], vector: impl Fn(&Hit) -> Vector3<f64>) -> Columns {
    (0..3).map(|axis| hits.iter().map(|hit| vector(hit)[axis] as f32).collect()).collect()
}
