//! Results of fits as sections.

use std::collections::BTreeMap;

use crate::document::{Cell, Column, Section, Table, number};
use crate::fit::FitResult;
use crate::fit::outcome::{FamilyOutcome, Outcome};
use crate::report::pages::{constants, family_constants, status};

/// One line per fit.
pub(super) fn summary(results: &[FitResult]) -> Section {
    let columns = vec![
        Column::code("fit"),
        Column::verdict("status"),
        Column::figures("free"),
        Column::figures("rms (f32)"),
        Column::figures("max (f32)"),
    ];
    let row = |result: &FitResult| match result {
        FitResult::Single(outcome) => vec![
            Cell::text(outcome.name.as_str()),
            status(outcome),
            Cell::count(outcome.free_count()),
            Cell::number(outcome.residuals_f32.rms, 4),
            Cell::number(outcome.residuals_f32.max_abs, 4),
        ],
        FitResult::Family(family) => family_row(family),
    };
    Section::default().block(Table::new("", columns).with_rows(results.iter().map(row)))
}

fn family_row(family: &FamilyOutcome) -> Vec<Cell> {
    let members = &family.members;
    let mut endings: BTreeMap<&str, usize> = BTreeMap::new();
    for member in members {
        *endings.entry(member.status.words()).or_default() += 1;
    }
    let endings: Vec<String> = endings.iter().map(|(name, n)| format!("{n} {name}")).collect();
    let points: usize = members.iter().map(|m| m.residuals_f32.count).sum();
    let squares: f64 =
        members.iter().map(|m| m.residuals_f32.rms.powi(2) * m.residuals_f32.count as f64).sum();
    let max = members.iter().map(|m| m.residuals_f32.max_abs).fold(0.0, f64::max);
    vec![
        Cell::text(family.name.as_str()),
        Cell::text(endings.join(", ")),
        members.first().map_or_else(|| Cell::text(""), |member| Cell::count(member.free_count())),
        Cell::number((squares / points as f64).sqrt(), 4),
        Cell::number(max, 4),
    ]
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
    let section = Section::new(name.as_str()).paragraph(format!(
        "{} after {} iterations ({}). {} points, rms {}, max {}{}; in f32 rms {}, max {}.",
        outcome.status.words(),
        outcome.iterations,
        outcome.solver,
        residuals.count,
        number(residuals.rms, 6),
        number(residuals.max_abs, 6),
        place(outcome),
        number(shipped.rms, 6),
        number(shipped.max_abs, 6),
    ));
    if outcome.parameters.is_empty() {
        return section;
    }
    section.block(constants(std::iter::once(outcome)))
}

fn place(outcome: &Outcome) -> String {
    let at = outcome.residuals.max_abs_at.iter();
    let places: Vec<String> =
        at.map(|(name, value)| format!("{name} = {}", number(*value, 6))).collect();
    if places.is_empty() { String::new() } else { format!(" at {}", places.join(", ")) }
}
