//! What became of a gate.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Gate, Metric, Precision};
use crate::document::{Verdict, number, place};

/// A number of a fit, and where it was reached.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reached {
    /// The metric's value, in the target's unit (`max_rel` and what is measured of draws: 1, `drift`: ulp
    /// of f32).
    pub value: f64,
    /// Where an extreme is reached: input column to value.
    pub at: BTreeMap<String, f64>,
    /// Which member of a family, or which constant (`drift`), is the worst.
    pub of: Option<String>,
    /// Number of points, or of constants, that were compared.
    pub count: usize,
}

impl Reached {
    /// `x = 3.56, Au.Johnson@R`: where the value was reached; empty if it has no place.
    pub fn place(&self) -> String {
        let at = Some(place(&self.at, DIGITS)).filter(|at| !at.is_empty());
        at.into_iter().chain(self.of.clone()).collect::<Vec<_>>().join(", ")
    }
}

/// Significant digits of a value or a place: enough to find it again.
const DIGITS: usize = 6;

/// A gate with its verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judgement {
    /// The gate.
    #[serde(flatten)]
    pub gate: Gate,
    /// Its verdict.
    pub verdict: Verdict,
    /// What was measured, if anything.
    pub measured: Option<Reached>,
    /// Part of the limit that is left, 1; negative beyond it.
    pub margin: Option<f64>,
    /// Why it failed, or was not measured, where the number does not say it.
    pub reason: Option<String>,
}

impl Judgement {
    /// Holds `measured` against the gate. A value that is not a number fails.
    pub fn of(gate: Gate, measured: Reached) -> Self {
        let value = measured.value;
        let (verdict, reason) = if value.is_nan() {
            (Verdict::Fail, Some("the error is not a number".to_owned()))
        } else if gate.metric.worse(value, gate.limit) {
            (Verdict::Fail, None)
        } else if gate.warn.is_some_and(|warn| !gate.metric.worse(warn, value)) {
            (Verdict::Warn, None)
        } else if let Some(stale) = stale(&gate, value) {
            (Verdict::Warn, Some(stale))
        } else {
            (Verdict::Pass, None)
        };
        let part = match gate.metric {
            Metric::Chi2P => gate.limit / value,
            _ => value / gate.limit,
        };
        let margin = Some(1.0 - part);
        Self { gate, verdict, measured: Some(measured), margin, reason }
    }

    /// A gate that fails without a number.
    pub fn failed(gate: Gate, reason: impl Into<String>) -> Self {
        let reason = Some(reason.into());
        Self { gate, verdict: Verdict::Fail, measured: None, margin: None, reason }
    }

    /// A gate that cannot be measured here.
    pub fn not_measured(gate: Gate, reason: impl Into<String>) -> Self {
        Self { verdict: Verdict::NotMeasured, ..Self::failed(gate, reason) }
    }

    /// One line: `max_abs 0.05098 of 0.05105 (0.1 % left) at x = 3.56`.
    pub fn summary(&self) -> String {
        let metric = self.gate.metric;
        let mut line = match &self.measured {
            None => format!("{metric} not measured"),
            Some(measured) => {
                let margin = 100.0 * self.margin.unwrap_or(f64::NAN);
                let place = measured.place();
                let at = if place.is_empty() { String::new() } else { format!(" at {place}") };
                let (value, limit) = (number(measured.value, DIGITS), self.gate.limit);
                format!("{metric} {value} of {limit} ({margin:.2} % left){at}")
            }
        };
        if let Some(reason) = &self.reason {
            line.push_str(": ");
            line.push_str(reason);
        }
        line
    }
}

/// Relative difference from which a recorded number is stale: the digits that files give.
const STALE: f64 = 1e-3;
/// On a device, where arithmetic is its own, more.
const STALE_ON_DEVICE: f64 = 0.05;

/// That the number recorded when the limit was set is no longer the one that is measured.
fn stale(gate: &Gate, value: f64) -> Option<String> {
    let recorded = gate.measured?;
    let tolerance = match gate.precision {
        Precision::Device => STALE_ON_DEVICE,
        Precision::F64 | Precision::F32 => STALE,
    };
    let near = (value - recorded).abs() <= tolerance * recorded.abs().max(value.abs());
    (!near).then(|| format!("measured = {recorded} is stale: {} now", number(value, 4)))
}
