//! The TOML of a spec, as in `fits/<effect>/<name>.toml`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::FitError;
use super::loss::Loss;
use super::solve::SolverKind;
use super::spec::{FormChoice, ParameterChoice, SampledDomain, Spec, Target, Unnamed, Weighting};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpecFile {
    #[serde(default)]
    description: String,
    form: String,
    function: Option<String>,
    output: Option<String>,
    target: Option<String>,
    family: Option<String>,
    table: Option<PathBuf>,
    column: Option<String>,
    weight: Option<String>,
    #[serde(default)]
    domain: SampledDomain,
    region: Option<String>,
    #[serde(default)]
    constants: Vec<String>,
    #[serde(default)]
    loss: LossFile,
    #[serde(default)]
    solver: SolverFile,
    #[serde(default)]
    parameters: BTreeMap<String, ParameterFile>,
    #[serde(default)]
    outside: BTreeMap<String, SampledDomain>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct LossFile {
    #[serde(default)]
    kind: LossKind,
    scale: Option<f64>,
}

#[derive(Deserialize, Default, PartialEq)]
#[serde(rename_all = "snake_case")]
enum LossKind {
    #[default]
    LeastSquares,
    Relative,
    Huber,
    Minimax,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SolverFile {
    kind: SolverKind,
    max_iterations: u64,
    multi_start: usize,
    seed: u64,
}

impl Default for SolverFile {
    fn default() -> Self {
        Self { kind: SolverKind::Auto, max_iterations: 500, multi_start: 1, seed: 1 }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ParameterFile {
    start: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
    fixed: Option<f64>,
    tied: Option<String>,
}

impl Spec {
    /// Reads a spec; its name is the last folder and the stem of `path`, as in `effect/name`.
    ///
    /// # Errors
    /// [`FitError::Io`], and everything of [`Spec::parse`].
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let origin = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|source| FitError::Io { path: origin.clone(), source })?;
        let part = |part: Option<&std::ffi::OsStr>| {
            part.map(|p| p.to_string_lossy().into_owned()).unwrap_or_default()
        };
        let stem = part(path.file_stem());
        let folder = part(path.parent().and_then(Path::file_name));
        let name = if folder.is_empty() { stem } else { format!("{folder}/{stem}") };
        Self::parse(&origin, &name, &text)
    }

    /// The spec called `name` in `text`; `origin` names the file in errors.
    ///
    /// # Errors
    /// [`FitError::Unusable`] for a text that is not TOML, an unknown key or a wrong type;
    /// [`FitError::Spec`] for values that make no sense ([`Spec::check`]).
    pub fn parse(origin: &str, name: &str, text: &str) -> Result<Self, FitError> {
        let file: SpecFile = toml::from_str(text).map_err(|error| FitError::Unusable {
            origin: origin.to_owned(),
            what: error.to_string().trim_end().to_owned(),
        })?;
        let mut spec = Self::ad_hoc(
            name,
            FormChoice::Registered(String::new()),
            Target::Reference(String::new()),
        );
        spec.origin = origin.to_owned();
        spec.text = text.to_owned();
        spec.unnamed = Unnamed::Fixed;
        spec.command = format!("striae fit {name}");
        spec.form = match &file.function {
            Some(function) => {
                FormChoice::File { path: PathBuf::from(&file.form), function: function.clone() }
            }
            None if file.form.ends_with(".wgsl") => {
                return Err(spec.fault("form", "a WGSL file also needs `function`".into()));
            }
            None => FormChoice::Registered(file.form.clone()),
        };
        spec.target = target(&spec, &file)?;
        spec.loss = loss(&spec, &file.loss)?;
        for (parameter, choice) in &file.parameters {
            spec.parameters.insert(parameter.clone(), choice_of(&spec, parameter, choice)?);
        }
        let SolverFile { kind: solver, max_iterations, multi_start, seed } = file.solver;
        let SpecFile { description, output, region, constants, domain, outside, .. } = file;
        spec = Self { description, output, region, constants, domain, outside, ..spec };
        spec = Self { solver, max_iterations, multi_start, seed, ..spec };
        spec.check()?;
        Ok(spec)
    }
}

fn target(spec: &Spec, file: &SpecFile) -> Result<Target, FitError> {
    let domain_key = (!file.domain.is_empty()).then_some("domain");
    let region_key = file.region.is_some().then_some("region");
    let domain_key = domain_key.or(region_key);
    let outside_key = (!file.outside.is_empty()).then_some("outside");
    let of_tables = [("column", file.column.is_some()), ("weight", file.weight.is_some())];
    let stray = of_tables.iter().find(|(_, there)| *there).map(|(key, _)| *key);
    match (&file.target, &file.family, &file.table) {
        (Some(reference), None, None) => match stray {
            Some(key) => Err(spec.fault(key, "only a table has columns".into())),
            None if file.domain.is_empty() == file.region.is_none() => {
                Err(spec.fault("domain", "a reference needs either a domain or a region".into()))
            }
            None => Ok(Target::Reference(reference.clone())),
        },
        (None, Some(family), None) => match stray.or(domain_key).or(outside_key) {
            Some(key) => Err(spec.fault(key, "a family brings its own points".into())),
            None => Ok(Target::Family(family.clone())),
        },
        (None, None, Some(path)) => {
            if let Some(key) = domain_key.or(outside_key) {
                return Err(spec.fault(key, "a table brings its own points".into()));
            }
            let column = file
                .column
                .clone()
                .ok_or_else(|| spec.fault("table", "a table also needs `column`".into()))?;
            let weight = match file.weight.as_deref() {
                None | Some("uncertainty") => Weighting::Uncertainty,
                Some("none") => Weighting::Equal,
                Some(column) => Weighting::Column(column.to_owned()),
            };
            Ok(Target::File { path: path.clone(), column, weight })
        }
        _ => Err(spec.fault("target", "expected exactly one of target, family and table".into())),
    }
}

fn loss(spec: &Spec, file: &LossFile) -> Result<Loss, FitError> {
    match (&file.kind, file.scale) {
        (LossKind::Huber, Some(scale)) => Ok(Loss::Huber { scale }),
        (LossKind::Huber, None) => Err(spec.fault("loss.kind", "huber needs `scale`".into())),
        (_, Some(_)) => Err(spec.fault("loss.scale", "only huber has a scale".into())),
        (LossKind::LeastSquares, None) => Ok(Loss::LeastSquares),
        (LossKind::Relative, None) => Ok(Loss::Relative),
        (LossKind::Minimax, None) => Ok(Loss::Minimax),
    }
}

fn choice_of(spec: &Spec, name: &str, file: &ParameterFile) -> Result<ParameterChoice, FitError> {
    let varies = file.start.is_some() || file.lower.is_some() || file.upper.is_some();
    match (file.fixed, &file.tied, varies) {
        (Some(value), None, false) => Ok(ParameterChoice::Fixed(value)),
        (None, Some(other), false) => Ok(ParameterChoice::Tied(other.clone())),
        (None, None, _) => {
            Ok(ParameterChoice::Free { start: file.start, lower: file.lower, upper: file.upper })
        }
        _ => Err(spec.fault(
            &format!("parameters.{name}"),
            "expected either fixed, or tied, or start and bounds".into(),
        )),
    }
}
