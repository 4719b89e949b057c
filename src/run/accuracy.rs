//! The table of errors that is committed: deterministic, a line per candidate, region and precision.

use std::path::Path;

use super::{RunError, Studied};
use crate::document::cell::number;
use crate::fit::outcome::Residuals;
use crate::table::store::atomic_write;
use crate::validate::accuracy::Accuracy;

/// Digits of an error.
const DIGITS: usize = 4;
/// Columns of the table.
const HEADER: &str = "candidate\tregion\tprecision\terror\tby\tmax_abs\trms\tbias\tp95\tcount";

/// The errors of every candidate in f64 and in f32, without a device, as tab-separated values: the same
/// bytes on every machine with IEEE arithmetic.
///
/// | column | unit | what |
/// |---|---|---|
/// | candidate | | `effect/name` |
/// | region | | region, set of hard cases, or family |
/// | precision | | `f64`: the optimum before rounding; `f32`: what ships |
/// | error | 1 or that of the reference | by the yardstick of the region |
/// | by | | the yardstick; of draws the mean off, in standard errors |
/// | max_abs, rms, bias, p95 | that of the reference | residuals |
/// | count | 1 | points |
pub fn accuracy_table(studied: &[Studied]) -> String {
    let mut lines = vec![HEADER.to_owned()];
    for Studied { study, .. } in studied {
        for candidate in &study.candidates {
            for (region, accuracy) in candidate.regions.iter().chain(&candidate.hard_cases) {
                lines.extend(lines_of(&candidate.name, region, accuracy));
            }
            for (region, draws) in &candidate.draws {
                let (z, count) = (shown(draws.f32.worst_mean_z), draws.f32.points.len());
                let name = &candidate.name;
                lines.push(format!("{name}\t{region}\tf32\t{z}\t|mean z|\t\t\t\t\t{count}"));
            }
        }
        for family in &study.families {
            for form in &family.forms {
                let count: usize = form.members.iter().map(|member| member.residuals.count).sum();
                let cells = [form.max_abs, form.max_abs, form.rms].map(shown);
                let [error, max_abs, rms] = &cells;
                lines.push(format!(
                    "{}\t{}\tf32\t{error}\tmax |error|\t{max_abs}\t{rms}\t\t\t{count}",
                    form.fit, family.family
                ));
            }
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

fn lines_of(candidate: &str, region: &str, accuracy: &Accuracy) -> [String; 2] {
    let line = |precision: &str, error: f64, residuals: &Residuals| {
        let Residuals { max_abs, rms, bias, p95, count, .. } = residuals;
        let cells = [error, *max_abs, *rms, *bias, *p95].map(shown);
        let [error, max_abs, rms, bias, p95] = &cells;
        let by = accuracy.yardstick.words();
        format!(
            "{candidate}\t{region}\t{precision}\t{error}\t{by}\t{max_abs}\t{rms}\t{bias}\t{p95}\t{count}"
        )
    };
    [
        line("f64", accuracy.headline_f64, &accuracy.f64),
        line("f32", accuracy.headline(), &accuracy.f32),
    ]
}

fn shown(value: f64) -> String {
    number(value, DIGITS)
}

/// Writes [`accuracy_table`] to `path`.
///
/// # Errors
/// [`RunError::Table`] if it cannot be written.
pub fn write_accuracy(path: &Path, studied: &[Studied]) -> Result<(), RunError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|source| RunError::Io { path: folder.display().to_string(), source })?;
    }
    Ok(atomic_write(path, accuracy_table(studied).as_bytes())?)
}
