//! The index: what needs attention, one row per effect, and the errors at a glance.

use super::{Evidence, bare, gates};
use crate::document::{Cell, Column, Page, Section, Table, Verdict};
use crate::gate::Judgement;
use crate::numeric::measured::Measured;

/// The first page: how it stands, what there is.
pub fn index_page(effects: &[Evidence<'_>], gates: &[&Judgement]) -> Page {
    Page::new(
        "index",
        "striae: approximations, fitted and judged",
        "What was fitted to what, how wrong it is, what it costs, and which budget holds it.",
    )
    .section(gates::attention_section("Gates that need attention", gates))
    .section(Section::new("Overview").block(overview(effects)))
    .section(Section::new("Errors at a glance").block(errors(effects)))
}

fn overview(effects: &[Evidence<'_>]) -> Table {
    let columns = vec![
        Column::text("effect"),
        Column::number("forms", "1"),
        Column::number("fits", "1"),
        Column::number("gates passed", "1"),
        Column::number("gates", "1"),
        Column::text("device"),
    ];
    Table::new("Effects.", columns).with_rows(effects.iter().map(|evidence| {
        let members = evidence.families.iter().map(|family| family.members.len());
        let passed = |gate: &&&Judgement| matches!(gate.verdict, Verdict::Pass | Verdict::Warn);
        vec![
            Cell::link(evidence.effect.title, format!("{}.html", evidence.effect.name)),
            Cell::count(evidence.effect.forms.len()),
            Cell::count(evidence.study.fits.len() + members.sum::<usize>()),
            Cell::count(evidence.gates.iter().filter(passed).count()),
            Cell::count(evidence.gates.len()),
            match &evidence.costs.adapter {
                Measured::Value(adapter) => Cell::text(adapter.to_string()),
                Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
            },
        ]
    }))
}

/// The first error of every fit, beside its cost.
fn errors(effects: &[Evidence<'_>]) -> Table {
    let columns = vec![
        Column::text("effect"),
        Column::code("fit"),
        Column::text("error"),
        Column::number("value", "1"),
        Column::number("cost", "ns"),
    ];
    let rows = effects.iter().flat_map(|evidence| {
        evidence.study.fits.iter().filter_map(|fit| {
            let (_, accuracy) = fit.regions.first()?;
            let cost = evidence.costs.forms.iter().find(|cost| cost.name == fit.outcome.name);
            Some(vec![
                Cell::text(evidence.effect.title),
                Cell::text(bare(&fit.outcome.name)),
                Cell::text(accuracy.yardstick.words()),
                Cell::number(accuracy.headline(), 3),
                Cell::number_or(cost.map(|cost| cost.nanoseconds()), 3, "not timed"),
            ])
        })
    });
    Table::new(
        "Fits to references over the first region in which they are judged, in f32, by the error by \
         which forms are compared there. Cost: on the device, or on f32 lanes where no device was \
         measured.",
        columns,
    )
    .with_rows(rows)
}
