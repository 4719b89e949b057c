use std::f64::consts::{PI, TAU};

use rand::Rng;

use super::{Patch, coverage, folded, random, turned};
use crate::measured::height_map::HeightMap;

/// Cross-section of a grating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Profile {
    /// b sin(2πx/d): from −b to b.
    Sinusoid {
        /// b, nm.
        amplitude_nm: f64,
    },
    /// Ramps from 0 to the height, with a step back down: slope height/d.
    Blazed {
        /// Height of the step, nm.
        height_nm: f64,
    },
    /// 0 over the share `duty` of the period, −depth over the rest.
    Rectangle {
        /// Depth, nm.
        depth_nm: f64,
        /// Share of the period at the top, in [0, 1].
        duty: f64,
    },
}

/// A grating that repeats along one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grating {
    /// Period, µm.
    pub period_um: f64,
    /// Direction in which it repeats, rad from the x axis.
    pub angle: f64,
    /// Its cross-section.
    pub profile: Profile,
}

/// Heights of a grating.
pub fn grating(grating: Grating, patch: Patch) -> HeightMap {
    let origin = format!("{grating:?} over {} µm", patch.side_um);
    patch.heights(origin, |x, y| profile_height(grating, turned(x, y, grating.angle).0, patch))
}

/// Height at `x` along the direction of repetition, nm.
fn profile_height(grating: Grating, x: f64, patch: Patch) -> f64 {
    let d = grating.period_um;
    match grating.profile {
        Profile::Sinusoid { amplitude_nm } => amplitude_nm * core_math::sin(TAU * x / d),
        Profile::Blazed { height_nm } => height_nm * (folded(x, d) / d + 0.5),
        Profile::Rectangle { depth_nm, duty } => {
            let top = coverage(folded(x, d), 0.5 * duty * d, patch.pitch_um());
            depth_nm * (top - 1.0)
        }
    }
}

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
            let along = turned(x, y, grating.angle).0 + shift;
            profile_height(*grating, along, patch)
        })
    })
}
