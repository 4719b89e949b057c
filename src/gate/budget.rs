//! What a gate says.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use super::Domain;
use crate::counted::GpuTarget;

/// One budget, as written in `fits/gates.toml`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gate {
    /// Position in the file, from 1.
    #[serde(skip)]
    pub index: usize,
    /// A fit (`effect/name`), a family of fits (`effect/name`: its worst member), one member
    /// (`effect/name#label`), or an approximation of a scene (`scenes/name#approximation`).
    pub subject: String,
    /// What is measured.
    pub metric: Metric,
    /// In which arithmetic the form is evaluated.
    pub precision: Precision,
    /// Over which points; absent means the region that the fit itself was made on.
    pub domain: Option<Domain>,
    /// Largest value accepted, of [`Metric::Chi2P`] the smallest: finite, > 0, in the metric's unit.
    pub limit: f64,
    /// The number measured when the limit was set, where it is recorded.
    #[serde(rename = "recorded")]
    pub measured: Option<f64>,
    /// Value from which on the gate warns; at most `limit`.
    pub warn: Option<f64>,
    /// File whose constants are compared with the fitted ones, relative to the project; for the
    /// metric `drift` and for it only.
    #[serde(skip)]
    pub shipped: Option<PathBuf>,
    /// The candidate, as `subject` names one, to whose cost that of the subject is relative; for the
    /// metric `cost` and for it only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_to: Option<String>,
    /// The target on which costs are counted; for the metric `cost` and for it only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<GpuTarget>,
    /// Why the limit is what it is.
    pub why: String,
    /// Line of its `subject` in the file, from 1.
    pub line: usize,
}

/// What a gate measures of the errors, form minus target; of a form that draws from a distribution, of
/// its draws: `mean_z`, `variance_ratio` and `chi2_p`, and nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Largest magnitude.
    MaxAbs,
    /// Root mean square.
    Rms,
    /// Magnitude of the mean.
    Bias,
    /// Median magnitude.
    P50,
    /// 95th percentile of the magnitude.
    P95,
    /// 99th percentile of the magnitude.
    P99,
    /// Largest magnitude relative to the target, where the target is not 0.
    MaxRel,
    /// Error relative to the target in the L2 norm; over a region whose points are grouped (over
    /// the offset for every half-extent, say) the worst group.
    RelL2,
    /// Mean LDR-FLIP of a picture; for scenes only.
    Flip,
    /// Largest distance, in units in the last place of f32, between a constant in the shipped file
    /// and the fitted one.
    Drift,
    /// Cost of an evaluation over that of the candidate `relative_to`, counted in the machine code of
    /// `target`; not measured where its compiler is not installed.
    Cost,
    /// Mean of the draws less that of the distribution, in its standard errors: the largest magnitude at
    /// any point. That of fair draws is below 4 at most and above it at 1 point of 16 000.
    MeanZ,
    /// Variance of the draws over that of the distribution, or its inverse: the largest at any point,
    /// 1 or above.
    VarianceRatio,
    /// Probability that fair draws are as far from their probabilities at any point (χ², corrected for the
    /// number of points by Šidák's rule): the gate fails below its limit, and above it for no other metric.
    Chi2P,
}

impl Metric {
    /// Every metric with its name in the file, in the order of the documentation.
    pub const ALL: [(&str, Self); 14] = [
        ("max_abs", Self::MaxAbs),
        ("rms", Self::Rms),
        ("bias", Self::Bias),
        ("p50", Self::P50),
        ("p95", Self::P95),
        ("p99", Self::P99),
        ("max_rel", Self::MaxRel),
        ("rel_l2", Self::RelL2),
        ("flip", Self::Flip),
        ("drift", Self::Drift),
        ("cost", Self::Cost),
        ("mean_z", Self::MeanZ),
        ("variance_ratio", Self::VarianceRatio),
        ("chi2_p", Self::Chi2P),
    ];

    /// Name in the file.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, metric)| *metric == self).map_or("", |(name, _)| name)
    }

    /// Whether it is measured of draws from a distribution.
    pub(super) fn of_draws(self) -> bool {
        matches!(self, Self::MeanZ | Self::VarianceRatio | Self::Chi2P)
    }

    /// Whether `value` is worse than `than`: larger, of a probability smaller. What is not a number is
    /// worse than anything.
    pub(super) fn worse(self, value: f64, than: f64) -> bool {
        value.is_nan() || if self == Self::Chi2P { value < than } else { value > than }
    }
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// In which arithmetic a gate evaluates the form.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// The f32 constants in f64 arithmetic: the error of the form itself.
    F64,
    /// The f32 constants in f32, correctly rounded: the same on every machine.
    #[default]
    F32,
    /// On the device; not measured where there is none.
    Device,
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
            Self::Device => "device",
        })
    }
}
