//! Where forms stand: the error of each beside its cost, and which no other beats in both.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::effect::Yardstick;
use crate::numeric::statistics::largest;
use crate::validate::cost::{Cost, Costs};
use crate::validate::draws::DrawsStudy;
use crate::validate::study::Study;

/// A form with its error and its cost.
#[derive(Debug, Clone, Serialize)]
pub struct Standing<'a> {
    /// The fit.
    pub fit: &'a str,
    /// Error in f32 by which forms are compared, by region (or over all members of a family); of a form
    /// that draws the mean off that of its distribution, in standard errors.
    pub error: Vec<(String, f64)>,
    /// Whether no fit to the same reference errs less at no more cost.
    pub frontier: bool,
    /// Its cost.
    #[serde(flatten)]
    pub cost: &'a Cost,
}

impl Standing<'_> {
    /// The largest error over all regions; NaN if one has no value.
    pub fn worst(&self) -> f64 {
        largest(self.error.iter().map(|(_, error)| *error))
    }
}

/// The forms of `costs` with their errors in `study`, the cheapest first.
pub fn standings<'a>(study: &'a Study, costs: &'a Costs) -> Vec<Standing<'a>> {
    let mut standings: Vec<Standing<'_>> = costs
        .forms
        .iter()
        .map(|cost| Standing {
            fit: &cost.name,
            error: errors(study, &cost.name),
            frontier: false,
            cost,
        })
        .collect();
    standings.sort_by(|a, b| a.cost.nanoseconds().total_cmp(&b.cost.nanoseconds()));
    // Fits to different references answer different questions: a frontier each.
    let baselines: BTreeSet<&str> = costs.forms.iter().map(|cost| cost.baseline.as_str()).collect();
    for baseline in baselines {
        let mut best = f64::INFINITY;
        for standing in standings.iter_mut().filter(|one| one.cost.baseline == baseline) {
            let worst = standing.worst();
            standing.frontier = worst < best;
            // A NaN is no error to beat.
            best = best.min(worst);
        }
    }
    standings
}

fn errors(study: &Study, fit: &str) -> Vec<(String, f64)> {
    if let Some(study) = study.candidates.iter().find(|study| study.name == fit) {
        let region = |(name, accuracy): &(String, crate::validate::accuracy::Accuracy)| {
            let kind = match accuracy.yardstick {
                Yardstick::MaxAbs => name.clone(),
                other => format!("{name}, {}", other.words()),
            };
            (kind, accuracy.headline())
        };
        let drawn = |(name, draws): &(String, DrawsStudy)| {
            (format!("{name}, |mean z|"), draws.f32.worst_mean_z)
        };
        return study.regions.iter().map(region).chain(study.draws.iter().map(drawn)).collect();
    }
    let forms = study.families.iter().flat_map(|family| &family.forms);
    forms
        .filter(|form| form.fit == fit)
        .flat_map(|form| [("all members".to_owned(), form.max_abs), ("RMS".to_owned(), form.rms)])
        .collect()
}

/// What a renderer that ships a baseline asks of the other fits to its reference.
#[derive(Debug, Clone, Copy)]
pub struct Answers<'a> {
    /// The baseline.
    pub baseline: &'a Standing<'a>,
    /// The most accurate at no more than its cost, itself included.
    pub as_cheap: Option<&'a Standing<'a>>,
    /// The cheapest that errs less.
    pub better: Option<&'a Standing<'a>>,
}

impl<'a> Answers<'a> {
    /// For the fit `baseline` among `standings`; none if it is not among them.
    pub fn of(standings: &'a [Standing<'a>], baseline: &str) -> Option<Self> {
        let baseline = standings.iter().find(|one| one.fit == baseline)?;
        let comparable = || {
            standings.iter().filter(|one| {
                one.cost.baseline == baseline.fit && one.error.len() == baseline.error.len()
            })
        };
        Some(Self {
            baseline,
            as_cheap: comparable()
                .filter(|one| one.cost.nanoseconds() / baseline.cost.nanoseconds() <= 1.0)
                .min_by(|a, b| a.worst().total_cmp(&b.worst())),
            better: comparable()
                .filter(|one| one.worst() < baseline.worst())
                .min_by(|a, b| a.cost.nanoseconds().total_cmp(&b.cost.nanoseconds())),
        })
    }
}
