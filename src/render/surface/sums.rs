//! The light that a surface with a diffraction table sends to the eye, as a sum over the cells of the
//! table: in f64, the reference, and as kernels.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | ω_i, ω_o | | 1 | directions of light and of view, unit |
//! | h | taps | 1 | ω_i + ω_o projected on the surface |
//! | w | | 1 | ω_i·n + ω_o·n |
//! | S_d | [`Orders::taps`] | sr⁻¹ | share of the light per area of direction cosines, at the w of the table |
//! | g(w) | [`Orders::growth`] | 1 | orders at w over those of the table |
//! | E | [`Orders::total`] | 1 | ∫ S_d dA over the table, the zero order included |
//!
//! Light that leaves in dω_o fills dh_x dh_y = cos θ_o dω_o of direction cosines, so that a share S_d dh
//! of what falls on the surface is a reflectance distribution of S_d (Harvey–Shack), and of the mirror
//! nothing is lost at any angle. Eq. 3 of toisoul2017 has Stam's factor G/4 beside a table at w = 2: at
//! the mirror direction that is cos²θ, not 1, where w² stands for 4, and over all directions it does not
//! conserve (∫ S_d dh/cos θ_i at normal exitance). Orders beyond the horizon carry no light. What they
//! hold, and what other orders lose or gain at their own w, is the mirror's, as in the theory of small
//! perturbations (Rayleigh–Rice), so that a table with E = 1 returns the light of a white sky whole.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::orders::Orders;
use crate::form::DataTable;
use crate::render::RenderError;
use crate::render::backend::{Backend, Kernel, Painter};
use crate::render::geometry::Hit;
use crate::render::shading::Columns;
use crate::render::sphere_map::{self, MOST_TAPS, STILL, SphereMap, Taps, summed};
use crate::render::times::TimedPass;

/// The text of the kernel: lookups in maps, and the sum.
pub(super) const TEXT: &str =
    concat!(include_str!("../sphere_map/sphere_map.wgsl"), "\n", include_str!("surface_sum.wgsl"));
/// The file of the sum.
const FILE: &str = "src/render/surface/surface_sum.wgsl";

/// Radiance R, G, B at each hit, for F₀ = 1.
///
/// With L_m the radiance from the mirror direction, E the whole share `total` of the table and g its
/// growth, the sum over cells is E L_m + Σ S_d g(w) (L_i − L_m) ΔA: cells beyond the horizon leave what
/// they hold to the mirror. Bilinear in `map`.
pub fn integrals(map: &SphereMap, hits: &[Hit], orders: &Orders) -> Vec<[f64; 3]> {
    hits.par_iter().map(|hit| integral(map, hit, orders)).collect()
}

fn integral(map: &SphereMap, hit: &Hit, orders: &Orders) -> [f64; 3] {
    let Hit { frame, reflection, .. } = hit;
    let [first, beside] = frame.tangents;
    let mu_o = reflection.dot(&frame.normal);
    let mirror = [reflection.dot(&first), reflection.dot(&beside)];
    let mirrored = map.bilinear((*reflection).into());
    let mut sum = [0, 1, 2].map(|channel| orders.total[channel] * mirrored[channel]);
    for ([along, across, _], weight) in orders.taps.iter() {
        let (u, v) = (mirror[0] + along, mirror[1] + across);
        let square = u * u + v * v;
        if square >= 1.0 {
            continue;
        }
        let mu_i = (1.0 - square).sqrt();
        let growth = orders.growth.at(mu_o + mu_i);
        let incident = first * u + beside * v + frame.normal * mu_i;
        let radiance = map.bilinear(incident.into());
        for channel in 0..3 {
            let more = radiance[channel] - mirrored[channel];
            sum[channel] += weight[channel] * growth[channel] * more;
        }
    }
    sum
}

/// A sum over orders under one map, ready for hits.
pub struct Sums<'d> {
    painter: Painter<'d>,
    blocks: Vec<[f32; 1]>,
}

impl<'d> Sums<'d> {
    /// Makes the kernel.
    ///
    /// # Errors
    /// [`RenderError`] if it does not compile.
    pub fn new(
        map: &SphereMap,
        orders: &Orders,
        backend: Backend<'d>,
    ) -> Result<Self, RenderError> {
        let (kernel, blocks) = sum(map, orders)?;
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

/// The sum over `orders` at `hits` as something to time.
///
/// # Errors
/// [`RenderError`] if the kernel does not parse.
pub(super) fn timed(
    map: &SphereMap,
    hits: &[Hit],
    orders: &Orders,
) -> Result<TimedPass, RenderError> {
    let (kernel, blocks) = sum(map, orders)?;
    Ok(TimedPass::summed(kernel, &hit_columns(hits), [0.0], blocks.len()))
}

/// The kernel of a sum, and the first tap of each block that one evaluation takes.
fn sum(map: &SphereMap, orders: &Orders) -> Result<(Kernel, Vec<[f32; 1]>), RenderError> {
    let count = orders.taps.count();
    let per_evaluation = count.clamp(1, MOST_TAPS);
    let blocks = (0..count.max(1)).step_by(per_evaluation).map(|first| [first as f32]).collect();
    let kernel = kernel(TEXT, "surface_sum", map, (&orders.taps, orders), per_evaluation, None)?;
    Ok((kernel, blocks))
}

/// A kernel over one map and taps that stand for `orders`, and one more table.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub(super) fn kernel(
    text: &str,
    function: &str,
    map: &SphereMap,
    (taps, orders): (&Taps, &Orders),
    per_evaluation: usize,
    more: Option<DataTable>,
) -> Result<Kernel, RenderError> {
    let factors: Vec<[f32; 3]> =
        orders.growth.factors().iter().map(|rgb| rgb.map(|factor| factor as f32)).collect();
    let [r, g, b] = orders.total.map(|share| share as f32);
    let text = format!(
        "{text}\nconst ORDER_TOTAL = vec3<f32>({r:?}, {g:?}, {b:?});\n\
         const GROWTH_STEPS = {}u;\n",
        factors.len() - 1
    );
    let mut tables = vec![DataTable::vectors("order_growth", &factors)];
    tables.extend(more);
    let (text, layer) = ((text.as_str(), FILE, function), std::slice::from_ref(map));
    sphere_map::kernel(text, layer, taps, per_evaluation, STILL, tables)
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
