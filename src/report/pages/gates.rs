//! Gates and their margins.

use crate::document::{Cell, Column, NoticeLevel, Section, Table, Verdict};
use crate::gate::Judgement;

/// The gates that plainly pass, in their order, and those that need attention, failures first.
pub fn by_attention<'a>(gates: &[&'a Judgement]) -> (Vec<&'a Judgement>, Vec<&'a Judgement>) {
    let pass = |gate: &&Judgement| gate.verdict == Verdict::Pass;
    let (passed, mut attention): (Vec<_>, Vec<_>) = gates.iter().copied().partition(pass);
    attention.sort_by_key(|gate| std::cmp::Reverse(gate.verdict));
    (passed, attention)
}

/// A line that sums up, and the gates that need attention.
pub(super) fn attention_section(title: &str, gates: &[&Judgement]) -> Section {
    let section = Section::new(title);
    if gates.is_empty() {
        let text = "No gate holds this: nothing would notice a change.";
        return section.notice(NoticeLevel::Warning, text);
    }
    let (_, attention) = by_attention(gates);
    let level = match attention.first().map(|gate| gate.verdict) {
        Some(Verdict::Fail) => NoticeLevel::Failure,
        Some(Verdict::Warn) => NoticeLevel::Warning,
        Some(Verdict::NotMeasured) => NoticeLevel::NotMeasured,
        Some(Verdict::Pass) | None => NoticeLevel::Info,
    };
    let section = section.notice(level, summary(gates));
    if attention.is_empty() {
        return section;
    }
    let caption = "Gates that failed, were not measured, or are close to their limit.";
    section.block(table(caption, &attention))
}

/// The gates of a page: what needs attention, then all of them.
pub(super) fn section(gates: &[&Judgement]) -> Section {
    let section = attention_section("Gates", gates);
    if gates.is_empty() {
        return section;
    }
    section.block(table("Every budget of `fits/gates.toml` on what this page shows.", gates))
}

/// `2 gates: 2 passed, 0 of them with a warning, 0 not measured, 0 failed`.
pub fn summary(gates: &[&Judgement]) -> String {
    let count = |wanted| gates.iter().filter(|gate| gate.verdict == wanted).count();
    let (passed, warned) = (count(Verdict::Pass), count(Verdict::Warn));
    format!(
        "{} gates: {} passed, {warned} of them with a warning, {} not measured, {} failed",
        gates.len(),
        passed + warned,
        count(Verdict::NotMeasured),
        count(Verdict::Fail),
    )
}

/// A row per gate: verdict, what was measured of which limit and where, and why the gate is there.
pub fn table(caption: &str, gates: &[&Judgement]) -> Table {
    let columns = vec![
        Column::verdict("verdict"),
        Column::code("subject"),
        Column::code("metric"),
        Column::text("domain"),
        Column::figures("measured"),
        Column::figures("limit"),
        Column::number("left", "%"),
        Column::text("where"),
        Column::text("why it is there"),
    ];
    Table::new(caption, columns).with_rows(gates.iter().map(|judgement| {
        let gate = &judgement.gate;
        let reason = judgement.reason.as_deref();
        let (measured, place) = match &judgement.measured {
            Some(measured) => {
                let place = reason.map_or_else(|| measured.place(), str::to_owned);
                (Cell::number(measured.value, 5), place)
            }
            None => (Cell::missing(reason.unwrap_or("no reason given")), String::new()),
        };
        vec![
            Cell::verdict(judgement.verdict),
            Cell::text(gate.subject.as_str()),
            Cell::text(format!("{} {}", gate.metric, gate.precision)),
            Cell::text(gate.domain.as_ref().map_or("as fitted".to_owned(), ToString::to_string)),
            measured,
            Cell::number(gate.limit, 5),
            judgement.margin().map_or_else(|| Cell::text(""), |left| Cell::number(100.0 * left, 3)),
            Cell::text(place),
            Cell::text(gate.why.as_str()),
        ]
    }))
}
