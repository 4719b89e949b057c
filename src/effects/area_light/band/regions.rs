//! Where band forms are judged, and the points on which they are fitted: every lobe to n = 1000, bands
//! as scenes make them, narrow bands, and bands that have broken implementations.
//!
//! Every bound is an f32, so that a form in f32 and the reference in f64 see the same band.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use super::sinc_squared_band;
use crate::effect::{Points, points};
use crate::table::{Column, Table};

/// Highest order of the lobes judged.
const LAST_LOBE: u32 = 1000;

/// Regions of bands, by name: points that are judged and that are fitted.
pub(crate) const REGIONS: &[(&str, Points, Option<Points>)] = &[
    ("lobes", lobes, None),
    ("scene bands", || scene_bands(27, 6000), Some(|| weighted(scene_bands(1827, 6000)))),
    ("narrow bands", narrow, None),
];

/// Hard cases of bands, by name.
pub(crate) const HARD_CASES: &[(&str, Points)] = &[("hard bands", hard_cases)];

fn lobes() -> Table {
    let bands = (0..=LAST_LOBE).flat_map(|n| {
        let start = TAU * f64::from(n);
        let spans = [(start, start + TAU), (start, start + PI), (start + PI, start + TAU)];
        spans.into_iter().flat_map(|(a, b)| [(a, b), (b, a), (-b, -a), (-a, -b)])
    });
    table(bands.collect(), "lobes and half lobes")
}

/// Ends of a light of random size and place, from the eye's point of view, times kW.
fn scene_bands(seed: u64, count: usize) -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let bands = (0..count).map(|_| {
        let width_um = rng.random_range(0.8..6.0);
        let wavelength_um = rng.random_range(0.38..0.78);
        let size_rad = 0.1_f64.to_radians() * 900_f64.powf(rng.random());
        let half_rad = 0.5 * size_rad;
        let light_rad = rng.random_range(half_rad - 0.5 * PI..0.5 * PI - half_rad);
        let eye_rad = rng.random_range(-0.5 * PI..0.5 * PI);
        let per_q = TAU / wavelength_um * width_um;
        let x = |edge_rad: f64| per_q * (core_math::sin(edge_rad) + core_math::sin(eye_rad));
        (x(light_rad - half_rad), x(light_rad + half_rad))
    });
    table(bands.collect(), "seeded draws of W, wavelength, light and eye")
}

fn narrow() -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(3);
    let bands = (0..6000).map(|i| {
        let width = 1e-3 * 1e3_f64.powf(rng.random());
        let order = (1001_f64.powf(rng.random()) - 1.0).floor();
        let from_zero = match i % 3 {
            0 => rng.random_range(-width..width),
            1 => PI,
            _ => rng.random_range(-PI..PI),
        };
        let middle = TAU * order + from_zero;
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        (side * (middle - 0.5 * width), side * (middle + 0.5 * width))
    });
    table(bands.collect(), "seeded draws of width and place")
}

/// Bounds that have broken implementations, then bands of a few ulp, then bands of one period.
pub(super) fn hard_cases() -> Table {
    let bounds = bounds();
    let mut bands = Vec::new();
    for (i, &a) in bounds.iter().enumerate() {
        bands.push((-a, a));
        bands.push((0.0, a));
        bands.push((a, 0.0));
        // Every bound against a fifth of the others, so that all pairs of kinds occur.
        for &b in bounds.iter().skip(i % 5).step_by(5) {
            bands.extend([(a, b), (-a, b)]);
        }
    }
    for n in [0, 1, 2, 5, 10, 100, 1000, 10_000, 15_000] {
        for quarter in 0..4 {
            let start = (TAU * f64::from(n) + 0.5 * PI * f64::from(quarter)) as f32;
            for ulps in [1, 2, 7, 100] {
                let end = f32::from_bits(start.to_bits() + ulps);
                bands.extend([
                    (f64::from(start), f64::from(end)),
                    (-f64::from(start), -f64::from(end)),
                ]);
            }
            for width in [PI, TAU - 1e-3, TAU, TAU + 1e-3, 2.0 * TAU] {
                let (start, end) = (f64::from(start), f64::from(start) + width);
                bands.extend([(start, end), (-start, -end), (start - width, start)]);
            }
        }
    }
    table(bands, "hard bands")
}

fn bounds() -> Vec<f64> {
    let mut bounds: Vec<f32> =
        vec![0.0, 1e-45, 1e-40, f32::MIN_POSITIVE, 1e-30, 1e-10, 1e-5, 1e-3, 0.1];
    bounds.extend([1.0, 2.0, 3.0, 4.0, 10.0, 1e3, 1e5]);
    for n in [1, 2, 3, 4, 5, 20, 200, 1999, 2000, 31_830] {
        bounds.extend(points::neighbours(PI * f64::from(n)));
    }
    bounds.into_iter().map(f64::from).collect()
}

/// A table of bounds, rounded to f32; a band that rounding closes is left out.
pub(super) fn table(bands: Vec<(f64, f64)>, origin: &str) -> Table {
    let open = bands.into_iter().filter(|&(a, b)| a as f32 != b as f32);
    let rows: Vec<[f64; 2]> = open.map(|(a, b)| [a, b]).collect();
    let columns = [("x0", "rad"), ("x1", "rad")];
    points::rounded(points::of_rows(columns, &rows, format!("band: {origin}")))
}

/// With a column of weights 1/B², so that squared residuals are relative.
fn weighted(mut table: Table) -> Table {
    let [x0, x1] = [0, 1].map(|at| table.columns[at].values.clone());
    let weights = x0.iter().zip(&x1).map(|(&a, &b)| sinc_squared_band(a, b).powi(-2)).collect();
    table.columns.push(Column::new("weight", "1", weights));
    table
}
