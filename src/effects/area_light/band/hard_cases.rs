//! Bands that have broken implementations.

use std::f64::consts::{PI, TAU};

use super::regions::table;
use crate::effect::{Region, Yardstick, points};
use crate::table::Table;

/// The hard cases, as registered.
pub(crate) const HARD_CASES: Region = Region {
    name: "hard bands",
    description: "pairs of bounds among 0, subnormals, multiples of pi with their neighbours in f32, the \
                  branch switches of forms and |x| to 1e5; about one period wide; a few ulp wide; across 0 \
                  and mirrored; in either order.",
    points: hard_cases,
    yardstick: Yardstick::MaxRelative,
    ..Region::EMPTY
};

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
