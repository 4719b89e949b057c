//! Where forms of lights are judged: by the angular size of the light against the width of the lobe
//! and by where its edges lie.
//!
//! Widths and wavelengths are those of velinov2018's scenes; kσ is 60, 250 or 1000 (a coherence
//! radius of 5, 22 and 88 µm at 550 nm, a lobe of 1/kσ), and errors are measured for each.

use super::draws::{Draw, limbs, sphere_row, table, triangle_row};
use super::vector::unit;
use super::{SPHERE, TRIANGLE};
use crate::effect::Points;
use crate::table::Table;

/// Points that are judged, per region.
const POINTS: usize = 2000;
/// Points to which fits are held, per region.
const FITTED: usize = 240;
/// kσ by which regions are grouped.
pub(super) const KS: [f64; 3] = [60.0, 250.0, 1000.0];

/// A region by name, from the draw of one of its lights.
macro_rules! region {
    ($name:literal, $seed:literal, $rows:ident, $one:expr) => {
        (
            $name,
            || $rows($seed, POINTS, $name, $one),
            Some(|| $rows($seed + 1000, FITTED, $name, $one)),
        )
    };
}

/// Regions of the lights.
pub(in super::super) const REGIONS: &[(&str, Points, Option<Points>)] = &[
    region!("small spheres", 11, spheres, |draw, ks| {
        let half_angle = draw.log_between(0.001, 0.05);
        let axis = draw.direction(0.06, 1.0);
        (axis, half_angle, across(draw, axis, half_angle, 2.0 / ks))
    }),
    region!("large spheres", 12, spheres, |draw, _| {
        let half_angle = draw.log_between(0.05, 0.8);
        let axis = draw.direction(0.0, 1.0);
        (axis, half_angle, across(draw, axis, half_angle, 0.0))
    }),
    region!("limb of a sphere", 13, spheres, |draw, ks| {
        let half_angle = draw.log_between(0.02, 0.8);
        let axis = draw.direction(0.1, 1.0);
        let limb = draw.one_of(&limbs(axis, half_angle));
        (axis, half_angle, axis[0] - limb + draw.between(-2.0, 2.0) / ks)
    }),
    region!("grazing spheres", 14, spheres, |draw, _| {
        let half_angle = draw.log_between(0.02, 0.5);
        let axis = draw.direction(-0.9 * half_angle.sin(), half_angle.sin());
        (axis, half_angle, across(draw, axis, half_angle, 0.0))
    }),
    region!("small triangles", 15, triangles, |draw, ks| {
        let centre = draw.direction(0.06, 1.0);
        let size = draw.log_between(0.001, 0.05);
        let vertices = draw.triangle(centre, size);
        let view_x = through(draw, vertices) + draw.between(-2.0, 2.0) / ks;
        (vertices, view_x)
    }),
    region!("large triangles", 16, triangles, |draw, _| {
        let centre = draw.direction(0.3, 1.0);
        let size = draw.log_between(0.1, 1.0);
        let vertices = draw.triangle(centre, size);
        (vertices, through(draw, vertices))
    }),
    region!("vertex on the line", 17, triangles, |draw, ks| {
        let centre = draw.direction(0.5, 1.0);
        let size = draw.log_between(0.1, 0.5);
        let vertices = draw.triangle(centre, size);
        (vertices, -unit(vertices[0])[0] + draw.between(-2.0, 2.0) / ks)
    }),
    region!("grazing triangles", 18, triangles, |draw, _| {
        let size = draw.log_between(0.1, 0.8);
        let centre = draw.direction(-0.5 * size, 0.5 * size);
        let vertices = draw.triangle(centre, size);
        (vertices, through(draw, vertices))
    }),
];

fn spheres(
    seed: u64,
    count: usize,
    origin: &str,
    mut one: impl FnMut(&mut Draw, f64) -> ([f64; 3], f64, f64),
) -> Table {
    let mut draw = Draw::new(seed);
    let mut rows = Vec::with_capacity(count);
    while rows.len() < count {
        let ks = KS[rows.len() % KS.len()];
        let (axis, half_angle, xi_1) = one(&mut draw, ks);
        // ξ₁ of the axis decides the view.
        let view_x = xi_1 - axis[0];
        if view_x.abs() < 0.999 {
            let view = [view_x, draw.view_y(view_x)];
            let distance = draw.log_between(0.5, 5.0);
            let centre = axis.map(|component| distance * component);
            rows.push(sphere_row(draw.kw(), ks, view, centre, distance * half_angle.sin()));
        }
    }
    table(SPHERE, &rows, origin)
}

/// ξ₁ of the axis such that the origin line crosses the sphere or passes it by up to `beside`.
fn across(draw: &mut Draw, axis: [f64; 3], half_angle: f64, beside: f64) -> f64 {
    let [low, high] = limbs(axis, half_angle);
    axis[0] - draw.between(low - beside, high + beside)
}

fn triangles(
    seed: u64,
    count: usize,
    origin: &str,
    mut one: impl FnMut(&mut Draw, f64) -> ([[f64; 3]; 3], f64),
) -> Table {
    let mut draw = Draw::new(seed);
    let mut rows = Vec::with_capacity(count);
    while rows.len() < count {
        let ks = KS[rows.len() % KS.len()];
        let (vertices, view_x) = one(&mut draw, ks);
        if view_x.abs() < 0.999 {
            let view = [view_x, draw.view_y(view_x)];
            rows.push(triangle_row(draw.kw(), ks, view, vertices));
        }
    }
    table(TRIANGLE, &rows, origin)
}

/// The view for which the origin line goes through a point of the triangle.
fn through(draw: &mut Draw, vertices: [[f64; 3]; 3]) -> f64 {
    let (u, v) = (draw.between(0.0, 1.0).sqrt(), draw.between(0.0, 1.0));
    let shares = [1.0 - u, u * (1.0 - v), u * v];
    let point = [0, 1, 2].map(|axis| (0..3).map(|k| shares[k] * vertices[k][axis]).sum());
    -unit(point)[0]
}
