//! Printed and found: claims of papers with this run's numbers beside them.

use super::EffectEvidence;
use crate::document::{Cell, PrintedColumn, PrintedTable, Section, Verdict};
use crate::effect::Finding;

pub(super) fn section(evidence: &EffectEvidence<'_>) -> Section {
    table_section(&evidence.study.findings)
}

/// Claims with what is found.
pub(super) fn table_section(findings: &[Finding]) -> Section {
    let section = Section::new("Printed and found");
    if findings.is_empty() {
        return section.paragraph("No printed claim is checked here.");
    }
    let mut table = PrintedTable::new(
        "What is printed, what holds, and the command that shows it.",
        vec![
            PrintedColumn::text("where"),
            PrintedColumn::text("as printed"),
            PrintedColumn::text("found"),
            PrintedColumn::verdict("verdict"),
            PrintedColumn::code("command"),
        ],
    );
    for finding in findings {
        let verdict = if finding.verdict == "holds" { Verdict::Pass } else { Verdict::Warn };
        table.push(vec![
            Cell::text(finding.place.clone()),
            Cell::text(finding.printed.clone()),
            Cell::text(finding.found.clone()),
            Cell::verdict_as(verdict, finding.verdict.clone()),
            Cell::text(finding.command.clone()),
        ]);
    }
    section.block(table)
}
