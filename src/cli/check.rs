//! `check`: gates, and whether the committed constants come out again.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueEnum};

use super::Ending;
use super::context::Context;
use super::output::{self, significant, table};
use crate::gate::{self, Check, Precision, Proofs, Verdict};
use crate::gpu;
use crate::numeric::measured::Measured;
use crate::run::Run;

const MORE: &str = "\
A gate of fits/gates.toml is measured afresh, with the committed constants on points that were not
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
    let format = if context.output.json() { Format::Json } else { arguments.format };
    if arguments.prove && matches!(format, Format::Junit | Format::Github) {
        bail!("--prove prints tables or JSON; expected --format human or json");
    }
    let gates = arguments.gates.as_deref();
    let check = run_for(gates, context)?.check(gates, arguments.prove)?;
    match format {
        Format::Human => output::to_stdout(&text(&check))?,
        Format::Json => {
            output::to_stdout(&format!("{}\n", serde_json::to_string_pretty(&check)?))?;
        }
        Format::Junit => output::to_stdout(&gate::junit(&check.gates, &check.constants))?,
        Format::Github => {
            let named = arguments.gates.as_ref().map(|path| path.display().to_string());
            let file = named.as_deref().unwrap_or("fits/gates.toml");
            output::to_stdout(&gate::annotations(file, &check.gates, &check.constants))?;
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

/// Tables of verdicts, and a line that sums them up.
pub(super) fn text(check: &Check) -> String {
    let mut text = gates(check);
    text.push('\n');
    text.push_str(&constants(check));
    if let Some(proofs) = &check.proofs {
        text.push('\n');
        text.push_str(&proved(proofs));
    }
    text
}

fn gates(check: &Check) -> String {
    let row = |judgement: &gate::Judgement| {
        let gate = &judgement.gate;
        let domain = gate.domain.as_ref().map_or_else(|| "as fitted".to_owned(), |d| d.to_string());
        let measured = judgement.measured.as_ref();
        let left = judgement.margin().map(|margin| format!("{:.2} %", 100.0 * margin));
        let place = measured.map(gate::Reached::place).unwrap_or_default();
        vec![
            judgement.verdict.name().to_owned(),
            gate.subject.clone(),
            format!("{} {}", gate.metric, gate.precision),
            domain,
            measured.map_or_else(String::new, |m| significant(m.value, 5)),
            significant(gate.limit, 5),
            left.unwrap_or_default(),
            judgement.reason.clone().unwrap_or(place),
        ]
    };
    let header =
        ["verdict", "subject", "metric", "domain", "measured", "limit", "left", "where or why"];
    let count = |wanted| check.gates.iter().filter(|j| j.verdict == wanted).count();
    format!(
        "{}\n{} gates: {} passed, {} of them with a warning, {} not measured, {} failed\n",
        table(&header, check.gates.iter().map(row).collect()),
        check.gates.len(),
        count(Verdict::Pass) + count(Verdict::Warn),
        count(Verdict::Warn),
        count(Verdict::NotMeasured),
        count(Verdict::Fail),
    )
}

fn constants(check: &Check) -> String {
    let failed: Vec<_> = check.constants.iter().filter(|c| c.verdict == Verdict::Fail).collect();
    let mut text = format!(
        "constants reproduce in {} of {} fits\n",
        check.constants.len() - failed.len(),
        check.constants.len()
    );
    for constants in failed {
        text.push_str(&format!("FAIL {}: {}\n", constants.fit, constants.detail));
    }
    text
}

fn proved(proofs: &Proofs) -> String {
    let row = |proof: &gate::Proof| {
        let step = proof.step.map_or_else(|| "none".to_owned(), |s| format!("{:+} %", 100.0 * s));
        vec![
            proof.line.to_string(),
            proof.subject.clone(),
            proof.metric.name().to_owned(),
            proof.constant.clone(),
            step,
            proof.value.map_or_else(String::new, |value| significant(value, 5)),
            significant(proof.limit, 5),
            format!("{} of {}", proof.alone, proof.of),
        ]
    };
    let header =
        ["line", "subject", "metric", "constant", "trips at", "measured", "limit", "fits alone"];
    let mut text = table(&header, proofs.proofs.iter().map(row).collect());
    if proofs.without_device > 0 {
        let count = proofs.without_device;
        text.push_str(&format!("{count} gates on the device were tried on f32 lanes instead\n"));
    }
    for defect in &proofs.defects {
        text.push_str(&format!("DEFECT {defect}\n"));
    }
    if proofs.defects.is_empty() {
        text.push_str("every gate can fail, and every constant has a gate that notices it\n");
    }
    text
}
