//! Limits and symmetries of the references.

use std::f64::consts::{PI, TAU};

use super::vector::{cross, length};
use super::{polygon_light, sphere_light};
use crate::effects::area_light::band::sinc_squared_band;

fn relative(got: f64, expected: f64) -> f64 {
    ((got - expected) / expected).abs()
}

/// Relative error that the documentation of the references states.
const STATED: f64 = 1e-9;

/// With a wide lobe (kw, ks → 0) the integral is the projected solid angle of the light.
#[test]
fn projected_solid_angle() {
    let distance = (1.2_f64.powi(2) + 0.5_f64.powi(2) + 1.7_f64.powi(2)).sqrt();
    let sine: f64 = 0.3;
    let cases = [
        // A sphere overhead: π sin²α.
        ([0.0; 2], [0.0, 0.0, 2.0], 1.0, PI / 4.0, 1e-10),
        // A tilted one, all above the horizon: π sin²α cos θ.
        ([0.3, 0.1], [1.2, 0.5, 1.7], 0.4, PI * (0.4 / distance).powi(2) * 1.7 / distance, 1e-10),
        // From inside: the whole disc.
        ([0.0; 2], [0.1, 0.0, -0.2], 1.0, PI, 1e-10),
        // Half of one whose centre lies on the horizon: measured by Lambert's formula below.
        ([0.0; 2], [1.0, 0.0, 0.0], sine, sine.asin() - sine * (1.0 - sine * sine).sqrt(), 1e-9),
    ];
    for (view, centre, radius, expected, tolerance) in cases {
        let value = sphere_light(1e-6, 1e-6, view, centre, radius).unwrap();
        assert!(relative(value, expected) < tolerance, "{value} {expected}");
    }
}

/// Lambert's formula: ½ Σ (angle of the edge) (n·Γ) for a polygon above the horizon.
#[test]
fn polygon_projected_solid_angle() {
    let vertices = [[0.5, -0.2, 1.0], [1.5, 0.3, 0.8], [0.4, 0.9, 1.3], [-0.2, 0.5, 1.237]];
    let mut lambert = 0.0;
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        let cross = cross(*a, *b);
        let length = length(cross);
        let dot = a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        lambert += 0.5 * length.atan2(dot) * cross[2] / length;
    }
    let value = polygon_light(1e-6, 1e-6, [0.1, 0.2], &vertices).unwrap();
    assert!(relative(value, lambert.abs()) < 1e-9, "{value} {lambert}");
}

/// Both ways around, any first vertex, mirrored in t and in b.
#[test]
fn symmetries_of_polygons() {
    let (kw, ks, view) = (40.0, 60.0, [0.1, -0.2]);
    let vertices = [[0.5, -0.2, 0.6], [-1.5, 0.3, 0.8], [0.4, 0.9, -0.3]];
    let value = polygon_light(kw, ks, view, &vertices).unwrap();
    let mut turned = vertices;
    turned.rotate_left(1);
    let mut reversed = turned;
    reversed.reverse();
    let same = [
        (view, turned),
        (view, reversed),
        ([-0.1, -0.2], vertices.map(|[x, y, z]| [-x, y, z])),
        ([0.1, 0.2], vertices.map(|[x, y, z]| [x, -y, z])),
    ];
    for (view, vertices) in same {
        assert!(relative(polygon_light(kw, ks, view, &vertices).unwrap(), value) < 1e-9);
    }
}

/// A polygon cut in two parts is the sum of the parts, with edges across the origin line.
#[test]
fn polygons_add() {
    let (kw, ks, view) = (300.0, 500.0, [-0.05, 0.1]);
    let [a, b, c, d] = [[-0.4, -0.5, 1.0], [0.6, -0.5, 1.0], [0.6, 0.5, 1.0], [-0.4, 0.5, 1.0]];
    let whole = polygon_light(kw, ks, view, &[a, b, c, d]).unwrap();
    let parts = polygon_light(kw, ks, view, &[a, b, c]).unwrap()
        + polygon_light(kw, ks, view, &[a, c, d]).unwrap();
    assert!(relative(parts, whole) < 1e-9, "{parts} {whole}");
}

/// Nothing is seen of lights below the surface and of polygons seen edge-on.
#[test]
fn dark() {
    assert_eq!(sphere_light(10.0, 10.0, [0.0; 2], [0.0, 0.0, -2.0], 1.0), Ok(0.0));
    assert_eq!(sphere_light(10.0, 10.0, [0.0; 2], [2.0, 1.0, -2.0], 1.9), Ok(0.0));
    let below = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0]];
    assert_eq!(polygon_light(10.0, 10.0, [0.0; 2], &below), Ok(0.0));
    let edge_on = [[0.5, 0.0, 1.0], [1.0, 0.0, 2.0], [1.0, 0.0, 1.0]];
    assert_eq!(polygon_light(10.0, 10.0, [0.0; 2], &edge_on), Ok(0.0));
}

