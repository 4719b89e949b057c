//! Costs per adapter, recorded on purpose (`striae bench --record`): time belongs to a machine and to a
//! moment, so that no other run writes it.

use std::path::{Path, PathBuf};

use super::{RunError, Studied};
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
    let path = folder.join(format!("{}.tsv", first.chars().map(plain).collect::<String>()));
    std::fs::create_dir_all(folder)
        .map_err(|source| RunError::Io { path: folder.display().to_string(), source })?;
    atomic_write(&path, cost_table(adapter, studied).as_bytes())?;
    Ok(path)
}
