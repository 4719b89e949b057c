//! `bench --target`: costs counted in machine code, or timed on the device, candidate by candidate.

use anyhow::bail;
use serde::Serialize;

use super::Ending;
use super::context::Context;
use crate::counted::GpuTarget;
use crate::document::{Cell, PrintedColumn, PrintedTable, Section};
use crate::gpu::TimingOptions;
use crate::numeric::measured::Measured;
use crate::project::{Subject, nearest};
use crate::run::{CountedCandidate, OnTarget, Run, write_counted};

/// Targets that are no GPU by name.
const DEVICE: &str = "device";
const ALL: &str = "all";

/// The cost of a candidate on a target.
#[derive(Debug, Serialize)]
struct Line<'a> {
    name: &'a str,
    /// Largest error in f32 over the regions; null if it approximates nothing known.
    error: Option<f64>,
    /// Per evaluation; null if it was not measured.
    cost: Option<f64>,
    target: &'a str,
    unit: &'static str,
    baseline: Option<&'a str>,
    /// Of the cost to that of the baseline.
    ratio: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    latency: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    instructions: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quarter_rate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    registers: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    not_measured: Option<&'a str>,
}

impl<'a> Line<'a> {
    fn counted(of: &'a CountedCandidate, on: &'a OnTarget, error: Option<f64>) -> Self {
        let counted = on.counted.value();
        Self {
            name: &of.name,
            error,
            cost: counted.map(|counted| counted.cost),
            target: on.target.name(),
            unit: "issue cycles of a wave",
            baseline: of.baseline.as_deref(),
            ratio: on.ratio,
            latency: counted.and_then(|counted| counted.latency),
            instructions: counted.map(|counted| counted.instructions),
            quarter_rate: counted.map(|counted| counted.quarter_rate),
            registers: counted.map(|counted| counted.registers),
            not_measured: reason(&on.counted),
        }
    }

    fn timed(of: &'a CountedCandidate, time: &'a Measured<Timed>, error: Option<f64>) -> Self {
        Self {
            name: &of.name,
            error,
            cost: time.value().map(|time| time.ns),
            target: DEVICE,
            unit: "ns",
            baseline: of.baseline.as_deref(),
            ratio: time.value().and_then(|time| time.ratio),
            latency: None,
            instructions: None,
            quarter_rate: None,
            registers: None,
            not_measured: reason(time),
        }
    }
}

fn reason<T>(measured: &Measured<T>) -> Option<&str> {
    match measured {
        Measured::Value(_) => None,
        Measured::NotMeasured(reason) => Some(reason),
    }
}

/// A time on the device.
struct Timed {
    ns: f64,
    ratio: Option<f64>,
}

/// Counts or times, and prints.
pub(super) fn run(
    target: &str,
    names: &[String],
    record: bool,
    context: &Context,
) -> anyhow::Result<Ending> {
    let targets: Vec<GpuTarget> = match (target, GpuTarget::named(target)) {
        (DEVICE, _) => Vec::new(),
        (ALL, _) => GpuTarget::ALL.to_vec(),
        (_, Some(target)) => vec![target],
        (_, None) => {
            let known = GpuTarget::ALL.map(GpuTarget::name).into_iter().chain([DEVICE, ALL]);
            let nearest = nearest(target, known.map(str::to_owned)).join(", ");
            bail!("--target: there is no target `{target}`; the nearest: {nearest}");
        }
    };
    let on_device = [DEVICE, ALL].contains(&target);
    let mut run = context.run()?;
    run.timing = TimingOptions::default();
    let subjects = run.project.subjects_named(names)?;
    let counted = run.counted(&subjects, &targets)?;
    if record {
        if targets.is_empty() {
            bail!("--record without --target records the device");
        }
        for path in write_counted(&run.project.costs(), &run.counter, &targets, &counted)? {
            context.output.note(&format!("costs: {}", run.project.shown(&path)));
        }
        return Ok(Ending::Done);
    }
    let errors = run.errors(&subjects)?;
    let times = if on_device { times(&run, &subjects)? } else { Vec::new() };
    let rows = || counted.iter().zip(&errors).enumerate();
    let lines: Vec<Line<'_>> = rows()
        .flat_map(|(at, (of, error))| {
            let counted = of.costs.iter().map(|on| Line::counted(of, on, *error));
            counted.chain(times.get(at).map(|time| Line::timed(of, time, *error)))
        })
        .collect();
    context.output.sections(&lines, || match target {
        ALL => vec![Section::default().block(across(&lines, &targets))],
        _ => vec![Section::default().block(alone(&lines))],
    })
}

/// Times of `subjects` on the device, against their baselines in one run.
fn times(run: &Run, subjects: &[Subject]) -> anyhow::Result<Vec<Measured<Timed>>> {
    let timed = run.timed(subjects)?;
    let time = |subject: &Subject| match timed.iter().find(|cost| cost.name == subject.name) {
        None => Measured::NotMeasured("it has no points to be timed at".to_owned()),
        Some(cost) => cost.device.map(|timing| Timed {
            ns: timing.net_ns.median,
            ratio: timing.ratio.map(|ratio| ratio.median),
        }),
    };
    Ok(subjects.iter().map(time).collect())
}

/// One target, with all that is counted.
fn alone(lines: &[Line<'_>]) -> PrintedTable {
    let caption = "Cost per evaluation, net of a kernel without the form: inverse throughput, or ns \
                   on the device. Error: the largest in f32 over the regions.";
    let shown = |of: fn(&Line<'_>) -> Option<f64>| {
        move |line: &&Line<'_>| Cell::number_or(of(line), 4, line.not_measured.unwrap_or("none"))
    };
    PrintedTable::over(caption, lines)
        .code("candidate", |line| line.name)
        .number("error, f32", "1", shown(|line| line.error))
        .number("cost", "cycles", shown(|line| line.cost))
        .number("ratio", "1", shown(|line| line.ratio))
        .number("latency", "cycles", shown(|line| line.latency))
        .number("instructions", "1", shown(|line| line.instructions))
        .number("quarter rate", "1", shown(|line| line.quarter_rate))
        .number("registers", "1", shown(|line| line.registers))
        .code("baseline", |line| line.baseline.unwrap_or_default())
        .table()
}

/// Every target in a column: costs relative to the baseline.
fn across(lines: &[Line<'_>], targets: &[GpuTarget]) -> PrintedTable {
    let columns: Vec<&str> = targets.iter().map(|target| target.name()).chain([DEVICE]).collect();
    let rows: Vec<&[Line<'_>]> = lines.chunks(columns.len()).collect();
    let caption = "Cost per evaluation relative to the baseline. Error: the largest in f32 over the \
                   regions. Counted targets are the same on every run; the device is timed.";
    PrintedTable::over(caption, &rows)
        .code("candidate", |row| row[0].name)
        .number("error, f32", "1", |row| Cell::number_or(row[0].error, 3, "none"))
        .columns(
            columns.into_iter().enumerate(),
            |(_, name)| PrintedColumn::number(*name, "1"),
            |row, (at, _)| {
                let line = &row[*at];
                Cell::number_or(line.ratio, 3, line.not_measured.unwrap_or("no baseline"))
            },
        )
        .code("baseline", |row| row[0].baseline.unwrap_or_default())
        .table()
}
