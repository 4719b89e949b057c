//! Surfaces that the exhibits share.

use crate::effects::diffraction::DiffractionError;
use crate::effects::diffraction::preparation::{
    Preparation, PreparedHeights, USUAL, Window, prepared,
};
use crate::effects::diffraction::surfaces::{
    CompactDisc, Grating, HolographicPaper, Patch, Profile, compact_disc, grating,
};

/// One row across 32 periods of a grating, sampled 64 times each, without a window: every order falls on a
/// cell of the transform.
pub(super) fn line(period_um: f64, profile: Profile) -> Result<PreparedHeights, DiffractionError> {
    let patch = Patch { samples: 2048, side_um: 32.0 * period_um, line: true };
    let heights = grating(Grating { period_um, angle: 0.0, profile }, patch);
    prepared(&heights, Preparation { window: Window::Rectangle, ..level() })
}

/// The usual preparation with the mean plane left in: simulated gratings are level, and a plane through
/// whole periods of a sine is not flat.
pub(super) fn level() -> Preparation {
    Preparation { detrend: super::super::preparation::Detrend::Piston, ..USUAL }
}

/// The disc of the exhibits: IEC 60908's pitch, pits of 0.5 by 0.12 µm.
const DISC: CompactDisc =
    CompactDisc { pitch_um: 1.6, pit_width_um: 0.5, depth_nm: 120.0, bit_um: 0.278, seed: 1 };

/// The paper of the exhibits and of the claims.
pub(in crate::effects::diffraction) const PAPER: HolographicPaper = HolographicPaper {
    cell_um: 8.0,
    pitch_um: [1.0, 2.0],
    amplitude_nm: 60.0,
    spread: 0.2,
    seed: 1,
};

/// 51.2 µm of that disc in samples of 0.2 µm.
pub(super) fn disc() -> Result<PreparedHeights, DiffractionError> {
    let patch = Patch { samples: 256, side_um: 51.2, line: false };
    prepared(&compact_disc(DISC, patch), level())
}
