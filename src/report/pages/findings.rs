//! Printed and found: claims of papers with this run's numbers beside them.

use super::Evidence;
use crate::document::{Cell, Column, Section, Table, Verdict};
use crate::effect::Finding;

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    table_section(&evidence.study.findings)
}

/// Claims with what is found.
pub(super) fn table_section(findings: &[Finding]) -> Section {
    let section = Section::new("Printed and found");
    if findings.is_empty() {
        return section.paragraph("No printed claim is checked here.");
    }
    let mut table = Table::new(
        "What is printed, what holds, and the command that shows it.",
        vec![
            Column::text("where"),
            Column::text("as printed"),
            Column::text("found"),
            Column::verdict("verdict"),
            Column::code("command"),
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
