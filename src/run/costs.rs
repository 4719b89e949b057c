//! Costs, recorded on purpose (`striae bench --record`): per adapter, since time belongs to a machine and to
//! a moment, and per target whose machine code is counted, since that belongs to a compiler.

use std::path::{Path, PathBuf};

use super::{CountedCandidate, OnTarget, RunError, Studied};
use crate::counted::{Counter, GpuTarget};
use crate::document::cell::number;
use crate::gpu::AdapterDescription;
use crate::numeric::measured::Measured;
use crate::table::store::atomic_write;

/// Columns of the table, after a line with the adapter.
const HEADER: &str = "candidate\tbaseline\tratio\tratio_p25\tratio_p75\tns";

/// The device costs of `studied` as tab-separated values, under a line that names the adapter.
///
/// | column | unit | what |
/// |---|---|---|
/// | candidate, baseline | | names |
/// | ratio, ratio_p25, ratio_p75 | 1 | cost over that of the baseline in one run: median and quartiles |
/// | ns | ns | one evaluation, net of the empty loop, all invocations side by side |
pub fn cost_table(adapter: &AdapterDescription, studied: &[Studied]) -> String {
    let mut lines = vec![format!("# {adapter}"), HEADER.to_owned()];
    for cost in studied.iter().flat_map(|studied| &studied.costs.forms) {
        let Measured::Value(timing) = &cost.device else { continue };
        let of = |part: fn(&crate::gpu::Spread) -> f64| {
            timing.ratio.as_ref().map_or_else(String::new, |ratio| number(part(ratio), 3))
        };
        let (median, p25, p75) = (of(|r| r.median), of(|r| r.p25), of(|r| r.p75));
        let ns = number(timing.net_ns.median, 3);
        lines.push(format!("{}\t{}\t{median}\t{p25}\t{p75}\t{ns}", cost.name, cost.baseline));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Writes [`cost_table`] to `folder`, in a file named after the adapter.
///
/// # Errors
/// [`RunError::Table`] if it cannot be written.
pub fn write_costs(
    folder: &Path,
    adapter: &AdapterDescription,
    studied: &[Studied],
) -> Result<PathBuf, RunError> {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let first = adapter.name.split(" (").next().unwrap_or(&adapter.name);
    let name: String = first.chars().map(plain).collect();
    write(folder, &name, &cost_table(adapter, studied))
}

fn write(folder: &Path, name: &str, table: &str) -> Result<PathBuf, RunError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| RunError::Io { path: folder.display().to_string(), source })?;
    let path = folder.join(format!("{name}.tsv"));
    atomic_write(&path, table.as_bytes())?;
    Ok(path)
}

/// Columns of a table of counted costs, after a line with target and compiler.
const COUNTED: &str =
    "candidate\tbaseline\tratio\tcost\tlatency\tinstructions\tquarter_rate\tregisters";

/// What candidates cost on `target` as tab-separated values, under a line that names the compiler.
///
/// | column | unit | what |
/// |---|---|---|
/// | candidate, baseline | | names |
/// | ratio | 1 | cost over that of the baseline |
/// | cost, latency | cycles of a wave | inverse throughput and latency of one evaluation |
/// | instructions, quarter_rate | 1 | of one evaluation; those at a quarter of the rate |
/// | registers | 1 | vector registers of the kernel |
///
/// What was not counted has the reason in place of its cost and nothing after it.
pub fn counted_table(target: GpuTarget, compiler: &str, counted: &[CountedCandidate]) -> String {
    let mut lines = vec![format!("# {target}: {compiler}"), COUNTED.to_owned()];
    for of in counted {
        let Some(OnTarget { counted, ratio, .. }) = of.costs.iter().find(|on| on.target == target)
        else {
            continue;
        };
        let shown = |value: Option<f64>| value.map_or_else(String::new, |value| number(value, 4));
        let (name, baseline, ratio) =
            (&of.name, of.baseline.as_deref().unwrap_or_default(), shown(*ratio));
        let figures = match counted {
            Measured::NotMeasured(reason) => format!("not counted: {}", one_line(reason)),
            Measured::Value(of) => {
                let figures = [Some(of.cost), of.latency, Some(of.instructions)];
                let rest = [Some(of.quarter_rate), Some(of.registers)];
                figures.into_iter().chain(rest).map(shown).collect::<Vec<_>>().join("\t")
            }
        };
        lines.push(format!("{name}\t{baseline}\t{ratio}\t{figures}"));
    }
    lines.push(String::new());
    lines.join("\n")
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Writes [`counted_table`] of each target to `folder`, in a file named after it; of a target that cannot
/// be counted here, nothing.
///
/// # Errors
/// [`RunError::Table`] if one cannot be written.
pub fn write_counted(
    folder: &Path,
    counter: &Counter,
    targets: &[GpuTarget],
    counted: &[CountedCandidate],
) -> Result<Vec<PathBuf>, RunError> {
    let mut written = Vec::new();
    for target in targets {
        if let Measured::Value(compiler) = counter.driver(*target) {
            let table = counted_table(*target, &compiler, counted);
            written.push(write(folder, target.name(), &table)?);
        }
    }
    Ok(written)
}
