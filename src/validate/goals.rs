//! Goals: the error that a form was to reach at a cost, beside what it reaches.

use serde::Serialize;

use crate::effect::Effect;
use crate::numeric::measured::Measured;
use crate::validate::cost::Costs;
use crate::validate::study::Study;

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
    /// The cost on the device, relative to the baseline.
    pub cost: Measured<f64>,
    /// Why this error and this cost.
    pub why: String,
    /// Whether both are reached; not measured without a device, unless the error alone fails.
    pub met: Measured<bool>,
}

/// Judges the goals of `effect`. A goal on a fit or region that was not studied is not met: its
/// error is NaN.
pub fn goals(effect: &Effect, study: &Study, costs: &Costs) -> Vec<GoalVerdict> {
    let verdict = |goal: &crate::effect::Goal| {
        let fit = study.candidates.iter().find(|fit| fit.name == goal.fit);
        let accuracy = fit.and_then(|fit| {
            let mut all = fit.regions.iter().chain(&fit.hard_cases);
            all.find(|(name, _)| name == goal.region).map(|(_, accuracy)| accuracy)
        });
        let error = accuracy.map_or(f64::NAN, |accuracy| {
            accuracy.headline_device.value().copied().unwrap_or_else(|| accuracy.headline())
        });
        let cost = costs.forms.iter().find(|cost| cost.name == goal.fit);
        let ratio = match cost.map(|cost| &cost.device) {
            Some(Measured::Value(timing)) => {
                Measured::Value(timing.ratio.map_or(f64::NAN, |ratio| ratio.median))
            }
            Some(Measured::NotMeasured(reason)) => Measured::NotMeasured(reason.clone()),
            None => Measured::NotMeasured("the fit was not timed".to_owned()),
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
