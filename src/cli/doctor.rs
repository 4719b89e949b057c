//! `doctor`: what this machine and this project offer.

use std::process::{Command, Stdio};

use clap::Args;
use serde::Serialize;

use super::context::Context;
use super::{Ending, data};
use crate::document::{PrintedTable, Section};
use crate::gpu;

/// Tools outside that some checks use where they are installed, and what for.
const TOOLS: &[(&str, &str)] = &[
    ("glslangValidator", "compiles emitted GLSL and HLSL in the tests"),
    ("dxc", "compiles emitted HLSL in the tests"),
    ("spirv-val", "validates emitted SPIR-V in the tests"),
    ("rustc", "builds striae"),
    ("python3", "runs the peers of the benches and the oracles"),
];

/// Show what this machine and this project offer: toolchain, adapters, data, tools
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  striae doctor --json")]
pub(super) struct Arguments {}

/// One line of the examination.
#[derive(Debug, Serialize)]
struct Line {
    subject: String,
    state: &'static str,
    detail: String,
}

impl Line {
    fn new(subject: &str, state: &'static str, detail: impl Into<String>) -> Self {
        Self { subject: subject.to_owned(), state, detail: detail.into() }
    }
}

/// Prints the examination. What is optional and missing is shown, and is no failure.
pub(super) fn run(_: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let mut lines = machine();
    lines.extend(adapters());
    lines.extend(project(context)?);
    lines.extend(TOOLS.iter().map(|(name, what_for)| tool(name, what_for)));
    context.output.sections(&lines, || {
        let table = PrintedTable::over("", &lines)
            .text("subject", |line| line.subject.as_str())
            .text("state", |line| line.state)
            .text("detail", |line| line.detail.as_str());
        vec![Section::default().block(table)]
    })
}

fn machine() -> Vec<Line> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let platform = format!("{} {}", std::env::consts::OS, std::env::consts::ARCH);
    vec![
        Line::new("striae", "found", format!("{} on {platform}", env!("CARGO_PKG_VERSION"))),
        Line::new("cores", "found", format!("{cores}, {} used", rayon::current_num_threads())),
    ]
}

fn adapters() -> Vec<Line> {
    let adapters = gpu::list_adapters();
    if adapters.is_empty() {
        let required = if gpu::required() { "required by STRIAE_REQUIRE_GPU" } else { "optional" };
        let detail = format!("{required}; device columns are shown as not measured");
        return vec![Line::new("adapter", "missing", detail)];
    }
    let line = |adapter: &gpu::AdapterReport| {
        let features = [
            ("timestamps", adapter.timestamp_query),
            ("f64", adapter.shader_f64),
            ("subgroups", adapter.subgroup),
        ];
        let features: Vec<&str> = features.iter().filter(|(_, on)| *on).map(|(n, _)| *n).collect();
        let state = if adapter.preferred { "used" } else { "found" };
        Line::new("adapter", state, format!("{}; {}", adapter.description, features.join(", ")))
    };
    adapters.iter().map(line).collect()
}

fn project(context: &Context) -> anyhow::Result<Vec<Line>> {
    let project = match context.project() {
        Ok(project) => project,
        Err(error) => return Ok(vec![Line::new("project", "missing", error.to_string())]),
    };
    let mut lines = vec![Line::new("project", "found", project.root().display().to_string())];
    let specs = project.specs()?;
    let fitted = specs.iter().filter(|spec| spec.result().is_file()).count();
    lines.push(Line::new("fits", "found", format!("{} specs, {fitted} results", specs.len())));
    lines.push(match crate::gate::read(&project.gates()) {
        Ok(gates) => Line::new("gates", "found", format!("{}", gates.len())),
        Err(error) => Line::new("gates", "wrong", error.to_string()),
    });
    let sets = data::sets(&project.data())?;
    if sets.is_empty() {
        lines.push(Line::new("data", "missing", project.shown(&project.data())));
    }
    for set in sets {
        let subject = format!("data/{}", set.name);
        lines.push(match set.fault {
            None => Line::new(&subject, "found", format!("{} files as in SOURCE.toml", set.files)),
            Some(fault) => Line::new(&subject, "wrong", fault),
        });
    }
    Ok(lines)
}

fn tool(name: &str, what_for: &str) -> Line {
    let run =
        Command::new(name).arg("--version").stdin(Stdio::null()).stderr(Stdio::null()).output();
    match run {
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stdout);
            let version = text.lines().next().unwrap_or_default().trim().to_owned();
            Line::new(name, "found", format!("{version}; {what_for}"))
        }
        Err(_) => Line::new(name, "missing", format!("optional; {what_for}")),
    }
}
