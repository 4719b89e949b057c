//! The index: what needs attention, one row per effect, and the errors at a glance.

use super::{EffectEvidence, bare, gates};
use crate::document::{Cell, Page, PrintedTable, Section, Verdict};
use crate::gate::Judgement;
use crate::numeric::measured::Measured;
use crate::validate::cost::RANKED_ON;

/// The first page: how it stands, what there is.
pub fn index_page(effects: &[EffectEvidence<'_>], gates: &[&Judgement]) -> Page {
    Page::new(
        "index",
        "striae: approximations, fitted and judged",
        "What was fitted to what, how wrong it is, what it costs, and which budget holds it.",
    )
    .section(gates::attention_section("Gates that need attention", gates))
    .section(Section::new("Overview").block(overview(effects)))
    .section(Section::new("Errors at a glance").block(errors(effects)))
}

fn overview(effects: &[EffectEvidence<'_>]) -> PrintedTable {
    let passed = |gate: &&&Judgement| matches!(gate.verdict, Verdict::Pass | Verdict::Warn);
    PrintedTable::over("Effects.", effects)
        .text("effect", |of| Cell::link(of.effect.title, format!("{}.html", of.effect.name)))
        .number("candidates", "1", |of| of.subjects.len())
        .number("fits", "1", |of| {
            let fitted = of.subjects.iter().filter_map(|subject| subject.fitted.as_ref());
            Cell::count(fitted.map(|fitted| fitted.result.outcomes().len()).sum())
        })
        .number("gates passed", "1", |of| of.gates.iter().filter(passed).count())
        .number("gates", "1", |of| of.gates.len())
        .text("device", |of| match &of.costs.adapter {
            Measured::Value(adapter) => Cell::text(adapter.to_string()),
            Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
        })
        .table()
}

/// The first error of every fit, beside its cost.
fn errors(effects: &[EffectEvidence<'_>]) -> PrintedTable {
    let fits = effects.iter().flat_map(|of| {
        of.study.candidates.iter().filter_map(move |fit| Some((of, fit, &fit.regions.first()?.1)))
    });
    PrintedTable::over(
        "Fits to references over the first region in which they are judged, in f32, by the error by \
         which forms are compared there. Cost: counted in machine code, relative to the baseline of \
         the reference.",
        fits,
    )
    .text("effect", |(of, ..)| of.effect.title)
    .code("fit", |(_, fit, _)| bare(&fit.name))
    .text("error", |(.., accuracy)| accuracy.yardstick.words())
    .number("value", "1", |(.., accuracy)| accuracy.headline())
    .number(format!("cost on {RANKED_ON}, relative"), "1", |(of, fit, _)| {
        match of.costs.of(&fit.name).map(|cost| of.costs.ratio_on(RANKED_ON, cost)) {
            Some(Measured::Value(ratio)) => Cell::number(ratio, 3),
            Some(Measured::NotMeasured(reason)) => Cell::missing(reason),
            None => Cell::missing("has no points"),
        }
    })
    .table()
}
