//! `fit`: runs specs, or fits the user's own form to the user's own table.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueEnum};

use super::context::Context;
use super::fit_table::{one, summary};
use super::{Ending, assignment};
use crate::fit::loss::Loss;
use crate::fit::solve::SolverKind;
use crate::fit::spec::{FormChoice, ParameterChoice, Target, Unnamed, Weighting};
use crate::fit::{self, FitResult, Spec};
use crate::gate;
use crate::registry::Registry;
use crate::run::{self, Job};

const MORE: &str = "\
Results are written to fits/<effect>/<name>.json beside their specs, each through a temporary file
and a rename: an interrupted run leaves old results whole. Exit code 3 if a fit did not converge; one
that ends on a bound has, and says so.

Examples:
  striae fit --all
  striae fit sine_integral/refit
  striae fit --form mine.wgsl --function f --table mine.csv --output-column y \\
      --start a=1,b=2 --bounds a=0:10 -o mine.json";

/// Run specs, or fit a form to a table
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Specs to run, as `effect/name`
    #[arg(value_name = "NAME", conflicts_with_all = ["all", "spec", "form"])]
    names: Vec<String>,
    /// Run every spec of the project
    #[arg(long, conflicts_with_all = ["spec", "form"])]
    all: bool,
    /// Run the spec in a file; the result is written beside it, or to --output
    #[arg(long, value_name = "TOML", conflicts_with = "form")]
    spec: Option<PathBuf>,
    /// Result file
    #[arg(long, short, value_name = "JSON", conflicts_with = "all")]
    output: Option<PathBuf>,
    #[command(flatten)]
    own: Own,
}

/// A fit without a spec.
#[derive(Debug, Args)]
#[command(next_help_heading = "Fit a form to a table, without a spec")]
struct Own {
    /// WGSL file, with --function, or a registered form
    #[arg(long, value_name = "WGSL", requires_all = ["table", "output_column", "output"])]
    form: Option<String>,
    /// Function of the WGSL file
    #[arg(long, value_name = "NAME", requires = "form")]
    function: Option<String>,
    /// Table to fit to; its columns are named after the arguments of the form
    #[arg(long, value_name = "CSV", requires = "form")]
    table: Option<PathBuf>,
    /// Column that the form should return
    #[arg(long, value_name = "NAME", requires = "form")]
    output_column: Option<String>,
    /// Starting values; a constant without one starts from the default in the text
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',', requires = "form",
          value_parser = assignment::number)]
    start: Vec<(String, f64)>,
    /// Bounds, of which either end may be left out
    #[arg(long, value_name = "NAME=LOWER:UPPER", value_delimiter = ',', requires = "form",
          value_parser = assignment::bounds)]
    bounds: Vec<assignment::Bounds>,
    /// Constants that keep a value
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',', requires = "form",
          value_parser = assignment::number)]
    fix: Vec<(String, f64)>,
    /// What is minimised
    #[arg(long, value_enum, default_value_t = LossKind::LeastSquares)]
    loss: LossKind,
    /// Where the Huber loss turns linear, in the unit of the output column
    #[arg(long, value_name = "VALUE", required_if_eq("loss", "huber"))]
    huber_scale: Option<f64>,
    /// Column of weights of the squared residuals, or `none` to ignore a column of uncertainties
    #[arg(long, value_name = "COLUMN", requires = "form")]
    weight: Option<String>,
    /// Solver
    #[arg(long, value_name = "NAME", value_parser = solver, requires = "form")]
    solver: Option<SolverKind>,
    /// Number of starts: the given one and random ones
    #[arg(long, value_name = "N", default_value_t = 1, requires = "form")]
    multi_start: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LossKind {
    /// Sum of squares
    LeastSquares,
    /// Sum of squares relative to the target
    Relative,
    /// Squares up to --huber-scale, linear beyond
    Huber,
    /// Largest magnitude
    Minimax,
}

fn solver(name: &str) -> Result<SolverKind, String> {
    let all = [
        SolverKind::Auto,
        SolverKind::GaussNewton,
        SolverKind::TrustRegion,
        SolverKind::LevenbergMarquardt,
        SolverKind::NelderMead,
        SolverKind::Lbfgs,
        SolverKind::Brent,
    ];
    let names: Vec<&str> = all.iter().map(|solver| solver.name()).collect();
    let found = all.into_iter().find(|solver| solver.name() == name.replace('-', "_"));
    found.ok_or_else(|| format!("expected {}", names.join(" | ")))
}

/// Runs the specs that the command line names.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let (mut jobs, root) = jobs(arguments, context)?;
    if let Some(seed) = context.seed {
        jobs.iter_mut().for_each(|job| job.spec.seed = seed);
    }
    let place = fit::Context::new(root, context.project_or_here().registry());
    let results = fit(&jobs, &place, context)?;
    context.output.sections(&json(&results)?, || match arguments.all {
        true => vec![summary(&results)],
        false => results.iter().map(one).collect(),
    })?;
    Ok(ending(&results))
}

/// Exit code 3 as soon as one set of constants is no optimum, with or without a bound.
pub(super) fn ending(results: &[FitResult]) -> Ending {
    let mut outcomes = results.iter().flat_map(FitResult::outcomes);
    let converged = outcomes.all(|outcome| gate::stands(outcome.status));
    if converged { Ending::Done } else { Ending::NotConverged }
}

