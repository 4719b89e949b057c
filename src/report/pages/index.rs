//! The index: one row per effect, and the gates at a glance.

use super::{Evidence, GateLine, bare, count};
use crate::document::{Block, Cell, Column, NoticeLevel, Page, Section, Table, Verdict};
use crate::numeric::measured::Measured;
use crate::registry;

/// The first page: what there is, how it stands.
pub fn index_page(effects: &[Evidence<'_>], gates: &[GateLine]) -> Page {
    let mut overview = Table::new(
        "Effects.",
        vec![
            Column::text("effect"),
            Column::number("forms", "1"),
            Column::number("fits", "1"),
            Column::number("gates passed", "1"),
            Column::number("gates", "1"),
            Column::text("device"),
        ],
    );
    for evidence in effects {
        let fits: usize = evidence.study.fits.len()
            + evidence.families.iter().map(|family| family.members.len()).sum::<usize>();
        let passed = evidence
            .gates
            .iter()
            .filter(|gate| matches!(gate.verdict, Verdict::Pass | Verdict::Warn))
            .count();
        overview.push(vec![
            Cell::link(evidence.effect.title, format!("{}.html", evidence.effect.name)),
            count(registry::forms_of(evidence.effect).count()),
            count(fits),
            count(passed),
            count(evidence.gates.len()),
            match &evidence.costs.adapter {
                Measured::Value(adapter) => Cell::text(adapter.to_string()),
                Measured::NotMeasured(reason) => Cell::missing(reason.clone()),
            },
        ]);
    }
    let mut gate_section = Section::new("Gates that need attention");
    let attention: Vec<&GateLine> =
        gates.iter().filter(|gate| gate.verdict != Verdict::Pass).collect();
    if attention.is_empty() {
        gate_section = gate_section.block(Block::Notice {
            level: NoticeLevel::Info,
            text: format!("All {} gates pass.", gates.len()).into(),
        });
    } else {
        let mut table = Table::new(
            "Gates that failed, are close to their limit, or were not measured.",
            vec![
                Column::code("subject"),
                Column::code("metric"),
                Column::verdict("verdict"),
                Column::text("why"),
            ],
        );
        for gate in attention {
            table.push(vec![
                Cell::text(gate.subject.clone()),
                Cell::text(gate.metric.clone()),
                Cell::verdict(gate.verdict),
                Cell::text(gate.why.clone()),
            ]);
        }
        gate_section = gate_section.block(table);
    }
    Page::new(
        "index",
        "striae: approximations, fitted and judged",
        "What was fitted to what, how wrong it is, what it costs, and which budget holds it.",
    )
    .section(Section::new("Overview").block(overview))
    .section(best_section(effects))
    .section(gate_section)
}

/// The fits with the smallest and the published error, side by side.
fn best_section(effects: &[Evidence<'_>]) -> Section {
    let mut table = Table::new(
        "Fits to references over the first region in which they are judged, in f32, by the error by \
         which forms are compared there. Cost: on the device, or on f32 lanes where no device was \
         measured.",
        vec![
            Column::text("effect"),
            Column::code("fit"),
            Column::text("error"),
            Column::number("value", "1"),
            Column::number("cost", "ns"),
        ],
    );
    for evidence in effects {
        for fit in &evidence.study.fits {
            let Some((_, accuracy)) = fit.regions.first() else { continue };
            let cost = evidence.costs.forms.iter().find(|cost| cost.name == fit.outcome.name);
            table.push(vec![
                Cell::text(evidence.effect.title),
                Cell::text(bare(&fit.outcome.name)),
                Cell::text(accuracy.yardstick.words()),
                Cell::number(accuracy.headline(), 3),
                Cell::number_or(cost.map(|cost| cost.nanoseconds()), 3, "not timed"),
            ]);
        }
    }
    Section::new("Errors at a glance").block(table)
}
