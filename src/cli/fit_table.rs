//! Results of fits as sections.

use std::collections::BTreeMap;

use crate::document::{Cell, PrintedTable, Section, number, place};
use crate::fit::FitResult;
use crate::fit::outcome::Outcome;
use crate::report::pages::{constants, family_constants, status};

/// One line per fit; of a family the worst, and the RMS over the points of all members.
pub(super) fn summary(results: &[FitResult]) -> Section {
    let shipped = |result: &FitResult| {
        let residuals: Vec<_> = result.outcomes().iter().map(|of| &of.residuals_f32).collect();
        let points: usize = residuals.iter().map(|of| of.count).sum();
        let squares: f64 = residuals.iter().map(|of| of.rms.powi(2) * of.count as f64).sum();
        let max = residuals.iter().map(|of| of.max_abs).fold(0.0, f64::max);
        match residuals.as_slice() {
            [one] => (one.rms, one.max_abs),
            _ => ((squares / points as f64).sqrt(), max),
        }
    };
    let table = PrintedTable::over("", results)
        .code("fit", |result| match result {
            FitResult::Single(outcome) => Cell::text(outcome.name.as_str()),
            FitResult::Family(family) => Cell::text(family.name.as_str()),
        })
        .verdict("status", |result| match result {
            FitResult::Single(outcome) => status(outcome),
            FitResult::Family(family) => Cell::text(endings(&family.members)),
        })
        .figures("free", |result| {
            result
                .outcomes()
                .first()
                .map_or_else(|| Cell::text(""), |of| Cell::count(of.free_count()))
        })
        .figures("rms (f32)", |result| (shipped(result).0, 4))
        .figures("max (f32)", |result| (shipped(result).1, 4));
    Section::default().block(table)
}

/// `184 converged, 2 at a bound`.
fn endings(members: &[Outcome]) -> String {
    let mut endings: BTreeMap<&str, usize> = BTreeMap::new();
    for member in members {
        *endings.entry(member.status.words()).or_default() += 1;
    }
    endings.iter().map(|(name, n)| format!("{n} {name}")).collect::<Vec<_>>().join(", ")
}

/// The constants of a fit; one line per member for a family.
pub(super) fn one(result: &FitResult) -> Section {
    match result {
        FitResult::Single(outcome) => single(outcome),
        FitResult::Family(family) => {
            Section::new(format!("{}: {} members", family.name, family.members.len()))
                .block(family_constants(&family.members))
        }
    }
}

fn single(outcome: &Outcome) -> Section {
    let name = if outcome.name.is_empty() { &outcome.form } else { &outcome.name };
    let (residuals, shipped) = (&outcome.residuals, &outcome.residuals_f32);
    let at = match place(&residuals.max_abs_at, 6) {
        at if at.is_empty() => at,
        at => format!(" at {at}"),
    };
    let section = Section::new(name.as_str()).paragraph(format!(
        "{} after {} iterations ({}). {} points, rms {}, max {}{}; in f32 rms {}, max {}.",
        outcome.status.words(),
        outcome.iterations,
        outcome.solver,
        residuals.count,
        number(residuals.rms, 6),
        number(residuals.max_abs, 6),
        at,
        number(shipped.rms, 6),
        number(shipped.max_abs, 6),
    ));
    if outcome.parameters.is_empty() {
        return section;
    }
    section.block(constants(std::iter::once(outcome)))
}
