//! Gates and their margins.

use serde::Serialize;

use crate::document::{Block, Cell, Column, NoticeLevel, Section, Table, Verdict};

/// A gate and how it came out, as the report shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GateLine {
    /// What is judged.
    pub subject: String,
    /// Which figure of it, in which precision and domain.
    pub metric: String,
    /// The figure, or why there is none.
    pub measured: Result<f64, String>,
    /// Its limit.
    pub limit: f64,
    /// Verdict.
    pub verdict: Verdict,
    /// Why the gate is there.
    pub why: String,
}

pub(super) fn section(gates: &[GateLine]) -> Section {
    let section = Section::new("Gates");
    if gates.is_empty() {
        return section.block(Block::Notice {
            level: NoticeLevel::Warning,
            text: "No gate holds this page: nothing would notice a change.".into(),
        });
    }
    let mut table = Table::new(
        "Budgets of `fits/gates.toml`. The margin is what is left of the limit.",
        vec![
            Column::code("subject"),
            Column::code("metric"),
            Column::number("measured", "1"),
            Column::number("limit", "1"),
            Column::number("margin", "%"),
            Column::verdict("verdict"),
            Column::text("why"),
        ],
    );
    for gate in gates {
        let (measured, margin) = match &gate.measured {
            Ok(value) => (
                Cell::number(*value, 4),
                Cell::number((gate.limit - value) / gate.limit * 100.0, 3),
            ),
            Err(reason) => (Cell::missing(reason.clone()), Cell::missing("nothing was measured")),
        };
        table.push(vec![
            Cell::text(gate.subject.clone()),
            Cell::text(gate.metric.clone()),
            measured,
            Cell::number(gate.limit, 4),
            margin,
            Cell::verdict(gate.verdict),
            Cell::text(gate.why.clone()),
        ]);
    }
    section.block(table)
}
