//! Lights that have broken implementations, drawn around what they have in common.

use std::f64::consts::FRAC_PI_2;

use super::draws::{Draw, limbs, sphere_row, table, triangle_row};
use super::vector::{cross, unit};
use super::{SPHERE, TRIANGLE};
use crate::effect::Points;
use crate::table::Table;

/// Cases of each kind.
const EACH: usize = 400;

/// Hard cases of the lights, by name.
pub(in super::super) const HARD_CASES: &[(&str, Points)] =
    &[("hard spheres", spheres), ("hard triangles", triangles)];

/// A sphere seen under `half_angle` around `axis`, for a view.
struct Sphere {
    axis: [f64; 3],
    half_angle: f64,
    view: [f64; 2],
    kw: f64,
    ks: f64,
    distance: f64,
    /// r over distance, in place of the sine of the half-angle.
    ratio: Option<f64>,
}

impl Sphere {
    fn any(draw: &mut Draw) -> Self {
        Self {
            axis: draw.direction(0.0, 1.0),
            half_angle: draw.log_between(1e-3, 1.4),
            view: draw.view(),
            kw: draw.extreme_kw(),
            ks: draw.log_between(1.0, 1e4),
            distance: draw.log_between(0.1, 10.0),
            ratio: None,
        }
    }

    fn row(self) -> [f64; 8] {
        let ratio = self.ratio.unwrap_or(self.half_angle.sin());
        let centre = self.axis.map(|component| self.distance * component);
        sphere_row(self.kw, self.ks, self.view, centre, self.distance * ratio)
    }

    /// Moves the view so that the origin line is at ω_x = x.
    fn with_line_at(mut self, x: f64, draw: &mut Draw) -> Self {
        self.view = [-x, draw.view_y(-x)];
        self
    }
}

/// Offsets of what is degenerate, from none to visible.
fn nudge(draw: &mut Draw) -> f64 {
    let sizes = [0.0, 0.0, 6e-8, 1e-6, 1e-5, 1e-4, 1e-3];
    draw.sign() * draw.one_of(&sizes)
}

/// A sphere with a limb on the origin line, but for an offset.
fn at_limb(draw: &mut Draw, offset: fn(&mut Draw) -> f64) -> Sphere {
    let sphere = Sphere::any(draw);
    let limb = draw.one_of(&limbs(sphere.axis, sphere.half_angle));
    let x = (limb + offset(draw)).clamp(-1.0, 1.0);
    sphere.with_line_at(x, draw)
}

