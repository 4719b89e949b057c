//! The report as plain text.

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{CellAlignment, ContentArrangement};

use super::cell::Highlight;
use super::{Align, Block, Page, Provenance, Table};

/// Columns that running text is broken to.
const COLUMNS: usize = 100;

/// Every page, one after the other, with the provenance at the end.
#[must_use]
pub fn report(pages: &[Page], provenance: &Provenance) -> String {
    let mut out = String::new();
    for page in pages {
        heading(&page.title, '=', &mut out);
        paragraph(&page.summary.to_plain(), "", &mut out);
        for section in &page.sections {
            heading(&section.title, '-', &mut out);
            for block in &section.blocks {
                write(block, &mut out);
            }
        }
    }
    heading("Provenance", '-', &mut out);
    for (name, value) in provenance.lines() {
        out.push_str(&format!("{name}: {value}\n"));
    }
    out
}

/// A table with its caption.
#[must_use]
pub fn table(table: &Table) -> String {
    let mut shown = comfy_table::Table::new();
    shown.load_style(ASCII_MARKDOWN).set_content_arrangement(ContentArrangement::Disabled);
    shown.set_header(table.columns.iter().map(|c| c.heading()));
    for row in table.rows() {
        shown.add_row(row.iter().map(|cell| {
            let mark = match cell.highlight {
                Some(Highlight::Best) => " *",
                Some(Highlight::Worst) => " !",
                Some(Highlight::Subject) => " <",
                None => "",
            };
            cell.to_plain() + mark
        }));
    }
    for (index, column) in table.columns.iter().enumerate() {
        if let Some(shown) = shown.column_mut(index) {
            shown.set_cell_alignment(match column.align {
                Align::Left => CellAlignment::Left,
                Align::Centre => CellAlignment::Center,
                Align::Right => CellAlignment::Right,
            });
        }
    }
    let nothing = if table.rows().is_empty() { "nothing to show\n" } else { "" };
    format!("{}\n{shown}\n{nothing}", table.caption.to_plain())
}

fn heading(title: &str, rule: char, out: &mut String) {
    if !out.is_empty() {
        out.push('\n');
    }
    out.push_str(title);
    out.push('\n');
    out.extend(std::iter::repeat_n(rule, title.chars().count()));
    out.push_str("\n\n");
}

fn write(block: &Block, out: &mut String) {
    match block {
        Block::Paragraph(text) => paragraph(&text.to_plain(), "", out),
        Block::List(items) => {
            for item in items {
                paragraph(&item.to_plain(), "- ", out);
                // Items stand on consecutive lines.
                out.pop();
            }
            out.push('\n');
        }
        Block::Table(one) => {
            out.push_str(&table(one));
            out.push('\n');
        }
        Block::Figure(figure) => {
            let text =
                format!("[figure figures/{}.svg] {}", figure.file_stem, figure.caption.to_plain());
            paragraph(&text, "", out);
        }
        Block::Picture(picture) => {
            let (stem, caption) = (&picture.file_stem, picture.caption.to_plain());
            paragraph(&format!("[picture figures/{stem}.png] {caption}"), "", out);
        }
        Block::Code { text, .. } => {
            for line in text.lines() {
                out.push_str(format!("    {line}").trim_end());
                out.push('\n');
            }
            out.push('\n');
        }
        Block::Notice { level, text } => {
            paragraph(&format!("{}: {}", level.word().to_uppercase(), text.to_plain()), "", out);
        }
        Block::Details { summary, blocks } => {
            paragraph(&summary.to_plain(), "", out);
            for block in blocks {
                write(block, out);
            }
        }
    }
}

/// Breaks `text` into lines, the first led by `lead`, the others by as many spaces.
fn paragraph(text: &str, lead: &str, out: &mut String) {
    let mut line = lead.to_owned();
    let mut empty = true;
    for word in text.split_whitespace() {
        if !empty && line.chars().count() + 1 + word.chars().count() > COLUMNS {
            out.push_str(&line);
            out.push('\n');
            line = " ".repeat(lead.len());
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    out.push_str(&line);
    out.push_str("\n\n");
}
