//! Monte Carlo over a light: the second method, which knows nothing of slices or bands.
//!
//! Samples are drawn from ChaCha12 streams, so that an estimate depends on its seed and stream
//! only. Spheres are sampled uniformly in the solid angle of their cone, polygons uniformly in area over
//! a rectangle around them in their own plane, with the even–odd rule and the geometry term.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// A mean with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Estimate {
    /// Mean of the samples.
    pub(crate) mean: f64,
    /// Standard error of the mean.
    pub(crate) standard_error: f64,
}

/// Samples to draw: how many, and from which stream of which seed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Draws {
    /// Number of samples, at least 2.
    pub(crate) count: u32,
    /// Seed of the generator.
    pub(crate) seed: u64,
    /// Stream of the generator.
    pub(crate) stream: u64,
}

/// Estimate of the sphere light (`striae::effects::area_light::sphere_light`).
pub(crate) fn sphere_light(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    centre: [f64; 3],
    radius: f64,
    draws: Draws,
) -> Estimate {
    let distance = norm(centre);
    if distance <= radius {
        // All around: uniformly in the disc of direction cosines.
        return draws.estimate(|rng| {
            let (reach, turn) = (rng.random::<f64>().sqrt(), TAU * rng.random::<f64>());
            PI * lobe(kw, ks, view, reach * turn.cos(), reach * turn.sin())
        });
    }
    let axis = centre.map(|component| component / distance);
    let [across, up] = tangents(axis);
    let sine = radius / distance;
    let depth = sine * sine / (1.0 + ((1.0 - sine) * (1.0 + sine)).sqrt());
    draws.estimate(|rng| {
        let drop = depth * rng.random::<f64>();
        let turn = TAU * rng.random::<f64>();
        let reach = (drop * (2.0 - drop)).sqrt();
        let direction = [0, 1, 2].map(|k| {
            (1.0 - drop) * axis[k] + reach * (turn.cos() * across[k] + turn.sin() * up[k])
        });
        TAU * depth * lobe(kw, ks, view, direction[0], direction[1]) * direction[2].max(0.0)
    })
}

/// Estimate of the polygon light (`striae::effects::area_light::polygon_light`).
pub(crate) fn polygon_light(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    vertices: &[[f64; 3]],
    draws: Draws,
) -> Estimate {
    let Some(&origin) = vertices.first() else {
        return Estimate { mean: 0.0, standard_error: 0.0 };
    };
    let mut normal = [0.0; 3];
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        let part = cross(difference(*a, origin), difference(*b, origin));
        normal = [0, 1, 2].map(|k| normal[k] + part[k]);
    }
    let length = norm(normal);
    let normal = normal.map(|component| component / length);
    let [right, up] = tangents(normal);
    let plane: Vec<[f64; 2]> = vertices
        .iter()
        .map(|vertex| [right, up].map(|axis| dot(difference(*vertex, origin), axis)))
        .collect();
    let [low, high] = [f64::min, f64::max].map(|pick: fn(f64, f64) -> f64| {
        [0, 1].map(|k| plane.iter().map(|point| point[k]).fold(plane[0][k], pick))
    });
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    draws.estimate(|rng| {
        let point = [0, 1].map(|k| low[k] + (high[k] - low[k]) * rng.random::<f64>());
        if !inside(&plane, point) {
            return 0.0;
        }
        let place = [0, 1, 2].map(|k| origin[k] + point[0] * right[k] + point[1] * up[k]);
        let distance = norm(place);
        let direction = place.map(|component| component / distance);
        let solid_angle = area * dot(normal, direction).abs() / (distance * distance);
        solid_angle * lobe(kw, ks, view, direction[0], direction[1]) * direction[2].max(0.0)
    })
}

impl Draws {
    fn estimate(self, mut sample: impl FnMut(&mut ChaCha12Rng) -> f64) -> Estimate {
        let mut rng = ChaCha12Rng::seed_from_u64(self.seed);
        rng.set_stream(self.stream);
        // Welford's recurrence.
        let (mut mean, mut squares) = (0.0, 0.0);
        for index in 1..=self.count {
            let value = sample(&mut rng);
            let before = value - mean;
            mean += before / f64::from(index);
            squares += before * (value - mean);
        }
        let count = f64::from(self.count);
        Estimate { mean, standard_error: (squares / (count - 1.0) / count).sqrt() }
    }
}

/// exp(−ks² ξ₁²) sinc²(kw ξ₂/2) for light from a direction with the given tangential parts.
fn lobe(kw: f64, ks: f64, view: [f64; 2], x: f64, y: f64) -> f64 {
    let exponent = ks * (x + view[0]);
    let phase = 0.5 * kw * (y + view[1]);
    let sinc = if phase == 0.0 { 1.0 } else { phase.sin() / phase };
    (-exponent * exponent).exp() * sinc * sinc
}

/// Even–odd rule in the plane.
fn inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let crossed = edges.filter(|(a, b)| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Two unit vectors that make a right-handed frame with the unit vector `n` (Duff et al. 2017).
fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let sign = 1.0_f64.copysign(n[2]);
    let a = -1.0 / (sign + n[2]);
    let b = n[0] * n[1] * a;
    [[1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]], [b, sign + n[1] * n[1] * a, -n[1]]]
}

fn norm(a: [f64; 3]) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
