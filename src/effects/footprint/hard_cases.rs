//! Points that have broken implementations.

use crate::effect::{Region, points};
use crate::table::Table;

use super::pixels::Footprint;
use super::regions::table;

/// Sets of hard cases.
pub(super) const HARD_CASES: &[Region] = &[
    Region {
        name: "hard cases",
        description: "h = 0 and tiny, s = 0, on the rim, next to it, far outside, up to h = 1000; \
                      circles, and ellipses tilted by 60 and 89 degrees that are thin across the \
                      scratch and large in area",
        points: infinite,
        ..Region::EMPTY
    },
    Region {
        name: "hard ends",
        description: "ends on the rim, at the centre, far away on both sides; chords of no length \
                      and of 1000 sigma, tilts to 89 degrees",
        points: ends,
        ..Region::EMPTY
    },
];

/// Half-extents of the hard cases.
pub(super) const HALF_EXTENTS: [f64; 20] = [
    0.0, 1e-30, 1e-15, 1e-6, 1e-3, 0.05, 0.1, 0.5, 1.0, 1.41, 1.42, 2.0, 2.65, 5.0, 10.0, 30.0,
    80.0, 100.0, 300.0, 1000.0,
];

/// Offsets that are hard for `h`.
pub(super) fn offsets(h: f64) -> Vec<f64> {
    let mut offsets = vec![0.0, 1e-30, 1e-6, 0.3 * h, 0.5 * h, 0.9 * h, 0.99 * h];
    offsets.extend(points::neighbours(h).map(f64::from).map(f64::abs));
    offsets.extend([1e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 15.0, 30.0, 1e3, 1e6].map(|d| h + d));
    offsets
}

fn infinite() -> Table {
    let mut rows = Vec::new();
    for h in HALF_EXTENTS {
        for tilt in [0.0_f64, 60.0, 89.0] {
            // Tilted along the scratch: thin across it, 1/cos as long along it.
            let area_ratio = h * h / tilt.to_radians().cos();
            for s in offsets(h) {
                rows.extend([[h, s, area_ratio], [h, -s, area_ratio]]);
            }
        }
    }
    table(["h", "s", "area_ratio"], &rows, "hard cases")
}

fn ends() -> Table {
    let mut rows = vec![[0.0; 5], [0.0, 0.0, 0.0, 0.5, 1.0], [0.0, 2.0, 0.0, 0.5, 1.0]];
    for across in [1e-3, 0.5, 1.0, 5.0] {
        for tilt in [0.0_f64, 60.0, 89.0] {
            for angle in [0.0_f64, 0.4, 1.5] {
                let f = Footprint::new(across, tilt.to_radians(), angle);
                for offset in [0.0, 0.7, 1.0, 1.2].map(|part| part * f.half_extent) {
                    let centre = f.shear * (offset / f.half_extent);
                    let rim = f.half_length;
                    let near = [-rim, 0.0, rim].map(|along| centre + along);
                    for end in near.into_iter().chain([centre - 2e3, centre + 2e3]) {
                        rows.push([f.half_extent, f.half_length, f.shear, offset, end]);
                    }
                }
            }
        }
    }
    table(["half_extent", "half_length", "shear", "offset", "end"], &rows, "hard ends")
}
