//! Errors per region and precision, laws, and parity with the device.

use super::{EffectEvidence, bare, device_notice, on_device};
use crate::document::{Cell, NoticeLevel, PrintedColumn, PrintedTable, Section, Verdict, place};
use crate::effect::Yardstick;
use crate::numeric::measured::Measured;
use crate::validate::accuracy::Accuracy;
use crate::validate::laws::{LawStanding, LawVerdict};
use crate::validate::parity::BINS;
use crate::validate::study::CandidateStudy;

pub(super) fn section(evidence: &EffectEvidence<'_>) -> Section {
    let section = Section::new("Accuracy").paragraph(
        "Measured on points that were not fitted: an offset grid, seeded random points and the hard \
         cases. f64 is the formula itself; f32 the constants as shipped with correctly rounded \
         elementary functions; the device evaluates the same text.",
    );
    let section = device_notice(section, &evidence.costs.adapter);
    type Judged = Vec<(String, Accuracy)>;
    let rows = |judged: fn(&CandidateStudy) -> &Judged, name: &str| {
        let of = |fit| Some((fit, &judged(fit).iter().find(|(of, _)| of == name)?.1));
        evidence.study.candidates.iter().filter_map(of).collect::<Vec<_>>()
    };
    let regions = evidence.effect.regions.iter().map(|region| {
        let caption = format!("Region {}: {}", region.name, region.description);
        (caption, rows(|fit| &fit.regions, region.name))
    });
    let hard_cases = evidence.effect.hard_cases.iter().map(|set| {
        let caption = format!("Hard cases ({}): {}", set.name, set.description);
        (caption, rows(|fit| &fit.hard_cases, set.name))
    });
    let tables = regions.chain(hard_cases).filter(|(_, rows)| !rows.is_empty());
    section.blocks(tables.map(|(caption, rows)| table(caption, &rows)))
}

/// Units of the references that fits are judged by in a table.
fn units(rows: &[(&CandidateStudy, &Accuracy)]) -> String {
    let mut units: Vec<&str> = Vec::new();
    for (fit, _) in rows {
        if !units.contains(&fit.reference.unit) {
            units.push(fit.reference.unit);
        }
    }
    units.join(" or ")
}

fn table(caption: String, rows: &[(&CandidateStudy, &Accuracy)]) -> PrintedTable {
    let unit = units(rows);
    let of_errors = |title: &str| PrintedColumn::number(title, unit.as_str());
    let mut table = PrintedTable::over(caption, rows).code("fit", |(fit, _)| bare(&fit.name));
    if rows.iter().any(|(_, accuracy)| accuracy.yardstick == Yardstick::RelativeL2) {
        let grouped = rows.iter().any(|(_, accuracy)| !accuracy.relative_l2.at.is_empty());
        let title = if grouped { "relative L2, worst group" } else { "relative L2" };
        table = table
            .number(title, "1", |(_, of)| of.relative_l2.value)
            .text("worst group", |(_, of)| place(&of.relative_l2.at, 4));
    }
    let largest = |title| of_errors(title).grouped("max |error|");
    table
        .column(largest("f64"), |(_, of)| Cell::number(of.f64.max_abs, 4))
        .column(largest("f32"), |(_, of)| Cell::number(of.f32.max_abs, 4))
        .column(largest("device"), |(_, of)| on_device(&of.device.map(|found| found.max_abs), 4))
        .column(of_errors("RMS, f32"), |(_, of)| Cell::number(of.f32.rms, 4))
        .column(of_errors("bias, f32"), |(_, of)| Cell::number(of.f32.bias, 3))
        .column(of_errors("p99, f32"), |(_, of)| Cell::number(of.f32.p99, 3))
        .number("max relative, f32", "1", |(_, of)| {
            Cell::number_or(of.f32.max_rel, 3, "the target is 0 everywhere")
        })
        .text("where (f32)", |(_, of)| place(&of.f32.max_abs_at, 4))
        .table()
}

pub(super) fn laws_section(evidence: &EffectEvidence<'_>) -> Section {
    let section = Section::new("Laws");
    if evidence.study.laws.is_empty() {
        return section.paragraph("No law is stated for this effect.");
    }
    let stated = evidence.effect.laws.iter();
    let stated = stated.map(|law| format!("`{}`: {}", law.name, law.description));
    let verdict = |law: &&LawVerdict| match &law.verdict {
        LawStanding::Holds => Cell::verdict_as(Verdict::Pass, "holds"),
        LawStanding::Known(_) => Cell::verdict_as(Verdict::Warn, "known violation"),
        LawStanding::Violated => Cell::verdict_as(Verdict::Fail, "violated"),
    };
    let table = PrintedTable::over(
        "Every law against every fit, in f32, at the points where it is most likely to break.",
        &evidence.study.laws,
    )
    .code("fit", |law| bare(&law.fit))
    .code("law", |law| law.law.as_str())
    .number("worst violation", "1", |law| law.violation)
    .number("accepted", "1", |law| law.tolerance)
    .verdict("verdict", verdict)
    .text("reason", |law| match &law.verdict {
        LawStanding::Known(reason) => Cell::text(reason.as_str()),
        LawStanding::Holds | LawStanding::Violated => Cell::text(""),
    });
    section.list(stated).block(table)
}

pub(super) fn parity_section(evidence: &EffectEvidence<'_>) -> Section {
    let (mut found, mut reasons) = (Vec::new(), Vec::new());
    for fit in &evidence.study.candidates {
        match &fit.parity {
            Measured::Value(parity) => found.push((bare(&fit.name), parity)),
            Measured::NotMeasured(reason) => reasons.push(reason.as_str()),
        }
    }
    reasons.dedup();
    let section =
        reasons.into_iter().fold(Section::new("Parity with the device"), |section, reason| {
            section.notice(NoticeLevel::NotMeasured, reason)
        });
    if found.is_empty() {
        return section;
    }
    let table = PrintedTable::over(
        "Distance between the device and the f32 lanes, in units in the last place of the result.",
        found,
    )
    .code("fit", |(fit, _)| *fit)
    .number("points", "1", |(_, parity)| parity.count)
    .columns(
        0..BINS.len(),
        |at| match (*at, BINS[*at]) {
            (0, _) => PrintedColumn::number("equal", "1"),
            (at, u64::MAX) => PrintedColumn::number(format!("> {} ulp", BINS[at - 1]), "1"),
            (_, end) => PrintedColumn::number(format!("≤ {end} ulp"), "1"),
        },
        |(_, parity), at| Cell::count(parity.histogram[*at]),
    )
    .number("max", "ulp", |(_, parity)| usize::try_from(parity.max_ulp).unwrap_or(usize::MAX))
    .number("max |difference|", "1", |(_, of)| of.max_abs)
    .number("NaN on one side", "1", |(_, of)| of.nan_mismatches);
    section.block(table)
}
