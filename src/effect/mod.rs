//! What an effect is made of: references, forms, regions, laws, families, goals, claims.

pub mod candidate;
pub mod claim;
mod exhibit;
mod form_library;
mod form_text;
pub mod points;
pub mod simulator;
mod text;
pub mod values;

use serde::Deserialize;

use crate::document::Section;
use crate::table::Table;
pub use candidate::{Candidate, CandidateError, Candidates, ConstantsOf};
pub use claim::{Claim, ClaimError, Finding, Found};
pub(crate) use exhibit::Exhibit;
pub use form_library::{FormEntry, FormLibrary};
pub use form_text::{FormText, FormTextError, FormTextFault, TextPlace};
use simulator::Simulator;
pub(crate) use text::{Functions, Points, Scalar};
pub use values::{NoValue, ReferenceValues};

/// A quantity a reference takes or returns.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Name, as in the columns of `striae eval`.
    pub name: &'static str,
    /// Unit; `1` for a pure number, `rad`, `nm`, `um` …
    pub unit: &'static str,
    /// Where it is defined, in words: `any finite`, `[0, 1]` …
    pub domain: &'static str,
}

/// Why a reference has no value at a point.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{quantity} = {got} is outside {expected}")]
pub struct DomainError {
    /// The argument at fault.
    pub quantity: &'static str,
    /// Its domain.
    pub expected: &'static str,
    /// The value given.
    pub got: f64,
}

impl DomainError {
    /// `got` if it is `inside` its domain, `expected` in words.
    ///
    /// # Errors
    /// [`DomainError`] if it is not.
    pub fn unless(
        inside: bool,
        quantity: &'static str,
        got: f64,
        expected: &'static str,
    ) -> Result<f64, Self> {
        if inside { Ok(got) } else { Err(Self { quantity, expected, got }) }
    }
}

/// What a reference returns at a point, and how.
#[derive(Debug, Clone, Copy)]
pub enum Evaluate {
    /// One number.
    Scalar(fn(&[f64]) -> Result<f64, DomainError>),
    /// Several, by name; forms of it return as many and are judged on all of them together.
    Vector(&'static [&'static str], fn(&[f64]) -> Result<Vec<f64>, DomainError>),
    /// A distribution of counts. A form of it either draws from it, numbered by a `u32` argument of its
    /// own (a seed, a counter), or returns mean and variance and is judged as a vector.
    Distribution(fn(&[f64]) -> Result<Distribution, DomainError>),
}

/// A distribution of counts 0, 1, 2 …
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    /// Mean.
    pub mean: f64,
    /// Variance.
    pub variance: f64,
    /// Probability of each count from 0; what is missing to 1 lies beyond.
    pub probabilities: Vec<f64>,
}

impl Distribution {
    /// The odds of each count against the one below it times `factor`, mean and variance with them: of a
    /// binomial or a Poisson distribution another of its kind. For distributions of which nothing lies
    /// beyond the probabilities.
    pub fn tilted(&self, factor: f64) -> Self {
        let weights = (0..).zip(&self.probabilities).map(|(k, p)| p * factor.powi(k));
        let weights: Vec<f64> = weights.collect();
        let sum: f64 = weights.iter().sum();
        let probabilities: Vec<f64> = weights.iter().map(|weight| weight / sum).collect();
        let moment = |of: &dyn Fn(f64) -> f64| -> f64 {
            (0..).zip(&probabilities).map(|(k, p)| p * of(f64::from(k))).sum()
        };
        let mean = moment(&|k| k);
        let variance = moment(&|k| (k - mean) * (k - mean));
        Self { mean, variance, probabilities }
    }
}

/// An exact value, in f64, from a formula independent of every form that it judges.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Name, as in `striae eval NAME`.
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    /// The arguments, in order.
    #[serde(deserialize_with = "text::slice")]
    pub arguments: &'static [Quantity],
    /// Unit of the value.
    pub unit: &'static str,
    /// Stated accuracy, with the test that holds it.
    pub accuracy: &'static str,
    /// Source: paper and equation.
    pub source: &'static str,
    /// What it returns at one point; arguments in the order above.
    #[serde(skip, default = "no_value")]
    pub evaluate: Evaluate,
}

