//! Errors per region and precision, laws, and parity with the device.

use super::{Evidence, bare, device_notice, on_device, place};
use crate::document::{Block, Cell, Column, NoticeLevel, Section, Table, Verdict};
use crate::effect::Yardstick;
use crate::numeric::measured::Measured;
use crate::registry;
use crate::validate::accuracy::Accuracy;
use crate::validate::laws::LawStanding;
use crate::validate::parity::BINS;
use crate::validate::study::FitStudy;

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    let section = Section::new("Accuracy").paragraph(
        "Measured on points that were not fitted: an offset grid, seeded random points and the hard \
         cases. f64 is the formula itself; f32 the constants as shipped with correctly rounded \
         elementary functions; the device evaluates the same text.",
    );
    let section = device_notice(section, &evidence.costs.adapter);
    let with = |section: Section, caption: String, of: &dyn Fn(&FitStudy) -> Found<'_>| {
        let judged = |fit| Some((fit, of(fit)?));
        let rows: Vec<_> = evidence.study.fits.iter().filter_map(judged).collect();
        if rows.is_empty() { section } else { section.block(table(caption, &rows)) }
    };
    let section = evidence.effect.regions.iter().fold(section, |section, region| {
        let caption = format!("Region {}: {}", region.name, region.description);
        with(section, caption, &|fit| named(&fit.regions, region.name))
    });
    evidence.effect.hard_cases.iter().fold(section, |section, set| {
        let caption = format!("Hard cases ({}): {}", set.name, set.description);
        with(section, caption, &|fit| named(&fit.hard_cases, set.name))
    })
}

type Found<'a> = Option<&'a Accuracy>;

fn named<'a>(judged: &'a [(String, Accuracy)], name: &str) -> Found<'a> {
    judged.iter().find(|(of, _)| of == name).map(|(_, accuracy)| accuracy)
}

/// Units of the references that fits are judged by in a table.
fn units(rows: &[(&FitStudy, &Accuracy)]) -> String {
    let mut units: Vec<&str> = Vec::new();
    for (fit, _) in rows {
        if let Some((_, reference)) = registry::reference(&fit.outcome.target)
            && !units.contains(&reference.unit)
        {
            units.push(reference.unit);
        }
    }
    units.join(" or ")
}

fn table(caption: String, rows: &[(&FitStudy, &Accuracy)]) -> Table {
    let unit = units(rows);
    let unit = unit.as_str();
    let by_norm = rows.iter().any(|(_, accuracy)| accuracy.yardstick == Yardstick::RelativeL2);
    let mut columns = vec![
        Column::code("fit"),
        Column::number("max |error|, f64", unit),
        Column::number("max |error|, f32", unit),
        Column::number("max |error|, device", unit),
        Column::number("RMS, f32", unit),
        Column::number("bias, f32", unit),
        Column::number("p99, f32", unit),
        Column::number("max relative, f32", "1"),
        Column::text("where (f32)"),
    ];
    if by_norm {
        let grouped = rows.iter().any(|(_, accuracy)| !accuracy.relative_l2.at.is_empty());
        let title = if grouped { "relative L2, worst group" } else { "relative L2" };
        columns.insert(1, Column::number(title, "1"));
        columns.insert(2, Column::text("worst group"));
    }
    Table::new(caption, columns).with_rows(rows.iter().map(|(fit, accuracy)| {
        let mut row = vec![
            Cell::text(bare(&fit.outcome.name)),
            Cell::number(accuracy.f64.max_abs, 4),
            Cell::number(accuracy.f32.max_abs, 4),
            on_device(&accuracy.device.map(|residuals| residuals.max_abs), 4),
            Cell::number(accuracy.f32.rms, 4),
            Cell::number(accuracy.f32.bias, 3),
            Cell::number(accuracy.f32.p99, 3),
            Cell::number_or(accuracy.f32.max_rel, 3, "the target is 0 everywhere"),
            Cell::text(place(&accuracy.f32.max_abs_at)),
        ];
        if by_norm {
            row.insert(1, Cell::number(accuracy.relative_l2.value, 3));
            row.insert(2, Cell::text(place(&accuracy.relative_l2.at)));
        }
        row
    }))
}

pub(super) fn laws_section(evidence: &Evidence<'_>) -> Section {
    let section = Section::new("Laws");
    if evidence.study.laws.is_empty() {
        return section.paragraph("No law is stated for this effect.");
    }
    let stated = evidence.effect.laws.iter();
    let stated = stated.map(|law| format!("`{}`: {}", law.name, law.description).into());
    let columns = vec![
        Column::code("fit"),
        Column::code("law"),
        Column::number("worst violation", "1"),
        Column::number("accepted", "1"),
        Column::verdict("verdict"),
        Column::text("reason"),
    ];
    let table = Table::new(
        "Every law against every fit, in f32, at the points where it is most likely to break.",
        columns,
    );
    section.block(Block::List(stated.collect())).block(table.with_rows(
        evidence.study.laws.iter().map(|law| {
            let (verdict, word, reason) = match &law.verdict {
                LawStanding::Holds => (Verdict::Pass, "holds", ""),
                LawStanding::Known(reason) => (Verdict::Warn, "known violation", reason.as_str()),
                LawStanding::Violated => (Verdict::Fail, "violated", ""),
            };
            vec![
                Cell::text(bare(&law.fit)),
                Cell::text(law.law.as_str()),
                Cell::number(law.violation, 3),
                Cell::number(law.tolerance, 3),
                Cell::verdict_as(verdict, word),
                Cell::text(reason),
            ]
        }),
    ))
}

pub(super) fn parity_section(evidence: &Evidence<'_>) -> Section {
    let mut columns = vec![Column::code("fit"), Column::number("points", "1")];
    columns.extend(BINS.iter().enumerate().map(|(at, end)| {
        let title = match at {
            0 => "equal".to_owned(),
            _ if *end == u64::MAX => format!("> {} ulp", BINS[at - 1]),
            _ => format!("≤ {end} ulp"),
        };
        Column::number(title, "1")
    }));
    columns.extend([
        Column::number("max", "ulp"),
        Column::number("max |difference|", "1"),
        Column::number("NaN on one side", "1"),
    ]);
    let mut table = Table::new(
        "Distance between the device and the f32 lanes, in units in the last place of the result.",
        columns,
    );
    let mut reasons = Vec::new();
    for fit in &evidence.study.fits {
        match &fit.parity {
            Measured::Value(parity) => {
                let mut row = vec![Cell::text(bare(&fit.outcome.name)), Cell::count(parity.count)];
                row.extend(parity.histogram.iter().map(|points| Cell::count(*points)));
                row.extend([
                    Cell::count(usize::try_from(parity.max_ulp).unwrap_or(usize::MAX)),
                    Cell::number(parity.max_abs, 3),
                    Cell::count(parity.nan_mismatches),
                ]);
                table.push(row);
            }
            Measured::NotMeasured(reason) => reasons.push(reason.as_str()),
        }
    }
    reasons.dedup();
    let section = Section::new("Parity with the device");
    let section = reasons
        .into_iter()
        .fold(section, |section, reason| section.notice(NoticeLevel::NotMeasured, reason));
    if table.rows().is_empty() { section } else { section.block(table) }
}
