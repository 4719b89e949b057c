//! Gates and their margins.

use crate::document::{Cell, NoticeLevel, PrintedTable, Section, Verdict};
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
    let caption = "Gates that failed, were not measured, or are close to their limit.";
    section
        .notice(level, summary(gates))
        .blocks((!attention.is_empty()).then(|| table(caption, &attention)))
}

/// The gates of a page: what needs attention, then all of them.
pub(super) fn section(gates: &[&Judgement]) -> Section {
    let caption = "Every budget of `fits/gates.toml` on what this page shows.";
    attention_section("Gates", gates).blocks((!gates.is_empty()).then(|| table(caption, gates)))
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
pub fn table(caption: &str, gates: &[&Judgement]) -> PrintedTable {
    PrintedTable::over(caption, gates)
        .verdict("verdict", |of| of.verdict)
        .code("subject", |of| of.gate.subject.as_str())
        .code("metric", |of| format!("{} {}", of.gate.metric, of.gate.precision))
        .text("domain", |of| {
            of.gate.domain.as_ref().map_or("as fitted".to_owned(), ToString::to_string)
        })
        .figures("measured", |of| {
            let why = of.reason.as_deref().unwrap_or_default();
            Cell::number_or(of.measured.as_ref().map(|found| found.value), 5, why)
        })
        .figures("limit", |of| (of.gate.limit, 5))
        .number("left", "%", |of| {
            of.margin.map_or_else(|| Cell::text(""), |left| Cell::number(100.0 * left, 3))
        })
        .text("where", |of| {
            of.measured.as_ref().map_or_else(String::new, |found| match &of.reason {
                Some(reason) => reason.clone(),
                None => found.place(),
            })
        })
        .text("why it is there", |of| of.gate.why.as_str())
        .table()
}
