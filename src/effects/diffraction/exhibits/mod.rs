//! What the effect shows beyond its fits: orders against J_m², sections of tables, and what each step and
//! each assumption costs.

mod angles;
mod order_powers;
mod preparation;
mod sections;
mod wavelengths;

pub(super) use angles::{
    disc_in_white_sky, even_table, fixed_cosine_error, grating_error as cosine_error,
    mirror_by_stam, zero_order_error,
};
pub(super) use wavelengths::rule_errors;

use super::DiffractionError;
use super::preparation::{Detrend, Preparation, PreparedHeights, USUAL, Window, prepared};
use super::surfaces::{
    CompactDisc, Grating, HolographicPaper, Patch, Profile, compact_disc, grating,
};
use crate::document::Section;
use crate::effect::{Candidates, ClaimError};

/// What is said of the exhibits.
const TEXTS: &str = include_str!("../exhibits.toml");

/// Wavelength of what is shown at one, nm.
pub(super) const GREEN_NM: f64 = 550.0;

impl From<DiffractionError> for ClaimError {
    fn from(error: DiffractionError) -> Self {
        Self::new(error)
    }
}

/// What the effect shows beyond its fits.
pub(super) fn exhibits(_: &Candidates) -> Result<Vec<Section>, ClaimError> {
    Ok(vec![
        order_powers::exhibit()?,
        sections::exhibit()?,
        preparation::exhibit()?,
        wavelengths::exhibit()?,
        angles::one_table()?,
        angles::white_sky()?,
    ])
}

/// One row across 32 periods of a grating, sampled 64 times each, without a window: every order falls on a
/// cell of the transform.
fn line(period_um: f64, profile: Profile) -> Result<PreparedHeights, DiffractionError> {
    let patch = Patch { samples: 2048, side_um: 32.0 * period_um, line: true };
    let heights = grating(Grating { period_um, angle: 0.0, profile }, patch);
    prepared(&heights, Preparation { window: Window::Rectangle, ..level() })
}

/// The usual preparation with the mean plane left in: simulated gratings are level, and a plane through
/// whole periods of a sine is not flat.
fn level() -> Preparation {
    Preparation { detrend: Detrend::Piston, ..USUAL }
}

/// The disc of the exhibits: IEC 60908's pitch, pits of 0.5 by 0.12 µm.
const DISC: CompactDisc =
    CompactDisc { pitch_um: 1.6, pit_width_um: 0.5, depth_nm: 120.0, bit_um: 0.278, seed: 1 };

/// The paper of the exhibits and of the claims.
pub(super) const PAPER: HolographicPaper = HolographicPaper {
    cell_um: 8.0,
    pitch_um: [1.0, 2.0],
    amplitude_nm: 60.0,
    spread: 0.2,
    seed: 1,
};

/// 51.2 µm of that disc in samples of 0.2 µm.
fn disc() -> Result<PreparedHeights, DiffractionError> {
    let patch = Patch { samples: 256, side_um: 51.2, line: false };
    prepared(&compact_disc(DISC, patch), level())
}
