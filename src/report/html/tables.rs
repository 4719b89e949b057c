//! Tables as HTML.

use maud::{Markup, html};

use super::blocks::{inline, safe};
use crate::document::{Align, Cell, ColumnKind, PrintedColumn, PrintedTable, Value, Verdict};

/// Rows beyond which a table is shown on demand: what a page says stands before its long tables.
const LONG: usize = 20;

/// A table; a long one under its caption, which unfolds it.
pub(super) fn table(table: &PrintedTable) -> Markup {
    let rows = table.rows().len();
    if rows <= LONG {
        return unfolded(table, true);
    }
    html! {
        details { summary { (inline(&table.caption)) " (" (rows) " rows)" } (unfolded(table, false)) }
    }
}

/// A table in a container of its own, so that a wide one scrolls and the page does not.
pub(super) fn unfolded(table: &PrintedTable, captioned: bool) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(table.caption.to_plain()) {
            table {
                @if captioned { caption { (inline(&table.caption)) } }
                (head(&table.columns))
                tbody {
                    @if table.rows().is_empty() {
                        tr { td.nothing colspan=(table.columns.len()) { "nothing to show" } }
                    }
                    @for row in table.rows() {
                        tr {
                            @for (index, (column, cell)) in table.columns.iter().zip(row).enumerate() {
                                @if index == 0 {
                                    th scope="row" class=(classes(column, cell)) {
                                        (content(column, cell))
                                    }
                                } @else {
                                    td class=(classes(column, cell)) { (content(column, cell)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The headings: one row, or two where columns are grouped.
fn head(columns: &[PrintedColumn]) -> Markup {
    let grouped = columns.iter().any(|c| c.group.is_some());
    let heading = |column: &PrintedColumn| {
        html! {
            (column.title)
            @if let Some(unit) = &column.unit { " " span.unit { "[" (unit) "]" } }
        }
    };
    html! {
        thead {
            @if grouped {
                tr {
                    @for run in columns.chunk_by(|a, b| a.group.is_some() && a.group == b.group) {
                        @for column in run.iter().take(1) {
                            @if let Some(group) = &column.group {
                                th.group scope="colgroup" colspan=(run.len()) { (group) }
                            } @else {
                                th scope="col" rowspan="2" class=(align(column)) {
                                    (heading(column))
                                }
                            }
                        }
                    }
                }
            }
            tr {
                @for column in columns.iter().filter(|c| !grouped || c.group.is_some()) {
                    th scope="col" class=(align(column)) { (heading(column)) }
                }
            }
        }
    }
}

fn align(column: &PrintedColumn) -> &'static str {
    match column.align {
        Align::Left => "left",
        Align::Right => "right",
    }
}

fn classes(column: &PrintedColumn, cell: &Cell) -> String {
    let mut classes = align(column).to_owned();
    if matches!(cell.value, Value::Number { .. }) {
        classes.push_str(" number");
    }
    if let (Value::Text(text), ColumnKind::Text) = (&cell.value, &column.kind) {
        match text.to_plain().chars().count() {
            0..=40 => {}
            41..=120 => classes.push_str(" wide"),
            _ => classes.push_str(" widest"),
        }
    }
    if cell.subject {
        classes.push_str(" subject");
    }
    classes
}

fn content(column: &PrintedColumn, cell: &Cell) -> Markup {
    match &cell.value {
        Value::Text(text) if column.kind == ColumnKind::Code => {
            let text = text.to_plain();
            // Commands may be broken at their spaces, names not.
            let long = text.chars().count() > 36;
            html! { code.long[long] { (text) } }
        }
        Value::Text(text) => inline(text),
        Value::Number { value, .. } if value.is_finite() => {
            html! { span title={ (format!("{value:?}")) } { (cell.to_plain()) } }
        }
        Value::Number { .. } => html! { span.not-finite { (cell.to_plain()) } },
        Value::Missing { reason } => html! {
            span.missing { "not measured" span.reason { (reason) } }
        },
        Value::Verdict { verdict, label } => html! {
            span class={ "badge " (verdict.word().replace(' ', "-")) } {
                span.mark aria-hidden="true" { (mark(*verdict)) }
                (verdict.shown(label.as_deref()))
            }
        },
        Value::Link { text, href } => html! { a href=(safe(href)) { (text) } },
    }
}

/// A sign beside the word, so that colour is not the only cue.
fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓",
        Verdict::Warn => "!",
        Verdict::Fail => "✗",
        Verdict::NotMeasured => "–",
    }
}
