//! The result of a fit, as committed in `fits/<effect>/<name>.json` (`schema: 1`).

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize};

/// JSON has no NaN: it is written as null, in a fit whose status is `non_finite`.
fn null_as_nan<'de, T: Deserialize<'de> + From<f32>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f32::NAN.into()))
}

/// How a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// A convergence criterion holds and every number is finite.
    Converged,
    /// No further progress without a criterion being met.
    Stalled,
    /// The budget ran out first.
    HitIterationLimit,
    /// A parameter sits on its bound.
    AtBound,
    /// The Jacobian is singular: some parameter, or a combination, has no effect.
    Singular,
    /// The cost or a parameter is not finite.
    NonFinite,
}

impl Status {
    /// In words, as tables and messages say it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Stalled => "stalled",
            Self::HitIterationLimit => "hit iteration limit",
            Self::AtBound => "at bound",
            Self::Singular => "singular",
            Self::NonFinite => "non-finite",
        }
    }
}

/// One constant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterOutcome {
    /// Optimum in f64.
    #[serde(deserialize_with = "null_as_nan")]
    pub value: f64,
    /// What ships: refined in f32 so that the error of the shipped expression is minimal.
    #[serde(deserialize_with = "null_as_nan")]
    pub f32: f32,
    /// Bits of `f32`, as in `0x3f295350`.
    pub f32_hex: String,
    /// Where the fit started.
    pub start: f64,
    /// Lower bound; absent means none.
    pub lower: Option<f64>,
    /// Upper bound; absent means none.
    pub upper: Option<f64>,
    /// `free`, `fixed` or `tied to <name>`.
    pub role: String,
    /// Standard error, where it means something.
    pub stderr: Option<f64>,
    /// Why there is none.
    pub why_no_stderr: Option<String>,
}

/// Residuals, form minus target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Residuals {
    /// Number of points.
    pub count: usize,
    /// Root mean square, in the target's unit.
    #[serde(deserialize_with = "null_as_nan")]
    pub rms: f64,
    /// Largest magnitude.
    #[serde(deserialize_with = "null_as_nan")]
    pub max_abs: f64,
    /// Where it is, by input column.
    pub max_abs_at: BTreeMap<String, f64>,
    /// Mean.
    #[serde(deserialize_with = "null_as_nan")]
    pub bias: f64,
    /// Median magnitude.
    #[serde(deserialize_with = "null_as_nan")]
    pub p50: f64,
    /// 95th percentile of the magnitude.
    #[serde(deserialize_with = "null_as_nan")]
    pub p95: f64,
    /// 99th percentile of the magnitude.
    #[serde(deserialize_with = "null_as_nan")]
    pub p99: f64,
    /// Largest magnitude relative to the target, over points where the target is not 0.
    pub max_rel: Option<f64>,
    /// Where it is.
    pub max_rel_at: Option<BTreeMap<String, f64>>,
}

/// Result of one start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StartOutcome {
    /// Starting values of the free parameters.
    pub start: BTreeMap<String, f64>,
    /// Final cost, absent if it is not finite.
    pub cost: Option<f64>,
    /// How this start ended.
    pub status: Status,
    /// The solver that won from this start.
    pub solver: String,
}

/// Where a result comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FitProvenance {
    /// Version of striae.
    pub striae: String,
    /// SHA-256 of the spec's text.
    pub spec_sha256: String,
    /// SHA-256 of the target's points and values, and of the form's text.
    pub data_sha256: String,
    /// Seed of every random choice.
    pub seed: u64,
    /// The command that regenerates it.
    pub command: String,
}

/// The result of a fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Version of this format: 1.
    pub schema: u32,
    /// `effect/name`, or `effect/name#member` for a member of a family.
    pub name: String,
    /// Registered form (`effect/form`) or path of a WGSL file.
    pub form: String,
    /// WGSL function.
    pub function: String,
    /// Reference, family or table that it is fitted to.
    pub target: String,
    /// How it ended.
    pub status: Status,
    /// Solver used, and why if the spec left it open.
    pub solver: String,
    /// Loss, as in the spec.
    pub loss: String,
    /// Iterations of the start that won.
    pub iterations: u64,
    /// Evaluations of the form over all points, all starts together.
    pub evaluations: u64,
    /// Constants by name.
    pub parameters: BTreeMap<String, ParameterOutcome>,
    /// Correlation of the free parameters, rows and columns in the order of `correlation_order`.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// Names of the free parameters in the order of `correlation`.
    pub correlation_order: Vec<String>,
    /// Condition number of the column-scaled Jacobian.
    pub condition: Option<f64>,
    /// For a minimax fit: how many times the error reaches its maximum with alternating sign.
    pub equioscillations: Option<usize>,
    /// Residuals of the f64 optimum over the fitted points.
    pub residuals: Residuals,
    /// Residuals of the f32 constants evaluated in f32 over the same points.
    pub residuals_f32: Residuals,
    /// Residuals of the f64 constants beyond the fitted domain, by region name.
    pub outside: BTreeMap<String, Residuals>,
    /// One entry per start.
    pub starts: Vec<StartOutcome>,
    /// Where it comes from.
    pub provenance: FitProvenance,
}

impl Outcome {
    /// What the result is of within its family: the part of the name after `#`, if there is one.
    pub fn label(&self) -> &str {
        self.name.split_once('#').map_or("", |(_, label)| label)
    }

    /// Number of free constants.
    pub fn free_count(&self) -> usize {
        self.parameters.values().filter(|parameter| parameter.role == "free").count()
    }
}

/// The results of a form fitted to every member of a family, in one file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FamilyOutcome {
    /// Version of this format: 1.
    pub schema: u32,
    /// `effect/name`.
    pub name: String,
    /// Registered form.
    pub form: String,
    /// Family that it is fitted to.
    pub family: String,
    /// One result per member, in the family's order.
    pub members: Vec<Outcome>,
    /// Where it comes from.
    pub provenance: FitProvenance,
}