#[test]
fn what_is_refused() {
    assert!(sphere_light(0.0, 1.0, [0.0; 2], [0.0, 0.0, 1.0], 0.1).is_err());
    assert!(sphere_light(1.0, f64::NAN, [0.0; 2], [0.0, 0.0, 1.0], 0.1).is_err());
    assert!(sphere_light(1.0, 1.0, [0.0; 2], [0.0, 0.0, 1.0], -0.1).is_err());
    assert!(sphere_light(1.0, 1.0, [0.0; 2], [0.0, f64::INFINITY, 1.0], 0.1).is_err());
    assert!(polygon_light(1.0, 1.0, [0.0; 2], &[[0.0; 3]; 2]).is_err());
    assert!(polygon_light(1.0, 1.0, [0.0, f64::NAN], &[[0.0; 3]; 3]).is_err());
}

/// An edge through the lobe, aslant, and a vertex to either side of it: two triangles, or one
/// quadrilateral.
const HALVES: [[f64; 3]; 4] =
    [[-0.01, -0.5, 1.0], [0.02, 0.6, 0.9], [0.7, 0.1, 1.1], [-0.6, 0.05, 0.95]];

/// At the largest kW and kσ of scenes, against scaled values: a band across a narrow lobe, half of it where
/// an edge lies along the origin line, and parts against the whole.
#[test]
fn extreme_lobes() {
    let (mut bands, mut parts) = (0.0_f64, 0.0_f64);
    for kw in [6e3, 6e5] {
        for ks in [6e3, 6e5, 6e6] {
            let across =
                |from: f64, to: f64| PI.sqrt() / ks * sinc_squared_band(kw * from, kw * to) / kw;
            let sphere = sphere_light(kw, ks, [0.0; 2], [0.0, 0.0, 1.0], 0.3).unwrap();
            let error = relative(sphere, across(-0.3, 0.3));
            assert!(error <= STATED, "kw {kw} ks {ks}: sphere {error:e}");
            bands = bands.max(error);
            let edge = [[0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
            let half = polygon_light(kw, ks, [0.0; 2], &edge).unwrap();
            let error = relative(half, 0.5 * across(-0.5_f64.sqrt(), 0.5_f64.sqrt()));
            println!("kw {kw} ks {ks}: half {error:e}");
            // One side of the lobe sees the tail 4/(kw y) change in the first order: 1/ks of it.
            assert!(error <= STATED + 4.0 / kw / ks, "kw {kw} ks {ks}: half {error:e}");
            let [a, b, c, d] = HALVES;
            let light = |vertices: &[[f64; 3]]| polygon_light(kw, ks, [0.0; 2], vertices);
            let whole = light(&[a, c, b, d]).unwrap();
            let cut = light(&[a, b, c]).unwrap() + light(&[a, b, d]).unwrap();
            parts = parts.max(relative(cut, whole));
        }
    }
    println!("band {bands:.1e}, parts {parts:.1e}");
    // Every part has an error of its own; k sigma times the rounding of xi_1 is 7e-10.
    assert!(parts <= 4.0 * STATED, "{parts:e}");
}

/// A wide lobe that a wide scratch makes narrow along: sinc² is 2π/kW δ(ξ₂), to 1/kW.
#[test]
fn wide_lobes_are_right_or_refused() {
    let (kw, half) = (6e5, 0.3);
    for ks in [1.0, 30.0] {
        let steps = 2000;
        let gaussian = |i: i32| (-(ks * half * f64::from(i) / f64::from(steps)).powi(2)).exp();
        let middle: f64 = (1..steps).map(gaussian).sum();
        let whole =
            2.0 * half / f64::from(steps) * (0.5 * (gaussian(0) + gaussian(steps)) + middle);
        match sphere_light(kw, ks, [0.0; 2], [0.0, 0.0, 1.0], half) {
            Ok(value) => {
                let error = (value / (TAU / kw * whole) - 1.0).abs();
                println!("ks {ks}: {error:.1e}");
                assert!(error <= 20.0 / kw, "ks {ks}: {error:e}");
            }
            Err(error) => println!("ks {ks}: {error}"),
        }
    }
}

#[test]
fn numbers_that_overflow_are_refused() {
    let huge = 1.7e308;
    assert!(sphere_light(10.0, 10.0, [0.0; 2], [huge, -huge, huge], 1.0).is_err());
    let vertices = [[0.5, -0.2, 1.0], [1.5, 0.3, 0.8], [0.4, 0.9, 1.3]];
    let value = polygon_light(10.0, 10.0, [0.0; 2], &vertices);
    for scale in [2.0_f64.powi(-600), 2.0_f64.powi(600)] {
        let scaled = vertices.map(|vertex| vertex.map(|v| scale * v));
        assert_eq!(polygon_light(10.0, 10.0, [0.0; 2], &scaled), value);
    }
}
