//! Polygon lights, cut into slices ξ₁ = const.
//!
//! The polygon is clipped at the horizon in space; each of its edges is then seen as an arc of a
//! great circle N·ω = 0, |N| = 1, from a to b with N along a × b. With M² = N_y² + N_z² its points
//! at ω_x = x are
//!
//! ω_y = (−N_x N_y x ∓ N_z S)/M², ω_z = (−N_x N_z x ± N_y S)/M², S = √(M² − x²),
//!
//! the upper sign where ω_x grows from a to b: dω/dγ = N × ω has the x component N_y ω_z − N_z ω_y =
//! ±S. So an arc is split where ω_x is extremal, at x = ±M, and each part is crossed exactly once
//! by every slice of the half-open range of its ends. Ends are shared, and computed once: crossings
//! come in pairs, and the even–odd rule says what is inside for any simple polygon.

use super::across::{Slice, Sliced};
use super::vector::{cross, length, unit};

/// A part of an edge along which ω_x is monotone.
#[derive(Debug, Clone, Copy)]
struct Arc {
    /// Range of ω_x, half-open.
    low: f64,
    high: f64,
    /// Factors of x in ω_y and ω_z, −N_x (N_y, N_z)/M².
    tilt: [f64; 2],
    /// Factors of S in them, ∓(N_z, −N_y)/M².
    bulge: [f64; 2],
    /// M.
    extreme: f64,
}

impl Arc {
    /// Azimuth φ of (ω_y, ω_z) at ω_x = x, in [0, π].
    fn azimuth(&self, x: f64) -> f64 {
        let root = ((self.extreme - x) * (self.extreme + x)).max(0.0).sqrt();
        let [y, z] = [0, 1].map(|k| self.tilt[k] * x + self.bulge[k] * root);
        z.max(0.0).atan2(y)
    }
}

/// The arcs around a polygon light, above the horizon.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    arcs: Vec<Arc>,
    kinks: Vec<f64>,
    low: f64,
    high: f64,
    view: [f64; 2],
}

impl Outline {
    /// The outline of the polygon with the given vertices, for a view of the given tangential parts.
    pub(super) fn new(vertices: &[[f64; 3]], view: [f64; 2]) -> Self {
        let mut arcs = Vec::new();
        let mut kinks = Vec::new();
        let vertices = in_units(vertices);
        if !edge_on(&vertices) {
            let clipped = above_horizon(&vertices);
            let directions: Vec<[f64; 3]> = clipped.iter().map(|vertex| unit(*vertex)).collect();
            for (index, from) in clipped.iter().enumerate() {
                let next = (index + 1) % clipped.len();
                let ends = [directions[index], directions[next]];
                add_edge(*from, clipped[next], ends, view, &mut arcs, &mut kinks);
            }
        }
        // An arc without a range leaves the outline without one.
        let unknown = arcs.iter().any(|arc| arc.low.is_nan() || arc.high.is_nan());
        let or_nan = |end: f64| if unknown { f64::NAN } else { end };
        let low = or_nan(arcs.iter().map(|arc| arc.low).fold(f64::INFINITY, f64::min));
        let high = or_nan(arcs.iter().map(|arc| arc.high).fold(f64::NEG_INFINITY, f64::max));
        kinks.extend(arcs.iter().flat_map(|arc| [arc.low, arc.high]));
        kinks.iter_mut().for_each(|x| *x += view[0]);
        Self { arcs, kinks, low, high, view }
    }
}

impl Sliced for Outline {
    fn range(&self) -> [f64; 2] {
        self.xi_1_range()
    }

    fn xi_1_range(&self) -> [f64; 2] {
        [self.low + self.view[0], self.high + self.view[0]]
    }

    fn at_xi_1(&self, xi_1: f64) -> f64 {
        xi_1
    }

    fn kinks(&self) -> Vec<f64> {
        self.kinks.clone()
    }

    fn slice(&self, s: f64, slice: &mut Slice) {
        let x = s - self.view[0];
        slice.xi_1 = s;
        slice.slope = 1.0;
        slice.radius = ((1.0 - x) * (1.0 + x)).max(0.0).sqrt();
        slice.covered.clear();
        let mut crossings =
            self.arcs.iter().filter(|arc| arc.low <= x && x < arc.high).map(|arc| arc.azimuth(x));
        while let (Some(first), Some(second)) = (crossings.next(), crossings.next()) {
            slice.covered.push([first, second]);
        }
        // Few crossings: sorted across pairs in place.
        slice.covered.as_flattened_mut().sort_by(f64::total_cmp);
    }
}

