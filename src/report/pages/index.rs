//! The index: what needs attention, one row per effect, and the errors at a glance.

use super::{EffectEvidence, bare, gates};
use crate::document::{Cell, Page, PrintedColumn, PrintedTable, Section, Verdict};
use crate::gate::Judgement;
use crate::numeric::measured::Measured;

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
        .column(PrintedColumn::text("effect"), |of| {
            Cell::link(of.effect.title, format!("{}.html", of.effect.name))
        })
        .column(PrintedColumn::number("candidates", "1"), |of| Cell::count(of.subjects.len()))
        .column(PrintedColumn::number("fits", "1"), |of| {
            let fitted = of.subjects.iter().filter_map(|subject| subject.fitted.as_ref());
            Cell::count(fitted.map(|fitted| fitted.result.outcomes().len()).sum())
        })
        .column(PrintedColumn::number("gates passed", "1"), |of| {
            Cell::count(of.gates.iter().filter(passed).count())
        })
        .column(PrintedColumn::number("gates", "1"), |of| Cell::count(of.gates.len()))
        .column(PrintedColumn::text("device"), |of| match &of.costs.adapter {
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
         which forms are compared there. Cost: on the device, or on f32 lanes where no device was \
         measured.",
        fits,
    )
    .column(PrintedColumn::text("effect"), |(of, ..)| Cell::text(of.effect.title))
    .column(PrintedColumn::code("fit"), |(_, fit, _)| Cell::text(bare(&fit.name)))
    .column(PrintedColumn::text("error"), |(.., accuracy)| Cell::text(accuracy.yardstick.words()))
    .column(PrintedColumn::number("value", "1"), |(.., accuracy)| Cell::number(accuracy.headline(), 3))
    .column(PrintedColumn::number("cost", "ns"), |(of, fit, _)| {
        let cost = of.costs.forms.iter().find(|cost| cost.name == fit.name);
        Cell::number_or(cost.map(|cost| cost.nanoseconds()), 3, "not timed")
    })
    .table()
}
