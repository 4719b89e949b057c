//! What each simplification costs, and where.

mod energy;
mod ensembles;
mod ends;
mod depth_phase;

pub(super) use depth_phase::{DepthPhase, Sampling, side_lobe_energy};
pub(super) use ends::{energy_ratio, response_errors};
pub(super) use energy::EnergyStudy;
pub(super) use ensembles::{EnsembleStudy, Seen};

use crate::document::Section;
use crate::effect::{Candidates, ClaimError};

/// What is said of the exhibits.
const TEXTS: &str = include_str!("../exhibits.toml");

/// The exhibits, in the order of the page.
pub(super) fn exhibits(candidates: &Candidates) -> Result<Vec<Section>, ClaimError> {
    Ok(vec![
        depth_phase::figure_three(),
        depth_phase::exhibit(),
        ends::exhibit(candidates)?,
        ensembles::exhibit(),
        energy::exhibit(),
    ])
}

/// `count` values in equal ratios from `from` to `to`, ends included.
fn log_grid(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from * (to / from).powf(f64::from(i) / f64::from(count - 1)))
}

/// `count` values in equal steps from `from` to `to`, ends included.
fn grid(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from + (to - from) * f64::from(i) / f64::from(count - 1))
}
