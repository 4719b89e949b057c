//! `eval`: a reference or a form at given points.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::{Args, ValueEnum};

use super::context::Context;
use super::points::Points;
use super::{Ending, output};
use crate::effect::{Candidate, Reference};
use crate::form::Input;
use crate::gpu::Device;
use crate::table::store::atomic_write;

const MORE: &str = "\
NAME is looked up as
  a reference                     sine_integral, fresnel_conductor
  a fit, with its constants       sine_integral/refit, fresnel/lazanyi#Au.Johnson@R
  a registered form               sine_integral/published, with the constants of its text
  a WGSL file, with --function    my.wgsl
in that order; `form:NAME` skips the fits. The constants of a fit are its f64 optimum for
--precision f64 and what ships for f32 and gpu.

The input has one column per argument, named after it, as `x` or `x [unit]`. Every column is kept;
the result is added as `value`, or `value_x`, `value_y` …, with as many digits as it takes to read
back the same number.

Example:
  striae eval sine_integral --input points.csv --output values.csv";

/// Evaluate a reference or a form at the points of a CSV
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Reference, fit, form or WGSL file
    name: String,
    /// CSV of points; `-` for stdin
    #[arg(long, short, value_name = "CSV")]
    input: PathBuf,
    /// CSV to write; `-` for stdout
    #[arg(long, short, value_name = "CSV", default_value = "-")]
    output: PathBuf,
    /// Arithmetic; references are f64 only
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    precision: Precision,
    /// Value of a constant of the form; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = super::assignment::number)]
    set: Vec<(String, f64)>,
    /// Function of a WGSL file
    #[arg(long, value_name = "NAME")]
    function: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Precision {
    /// Double precision
    F64,
    /// Single precision, correctly rounded, in the order of the text
    F32,
    /// On the device
    Gpu,
}

/// Evaluates and writes.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let name = match &arguments.function {
        Some(function) if arguments.name.ends_with(".wgsl") => {
            format!("{}#{function}", arguments.name)
        }
        Some(_) => bail!("--function is for WGSL files; `{}` is none", arguments.name),
        None if arguments.name.ends_with(".wgsl") => {
            bail!("a WGSL file needs --function NAME, or FILE.wgsl#NAME")
        }
        None => arguments.name.clone(),
    };
    let project = context.project_or_here();
    let csv = match project.registry().reference(&name) {
        Some((_, reference)) => {
            if let Some((name, _)) = arguments.set.first() {
                bail!("--set {name}: the reference {} has no constants", reference.name);
            }
            if arguments.precision != Precision::F64 {
                bail!("--precision: the reference {} is evaluated in f64 only", reference.name);
            }
            let points = Points::read(&arguments.input)?;
            points.with(&of_reference(reference, &points)?)?
        }
        None => {
            let set = arguments.set.iter().cloned().collect();
            let candidate = project.candidate_with(&name, &set)?;
            let points = Points::read(&arguments.input)?;
            points.with(&of_candidate(&candidate, &points, arguments.precision)?)?
        }
    };
    match arguments.output == Path::new("-") {
        true => output::to_stdout(&String::from_utf8_lossy(&csv))?,
        false => atomic_write(&arguments.output, &csv)?,
    }
    Ok(Ending::Done)
}

type Results = Vec<(String, Vec<String>)>;

fn of_reference(reference: &Reference, points: &Points) -> anyhow::Result<Results> {
    let arguments: Vec<(String, Option<&str>)> =
        reference.arguments.iter().map(|a| (a.name.to_owned(), Some(a.unit))).collect();
    let columns = points.columns(&arguments)?;
    let rows = columns.first().map_or(0, Vec::len);
    let value = |row: usize| {
        let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        let value = reference.value(&point);
        let value = value.with_context(|| format!("{}: {}", points.place(row), reference.name))?;
        Ok(format!("{value:?}"))
    };
    let values = (0..rows).map(value).collect::<anyhow::Result<_>>()?;
    Ok(vec![("value".to_owned(), values)])
}

fn of_candidate(
    candidate: &Candidate,
    points: &Points,
    precision: Precision,
) -> anyhow::Result<Results> {
    let form = &candidate.form;
    let names: Vec<(String, Option<&str>)> =
        form.input_columns().into_iter().map(|name| (name, None)).collect();
    let columns = points.columns(&names)?;
    let inputs: Vec<Input<'_>> = columns.iter().map(Input::from).collect();
    let values: Vec<Vec<String>> = match precision {
        Precision::F64 => {
            let inputs: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            texts(&form.eval_f64(&candidate.constants, &inputs)?)
        }
        Precision::F32 => texts(&form.eval_f32_inputs(&candidate.constants_f32, &inputs)?),
        Precision::Gpu => {
            let device = Device::open().context("--precision gpu")?;
            let kernel = device.compile(form, &candidate.constants_f32)?;
            texts(&kernel.evaluate_inputs(&inputs)?)
        }
    };
    Ok(form.output_columns().into_iter().zip(values).collect())
}

/// Debug formatting: the shortest digits that read back the same, with an exponent where the
/// number would be long without.
fn texts<T: std::fmt::Debug>(columns: &[Vec<T>]) -> Vec<Vec<String>> {
    columns.iter().map(|column| column.iter().map(|value| format!("{value:?}")).collect()).collect()
}
