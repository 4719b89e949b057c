//! Eq. 3 of toisoul2017 at points of a surface, as a sum over the cells of a table.

use crate::factor::DirectionalKernel;
use crate::form::DataTable;
use crate::render::RenderError;
use crate::render::backend::{Backend, Kernel, Painter};
use crate::render::geometry::Hit;
use crate::render::shading::Columns;
use crate::render::sphere_map::{SphereMap, Taps};
use crate::render::times::TimedPass;
use crate::table::{Grid, centres};

/// The text of the kernel: lookups in maps, and the sum.
pub(super) const TEXT: &str =
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

/// A sum over taps under one map, ready for hits.
pub(super) struct Sums<'d> {
    painter: Painter<'d>,
    taps: usize,
    per_evaluation: usize,
}

impl<'d> Sums<'d> {
    /// Makes the kernel.
    ///
    /// # Errors
    /// [`RenderError`] if it does not compile.
    pub(super) fn new(
        map: &SphereMap,
        taps: &Taps,
        backend: Backend<'d>,
    ) -> Result<Self, RenderError> {
        let per_evaluation = taps.count().clamp(1, MOST_TAPS);
        let kernel = kernel(TEXT, "surface_sum", map, taps, per_evaluation, Vec::new())?;
        Ok(Self {
            painter: Painter::new(vec![kernel], backend)?,
            taps: taps.count(),
            per_evaluation,
        })
    }

    /// Radiance for F₀ = 1.
    ///
    /// # Errors
    /// [`RenderError`] if the device fails.
    pub(super) fn at(&self, hits: &[Hit]) -> Result<Columns, RenderError> {
        let mut columns = hit_columns(hits);
        columns.push(vec![0.0; hits.len()]);
        let mut sums = vec![vec![0.0_f32; hits.len()]; 3];
        for first in (0..self.taps).step_by(self.per_evaluation) {
            if let Some(column) = columns.last_mut() {
                column.fill(first as f32);
            }
            for (sum, column) in sums.iter_mut().zip(self.painter.colours(&columns)?) {
                sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += value);
            }
        }
        Ok(sums)
    }
}

/// Radiance at hits lit by `map`, for F₀ = 1: columns R, G, B.
///
/// # Errors
/// [`RenderError`] if the kernel does not compile or the device fails.
pub fn surface_sums(
    map: &SphereMap,
    hits: &[Hit],
    taps: &Taps,
    backend: Backend<'_>,
) -> Result<Columns, RenderError> {
    Sums::new(map, taps, backend)?.at(hits)
}

/// The sum over `taps` at `hits` as something to time.
///
/// # Errors
/// [`RenderError`] if the kernel does not parse.
pub(super) fn timed(map: &SphereMap, hits: &[Hit], taps: &Taps) -> Result<TimedPass, RenderError> {
    let per_evaluation = taps.count().clamp(1, MOST_TAPS);
    let mut inputs = hit_columns(hits);
    inputs.push(vec![0.0; hits.len()]);
    Ok(TimedPass {
        kernel: kernel(TEXT, "surface_sum", map, taps, per_evaluation, Vec::new())?,
        inputs,
        evaluations: hits.len() * taps.count().div_ceil(per_evaluation),
    })
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
    let still = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let layer = std::slice::from_ref(map);
    let text = (text, FILE, function);
    crate::render::sphere_map::kernel(text, layer, taps, per_evaluation, still, more)
}

/// Reflection, normal and first direction of hits, as kernels take them.
pub(super) fn hit_columns(hits: &[Hit]) -> Columns {
    let vectors = [
        |hit: &Hit| hit.reflection,
        |hit: &Hit| hit.frame.normal,
        |hit: &Hit| hit.frame.tangents[0],
    ];
    vectors
        .iter()
        .flat_map(|vector| {
            (0..3).map(|axis| hits.iter().map(|hit| vector(hit)[axis] as f32).collect())
        })
        .collect()
}
