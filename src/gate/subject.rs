//! What a gate judges: fitted constants in a form, and points that were not fitted.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::{Gate, GateError, Metric, Precision, Reached};
use crate::effect::Candidate;
use crate::fit::outcome::Residuals;
use crate::gpu::Device;
use crate::validate::ValidateError;
use crate::validate::accuracy::{Arithmetic, GroundTruth, RelativeL2, values};
use crate::validate::draws::{Draws, PointDraws};

/// The fits that one gate judges together: one, or the members of a family.
#[derive(Debug)]
pub(super) struct Subject {
    /// One per fit.
    pub(super) instances: Vec<Instance>,
}

/// One fitted form at the points where it is judged.
#[derive(Debug)]
pub(super) struct Instance {
    /// Label of a member of a family.
    pub(super) label: Option<String>,
    /// Form and constants.
    pub(super) candidate: Candidate,
    /// Points and true values.
    pub(super) target: GroundTruth,
    /// What a proof perturbs.
    pub(super) levers: Vec<Lever>,
}

impl Gate {
    /// Whether the metric is one of what `target` judges.
    pub(super) fn fits(&self, target: &GroundTruth) -> Result<(), GateError> {
        let metric = self.metric;
        match (target.distributions.is_empty(), metric.of_draws()) {
            (false, false) if metric != Metric::Drift => {
                let of_draws = "draws from a distribution have mean_z, variance_ratio and chi2_p";
                Err(self.fault(format!("{of_draws}, got {metric}")))
            }
            (true, true) => {
                Err(self.fault(format!("{metric} is of forms that draw, not of values")))
            }
            _ => Ok(()),
        }
    }
}

/// Something of which a gate must notice a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Lever {
    /// A constant, with those that are tied to it: places in the order of the form.
    Constant {
        /// Its name.
        name: String,
        /// Places that move together.
        places: Vec<usize>,
    },
    /// All values that the form returns, for a form without constants.
    Output,
}

impl Lever {
    /// The constant's name, or `output`.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Constant { name, .. } => name,
            Self::Output => "output",
        }
    }
}

impl Instance {
    /// The same with the lever moved by the relative step; by the step itself from 0.
    pub(super) fn perturbed(
        &self,
        lever: &Lever,
        step: f64,
    ) -> (Cow<'_, Candidate>, Cow<'_, GroundTruth>) {
        let (mut candidate, mut target) =
            (Cow::Borrowed(&self.candidate), Cow::Borrowed(&self.target));
        match lever {
            Lever::Constant { places, .. } => {
                let candidate = candidate.to_mut();
                for place in places {
                    if let Some(value) = candidate.constants.get_mut(*place) {
                        *value = moved(*value, step);
                    }
                    if let Some(value) = candidate.constants_f32.get_mut(*place) {
                        *value = moved(f64::from(*value), step) as f32;
                    }
                }
            }
            // Values times 1 + step against the target leave the same residuals, up to that
            // factor, as values against the target over 1 + step; draws are counts, of which the odds move.
            Lever::Output => {
                let target = target.to_mut();
                target.values.iter_mut().for_each(|v| *v /= 1.0 + step);
                target.distributions.iter_mut().for_each(|of| *of = of.tilted(1.0 + step));
            }
        }
        (candidate, target)
    }
}

fn moved(value: f64, step: f64) -> f64 {
    if value == 0.0 { step } else { value * (1.0 + step) }
}

/// Measures an instance, perturbed or not.
pub(super) fn reached(
    label: Option<&str>,
    candidate: &Candidate,
    target: &GroundTruth,
    metric: Metric,
    precision: Precision,
    device: Option<&Device>,
) -> Result<Reached, ValidateError> {
    let arithmetic = match (precision, device) {
        (Precision::F64, _) => Arithmetic::F64,
        (Precision::Device, Some(device)) => Arithmetic::Device(device),
        (Precision::F32, _) | (Precision::Device, None) => Arithmetic::F32,
    };
    let values = values(candidate, target, arithmetic)?;
    let of = label.map(str::to_owned);
    if metric == Metric::RelL2 {
        let RelativeL2 { value, at } = target.relative_l2(&values);
        return Ok(Reached { value, at, of, count: target.values.len() });
    }
    if metric.of_draws() {
        let (value, at) = figure_of_draws(metric, target, &target.draws(&values));
        return Ok(Reached { value, at, of, count: target.distributions.len() });
    }
    let residuals = target.residuals(&values);
    let (value, at) = figure(metric, &residuals);
    Ok(Reached { value, at, of, count: residuals.count })
}

/// The metric's value and where it is; not a number as soon as any residual is none, or there is
/// none at all.
fn figure(metric: Metric, residuals: &Residuals) -> (f64, BTreeMap<String, f64>) {
    let nowhere = BTreeMap::new();
    if residuals.count == 0 || !residuals.max_abs.is_finite() {
        return (f64::NAN, residuals.max_abs_at.clone());
    }
    match metric {
        Metric::MaxAbs => (residuals.max_abs, residuals.max_abs_at.clone()),
        Metric::MaxRel => (
            residuals.max_rel.unwrap_or(f64::NAN),
            residuals.max_rel_at.clone().unwrap_or_default(),
        ),
        Metric::Rms => (residuals.rms, nowhere),
        Metric::Bias => (residuals.bias.abs(), nowhere),
        Metric::P50 => (residuals.p50, nowhere),
        Metric::P95 => (residuals.p95, nowhere),
        Metric::P99 => (residuals.p99, nowhere),
        // No other comes here, and each would fail if it did.
        _ => (f64::NAN, nowhere),
    }
}

/// The metric's value, and the point where it is with the number of the first draw there.
fn figure_of_draws(
    metric: Metric,
    target: &GroundTruth,
    draws: &Draws,
) -> (f64, BTreeMap<String, f64>) {
    let (value, point) = match metric {
        Metric::MeanZ => (draws.worst_mean_z, draws.worst_point(|of| of.mean_z.abs())),
        Metric::VarianceRatio => {
            (draws.worst_variance_ratio, draws.worst_point(PointDraws::variance_off))
        }
        _ => (draws.chi_squared_p, draws.worst_point(|of| -of.p)),
    };
    (value, target.place(point))
}

/// The worst of several; a value that is not a number is worse than any.
pub(super) fn worst(all: impl IntoIterator<Item = Reached>) -> Option<Reached> {
    all.into_iter().reduce(|worst, other| {
        let worse = !worst.value.is_nan() && (other.value.is_nan() || other.value > worst.value);
        if worse { other } else { worst }
    })
}
