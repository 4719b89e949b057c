use rand::Rng;

use super::{Patch, coverage, random};
use crate::measured::height_map::HeightMap;

/// Channel bits that a pit or a land may be long: runs of EFM are 3 to 11.
const RUNS: std::ops::RangeInclusive<u32> = 3..=11;

/// A patch of a pressed disc: tracks along y, straight since their radius is thousands of times the
/// patch; pits of equal width and depth, pits and lands in turn along each track.
///
/// Run lengths are those of EFM, 3 to 11 channel bits, drawn with weights that halve every 1.4 bits, as
/// short runs prevail on discs (a mean of 4.5 bits). Phases of the tracks
/// are independent, so that along the track there is a continuum and no order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompactDisc {
    /// Distance of tracks, µm; 1.6 by IEC 60908.
    pub pitch_um: f64,
    /// Width of a pit, µm; about 0.5.
    pub pit_width_um: f64,
    /// Depth of a pit, nm; about 120.
    pub depth_nm: f64,
    /// Length of a channel bit, µm; 0.278 at 1.2 m/s and 4.3218 MHz.
    pub bit_um: f64,
    /// Seed of the run lengths.
    pub seed: u64,
}

/// Heights of a disc: 0 on land, −depth in pits.
pub fn compact_disc(disc: CompactDisc, patch: Patch) -> HeightMap {
    let half = 0.5 * patch.side_um;
    let last = (half / disc.pitch_um).ceil() as i64 + 1;
    let tracks: Vec<Vec<(f64, f64)>> =
        (-last..=last).map(|track| pits(disc, track, half)).collect();
    let origin = format!("{disc:?} over {} µm", patch.side_um);
    patch.heights(origin, |x, y| {
        let track = (x / disc.pitch_um).round();
        let across = coverage(x - track * disc.pitch_um, 0.5 * disc.pit_width_um, patch.pitch_um());
        if across <= 0.0 {
            return 0.0;
        }
        let pits = tracks.get((track as i64 + last) as usize).map_or(&[][..], Vec::as_slice);
        let reach = patch.pitch_um();
        let from = pits.partition_point(|(_, end)| *end < y - reach);
        let near = pits.iter().skip(from).take_while(|(start, _)| *start < y + reach);
        let along: f64 = near
            .map(|(start, end)| coverage(y - 0.5 * (start + end), 0.5 * (end - start), reach))
            .sum();
        -disc.depth_nm * across * along.min(1.0)
    })
}

/// Start and end of every pit of a track that reaches from −`half` to `half`.
fn pits(disc: CompactDisc, track: i64, half: f64) -> Vec<(f64, f64)> {
    // Two's complement keeps tracks on either side of 0 apart.
    let mut random = random(disc.seed, track as u64);
    let run = |random: &mut rand_chacha::ChaCha12Rng| {
        let total: f64 = RUNS.map(weight).sum();
        let mut left = random.random_range(0.0..total);
        for bits in RUNS {
            left -= weight(bits);
            if left <= 0.0 {
                return f64::from(bits) * disc.bit_um;
            }
        }
        f64::from(*RUNS.end()) * disc.bit_um
    };
    let mut at = -half - random.random_range(0.0..22.0) * disc.bit_um;
    let mut pits = Vec::new();
    while at < half {
        let pit = run(&mut random);
        pits.push((at, at + pit));
        at += pit + run(&mut random);
    }
    pits
}

fn weight(bits: u32) -> f64 {
    core_math::exp2(-f64::from(bits - RUNS.start()) / 1.4)
}
