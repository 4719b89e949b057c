//! What a fit is asked to do: read from a TOML file ([`Spec::read`]) or made by a caller
//! ([`Spec::ad_hoc`]).

use std::collections::BTreeMap;
use std::path::PathBuf;

use toml::de::DeTable;

use super::error::FitError;
use super::loss::Loss;
use super::sampling::Sampling;
use super::solve::SolverKind;
use crate::table::Table;

/// Largest budget of a solver; more is a mistake.
const MOST_ITERATIONS: u64 = 1_000_000;
/// Most starts; more is a mistake.
const MOST_STARTS: u64 = 10_000;

/// Which form.
#[derive(Debug, Clone, PartialEq)]
pub enum FormChoice {
    /// A registered form, `effect/form`.
    Registered(String),
    /// A function of a WGSL file.
    File {
        /// Path, relative to the project's root unless absolute.
        path: PathBuf,
        /// The WGSL function.
        function: String,
    },
    /// A function of a text.
    Text {
        /// Name for diagnostics.
        origin: String,
        /// The WGSL text.
        source: String,
        /// The WGSL function.
        function: String,
    },
}

/// How the rows of a table are weighted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Weighting {
    /// 1/u² with the target column's standard uncertainty u where it has one, else all equal.
    Uncertainty,
    /// All equal, whatever the column's uncertainty.
    Equal,
    /// The numbers of a column, which multiply the squared residuals.
    Column(String),
}

/// What is fitted to.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// A registered reference over the spec's domain. The points are rounded to f32, so that the f32
    /// constants are judged where the reference was evaluated.
    Reference(String),
    /// Every member of a registered family, one by one.
    Family(String),
    /// A CSV file.
    File {
        /// Path, relative to the project's root unless absolute.
        path: PathBuf,
        /// The column to reproduce.
        column: String,
        /// Weights.
        weight: Weighting,
    },
    /// A table in memory, measured: standard errors mean something.
    Table {
        /// Name for diagnostics.
        label: String,
        /// The table; the form's inputs and `column` are among its columns.
        table: Table,
        /// The column to reproduce.
        column: String,
        /// Weights.
        weight: Weighting,
    },
}

/// Values per argument of the form; several arguments make a tensor product.
pub type SampledDomain = BTreeMap<String, Sampling>;

/// What becomes of an `override`.
#[derive(Debug, Clone, PartialEq)]
pub enum ParameterChoice {
    /// Fitted.
    Free {
        /// Start; the text's default if absent.
        start: Option<f64>,
        /// Lower bound.
        lower: Option<f64>,
        /// Upper bound.
        upper: Option<f64>,
    },
    /// Kept at a value.
    Fixed(f64),
    /// Equal to another parameter.
    Tied(String),
}

/// What becomes of an `override` that the spec does not name; one without a default is an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unnamed {
    /// It keeps its default.
    Fixed,
    /// It is fitted, from its default.
    Free,
}

/// A fit, complete.
#[derive(Debug, Clone, PartialEq)]
pub struct Spec {
    /// `effect/name`.
    pub name: String,
    /// One line.
    pub description: String,
    /// The form.
    pub form: FormChoice,
    /// Output column of the form, for forms that return vectors; absent means the only one.
    pub output: Option<String>,
    /// The target.
    pub target: Target,
    /// Where, for a reference.
    pub domain: SampledDomain,
    /// A region of the effect whose fitted points take the place of the domain, for a reference.
    pub region: Option<String>,
    /// Fits whose committed f32 constants those parameters keep that are not named below.
    pub constants: Vec<String>,
    /// Further regions in which residuals are reported, for a reference.
    pub outside: BTreeMap<String, SampledDomain>,
    /// The loss.
    pub loss: Loss,
    /// The solver.
    pub solver: SolverKind,
    /// Budget of the solver, per start.
    pub max_iterations: u64,
    /// Number of starts, at least 1.
    pub multi_start: usize,
    /// Seed of the further starts.
    pub seed: u64,
    /// Parameters by name.
    pub parameters: BTreeMap<String, ParameterChoice>,
    /// Parameters not named above.
    pub unnamed: Unnamed,
    /// Where the spec was read, or `command line`.
    pub origin: String,
    /// Its text; empty if it was not read from a file.
    pub text: String,
    /// The command that regenerates the result.
    pub command: String,
}

impl Spec {
    /// A form fitted to a table by least squares from the defaults of its text, with everything
    /// else left to `auto`; the fields are public to be changed.
    pub fn ad_hoc(name: &str, form: FormChoice, target: Target) -> Self {
        Self {
            name: name.to_owned(),
            description: String::new(),
            form,
            output: None,
            target,
            domain: SampledDomain::new(),
            region: None,
            constants: Vec::new(),
            outside: BTreeMap::new(),
            loss: Loss::LeastSquares,
            solver: SolverKind::Auto,
            max_iterations: 2000,
            multi_start: 1,
            seed: 1,
            parameters: BTreeMap::new(),
            unnamed: Unnamed::Free,
            origin: "command line".to_owned(),
            text: String::new(),
            command: String::new(),
        }
    }

