use std::f64::consts::TAU;

use super::{Patch, coverage, folded, turned};
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
pub(super) fn profile_height(grating: Grating, x: f64, patch: Patch) -> f64 {
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