/// Of a reference whose text alone is known.
fn no_value() -> Evaluate {
    Evaluate::Scalar(|_| Ok(f64::NAN))
}

/// The arguments of a reference as an array, since the caller may have got their number wrong.
///
/// # Errors
/// [`DomainError`] if there are not N.
pub fn arguments<const N: usize>(point: &[f64]) -> Result<[f64; N], DomainError> {
    point.try_into().map_err(|_| DomainError {
        quantity: "number of arguments",
        expected: "that of the reference",
        got: point.len() as f64,
    })
}

/// A named region in which forms are judged: for every argument of the reference, its values.
///
/// A form is judged in a region that has a column for every argument of its reference and for
/// every input of its own; an input that the reference does not take (the area of a footprint, say)
/// is a further column.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// Short name, as in tables: `[-10, 10]`, `far`, `scene` …
    pub name: &'static str,
    /// In words: what it covers and why it is judged.
    pub description: &'static str,
    /// The points, as a table with one column per argument of the reference; never fitted points.
    #[serde(skip, default = "no_points")]
    pub points: fn() -> Table,
    /// Points of the same distribution on which a spec with `region = "name"` fits, others than
    /// `points`; a column `weight`, where there is one, multiplies the squared residuals.
    #[serde(skip)]
    pub fitted: Option<fn() -> Table>,
    /// An argument whose values part the points into groups: relative errors are then measured
    /// group by group (over the offset for every half-extent, say) and the worst group counts.
    pub by: Option<&'static str>,
    /// The error by which forms are compared there.
    #[serde(default)]
    pub yardstick: Yardstick,
}

impl Region {
    /// What most regions share, for `..Region::EMPTY`: no points of its own to fit, no groups, and
    /// the largest magnitude of the error as the yardstick.
    pub const EMPTY: Self = Self {
        name: "",
        description: "",
        points: Table::default,
        fitted: None,
        by: None,
        yardstick: Yardstick::MaxAbs,
    };
}

/// The error by which forms are compared.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, serde::Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Yardstick {
    /// Largest magnitude.
    #[default]
    MaxAbs,
    /// Largest magnitude relative to the target.
    MaxRelative,
    /// Relative error in the L2 norm, the worst of the groups of [`Region::by`].
    RelativeL2,
}

impl Yardstick {
    /// In words, for the heading of a column.
    pub fn words(self) -> &'static str {
        match self {
            Self::MaxAbs => "max |error|",
            Self::MaxRelative => "max relative error",
            Self::RelativeL2 => "relative L2 error",
        }
    }
}

/// Of a region whose text alone is known.
fn no_points() -> fn() -> Table {
    Region::EMPTY.points
}

/// Evaluates a form in f32 at the rows of a table, from which it takes its inputs by name; all NaN if
/// one is not there.
pub type FormValues<'a> = &'a dyn Fn(&Table) -> Vec<f32>;

/// Worst violation of a law by a form.
pub type Violation = for<'a> fn(FormValues<'a>) -> f64;

/// A property that a form must have whatever its error: oddness, range, monotonicity, end points.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    /// Short name.
    pub name: &'static str,
    /// What is required, with the tolerance and why.
    pub description: &'static str,
    /// Worst violation over hard points, 0 when the law holds exactly.
    #[serde(skip, default = "never_holds")]
    pub violation: Violation,
    /// Largest violation accepted.
    #[serde(default)]
    pub tolerance: f64,
    /// References to whose forms it applies; empty means all of the effect's.
    #[serde(default, deserialize_with = "text::slice")]
    pub references: &'static [&'static str],
    /// Names of the forms known not to satisfy it, each with the reason; shown, not hidden.
    #[serde(default, deserialize_with = "text::known_violations")]
    pub known_violations: &'static [(&'static str, &'static str)],
}