/// Splits the edge between two vertices into arcs along which ω_x is monotone.
fn add_edge(
    from: [f64; 3],
    to: [f64; 3],
    [a, b]: [[f64; 3]; 2],
    view: [f64; 2],
    arcs: &mut Vec<Arc>,
    kinks: &mut Vec<f64>,
) {
    let step = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    let normal = cross(from, step);
    let length = length(normal);
    if length == 0.0 {
        return;
    }
    let [n_x, n_y, n_z] = normal.map(|component| component / length);
    let extreme = n_y.hypot(n_z);
    if extreme == 0.0 {
        return;
    }
    let square = extreme * extreme;
    let mut add = |start: f64, end: f64, sign: f64| {
        let (low, high) = if start < end { (start, end) } else { (end, start) };
        if low < high || low.is_nan() || high.is_nan() {
            arcs.push(Arc {
                low,
                high,
                tilt: [-n_x * n_y / square, -n_x * n_z / square],
                bulge: [sign * n_z / square, -sign * n_y / square],
                extreme,
            });
        }
    };
    let growth = |point: [f64; 3]| n_y * point[2] - n_z * point[1];
    let (leaving, arriving) = (growth(a), growth(b));
    if leaving > 0.0 && arriving < 0.0 {
        let top = extreme.max(a[0]).max(b[0]);
        add(a[0], top, -1.0);
        add(top, b[0], 1.0);
    } else if leaving < 0.0 && arriving > 0.0 {
        let bottom = (-extreme).min(a[0]).min(b[0]);
        add(a[0], bottom, 1.0);
        add(bottom, b[0], -1.0);
    } else {
        add(a[0], b[0], if a[0] < b[0] { -1.0 } else { 1.0 });
    }
    // Where the great circle crosses ξ₂ = 0: the same with x and y exchanged.
    let across = 1.0 - n_y * n_y;
    let root = (across - view[1] * view[1]).max(0.0).sqrt();
    if across > 0.0 {
        let centre = n_x * n_y * view[1] / across;
        kinks.extend([centre - n_z * root / across, centre + n_z * root / across]);
    }
}

/// Whether the shaded point lies in the plane of the polygon, to rounding: nothing is seen of it.
fn edge_on(vertices: &[[f64; 3]]) -> bool {
    let Some(&origin) = vertices.first() else { return true };
    let from_first = |vertex: &[f64; 3]| [0, 1, 2].map(|axis| vertex[axis] - origin[axis]);
    let mut normal = [0.0; 3];
    let mut extent = 0.0_f64;
    for pair in vertices.windows(2) {
        let (a, b) = (from_first(&pair[0]), from_first(&pair[1]));
        let part = cross(a, b);
        normal = [0, 1, 2].map(|axis| normal[axis] + part[axis]);
        extent += part.iter().map(|component| component.abs()).sum::<f64>();
    }
    let volume = normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2];
    let scale = extent * origin.iter().map(|component| component.abs()).sum::<f64>();
    let at_a_vertex = vertices.contains(&[0.0; 3]);
    at_a_vertex || volume.abs() <= 4.0 * f64::EPSILON * scale
}

/// The part of the polygon with z ≥ 0 (Sutherland & Hodgman).
fn above_horizon(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut kept = Vec::with_capacity(vertices.len() + 2);
    for (index, from) in vertices.iter().enumerate() {
        let to = &vertices[(index + 1) % vertices.len()];
        if from[2] >= 0.0 {
            kept.push(*from);
        }
        if (from[2] < 0.0 && to[2] > 0.0) || (from[2] > 0.0 && to[2] < 0.0) {
            let part = from[2] / (from[2] - to[2]);
            let at = |axis: usize| from[axis] + part * (to[axis] - from[axis]);
            kept.push([at(0), at(1), 0.0]);
        }
    }
    kept
}

/// The vertices over the power of two that brings the largest component to [1, 2): no product of theirs
/// overflows.
fn in_units(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let largest = vertices.iter().flatten().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    // Clamped so that neither it nor its reciprocal overflows.
    let exponent = largest.clamp(1e-300, 1e300).log2().floor();
    let unit = exponent.exp2();
    vertices.iter().map(|vertex| vertex.map(|component| component / unit)).collect()
}
