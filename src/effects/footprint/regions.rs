//! Where the forms are judged: footprints of cameras, every half-extent, and scratches that end.
//!
//! Offsets go a little past the rim, to h + [`MARGIN`], with either sign. Errors are relative in the L2
//! norm over the offsets of one footprint: an image shows one footprint per pixel and scratches at
//! every offset. The weights that fits use are the reciprocal of what the response sums to over a
//! footprint, so that every footprint counts alike; for the coverage they are the same to a factor
//! between 1 and √2.

use crate::effect::{Region, Yardstick, points};
use crate::numeric::statistics::sum;
use crate::table::Table;

use super::end::{ScratchEnd, response_at_end};
use super::pixels::{Camera, Footprint};
use super::reference::response;

/// How far past the rim the offsets go, σ: the response is below e⁻²⁰ there, the coverage below e⁻¹⁰.
const MARGIN: f64 = 4.5;

/// Regions of the effect.
pub(super) const REGIONS: &[Region] = &[
    Region {
        name: "camera",
        description: "300 pixels of cameras 0.2 to 20 m away, tilts of 0 to 89 degrees, 720 to 2160 \
                      rows, fields of view of 20 to 90 degrees, sigma 60 um or 20 to 120 um, \
                      scratches in every direction; 32 offsets each. The worst pixel counts.",
        points: || camera(300, 32, 41, 0.5),
        fitted: Some(|| camera(400, 24, 42, 0.25)),
        by: Some("h"),
        yardstick: Yardstick::RelativeL2,
    },
    Region {
        name: EVERY_HALF_EXTENT,
        description: "41 half-extents from 0.05 to 30 in equal ratios, circular footprints, 96 \
                      offsets each. The worst half-extent counts. Fits see pixels of cameras and \
                      half-extents in equal ratios, in equal shares: cameras alone leave small \
                      footprints unheld.",
        points: || circles(&equal_ratios(0.05, 30.0, 41), 96, 0.5),
        fitted: Some(mixed),
        by: Some("h"),
        yardstick: Yardstick::RelativeL2,
    },
    Region {
        name: "scratch ends",
        description: "60 footprints of cameras up to h = 30, with a scratch that begins inside or \
                      near: 64 offsets and ends each. The worst footprint counts.",
        points: || ends(60, 64, 43),
        fitted: Some(|| ends(60, 64, 44)),
        by: Some("half_extent"),
        yardstick: Yardstick::RelativeL2,
    },
];

/// Name of the region that the target line is about.
pub(super) const EVERY_HALF_EXTENT: &str = "every half-extent";

/// `count` numbers in equal ratios, ends included.
pub(super) fn equal_ratios(from: f64, to: f64, count: u32) -> Vec<f64> {
    let step = (to / from).ln() / f64::from(count - 1);
    (0..count).map(|i| from * (step * f64::from(i)).exp()).collect()
}

/// `count` offsets in [0, h + margin] in equal steps, `phase` of a step from the start, of alternate
/// sign.
pub(super) fn offsets(half_extent: f64, count: u32, phase: f64) -> impl Iterator<Item = f64> {
    let step = (half_extent + MARGIN) / f64::from(count);
    (0..count).map(move |i| {
        let offset = (f64::from(i) + phase) * step;
        if i % 2 == 0 { offset } else { -offset }
    })
}

fn camera(pixels: usize, count: u32, seed: u64, phase: f64) -> Table {
    let footprints = Camera::seeded(seed).take(pixels).map(|f| (f.half_extent, f.area_ratio()));
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
        let offsets: Vec<f64> = offsets(h, count, phase).collect();
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
    for f in Camera::seeded(seed).filter(small).take(footprints) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_hold_what_their_descriptions_say() {
        for region in REGIONS {
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