impl Law {
    /// What most laws share, for `..Law::EMPTY`: no tolerance, every form of the effect, and no known
    /// violation. By itself it never holds.
    pub const EMPTY: Self = Self {
        name: "",
        description: "",
        violation: |_| f64::NAN,
        tolerance: 0.0,
        references: &[],
        known_violations: &[],
    };

    /// The largest of `violations`, 0 if none is positive; infinite if there is none or one is not a
    /// number, which no tolerance accepts.
    pub fn worst(violations: impl IntoIterator<Item = f64>) -> f64 {
        let larger = |worst: f64, v: f64| if v.is_nan() { f64::INFINITY } else { worst.max(v) };
        let mut violations = violations.into_iter().peekable();
        if violations.peek().is_none() { f64::INFINITY } else { violations.fold(0.0, larger) }
    }
}

/// Of a law whose text alone is known.
fn never_holds() -> Violation {
    Law::EMPTY.violation
}

/// One table of a [`Family`]: what a form is fitted to under one set of conditions.
#[derive(Debug, Clone)]
pub struct Member {
    /// `group.source@band`, unique in the family, as in `Au.Johnson@550nm` or `Au.Johnson@R`.
    pub label: String,
    /// What is described (a material).
    pub group: String,
    /// Who measured it.
    pub source: String,
    /// Under which condition (a wavelength, a colour channel).
    pub band: String,
    /// One column per argument of the form, and `value`: what the form should return.
    pub table: Table,
}

/// Tables of one kind made from measured data, to all of which a form is fitted one by one.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// Name, as in a spec's `family = "…"`.
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    /// Makes the members from the data folder (`data/measured`), in a fixed order. `held_out`
    /// asks for other points than the ones that are fitted (denser, hard cases among them).
    pub members: fn(data: &std::path::Path, held_out: bool) -> Result<Vec<Member>, FamilyError>,
}

/// Why a family could not be made.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct FamilyError(pub String);

/// An error that a form was to reach at a cost, held beside what it reaches.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The fit.
    pub fit: &'static str,
    /// The region, or set of hard cases, in which the error is taken, by its yardstick.
    pub region: &'static str,
    /// Largest error.
    pub error: f64,
    /// Largest cost, as counted, relative to the baseline of its reference.
    pub cost: f64,
    /// Why this error and this cost.
    pub why: &'static str,
}

/// One physical thing. What it lacks is left to [`Effect::EMPTY`].
#[derive(Debug, Clone, Copy)]
pub struct Effect {
    /// Module name.
    pub name: &'static str,
    /// Title of its page.
    pub title: &'static str,
    /// A paragraph: what it is and where renderers use it.
    pub description: &'static str,
    /// Exact quantities.
    pub references: &'static [Reference],
    /// Texts of its approximations, and of the pieces that they share.
    pub forms: fn() -> Vec<FormText>,
    /// What makes tables of it.
    pub simulators: &'static [Simulator],
    /// Families of tables made from measured data.
    pub families: &'static [Family],
    /// Where they are judged.
    pub regions: &'static [Region],
    /// Points that have broken implementations, by what they have in common: each a table with one
    /// column per argument of a reference.
    pub hard_cases: &'static [Region],
    /// Properties of every form.
    pub laws: &'static [Law],
    /// What was set out to be reached.
    pub goals: &'static [Goal],
    /// The fits that ratios of cost refer to, one per reference: what renderers ship today.
    pub baselines: &'static [&'static str],
    /// Claims of papers.
    pub claims: &'static [Claim<Candidates>],
    /// What it shows beyond its fits: figures of a paper, energies, errors against a parameter of the
    /// scene. Every number is measured when the sections are made.
    pub exhibits: fn(&Candidates) -> Result<Vec<Section>, ClaimError>,
}

impl Effect {
    /// An effect without a name and with nothing in it, for `..Effect::EMPTY`.
    pub const EMPTY: Self = Self {
        name: "",
        title: "",
        description: "",
        references: &[],
        forms: Vec::new,
        simulators: &[],
        families: &[],
        regions: &[],
        hard_cases: &[],
        laws: &[],
        goals: &[],
        baselines: &[],
        claims: &[],
        exhibits: |_| Ok(Vec::new()),
    };
}
