//! What a gate judges: fitted constants in a form, and points that were not fitted.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::evidence::Found;
use super::{Gate, GateError, Metric, Precision, Reached, ShippedConstants};
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
    /// The file whose constants are compared with the fitted ones, for the metric `drift`.
    pub(super) shipped: Option<ShippedConstants>,
}

/// One fitted form at the points where it is judged.
#[derive(Debug)]
pub(super) struct Instance {
    /// Label of a member of a family.
    pub(super) label: Option<String>,
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

impl Subject {
    /// What the gate measures of one fit, with a lever moved by a relative step if one is `moved`; or
    /// why a gate on it fails.
    pub(super) fn reached(
        &self,
        instance: &Instance,
        gate: &Gate,
        moved: Option<(&Lever, f64)>,
        device: Option<&Device>,
    ) -> Result<Found<Reached>, ValidateError> {
        let (candidate, target) = instance.perturbed(moved);
        match &self.shipped {
            Some(shipped) => Ok(shipped.drift(&candidate)),
            None => instance.errors(gate, &candidate, &target, device).map(Ok),
        }
    }
}

impl Instance {
    /// The same with the lever moved by the relative step; by the step itself from 0.
    fn perturbed(
        &self,
        moved: Option<(&Lever, f64)>,
    ) -> (Cow<'_, Candidate>, Cow<'_, GroundTruth>) {
        let (mut candidate, mut target) =
            (Cow::Borrowed(&self.candidate), Cow::Borrowed(&self.target));
        match moved {
            Some((Lever::Constant { places, .. }, step)) => {
                let to = |value: f64| if value == 0.0 { step } else { value * (1.0 + step) };
                let Candidate { constants, constants_f32, .. } = candidate.to_mut();
                for place in places {
                    constants[*place] = to(constants[*place]);
                    constants_f32[*place] = to(f64::from(constants_f32[*place])) as f32;
                }
            }
            // Values times 1 + step against the target leave the same residuals, up to that
            // factor, as values against the target over 1 + step; draws are counts, of which the odds move.
            Some((Lever::Output, step)) => {
                let target = target.to_mut();
                target.values.iter_mut().for_each(|v| *v /= 1.0 + step);
                target.distributions.iter_mut().for_each(|of| *of = of.tilted(1.0 + step));
            }
            None => {}
        }
        (candidate, target)
    }

    /// Errors of the candidate against the target, which may both be perturbed.
    fn errors(
        &self,
        gate: &Gate,
        candidate: &Candidate,
        target: &GroundTruth,
        device: Option<&Device>,
    ) -> Result<Reached, ValidateError> {
        let arithmetic = match (gate.precision, device) {
            (Precision::F64, _) => Arithmetic::F64,
            (Precision::Device, Some(device)) => Arithmetic::Device(device),
            (Precision::F32, _) | (Precision::Device, None) => Arithmetic::F32,
        };
        let values = values(candidate, target, arithmetic)?;
        let of = self.label.clone();
        if gate.metric == Metric::RelL2 {
            let RelativeL2 { value, at } = target.relative_l2(&values);
            return Ok(Reached { value, at, of, count: target.values.len() });
        }
        if gate.metric.of_draws() {
            let (value, at) = figure_of_draws(gate.metric, target, &target.draws(&values));
            return Ok(Reached { value, at, of, count: target.distributions.len() });
        }
        let residuals = target.residuals(&values);
        let (value, at) = figure(gate.metric, &residuals);
        Ok(Reached { value, at, of, count: residuals.count })
    }
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
