//! Where band forms are judged, and the points on which they are fitted: every lobe to n = 1000, bands
//! as scenes make them, and narrow bands.
//!
//! Every bound is an f32, so that a form in f32 and the reference in f64 see the same band.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use super::sinc_squared_band;
use crate::effect::{Region, Yardstick, points};
use crate::table::{Column, Table};

/// Highest order of the lobes judged.
const LAST_LOBE: u32 = 1000;

/// Every lobe and half lobe.
pub(crate) const LOBES: Region = Region {
    name: "lobes",
    description: "x0 to x1 over [2 pi n, 2 pi (n + 1)], its first and its second half, n = 0 ... 1000, on \
                  both sides of 0 and in either order of the bounds (12012 bands).",
    points: lobes,
    yardstick: Yardstick::MaxRelative,
    ..Region::EMPTY
};

/// Bands of lights.
pub(crate) const SCENE_BANDS: Region = Region {
    name: "scene bands",
    description: "x = k W q as scenes reach it: widths W of 0.8 to 6 um and wavelengths of 380 to 780 nm, \
                  uniform; lights of 0.1 to 90 degrees, log-uniform, anywhere in the plane of incidence, \
                  the eye likewise (6000 draws; 6000 others are fitted, each weighted by 1/B^2, so that \
                  the relative error counts).",
    points: || scene_bands(27, 6000),
    fitted: Some(|| weighted(scene_bands(1827, 6000))),
    yardstick: Yardstick::MaxRelative,
    ..Region::EMPTY
};

/// Bands that are narrow beside a period.
pub(crate) const NARROW: Region = Region {
    name: "narrow bands",
    description: "widths of 1e-3 to 1 rad about zeros 2 pi n, crests and anywhere, |x| to 6.3e3, \
                  log-uniform (6000 draws).",
    points: narrow,
    yardstick: Yardstick::MaxRelative,
    ..Region::EMPTY
};

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