    /// Checks what can be checked without the form and the target.
    ///
    /// # Errors
    /// [`FitError::Spec`] naming the key: a domain or bounds without width, a start outside its
    /// bounds, numbers that are not finite, counts of 0, a parameter tied to one that is tied.
    pub fn check(&self) -> Result<(), FitError> {
        let outside = self.outside.iter().map(|(name, d)| (format!("outside.{name}"), d));
        for (key, domain) in [("domain".to_owned(), &self.domain)].into_iter().chain(outside) {
            for (argument, axis) in domain {
                if let Some(fault) = axis_fault(axis) {
                    return Err(self.fault(&format!("{key}.{argument}"), fault));
                }
            }
        }
        if let Loss::Huber { scale } = self.loss
            && !(scale.is_finite() && scale > 0.0)
        {
            return Err(self.fault("loss.scale", format!("expected a number > 0, got {scale}")));
        }
        for (key, most, got) in [
            ("solver.max_iterations", MOST_ITERATIONS, self.max_iterations),
            ("solver.multi_start", MOST_STARTS, self.multi_start as u64),
        ] {
            if !(1..=most).contains(&got) {
                return Err(self.fault(key, format!("expected 1 to {most}, got {got}")));
            }
        }
        for (name, choice) in &self.parameters {
            if let Some((key, fault)) = self.parameter_fault(choice) {
                return Err(self.fault(&format!("parameters.{name}{key}"), fault));
            }
        }
        Ok(())
    }

    fn parameter_fault(&self, choice: &ParameterChoice) -> Option<(&'static str, String)> {
        match choice {
            ParameterChoice::Fixed(value) => (!value.is_finite())
                .then(|| (".fixed", format!("expected a finite number, got {value}"))),
            ParameterChoice::Tied(other) => match self.parameters.get(other) {
                Some(ParameterChoice::Tied(third)) => {
                    Some((".tied", format!("`{other}` is itself tied to `{third}`")))
                }
                _ => None,
            },
            ParameterChoice::Free { start, lower, upper } => {
                let numbers = [(".start", start), (".lower", lower), (".upper", upper)];
                let given = numbers.into_iter().filter_map(|(key, value)| Some((key, (*value)?)));
                if let Some((key, value)) = given.into_iter().find(|(_, value)| !value.is_finite())
                {
                    return Some((key, format!("expected a finite number, got {value}")));
                }
                if let (Some(lower), Some(upper)) = (lower, upper)
                    && lower >= upper
                {
                    let what = format!(
                        "expected lower < upper, got {lower} and {upper}: the bounds have no width \
                         (use `fixed`)"
                    );
                    return Some(("", what));
                }
                start.and_then(|start| start_fault(start, *lower, *upper)).map(|f| (".start", f))
            }
        }
    }

    /// A [`FitError::Spec`] at `key`, with the line of the key where the text has it.
    pub(super) fn fault(&self, key: &str, what: String) -> FitError {
        FitError::Spec {
            path: self.origin.clone(),
            line: line_of(&self.text, key),
            key: key.to_owned(),
            what,
        }
    }
}

/// Why a start cannot be within its bounds.
pub(super) fn start_fault(start: f64, lower: Option<f64>, upper: Option<f64>) -> Option<String> {
    let below = lower.filter(|lower| start < *lower);
    let above = upper.filter(|upper| start > *upper);
    match (below, above) {
        (Some(lower), _) => Some(format!("{start} is below the lower bound {lower}")),
        (_, Some(upper)) => Some(format!("{start} is above the upper bound {upper}")),
        _ => None,
    }
}

fn axis_fault(axis: &Sampling) -> Option<String> {
    match axis {
        Sampling::Constant(value) => {
            (!value.is_finite()).then(|| format!("expected a finite number, got {value}"))
        }
        Sampling::Pieces(pieces) if pieces.is_empty() => Some("expected at least one piece".into()),
        Sampling::Pieces(pieces) => pieces.iter().find_map(super::sampling::Piece::fault),
    }
}

/// The line, from 1, of `section.key…` in a TOML text; of the section if the key is not found.
fn line_of(text: &str, key: &str) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let mut table = Some(document.get_ref());
    let mut found = None;
    for part in key.split('.').take(2) {
        let entry = table.and_then(|table| table.iter().find(|(name, _)| name.get_ref() == part));
        let Some((name, value)) = entry else { break };
        found = Some(name.span().start);
        table = value.get_ref().as_table();
    }
    found.map(|start| 1 + text.bytes().take(start).filter(|byte| *byte == b'\n').count())
}

#[cfg(test)]
mod tests {
    use super::line_of;

    #[test]
    fn keys_are_found_by_section() {
        let text =
            "form = \"f\"\n[domain]\nx = {}\n[parameters]\n# a\na = {}\n[outside]\nfar = 1\n";
        assert_eq!(line_of(text, "form"), Some(1));
        assert_eq!(line_of(text, "domain.x"), Some(3));
        assert_eq!(line_of(text, "parameters.a.lower"), Some(6));
        assert_eq!(line_of(text, "parameters.b"), Some(4));
        assert_eq!(line_of(text, "outside.far.x"), Some(8));
        assert_eq!(line_of("", "form"), None);
    }
}
