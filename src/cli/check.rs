//! `check`: gates, and whether the committed constants come out again.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueEnum};

use super::Ending;
use super::context::Context;
use super::output::to_stdout;
use crate::document::text::{self, Layout};
use crate::document::{Cell, PrintedTable, Section, Verdict};
use crate::gate::{self, Check, Judgement, Precision, Proofs};
use crate::gpu;
use crate::numeric::measured::Measured;
use crate::report::pages::{by_attention, gate_table, summary};
use crate::run::Run;

const MORE: &str = "\
Gates that failed, were not measured or are close to their limit are listed, failures first; --all
lists the others too. A gate of fits/gates.toml is measured afresh, with the committed constants on points that were not
fitted. Every spec is fitted again in memory, and its constants must be the committed ones. A gate
on the device without a device is shown as not measured; with STRIAE_REQUIRE_GPU=1 that ends with
exit code 4.

--prove moves every fitted constant, step by step, until its gates fail. A gate that nothing trips,
and a constant that no gate guards, are failures.

Examples:
  striae check
  striae check --prove
  striae check --format junit > check.xml";

/// Hold the project to its gates; exit 1 if one fails
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// How to print verdicts
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// File of gates [default: fits/gates.toml in the project]
    #[arg(long, value_name = "TOML")]
    gates: Option<PathBuf>,
    /// Show that every gate can fail
    #[arg(long)]
    prove: bool,
    /// List the gates that pass too
    #[arg(long)]
    all: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Tables
    Human,
    /// JSON, as with --json
    Json,
    /// JUnit XML
    Junit,
    /// GitHub workflow commands
    Github,
}

/// Judges, prints, and fails if something failed.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let format = if context.output.json { Format::Json } else { arguments.format };
    if arguments.prove && matches!(format, Format::Junit | Format::Github) {
        bail!("--prove prints tables or JSON; expected --format human or json");
    }
    let gates = arguments.gates.as_deref();
    let check = run_for(gates, context)?.check(gates, arguments.prove)?;
    match format {
        Format::Json | Format::Human => {
            let mut output = context.output;
            output.json = format == Format::Json;
            output.sections(&check, || sections(&check, arguments.all))?;
        }
        Format::Junit => to_stdout(&gate::junit(&check.gates, &check.constants))?,
        Format::Github => {
            let file = gates.unwrap_or(Path::new("fits/gates.toml")).display().to_string();
            to_stdout(&gate::annotations(&file, &check.gates, &check.constants))?;
        }
    }
    Ok(if check.passed() { Ending::Done } else { Ending::GateFailed })
}

/// A run of the project with a device if a gate of `gates` needs one, or if there must be one.
fn run_for(gates: Option<&Path>, context: &Context) -> anyhow::Result<Run> {
    let project = context.project()?;
    let gates = gate::read(gates.unwrap_or(&project.gates()))?;
    let wanted = gates.iter().any(|gate| gate.precision == Precision::Device);
    if !wanted && !gpu::required() {
        let reason = "no gate needs a device".to_owned();
        return Ok(Run::new(project, Measured::NotMeasured(reason)));
    }
    context.run()
}

/// The verdicts as text: what needs attention, and lines that sum up.
pub(super) fn text(check: &Check) -> String {
    text::sections(&sections(check, false), Layout::default())
}

/// What needs attention, and lines that sum up; with `all` the gates that pass too.
fn sections(check: &Check, all: bool) -> Vec<Section> {
    let gates: Vec<&Judgement> = check.gates.iter().collect();
    let (passed, attention) = by_attention(&gates);
    let section = Section::new("Gates")
        .blocks((!attention.is_empty()).then(|| gate_table("", &attention)))
        .blocks((all && !passed.is_empty()).then(|| gate_table("Gates that pass:", &passed)))
        // The line that sums up comes last, where the eye ends.
        .paragraph(summary(&gates));
    let mut sections = vec![section, constants(check)];
    sections.extend(check.proofs.as_ref().map(proved));
    sections
}

fn constants(check: &Check) -> Section {
    let failed: Vec<_> = check.constants.iter().filter(|c| c.verdict == Verdict::Fail).collect();
    let (good, of) = (check.constants.len() - failed.len(), check.constants.len());
    let table = || {
        PrintedTable::over("", &failed)
            .verdict("verdict", |of| of.verdict)
            .code("fit", |of| of.fit.as_str())
            .text("why", |of| of.detail.as_str())
    };
    Section::new("Constants")
        .blocks((!failed.is_empty()).then(table))
        .paragraph(format!("constants reproduce in {good} of {of} fits"))
}

fn proved(proofs: &Proofs) -> Section {
    let step = |step: f64| Cell::text(format!("{:+} %", 100.0 * step));
    let none = |word: &'static str| move || Cell::text(word);
    let table = PrintedTable::over("", &proofs.proofs)
        .figures("line", |of| of.line)
        .code("subject", |of| of.subject.as_str())
        .code("metric", |of| of.metric.name())
        .code("constant", |of| of.constant.as_str())
        .figures("trips at", |of| of.step.map_or_else(none("none"), step))
        .figures("measured", |of| of.value.map_or_else(none(""), |value| Cell::number(value, 5)))
        .figures("limit", |of| (of.limit, 5))
        .text("fits alone", |of| format!("{} of {}", of.alone, of.of));
    let mut section = Section::new("Proofs that gates can fail").block(table);
    if proofs.without_device > 0 {
        let count = proofs.without_device;
        section = section
            .paragraph(format!("{count} gates on the device were tried on f32 lanes instead"));
    }
    if proofs.defects.is_empty() {
        return section
            .paragraph("every gate can fail, and every constant has a gate that notices it");
    }
    section.list(proofs.defects.iter().map(|defect| format!("DEFECT {defect}")))
}
