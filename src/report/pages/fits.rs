//! What was fitted to what, and the constants.

use super::{Evidence, bare, count};
use crate::document::{Block, Cell, Column, Section, Table, Verdict};
use crate::effect::Effect;
use crate::fit::outcome::{Outcome, Status};
use crate::registry;

pub(super) fn exact_section(effect: &Effect) -> Section {
    let mut references = Table::new(
        "References: exact values, from formulas that no form shares.",
        vec![
            Column::code("reference"),
            Column::text("what"),
            Column::text("arguments"),
            Column::text("accuracy"),
            Column::text("source"),
        ],
    );
    for reference in effect.references {
        let arguments = reference
            .arguments
            .iter()
            .map(|argument| {
                format!("`{}` [{}] in {}", argument.name, argument.unit, argument.domain)
            })
            .collect::<Vec<_>>()
            .join("; ");
        references.push(vec![
            Cell::text(reference.name),
            Cell::text(reference.description),
            Cell::text(arguments),
            Cell::text(reference.accuracy),
            Cell::text(reference.source),
        ]);
    }
    let mut forms = Table::new(
        "Forms: approximations, each one WGSL function.",
        vec![
            Column::code("form"),
            Column::text("what"),
            Column::text("from"),
            Column::code("text"),
        ],
    );
    for form in registry::forms_of(effect) {
        forms.push(vec![
            Cell::text(form.name.clone()),
            Cell::text(form.description.clone()),
            Cell::text(form.citation.clone()),
            Cell::text(form.path.clone()),
        ]);
    }
    Section::new("What is exact, and what approximates it").block(references).block(forms)
}

pub(super) fn fitted_section(evidence: &Evidence<'_>) -> Section {
    let mut section = Section::new("What was fitted to what");
    if !evidence.study.fits.is_empty() {
        let mut fits = Table::new(
            "Fits to references. RMS and max over the fitted points, of the constants as shipped, in f32.",
            vec![
                Column::code("fit"),
                Column::code("form"),
                Column::code("target"),
                Column::text("loss"),
                Column::verdict("status"),
                Column::text("solver"),
                Column::number("free", "1"),
                Column::number("RMS", "1"),
                Column::number("max", "1"),
                Column::number("alternations", "1"),
            ],
        );
        for outcome in evidence.study.fits.iter().map(|fit| &fit.outcome) {
            fits.push(vec![
                Cell::text(bare(&outcome.name)),
                Cell::text(bare(&outcome.form)),
                Cell::text(outcome.target.clone()),
                Cell::text(outcome.loss.clone()),
                status(outcome),
                Cell::text(outcome.solver.split(" (").next().unwrap_or_default()),
                count(outcome.free_count()),
                Cell::number(outcome.residuals_f32.rms, 4),
                Cell::number(outcome.residuals_f32.max_abs, 4),
                outcome.equioscillations.map_or_else(|| Cell::text("–"), count),
            ]);
        }
        section = section
            .block(fits)
            .paragraph(
                "Alternations: how often a minimax fit's error reaches its maximum with alternating sign; \
                 one more than the number of free constants proves the optimum.",
            )
            .block(Block::Details {
                summary: "Every constant, as shipped".into(),
                blocks: vec![Block::Table(constants(evidence))],
            });
    }
    for family in evidence.families {
        section = section.block(Block::Details {
            summary: format!(
                "Constants of `{}` for every member of `{}`",
                family.name, family.family
            )
            .into(),
            blocks: vec![Block::Table(family_constants(&family.members))],
        });
    }
    section
}

fn status(outcome: &Outcome) -> Cell {
    let verdict = match outcome.status {
        Status::Converged => Verdict::Pass,
        Status::Stalled | Status::AtBound => Verdict::Warn,
        Status::HitIterationLimit | Status::Singular | Status::NonFinite => Verdict::Fail,
    };
    Cell::verdict_as(verdict, outcome.status.words())
}

fn constants(evidence: &Evidence<'_>) -> Table {
    let mut table = Table::new(
        "Constants: the optimum in f64, and the f32 that ships.",
        vec![
            Column::code("fit"),
            Column::code("constant"),
            Column::number("f64", "1"),
            Column::number("f32", "1"),
            Column::code("bits"),
            Column::text("role"),
            Column::number("standard error", "1"),
        ],
    );
    for outcome in evidence.study.fits.iter().map(|fit| &fit.outcome) {
        for (name, constant) in &outcome.parameters {
            table.push(vec![
                Cell::text(bare(&outcome.name)),
                Cell::text(name.clone()),
                Cell::number(constant.value, 10),
                Cell::number(f64::from(constant.f32), 9),
                Cell::text(constant.f32_hex.clone()),
                Cell::text(constant.role.clone()),
                match (constant.stderr, &constant.why_no_stderr) {
                    (Some(stderr), _) => Cell::number(stderr, 3),
                    (None, why) => Cell::text(why.clone().unwrap_or_else(|| "–".into())),
                },
            ]);
        }
    }
    table
}

fn family_constants(members: &[Outcome]) -> Table {
    let names: Vec<&String> =
        members.first().map_or_else(Vec::new, |m| m.parameters.keys().collect());
    let mut columns = vec![Column::code("member"), Column::verdict("status")];
    columns.extend(names.iter().map(|name| Column::number(name.as_str(), "1")));
    columns.extend([Column::number("RMS", "1"), Column::number("max", "1")]);
    let mut table =
        Table::new("Constants as shipped (f32), and residuals over the fitted points.", columns);
    for outcome in members {
        let label = outcome.name.split_once('#').map_or(outcome.name.as_str(), |(_, label)| label);
        let mut row = vec![Cell::text(label), status(outcome)];
        row.extend(names.iter().map(|name| {
            outcome.parameters.get(*name).map_or_else(
                || Cell::missing("absent"),
                |constant| Cell::number(f64::from(constant.f32), 7),
            )
        }));
        row.extend([
            Cell::number(outcome.residuals_f32.rms, 3),
            Cell::number(outcome.residuals_f32.max_abs, 3),
        ]);
        table.push(row);
    }
    table
}
