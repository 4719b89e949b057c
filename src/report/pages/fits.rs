//! What was fitted to what, and the constants.

use super::{EffectEvidence, bare, families};
use crate::document::{Cell, PrintedColumn, PrintedTable, Section, Verdict};
use crate::effect::Reference;
use crate::fit::outcome::{Outcome, Status};

pub(super) fn exact_section(evidence: &EffectEvidence<'_>) -> Section {
    let effect = evidence.effect;
    let arguments = |reference: &&Reference| {
        let arguments = reference.arguments.iter();
        let arguments = arguments.map(|of| format!("`{}` [{}] in {}", of.name, of.unit, of.domain));
        Cell::text(arguments.collect::<Vec<_>>().join("; "))
    };
    let references = PrintedTable::over(
        "References: exact values, from formulas that no form shares.",
        effect.references,
    )
    .code("reference", |reference| reference.name)
    .text("what", |reference| reference.description)
    .text("arguments", arguments)
    .text("accuracy", |reference| reference.accuracy)
    .text("source", |reference| reference.source);
    let forms =
        PrintedTable::over("Forms: approximations, each one WGSL function.", evidence.forms)
            .code("form", |form| form.name.as_str())
            .text("what", |form| form.description.as_str())
            .text("from", |form| form.citation.as_str())
            .code("text", |form| form.path.as_str());
    Section::new("What is exact, and what approximates it").block(references).block(forms)
}

pub(super) fn fitted_section(evidence: &EffectEvidence<'_>) -> Section {
    let mut section = Section::new("What was fitted to what");
    let outcomes = || evidence.study.candidates.iter().filter_map(|fit| fit.outcome.as_ref());
    if !evidence.study.candidates.is_empty() {
        section = section
            .block(fits(outcomes()))
            .paragraph(
                "Alternations: how often a minimax fit's error reaches its maximum with alternating sign; \
                 one more than the number of free constants proves the optimum.",
            )
            .details("Every constant, as shipped", constants(outcomes()));
    }
    for family in families(evidence) {
        let (name, of) = (&family.name, &family.family);
        let summary = format!("Constants of `{name}` for every member of `{of}`");
        section = section.details(summary, family_constants(&family.members));
    }
    section
}

fn fits<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> PrintedTable {
    PrintedTable::over(
        "Fits to references. RMS and max over the fitted points, of the constants as shipped, in f32.",
        outcomes,
    )
    .code("fit", |of| bare(&of.name))
    .code("form", |of| bare(&of.form))
    .code("target", |of| of.target.as_str())
    .text("loss", |of| of.loss.as_str())
    .verdict("status", |of| status(of))
    .text("solver", |of| of.solver.split(" (").next().unwrap_or_default())
    .number("free", "1", |of| of.free_count())
    .number("RMS", "1", |of| (of.residuals_f32.rms, 4))
    .number("max", "1", |of| (of.residuals_f32.max_abs, 4))
    .number("alternations", "1", |of| of.equioscillations.map_or_else(|| Cell::text("–"), Cell::count))
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
pub fn constants<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> PrintedTable {
    let constants = outcomes.flat_map(|outcome| {
        outcome.parameters.iter().map(|(name, constant)| (&outcome.name, name, constant))
    });
    PrintedTable::over("Constants: the optimum in f64, and the f32 that ships.", constants)
        .code("fit", |(fit, ..)| bare(fit))
        .code("constant", |(_, name, _)| name.as_str())
        .number("f64", "1", |(.., constant)| (constant.value, 17))
        .number("f32", "1", |(.., constant)| Cell::single(constant.f32))
        .code("bits", |(.., constant)| constant.f32_hex.as_str())
        .text("role", |(.., constant)| constant.role.as_str())
        .number("standard error", "1", |(.., constant)| {
            let why = || Cell::text(constant.why_no_stderr.as_deref().unwrap_or("–"));
            constant.stderr.map_or_else(why, |error| Cell::number(error, 4))
        })
        .table()
}

/// The constants of a family, a row per member.
pub fn family_constants(members: &[Outcome]) -> PrintedTable {
    let names = members.first().map_or_else(Vec::new, |m| m.parameters.keys().collect());
    let label = |of: &&Outcome| of.name.split_once('#').map_or(of.name.clone(), |(_, l)| l.into());
    let caption = "Constants as shipped (f32), and residuals over the fitted points.";
    PrintedTable::over(caption, members)
        .code("member", |of| label(of))
        .verdict("status", |of| status(of))
        .columns(
            names,
            |name| PrintedColumn::number(name.as_str(), "1"),
            |of, name| {
                let constant = of.parameters.get(*name);
                constant.map_or_else(|| Cell::missing("absent"), |c| Cell::single(c.f32))
            },
        )
        .number("RMS", "1", |of| (of.residuals_f32.rms, 4))
        .number("max", "1", |of| (of.residuals_f32.max_abs, 4))
        .table()
}
