//! Where the forms are judged: footprints of cameras, every half-extent, scratches that end, and points
//! that have broken implementations.
//!
//! Offsets go a little past the rim, to h + [`MARGIN`], with either sign. Errors are relative in the L2
//! norm over the offsets of one footprint: an image shows one footprint per pixel and scratches at
//! every offset. The weights that fits use are the reciprocal of what the response sums to over a
//! footprint, so that every footprint counts alike; for the coverage they are the same to a factor
//! between 1 and √2.

use crate::effect::{Points, points};
use crate::numeric::statistics::sum;
use crate::table::Table;

use super::end::{ScratchEnd, response_at_end};
use super::pixels::{Footprint, of_cameras};
use super::reference::response;

/// How far past the rim the offsets go, σ: the response is below e⁻²⁰ there, the coverage below e⁻¹⁰.
const MARGIN: f64 = 4.5;

/// Regions of the effect, by name: points that are judged and that are fitted.
pub(super) const REGIONS: &[(&str, Points, Option<Points>)] = &[
    ("camera", || camera(300, 32, 41, 0.5), Some(|| camera(400, 24, 42, 0.25))),
    ("every half-extent", || circles(&equal_ratios(0.05, 30.0, 41), 96, 0.5), Some(mixed)),
    ("scratch ends", || ends(60, 64, 43), Some(|| ends(60, 64, 44))),
];

/// Hard cases, by name.
pub(super) const HARD_CASES: &[(&str, Points)] =
    &[("hard cases", hard_cases), ("hard ends", hard_ends)];

/// `count` numbers in equal ratios, ends included.
pub(super) fn equal_ratios(from: f64, to: f64, count: u32) -> Vec<f64> {
    let step = (to / from).ln() / f64::from(count - 1);
    (0..count).map(|i| from * (step * f64::from(i)).exp()).collect()
}

/// `count` offsets in [0, h + margin] in equal steps, `phase` of a step from the start, of alternate
/// sign.
pub(super) fn spaced_offsets(
    half_extent: f64,
    count: u32,
    phase: f64,
) -> impl Iterator<Item = f64> {
    let step = (half_extent + MARGIN) / f64::from(count);
    (0..count).map(move |i| {
        let offset = (f64::from(i) + phase) * step;
        if i % 2 == 0 { offset } else { -offset }
    })
}

fn camera(pixels: usize, count: u32, seed: u64, phase: f64) -> Table {
    let footprints = of_cameras(seed).take(pixels).map(|f| (f.half_extent, f.area_ratio()));
    infinite(footprints, count, phase, "footprints of cameras, seeded draws")
}

fn circles(half_extents: &[f64], count: u32, phase: f64) -> Table {
    let circles = half_extents.iter().map(|&h| (h, h * h));
    infinite(circles, count, phase, "circular footprints")
}

/// Pixels of cameras and half-extents in equal ratios, with half of the weight each.
fn mixed() -> Table {
    const PIXELS: usize = 400;
    const CIRCLES: u32 = 48;
    let mut all = circles(&equal_ratios(0.045, 33.0, CIRCLES), 72, 0.25);
    let share = f64::from(CIRCLES) / PIXELS as f64;
    for (column, pixels) in all.columns.iter_mut().zip(camera(PIXELS, 24, 42, 0.25).columns) {
        let scale = if column.name == "weight" { share } else { 1.0 };
        column.values.extend(pixels.values.iter().map(|value| value * scale));
    }
    all.origin = "circles and footprints of cameras of footprint".to_owned();
    all
}

/// Offsets of every (h, A_P/A_C), with the weight of the footprint.
fn infinite(
    footprints: impl Iterator<Item = (f64, f64)>,
    count: u32,
    phase: f64,
    origin: &str,
) -> Table {
    let mut rows = Vec::new();
    for (h, area_ratio) in footprints {
        let offsets: Vec<f64> = spaced_offsets(h, count, phase).collect();
        let weight = weight(offsets.iter().map(|&s| response(h, s).unwrap_or(f64::NAN)));
        rows.extend(offsets.iter().map(|&s| [h, s, area_ratio, weight]));
    }
    table(["h", "s", "area_ratio", "weight"], &rows, origin)
}

