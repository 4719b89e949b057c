//! What was fitted to what, and the constants.

use super::{Evidence, bare};
use crate::document::{Block, Cell, Column, Section, Table, Verdict};
use crate::effect::Effect;
use crate::fit::outcome::{Outcome, Status};

pub(super) fn exact_section(effect: &Effect) -> Section {
    let references = Table::new(
        "References: exact values, from formulas that no form shares.",
        vec![
            Column::code("reference"),
            Column::text("what"),
            Column::text("arguments"),
            Column::text("accuracy"),
            Column::text("source"),
        ],
    );
    let references = references.with_rows(effect.references.iter().map(|reference| {
        let arguments = reference.arguments.iter();
        let arguments: Vec<String> = arguments
            .map(|argument| {
                format!("`{}` [{}] in {}", argument.name, argument.unit, argument.domain)
            })
            .collect();
        vec![
            Cell::text(reference.name),
            Cell::text(reference.description),
            Cell::text(arguments.join("; ")),
            Cell::text(reference.accuracy),
            Cell::text(reference.source),
        ]
    }));
    let forms = Table::new(
        "Forms: approximations, each one WGSL function.",
        vec![
            Column::code("form"),
            Column::text("what"),
            Column::text("from"),
            Column::code("text"),
        ],
    );
    let forms = forms.with_rows(effect.forms.iter().map(|form| {
        [form.name, form.description, form.citation, form.path].map(Cell::text).to_vec()
    }));
    Section::new("What is exact, and what approximates it").block(references).block(forms)
}

pub(super) fn fitted_section(evidence: &Evidence<'_>) -> Section {
    let mut section = Section::new("What was fitted to what");
    let outcomes = || evidence.study.fits.iter().map(|fit| &fit.outcome);
    if !evidence.study.fits.is_empty() {
        section = section
            .block(fits(outcomes()))
            .paragraph(
                "Alternations: how often a minimax fit's error reaches its maximum with alternating sign; \
                 one more than the number of free constants proves the optimum.",
            )
            .block(Block::Details {
                summary: "Every constant, as shipped".into(),
                blocks: vec![constants(outcomes()).into()],
            });
    }
    for family in evidence.families {
        let (name, of) = (&family.name, &family.family);
        section = section.block(Block::Details {
            summary: format!("Constants of `{name}` for every member of `{of}`").into(),
            blocks: vec![family_constants(&family.members).into()],
        });
    }
    section
}

fn fits<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> Table {
    let columns = vec![
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
    ];
    Table::new(
        "Fits to references. RMS and max over the fitted points, of the constants as shipped, in f32.",
        columns,
    )
    .with_rows(outcomes.map(|outcome| {
        vec![
            Cell::text(bare(&outcome.name)),
            Cell::text(bare(&outcome.form)),
            Cell::text(outcome.target.as_str()),
            Cell::text(outcome.loss.as_str()),
            status(outcome),
            Cell::text(outcome.solver.split(" (").next().unwrap_or_default()),
            Cell::count(outcome.free_count()),
            Cell::number(outcome.residuals_f32.rms, 4),
            Cell::number(outcome.residuals_f32.max_abs, 4),
            outcome.equioscillations.map_or_else(|| Cell::text("–"), Cell::count),
        ]
    }))
}

/// How a fit ended.
pub fn status(outcome: &Outcome) -> Cell {
    let verdict = match outcome.status {
        Status::Converged => Verdict::Pass,
        Status::Stalled | Status::AtBound => Verdict::Warn,
        Status::HitIterationLimit | Status::Singular | Status::NonFinite => Verdict::Fail,
    };
    Cell::verdict_as(verdict, outcome.status.words())
}

/// Every constant of `outcomes`, a row each.
pub fn constants<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> Table {
    let columns = vec![
        Column::code("fit"),
        Column::code("constant"),
        Column::number("f64", "1"),
        Column::number("f32", "1"),
        Column::code("bits"),
        Column::text("role"),
        Column::number("standard error", "1"),
    ];
    let rows = outcomes.flat_map(|outcome| {
        outcome.parameters.iter().map(|(name, constant)| {
            let why = constant.why_no_stderr.as_deref();
            vec![
                Cell::text(bare(&outcome.name)),
                Cell::text(name.as_str()),
                Cell::number(constant.value, 17),
                Cell::single(constant.f32),
                Cell::text(constant.f32_hex.as_str()),
                Cell::text(constant.role.as_str()),
                constant
                    .stderr
                    .map_or_else(|| Cell::text(why.unwrap_or("–")), |e| Cell::number(e, 4)),
            ]
        })
    });
    Table::new("Constants: the optimum in f64, and the f32 that ships.", columns).with_rows(rows)
}

/// The constants of a family, a row per member.
pub fn family_constants(members: &[Outcome]) -> Table {
    let names: Vec<&String> =
        members.first().map_or_else(Vec::new, |m| m.parameters.keys().collect());
    let mut columns = vec![Column::code("member"), Column::verdict("status")];
    columns.extend(names.iter().map(|name| Column::number(name.as_str(), "1")));
    columns.extend([Column::number("RMS", "1"), Column::number("max", "1")]);
    let rows = members.iter().map(|outcome| {
        let label = outcome.name.split_once('#').map_or(outcome.name.as_str(), |(_, label)| label);
        let mut row = vec![Cell::text(label), status(outcome)];
        row.extend(names.iter().map(|name| {
            let constant = outcome.parameters.get(*name);
            constant.map_or_else(|| Cell::missing("absent"), |c| Cell::single(c.f32))
        }));
        row.push(Cell::number(outcome.residuals_f32.rms, 4));
        row.push(Cell::number(outcome.residuals_f32.max_abs, 4));
        row
    });
    Table::new("Constants as shipped (f32), and residuals over the fitted points.", columns)
        .with_rows(rows)
}
