//! What each simplification costs, and where.

mod energy;
mod ensembles;
mod ends;
mod figure_three;
mod depth_phase;

pub(super) use depth_phase::{DepthPhase, Sampling};
pub(super) use ends::{energy_ratio, response_errors};
pub(super) use energy::EnergyStudy;
pub(super) use ensembles::EnsembleStudy;
pub(super) use figure_three::side_lobe_energy;

use crate::effect::FittedConstants;
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitError, ExhibitSeries, Stroke,
};

/// The exhibits, in the order of the page.
pub(super) fn exhibits(_: &FittedConstants) -> Result<Vec<Exhibit>, ExhibitError> {
    Ok(vec![
        figure_three::exhibit(),
        depth_phase::exhibit(),
        ends::exhibit()?,
        ensembles::exhibit(),
        energy::exhibit(),
    ])
}

fn axis(label: &'static str, unit: &'static str, log: bool) -> ExhibitAxis {
    ExhibitAxis { label, unit, log }
}

fn series(name: &str, stroke: Stroke, points: Vec<(f64, f64)>) -> ExhibitSeries {
    ExhibitSeries { name: name.into(), points, stroke }
}

fn text(words: &str) -> ExhibitCell {
    ExhibitCell::Text(words.into())
}

fn columns(titles: &[(&str, &'static str)]) -> Vec<(String, &'static str)> {
    titles.iter().map(|(title, unit)| ((*title).to_owned(), *unit)).collect()
}

/// `count` values in equal ratios from `from` to `to`, ends included.
fn log_grid(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from * (to / from).powf(f64::from(i) / f64::from(count - 1)))
}

/// `count` values in equal steps from `from` to `to`, ends included.
fn grid(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from + (to - from) * f64::from(i) / f64::from(count - 1))
}