fn ends(footprints: usize, count: u32, seed: u64) -> Table {
    let small = |f: &Footprint| f.half_extent <= 30.0;
    let mut rows = Vec::new();
    // R2, Roberts' sequence of low discrepancy in the plane, from the seed.
    let start = seed as f64;
    for f in of_cameras(seed).filter(small).take(footprints) {
        let reach = f.half_length.hypot(f.shear) + 2.0;
        let scratches: Vec<ScratchEnd> = (0..count)
            .map(|i| {
                let place = |ratio: f64| 2.0 * ((start + f64::from(i)) * ratio).fract() - 1.0;
                ScratchEnd {
                    half_extent: f.half_extent,
                    half_length: f.half_length,
                    shear: f.shear,
                    offset: place(0.754_877_666_246_692_8) * (f.half_extent + 2.0),
                    end: place(0.569_840_290_998_053_3) * reach,
                }
            })
            .collect();
        let weight = weight(scratches.iter().map(|&e| response_at_end(e).unwrap_or(f64::NAN)));
        let row = |e: &ScratchEnd| [e.half_extent, e.half_length, e.shear, e.offset, e.end, weight];
        rows.extend(scratches.iter().map(row));
    }
    let names = ["half_extent", "half_length", "shear", "offset", "end", "weight"];
    table(names, &rows, "scratches that end, seeded draws")
}

/// 1 / Σ values².
fn weight(values: impl Iterator<Item = f64>) -> f64 {
    1.0 / sum(values.map(|v| v * v))
}

/// A table of pure numbers.
pub(super) fn table<const N: usize>(names: [&str; N], rows: &[[f64; N]], origin: &str) -> Table {
    points::of_rows(names.map(|name| (name, "1")), rows, format!("{origin} of footprint"))
}

/// Half-extents of the hard cases.
pub(super) const HALF_EXTENTS: [f64; 20] = [
    0.0, 1e-30, 1e-15, 1e-6, 1e-3, 0.05, 0.1, 0.5, 1.0, 1.41, 1.42, 2.0, 2.65, 5.0, 10.0, 30.0,
    80.0, 100.0, 300.0, 1000.0,
];

/// Offsets that are hard for `h`.
pub(super) fn hard_offsets(h: f64) -> Vec<f64> {
    let mut offsets = vec![0.0, 1e-30, 1e-6, 0.3 * h, 0.5 * h, 0.9 * h, 0.99 * h];
    offsets.extend(points::neighbours(h).map(f64::from).map(f64::abs));
    offsets.extend([1e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 15.0, 30.0, 1e3, 1e6].map(|d| h + d));
    offsets
}

fn hard_cases() -> Table {
    let mut rows = Vec::new();
    for h in HALF_EXTENTS {
        for tilt in [0.0_f64, 60.0, 89.0] {
            // Tilted along the scratch: thin across it, 1/cos as long along it.
            let area_ratio = h * h / tilt.to_radians().cos();
            for s in hard_offsets(h) {
                rows.extend([[h, s, area_ratio], [h, -s, area_ratio]]);
            }
        }
    }
    table(["h", "s", "area_ratio"], &rows, "hard cases")
}

fn hard_ends() -> Table {
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

#[cfg(test)]
mod tests {
    use super::super::EFFECT;
    use super::*;

    #[test]
    fn regions_hold_what_their_descriptions_say() {
        for region in EFFECT.regions {
            let (points, fitted) = ((region.points)(), (region.fitted.expect("points to fit"))());
            for table in [&points, &fitted] {
                let mut values = table.columns.iter().flat_map(|column| &column.values);
                assert!(values.all(|v| v.is_finite()), "{}", region.name);
            }
            assert_ne!(points, fitted, "{}", region.name);
        }
        let h = camera(300, 1, 41, 0.5);
        let mut h = h.column("h").expect("a column").values.clone();
        h.sort_by(f64::total_cmp);
        // 0.556 and 986 measured: pixels smaller and much larger than the coherence area.
        assert!(h[0] < 0.6 && h[299] > 900.0, "{} {}", h[0], h[299]);
    }
}
