use std::f64::consts::PI;

use rand::Rng;

use super::gratings::profile_height;
use super::{Grating, Patch, Profile, random};
use crate::measured::height_map::HeightMap;

/// Holographic wrapping paper: square patches of sinusoidal gratings, each with a direction, a pitch
/// and a phase of its own. Patches of a few periods have wide orders; directions drawn about one axis
/// and its normal keep two main arms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HolographicPaper {
    /// Side of a patch, µm.
    pub cell_um: f64,
    /// Smallest and largest pitch, µm, drawn uniformly.
    pub pitch_um: [f64; 2],
    /// Amplitude of the sinusoids, nm.
    pub amplitude_nm: f64,
    /// Largest angle between a grating's direction and the x or the y axis, rad, drawn uniformly.
    pub spread: f64,
    /// Seed of the draws.
    pub seed: u64,
}

/// Heights of holographic paper.
pub fn holographic_paper(paper: HolographicPaper, patch: Patch) -> HeightMap {
    let half = (0.5 * patch.side_um / paper.cell_um).ceil() as i64;
    let side = 2 * half + 1;
    let cells: Vec<(Grating, f64)> = (0..side * side)
        .map(|cell| {
            let mut random = random(paper.seed, cell as u64);
            let [low, high] = paper.pitch_um;
            let period_um = low + (high - low) * random.random_range(0.0..1.0);
            let axis = if random.random_range(0.0..1.0) < 0.5 { 0.0 } else { 0.5 * PI };
            let angle = axis + paper.spread * random.random_range(-1.0..1.0);
            let profile = Profile::Sinusoid { amplitude_nm: paper.amplitude_nm };
            let shift = period_um * random.random_range(0.0..1.0);
            (Grating { period_um, angle, profile }, shift)
        })
        .collect();
    let origin = format!("{paper:?} over {} µm", patch.side_um);
    patch.heights(origin, |x, y| {
        let place = |v: f64| (v / paper.cell_um).round() as i64 + half;
        let cell = cells.get((place(y) * side + place(x)) as usize);
        cell.map_or(0.0, |(grating, shift)| {
            let along = super::turned(x, y, grating.angle).0 + shift;
            profile_height(*grating, along, patch)
        })
    })
}