/// Runs and writes every job; the first fault is returned, the others are noted.
pub(super) fn fit(
    jobs: &[Job],
    place: &fit::Context,
    context: &Context,
) -> anyhow::Result<Vec<FitResult>> {
    let bar = context.output.bar(jobs.len());
    let results = run::fit(jobs, place, &|name| match name {
        Some(name) => bar.set_message(name.to_owned()),
        None => bar.inc(1),
    });
    bar.finish_and_clear();
    let (mut good, mut faults) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(result) => good.push(result),
            Err(error) => faults.push(anyhow::Error::new(error)),
        }
    }
    let mut faults = faults.into_iter();
    let first = faults.next();
    faults.for_each(|error| context.output.note(&format!("error: {error:#}")));
    first.map_or(Ok(good), Err)
}

fn json(results: &[FitResult]) -> anyhow::Result<serde_json::Value> {
    let parsed = results.iter().map(|result| -> anyhow::Result<serde_json::Value> {
        Ok(serde_json::from_str(&result.to_json()?)?)
    });
    Ok(serde_json::Value::Array(parsed.collect::<Result<_, _>>()?))
}

fn jobs(arguments: &Arguments, context: &Context) -> anyhow::Result<(Vec<Job>, PathBuf)> {
    if let Some(form) = &arguments.own.form {
        let spec = own_spec(form, &arguments.own, context.project_or_here().registry())?;
        let job = Job { spec, result: arguments.output.clone().unwrap_or_default() };
        return Ok((vec![job], PathBuf::new()));
    }
    if let Some(path) = &arguments.spec {
        let root = match context.has_project() {
            true => context.project()?.root().to_path_buf(),
            false => PathBuf::new(),
        };
        let result = arguments.output.clone().unwrap_or_else(|| path.with_extension("json"));
        return Ok((vec![Job { spec: Spec::read(path)?, result }], root));
    }
    if arguments.names.is_empty() && !arguments.all {
        bail!(
            "nothing to fit: name specs (see `striae list fits`), or give --all, --spec or --form"
        );
    }
    let project = context.project()?;
    let files = project.specs_named(&arguments.names)?.into_iter();
    let jobs = files.map(|file| Ok(Job { spec: Spec::read(&file.path)?, result: file.result() }));
    let mut jobs = jobs.collect::<anyhow::Result<Vec<_>>>()?;
    if let Some(output) = &arguments.output {
        match jobs.as_mut_slice() {
            [job] => job.result.clone_from(output),
            _ => bail!("--output is for one spec; {} are named", jobs.len()),
        }
    }
    Ok((jobs, project.root().to_path_buf()))
}

fn own_spec(form: &str, own: &Own, registry: &Registry) -> anyhow::Result<Spec> {
    let choice = match &own.function {
        Some(function) => {
            FormChoice::File { path: PathBuf::from(form), function: function.clone() }
        }
        None if registry.form(form).is_some() => FormChoice::Registered(form.to_owned()),
        None => bail!("--form {form}: not a registered form; a WGSL file also needs --function"),
    };
    let weight = match own.weight.as_deref() {
        None => Weighting::Uncertainty,
        Some("none") => Weighting::Equal,
        Some(column) => Weighting::Column(column.to_owned()),
    };
    let target = Target::File {
        path: own.table.clone().unwrap_or_default(),
        column: own.output_column.clone().unwrap_or_default(),
        weight,
    };
    let name = Path::new(form).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut spec = Spec::ad_hoc(&name, choice, target);
    spec.loss = match (own.loss, own.huber_scale) {
        (LossKind::LeastSquares, _) => Loss::LeastSquares,
        (LossKind::Relative, _) => Loss::Relative,
        (LossKind::Minimax, _) => Loss::Minimax,
        (LossKind::Huber, Some(scale)) => Loss::Huber { scale },
        (LossKind::Huber, None) => bail!("--loss huber needs --huber-scale"),
    };
    spec.solver = own.solver.unwrap_or_default();
    spec.multi_start = own.multi_start;
    spec.unnamed = Unnamed::Free;
    for (name, value) in &own.start {
        free(&mut spec, name)?.0.replace(*value);
    }
    for (name, lower, upper) in &own.bounds {
        let (_, below, above) = free(&mut spec, name)?;
        (*below, *above) = (*lower, *upper);
    }
    for (name, value) in &own.fix {
        if spec.parameters.insert(name.clone(), ParameterChoice::Fixed(*value)).is_some() {
            bail!("--fix {name}: it has a start or bounds too");
        }
    }
    spec.command =
        std::env::args().skip(1).fold("striae".to_owned(), |line, word| line + " " + &word);
    Ok(spec)
}

type FreeFields<'a> = (&'a mut Option<f64>, &'a mut Option<f64>, &'a mut Option<f64>);

/// Start, lower and upper bound of a constant.
fn free<'a>(spec: &'a mut Spec, name: &str) -> anyhow::Result<FreeFields<'a>> {
    let fresh = ParameterChoice::Free { start: None, lower: None, upper: None };
    match spec.parameters.entry(name.to_owned()).or_insert(fresh) {
        ParameterChoice::Free { start, lower, upper } => Ok((start, lower, upper)),
        _ => bail!("`{name}` is fixed"),
    }
}