const SPHERES: [fn(&mut Draw) -> Sphere; 15] = [
    Sphere::any,
    // A limb tangent to the origin line, a double root, and next to it.
    |draw| at_limb(draw, |_| 0.0),
    |draw| at_limb(draw, nudge),
    |draw| {
        let along =
            [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
        let which = draw.one_of(&[0.0, 1.0, 2.0, 3.0, 4.0]) as usize;
        Sphere { axis: along[which], ..Sphere::any(draw) }
    },
    |draw| {
        // The mirror direction: the middle of the lobe.
        let sphere = Sphere::any(draw);
        let view = [-sphere.axis[0], -sphere.axis[1]];
        Sphere { view, ..sphere }
    },
    |draw| {
        let sphere = Sphere::any(draw);
        let axis = unit([0.0, sphere.axis[1], sphere.axis[2] + 1e-3]);
        Sphere { axis, view: [0.0, sphere.view[1]], ..sphere }
    },
    |draw| {
        let sphere = Sphere::any(draw);
        let axis = unit([sphere.axis[0], 0.0, sphere.axis[2] + 1e-3]);
        Sphere { axis, view: [sphere.view[0], 0.0], ..sphere }
    },
    |draw| {
        let ratio = draw.one_of(&[1.0, 1.0 + 1e-7, 1.0 - 1e-7, 0.9999, 1.0001, 2.0, 1e3]);
        Sphere { axis: draw.direction(-1.0, 1.0), ratio: Some(ratio), ..Sphere::any(draw) }
    },
    |draw| {
        // Touching the horizon from below, or all of it below.
        let sphere = Sphere::any(draw);
        let z = (-sphere.half_angle.sin() * draw.one_of(&[1.0, 1.0, 1.01, 2.0]) + nudge(draw))
            .max(-1.0);
        Sphere { axis: draw.direction(z, z), ..sphere }
    },
    |draw| {
        let sphere = Sphere::any(draw);
        let reach = sphere.half_angle.sin();
        let axis = draw.direction(-reach, reach);
        let [low, high] = limbs(axis, sphere.half_angle);
        let x = draw.between(low, high);
        Sphere { axis, ..sphere }.with_line_at(x, draw)
    },
    |draw| {
        // View and light towards the horizon: 89.9 degrees is z = 0.0017.
        let axis = draw.direction(0.0, 0.0018);
        let [x, y, _] = draw.direction(0.0, 0.0018);
        Sphere { axis, view: [x, y], half_angle: draw.log_between(1e-3, 0.2), ..Sphere::any(draw) }
    },
    |draw| {
        // Far lobes: the light up to 2 away from the mirror direction, across.
        let sphere = Sphere::any(draw);
        let x = sphere.axis[0];
        Sphere { kw: draw.log_between(500.0, 6283.0), ..sphere }.with_line_at(x, draw)
    },
    |draw| {
        // A limb of the slice on the origin line at q = 0.
        let sphere = Sphere::any(draw);
        let edge =
            (sphere.axis[1].asin() + draw.sign() * sphere.half_angle).clamp(-FRAC_PI_2, FRAC_PI_2);
        Sphere {
            axis: unit([0.0, sphere.axis[1], 0.1 + sphere.axis[2]]),
            view: [0.0, -edge.sin()],
            ..sphere
        }
    },
    |draw| {
        let sphere = Sphere { half_angle: draw.log_between(1e-6, 1e-3), ..Sphere::any(draw) };
        let x = sphere.axis[0] + sphere.half_angle * draw.between(-1.0, 1.0);
        sphere.with_line_at(x.clamp(-1.0, 1.0), draw)
    },
    |draw| {
        let distance = draw.log_between(1e-6, 1e6);
        let sphere = Sphere { distance, ..Sphere::any(draw) };
        let x = sphere.axis[0];
        sphere.with_line_at(x, draw)
    },
];

fn spheres() -> Table {
    let mut draw = Draw::new(31);
    let rows: Vec<[f64; 8]> = SPHERES
        .iter()
        .flat_map(|kind| (0..EACH).map(|_| kind(&mut draw).row()).collect::<Vec<_>>())
        .collect();
    table(SPHERE, &rows, "hard spheres")
}

/// A triangle and a view of it.
struct Triangle {
    vertices: [[f64; 3]; 3],
    view: [f64; 2],
    kw: f64,
    ks: f64,
}

impl Triangle {
    fn any(draw: &mut Draw) -> Self {
        let centre = draw.direction(0.0, 1.0);
        let size = draw.log_between(1e-3, 3.0);
        Self::at(draw, centre, size)
    }

    fn at(draw: &mut Draw, centre: [f64; 3], size: f64) -> Self {
        Self {
            vertices: draw.triangle(centre, size),
            view: draw.view(),
            kw: draw.extreme_kw(),
            ks: draw.log_between(1.0, 1e4),
        }
    }

    fn row(self) -> [f64; 13] {
        triangle_row(self.kw, self.ks, self.view, self.vertices)
    }

    fn with_line_at(mut self, x: f64, draw: &mut Draw) -> Self {
        let x = x.clamp(-1.0, 1.0);
        self.view = [-x, draw.view_y(-x)];
        self
    }

    /// Applies a change to every vertex.
    fn each(mut self, change: impl FnMut([f64; 3]) -> [f64; 3]) -> Self {
        self.vertices = self.vertices.map(change);
        self
    }
}

const TRIANGLES: [fn(&mut Draw) -> Triangle; 18] = [
    Triangle::any,
    |draw| {
        let triangle = Triangle::any(draw);
        let x = unit(triangle.vertices[0])[0] + nudge(draw);
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // Two vertices on the origin line, which the edge then bulges across.
        let mut triangle = Triangle::any(draw);
        let x = unit(triangle.vertices[0])[0];
        let [_, y, z] = unit(triangle.vertices[1]);
        let across = ((1.0 - x * x) / (y * y + z * z).max(1e-12)).sqrt();
        triangle.vertices[1] = [x, y * across, z * across];
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // The origin line tangent to the great circle of an edge: a double root.
        let triangle = Triangle::any(draw);
        let [a, b, _] = triangle.vertices;
        let normal = unit(cross(a, b));
        let x = draw.sign() * normal[1].hypot(normal[2]) + nudge(draw);
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // An edge in the plane t = 0, the origin line on it or next to it.
        let mut triangle = Triangle::any(draw);
        triangle.vertices[0][0] = 0.0;
        triangle.vertices[1][0] = 0.0;
        let x = nudge(draw);
        triangle.with_line_at(x, draw)
    },
    |draw| {
        let mut triangle = Triangle::any(draw);
        triangle.vertices[0][1] = 0.0;
        triangle.vertices[1][1] = 0.0;
        triangle.view[1] = 0.0;
        triangle
    },
    |draw| {
        // Slivers.
        let mut triangle = Triangle::any(draw);
        let [a, b, _] = triangle.vertices;
        let part = draw.between(0.0, 1.0);
        let width = draw.log_between(1e-7, 1e-3);
        let offset = draw.direction(-1.0, 1.0);
        triangle.vertices[2] = [0, 1, 2].map(|k| a[k] + part * (b[k] - a[k]) + width * offset[k]);
        let x = unit(triangle.vertices[2])[0];
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // Repeated and collinear vertices.
        let mut triangle = Triangle::any(draw);
        let [a, b, _] = triangle.vertices;
        triangle.vertices[2] = match draw.one_of(&[0.0, 1.0, 2.0]) as usize {
            0 => a,
            1 => [0, 1, 2].map(|k| 0.5 * (a[k] + b[k])),
            _ => [0, 1, 2].map(|k| 2.0 * b[k] - a[k]),
        };
        let x = unit(a)[0];
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // The shaded point in the plane of the triangle, to rounding or nearly, or at a vertex.
        let mut triangle = Triangle::any(draw);
        let [a, b, _] = triangle.vertices;
        let (u, v) = (draw.between(-1.0, 2.0), draw.between(-1.0, 2.0));
        triangle.vertices[2] = [0, 1, 2].map(|k| u * a[k] + v * b[k] + nudge(draw));
        if draw.between(0.0, 1.0) < 0.1 {
            triangle.vertices[2] = [0.0; 3];
        }
        triangle
    },
    |draw| {
        // Below the horizon, a vertex or an edge on it.
        let size = draw.log_between(1e-2, 2.0);
        let centre = draw.direction(-1.0, 0.0);
        let mut triangle = Triangle::at(draw, centre, size).each(|[x, y, z]| [x, y, -z.abs()]);
        let high = draw.one_of(&[-1e-3, 0.0, 0.0, 6e-8, 1e-4]);
        triangle.vertices[0][2] = high;
        if draw.sign() > 0.0 {
            triangle.vertices[1][2] = high;
        }
        triangle
    },
    |draw| {
        let size = draw.log_between(0.1, 2.0);
        let centre = draw.direction(-0.3 * size.min(1.0), 0.3 * size.min(1.0));
        let triangle = Triangle::at(draw, centre, size);
        let x = unit(triangle.vertices[0])[0];
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // Around the zenith, or the nadir with corners above the horizon.
        let side = draw.sign();
        let turn = draw.between(0.0, 6.3);
        let mut triangle = Triangle::any(draw);
        for (k, vertex) in triangle.vertices.iter_mut().enumerate() {
            let angle = turn + 2.1 * k as f64 + draw.between(-0.5, 0.5);
            let z = draw.one_of(&[1e-3, 0.01, 0.3, -0.2]);
            *vertex = [angle.cos(), angle.sin(), if side > 0.0 { z.abs() } else { z }];
        }
        triangle
    },
    |draw| {
        // Grazing views and lights.
        let centre = draw.direction(0.0, 0.0018);
        let [x, y, _] = draw.direction(0.0, 0.0018);
        let size = draw.log_between(1e-3, 0.3);
        Triangle { view: [x, y], ..Triangle::at(draw, centre, size) }
    },
    |draw| {
        let triangle = Triangle { kw: draw.log_between(500.0, 6283.0), ..Triangle::any(draw) };
        let x = unit(triangle.vertices[0])[0] + nudge(draw);
        triangle.with_line_at(x, draw)
    },
    |draw| {
        let centre = draw.direction(0.05, 1.0);
        let size = draw.log_between(1e-5, 1e-3);
        let triangle = Triangle::at(draw, centre, size);
        let x = unit(triangle.vertices[0])[0] + 0.5 * size * draw.between(-1.0, 1.0);
        triangle.with_line_at(x, draw)
    },
    |draw| {
        let scale = draw.log_between(1e-6, 1e6);
        let triangle = Triangle::any(draw).each(|vertex| vertex.map(|component| scale * component));
        let x = unit(triangle.vertices[0])[0];
        triangle.with_line_at(x, draw)
    },
    |draw| {
        // A vertex at the origin of the lobe: q = 0 and an end of an edge at once.
        let triangle = Triangle::any(draw);
        let [x, y, _] = unit(triangle.vertices[0]);
        Triangle { view: [-x + nudge(draw), -y], ..triangle }
    },
    |draw| {
        // An edge from one side of the horizon to the other through a slice of next to no length.
        let mut triangle = Triangle::any(draw);
        let side = draw.sign();
        triangle.vertices[0] = [side, nudge(draw), draw.between(-0.1, 0.1)];
        triangle.with_line_at(side * (1.0 - draw.log_between(1e-7, 1e-2)), draw)
    },
];

fn triangles() -> Table {
    let mut draw = Draw::new(32);
    let rows: Vec<[f64; 13]> = TRIANGLES
        .iter()
        .flat_map(|kind| (0..EACH).map(|_| kind(&mut draw).row()).collect::<Vec<_>>())
        .collect();
    table(TRIANGLE, &rows, "hard triangles")
}
