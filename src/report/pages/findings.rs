//! Printed and found: claims of papers with this run's numbers beside them.

use crate::document::{Cell, PrintedTable, Section, Verdict};
use crate::effect::Finding;

/// Claims with what is found.
pub(super) fn section(findings: &[Finding]) -> Section {
    let section = Section::new("Printed and found");
    if findings.is_empty() {
        return section.paragraph("No printed claim is checked here.");
    }
    let verdict = |of: &&Finding| {
        let verdict = if of.verdict == "holds" { Verdict::Pass } else { Verdict::Warn };
        Cell::verdict_as(verdict, of.verdict.as_str())
    };
    let caption = "What is printed, what holds, and the command that shows it.";
    let table = PrintedTable::over(caption, findings)
        .text("where", |of| of.place.as_str())
        .text("as printed", |of| of.printed.as_str())
        .text("found", |of| of.found.as_str())
        .verdict("verdict", verdict)
        .code("command", |of| of.command.as_str());
    section.block(table)
}
