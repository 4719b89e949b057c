//! Errors per region and precision, laws, and parity with the device.

use super::{Evidence, bare, count, device_notice, no_device, place};
use crate::document::{Block, Cell, Column, NoticeLevel, Section, Table, Verdict};
use crate::effect::Yardstick;
use crate::numeric::measured::Measured;
use crate::validate::accuracy::Accuracy;
use crate::validate::laws::LawStanding;
use crate::validate::parity::BINS;

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    let mut section = Section::new("Accuracy").paragraph(
        "Measured on points that were not fitted: an offset grid, seeded random points and the hard \
         cases. f64 is the formula itself; f32 the constants as shipped with correctly rounded \
         elementary functions; the device evaluates the same text.",
    );
    section = device_notice(section, &evidence.costs.adapter);
    for region in evidence.effect.regions {
        let rows: Vec<(&str, &Accuracy)> = evidence
            .study
            .candidates
            .iter()
            .filter_map(|fit| {
                let found = fit.regions.iter().find(|(name, _)| name == region.name)?;
                Some((bare(&fit.name), &found.1))
            })
            .collect();
        if !rows.is_empty() {
            let caption = format!("Region {}: {}", region.name, region.description);
            let unit = units(evidence, rows.iter().map(|(name, _)| *name));
            section = section.block(table(caption, &rows, &unit));
        }
    }
    for set in evidence.effect.hard_cases {
        let rows: Vec<(&str, &Accuracy)> = evidence
            .study
            .candidates
            .iter()
            .filter_map(|fit| {
                let found = fit.hard_cases.iter().find(|(name, _)| name == set.name)?;
                Some((bare(&fit.name), &found.1))
            })
            .collect();
        if !rows.is_empty() {
            let caption = format!("Hard cases ({}): {}", set.name, set.description);
            let unit = units(evidence, rows.iter().map(|(name, _)| *name));
            section = section.block(table(caption, &rows, &unit));
        }
    }
    section
}

/// Units of the references that fits are judged by in a table.
fn units<'a>(evidence: &Evidence<'_>, names: impl Iterator<Item = &'a str>) -> String {
    let mut units: Vec<&str> = Vec::new();
    for name in names {
        let fit = evidence.study.candidates.iter().find(|fit| bare(&fit.name) == name);
        if let Some(fit) = fit.filter(|fit| !units.contains(&fit.reference.unit)) {
            units.push(fit.reference.unit);
        }
    }
    units.join(" or ")
}

fn table(caption: String, rows: &[(&str, &Accuracy)], unit: &str) -> Table {
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
    let mut table = Table::new(caption, columns);
    for (name, accuracy) in rows {
        let device = match &accuracy.device {
            Measured::Value(residuals) => Cell::number(residuals.max_abs, 4),
            Measured::NotMeasured(_) => no_device(),
        };
        let mut row = vec![
            Cell::text(*name),
            Cell::number(accuracy.f64.max_abs, 4),
            Cell::number(accuracy.f32.max_abs, 4),
            device,
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
        table.push(row);
    }
    table
}

pub(super) fn laws_section(evidence: &Evidence<'_>) -> Section {
    let mut section = Section::new("Laws");
    if evidence.study.laws.is_empty() {
        return section.paragraph("No law is stated for this effect.");
    }
    section = section.block(Block::List(
        evidence
            .effect
            .laws
            .iter()
            .map(|law| format!("`{}`: {}", law.name, law.description).into())
            .collect(),
    ));
    let mut table = Table::new(
        "Every law against every fit, in f32, at the points where it is most likely to break.",
        vec![
            Column::code("fit"),
            Column::code("law"),
            Column::number("worst violation", "1"),
            Column::number("accepted", "1"),
            Column::verdict("verdict"),
            Column::text("reason"),
        ],
    );
    for law in &evidence.study.laws {
        let (verdict, reason) = match &law.verdict {
            LawStanding::Holds => (Cell::verdict_as(Verdict::Pass, "holds"), ""),
            LawStanding::Known(reason) => {
                (Cell::verdict_as(Verdict::Warn, "known violation"), reason.as_str())
            }
            LawStanding::Violated => (Cell::verdict_as(Verdict::Fail, "violated"), ""),
        };
        table.push(vec![
            Cell::text(bare(&law.fit)),
            Cell::text(law.law.clone()),
            Cell::number(law.violation, 3),
            Cell::number(law.tolerance, 3),
            verdict,
            Cell::text(reason),
        ]);
    }
    section.block(table)
}

pub(super) fn parity_section(evidence: &Evidence<'_>) -> Section {
    let section = Section::new("Parity with the device");
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
    for fit in &evidence.study.candidates {
        match &fit.parity {
            Measured::Value(parity) => {
                let mut row = vec![Cell::text(bare(&fit.name)), count(parity.count)];
                row.extend(parity.histogram.iter().map(|points| count(*points)));
                row.extend([
                    count(usize::try_from(parity.max_ulp).unwrap_or(usize::MAX)),
                    Cell::number(parity.max_abs, 3),
                    count(parity.nan_mismatches),
                ]);
                table.push(row);
            }
            Measured::NotMeasured(reason) => reasons.push(reason.clone()),
        }
    }
    reasons.dedup();
    let section = if table.rows().is_empty() { section } else { section.block(table) };
    reasons.into_iter().fold(section, |section, reason| {
        section.block(Block::Notice { level: NoticeLevel::NotMeasured, text: reason.into() })
    })
}
