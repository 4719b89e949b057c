//! Where forms stand: the error of each beside its cost, which no other beats in both, which is the
//! cheapest for an error, and what was set out to be reached.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::effect::{Effect, Goal, Yardstick};
use crate::numeric::measured::Measured;
use crate::numeric::statistics::largest;
use crate::validate::accuracy::Accuracy;
use crate::validate::cost::{Cost, Costs, RANKED_ON};
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
    /// The cost by which fits to the same reference are ranked; NaN if it was not measured.
    pub ranked: f64,
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
            ranked: costs.ranked(cost),
            cost,
        })
        .collect();
    // What has no cost comes last.
    standings.sort_by(|a, b| a.ranked.total_cmp(&b.ranked));
    // Fits to different references answer different questions: a frontier each.
    let baselines: BTreeSet<&str> = costs.forms.iter().map(|cost| cost.baseline.as_str()).collect();
    for baseline in baselines {
        let mut best = f64::INFINITY;
        for standing in standings.iter_mut().filter(|one| one.cost.baseline == baseline) {
            let worst = standing.worst();
            standing.frontier = worst < best && !standing.ranked.is_nan();
            // A NaN is no error to beat.
            best = best.min(worst);
        }
    }
    standings
}

/// The errors in f32 of a subject of `study`, by region; none if it was not judged.
pub fn errors(study: &Study, fit: &str) -> Vec<(String, f64)> {
    if let Some(study) = study.candidates.iter().find(|study| study.name == fit) {
        let region = |(name, accuracy): &(String, Accuracy)| {
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
                .filter(|one| one.ranked <= baseline.ranked)
                .min_by(|a, b| a.worst().total_cmp(&b.worst())),
            better: comparable()
                .filter(|one| one.worst() < baseline.worst() && !one.ranked.is_nan())
                .min_by(|a, b| a.ranked.total_cmp(&b.ranked)),
        })
    }
}

/// Relative errors that are asked for.
pub const LIMITS: [f64; 3] = [0.1, 0.01, 0.001];

/// The cheapest forms of one reference in one region.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cheapest {
    /// The region.
    pub region: String,
    /// The fit that renderers ship.
    pub baseline: String,
    /// For each of [`LIMITS`] the cheapest fit whose error in f32 is not above it and its cost
    /// relative to the baseline; none if no fit reaches it.
    pub fits: [Option<(String, f64)>; LIMITS.len()],
}

/// For every region in which forms are compared by a relative error: who reaches 10 %, 1 % and 0.1 %
/// at the least cost, by what their group is ranked by.
pub fn cheapest(study: &Study, costs: &Costs) -> Vec<Cheapest> {
    let mut found: Vec<Cheapest> = Vec::new();
    for fit in &study.candidates {
        let Some(cost) = costs.of(&fit.name) else { continue };
        let unit = costs.of(&cost.baseline).map_or(f64::NAN, |baseline| costs.ranked(baseline));
        for (region, accuracy) in &fit.regions {
            if accuracy.yardstick == Yardstick::MaxAbs {
                continue;
            }
            let known =
                found.iter().position(|c| c.region == *region && c.baseline == cost.baseline);
            let place = known.unwrap_or_else(|| {
                found.push(Cheapest {
                    region: region.clone(),
                    baseline: cost.baseline.clone(),
                    fits: [const { None }; LIMITS.len()],
                });
                found.len() - 1
            });
            let ratio = costs.ranked(cost) / unit;
            for (best, limit) in found[place].fits.iter_mut().zip(LIMITS) {
                let cheaper = best.as_ref().is_none_or(|(_, least)| ratio < *least);
                if accuracy.headline() <= limit && cheaper && !ratio.is_nan() {
                    *best = Some((cost.name.clone(), ratio));
                }
            }
        }
    }
    found
}

/// A goal, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GoalVerdict {
    /// The fit.
    pub fit: String,
    /// Where its error is taken.
    pub region: String,
    /// What error that is.
    pub yardstick: &'static str,
    /// Largest error asked for.
    pub error_asked: f64,
    /// The error on the device, or in f32 where there is none.
    pub error: f64,
    /// Largest cost asked for, relative to the baseline.
    pub cost_asked: f64,
    /// The fit that the cost refers to.
    pub baseline: String,
    /// The cost counted on [`RANKED_ON`], relative to the baseline; a time on a device stands for no GPU but
    /// that one, and is not taken.
    pub cost: Measured<f64>,
    /// Why this error and this cost.
    pub why: String,
    /// Whether both are reached; not measured where nothing was counted, unless the error alone fails.
    pub met: Measured<bool>,
}

/// Judges the goals of `effect`. A goal on a fit or region that was not studied is not met: its
/// error is NaN.
pub fn goals(effect: &Effect, study: &Study, costs: &Costs) -> Vec<GoalVerdict> {
    let verdict = |goal: &Goal| {
        let fit = study.candidates.iter().find(|fit| fit.name == goal.fit);
        let accuracy = fit.and_then(|fit| {
            let mut all = fit.regions.iter().chain(&fit.hard_cases);
            all.find(|(name, _)| name == goal.region).map(|(_, accuracy)| accuracy)
        });
        let error = accuracy.map_or(f64::NAN, |accuracy| {
            accuracy.headline_device.value().copied().unwrap_or_else(|| accuracy.headline())
        });
        let cost = costs.of(goal.fit);
        let ratio = match cost {
            Some(cost) => costs.ratio_on(RANKED_ON, cost),
            None => Measured::NotMeasured("the fit is none that was measured".to_owned()),
        };
        let accurate = error <= goal.error;
        let met = match &ratio {
            _ if !accurate => Measured::Value(false),
            Measured::Value(ratio) => Measured::Value(*ratio <= goal.cost),
            Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
        };
        GoalVerdict {
            fit: goal.fit.to_owned(),
            region: goal.region.to_owned(),
            yardstick: accuracy.map_or("error", |accuracy| accuracy.yardstick.words()),
            error_asked: goal.error,
            error,
            cost_asked: goal.cost,
            baseline: cost.map(|cost| cost.baseline.clone()).unwrap_or_default(),
            cost: ratio,
            why: goal.why.to_owned(),
            met,
        }
    };
    effect.goals.iter().map(verdict).collect()
}
