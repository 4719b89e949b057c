//! What was fitted to what, and the constants.

use super::{Evidence, bare, families};
use crate::document::{Block, Cell, Column, Section, Table, Verdict};
use crate::effect::Reference;
use crate::fit::outcome::{Outcome, Status};

pub(super) fn exact_section(evidence: &Evidence<'_>) -> Section {
    let effect = evidence.effect;
    let arguments = |reference: &&Reference| {
        let arguments = reference.arguments.iter();
        let arguments = arguments.map(|of| format!("`{}` [{}] in {}", of.name, of.unit, of.domain));
        Cell::text(arguments.collect::<Vec<_>>().join("; "))
    };
    let references = Table::over(
        "References: exact values, from formulas that no form shares.",
        effect.references,
    )
    .column(Column::code("reference"), |reference| Cell::text(reference.name))
    .column(Column::text("what"), |reference| Cell::text(reference.description))
    .column(Column::text("arguments"), arguments)
    .column(Column::text("accuracy"), |reference| Cell::text(reference.accuracy))
    .column(Column::text("source"), |reference| Cell::text(reference.source));
    let forms = Table::over("Forms: approximations, each one WGSL function.", evidence.forms)
        .column(Column::code("form"), |form| Cell::text(form.name.as_str()))
        .column(Column::text("what"), |form| Cell::text(form.description.as_str()))
        .column(Column::text("from"), |form| Cell::text(form.citation.as_str()))
        .column(Column::code("text"), |form| Cell::text(form.path.as_str()));
    Section::new("What is exact, and what approximates it").block(references).block(forms)
}

pub(super) fn fitted_section(evidence: &Evidence<'_>) -> Section {
    let mut section = Section::new("What was fitted to what");
    let outcomes = || evidence.study.candidates.iter().filter_map(|fit| fit.outcome.as_ref());
    if !evidence.study.candidates.is_empty() {
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
    for family in families(evidence) {
        let (name, of) = (&family.name, &family.family);
        section = section.block(Block::Details {
            summary: format!("Constants of `{name}` for every member of `{of}`").into(),
            blocks: vec![family_constants(&family.members).into()],
        });
    }
    section
}

fn fits<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> Table {
    Table::over(
        "Fits to references. RMS and max over the fitted points, of the constants as shipped, in f32.",
        outcomes,
    )
    .column(Column::code("fit"), |of| Cell::text(bare(&of.name)))
    .column(Column::code("form"), |of| Cell::text(bare(&of.form)))
    .column(Column::code("target"), |of| Cell::text(of.target.as_str()))
    .column(Column::text("loss"), |of| Cell::text(of.loss.as_str()))
    .column(Column::verdict("status"), |of| status(of))
    .column(Column::text("solver"), |of| {
        Cell::text(of.solver.split(" (").next().unwrap_or_default())
    })
    .column(Column::number("free", "1"), |of| Cell::count(of.free_count()))
    .column(Column::number("RMS", "1"), |of| Cell::number(of.residuals_f32.rms, 4))
    .column(Column::number("max", "1"), |of| Cell::number(of.residuals_f32.max_abs, 4))
    .column(Column::number("alternations", "1"), |of| {
        of.equioscillations.map_or_else(|| Cell::text("–"), Cell::count)
    })
    .table()
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
    let constants = outcomes.flat_map(|outcome| {
        outcome.parameters.iter().map(|(name, constant)| (&outcome.name, name, constant))
    });
    Table::over("Constants: the optimum in f64, and the f32 that ships.", constants)
        .column(Column::code("fit"), |(fit, ..)| Cell::text(bare(fit)))
        .column(Column::code("constant"), |(_, name, _)| Cell::text(name.as_str()))
        .column(Column::number("f64", "1"), |(.., constant)| Cell::number(constant.value, 17))
        .column(Column::number("f32", "1"), |(.., constant)| Cell::single(constant.f32))
        .column(Column::code("bits"), |(.., constant)| Cell::text(constant.f32_hex.as_str()))
        .column(Column::text("role"), |(.., constant)| Cell::text(constant.role.as_str()))
        .column(Column::number("standard error", "1"), |(.., constant)| {
            let why = || Cell::text(constant.why_no_stderr.as_deref().unwrap_or("–"));
            constant.stderr.map_or_else(why, |error| Cell::number(error, 4))
        })
        .table()
}

/// The constants of a family, a row per member.
pub fn family_constants(members: &[Outcome]) -> Table {
    let names = members.first().map_or_else(Vec::new, |m| m.parameters.keys().collect());
    let label = |of: &&Outcome| of.name.split_once('#').map_or(of.name.clone(), |(_, l)| l.into());
    let caption = "Constants as shipped (f32), and residuals over the fitted points.";
    Table::over(caption, members)
        .column(Column::code("member"), |of| Cell::text(label(of)))
        .column(Column::verdict("status"), |of| status(of))
        .columns(
            names,
            |name| Column::number(name.as_str(), "1"),
            |of, name| {
                let constant = of.parameters.get(*name);
                constant.map_or_else(|| Cell::missing("absent"), |c| Cell::single(c.f32))
            },
        )
        .column(Column::number("RMS", "1"), |of| Cell::number(of.residuals_f32.rms, 4))
        .column(Column::number("max", "1"), |of| Cell::number(of.residuals_f32.max_abs, 4))
        .table()
}
