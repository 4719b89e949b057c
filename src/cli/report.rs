//! `report`: measures everything and writes the report.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Ending;
use super::context::Context;
use super::output::line;
use crate::gate::Check;
use crate::report::html::Written;
use crate::run::Run;

const MORE: &str = "\
Writes index.html and a page per effect (self-contained, no network), report.json, report.txt and
figures/*.svg, figures/*.png.

Example:
  striae report -o /tmp/report";

/// Measure every effect and write the report
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Folder of the report [default: reports in the project]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Measures, writes, and says where.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let folder = match &arguments.output {
        Some(folder) => folder.clone(),
        None => context.project()?.report(),
    };
    let run = context.run()?;
    let check = run.check_if_gated()?;
    let written = write(&folder, &run, &check, context)?;
    context.output.sections(&serde_json::json!({ "files": written.files }), || {
        line(format!("{} files in {}", written.files.len(), folder.display()))
    })
}

/// Measures everything and writes the report with the verdicts of `check`.
pub(super) fn write(
    folder: &Path,
    run: &Run,
    check: &Check,
    context: &Context,
) -> anyhow::Result<Written> {
    let project = &run.project;
    let steps = project.registry().effects().len() + project.scenes()?.len() + 1;
    let bar = context.output.bar(steps);
    let written = run.report(folder, check, &|what| {
        bar.set_message(format!("measuring {what}"));
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    Ok(written)
}
