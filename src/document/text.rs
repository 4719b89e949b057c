//! Sections as plain text: for a terminal, a pipe, or the report's `report.txt`.

use comfy_table::{Attribute, CellAlignment, Color, ContentArrangement, LineStyle, TableStyle};

use super::cell::{Value, Verdict};
use super::{Align, Block, Cell, Colophon, Page, PrintedTable, Section};

/// A rule under the header and nothing else, so that a table can be read, searched and pasted.
const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// Columns to which running text is broken where a person reads it.
const READABLE: u16 = 100;

/// How text is laid out. By default nothing is broken into lines and nothing is coloured, so that
/// it can be searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Layout {
    /// Columns that a table is fitted into, by breaking its cells.
    pub table_width: Option<u16>,
    /// Columns that running text is broken to.
    pub text_width: Option<u16>,
    /// Whether headings and verdicts are set off with ANSI escapes.
    pub colour: bool,
}

impl Layout {
    /// For a terminal of `width` columns; running text keeps to a readable width.
    #[must_use]
    pub fn terminal(width: u16, colour: bool) -> Self {
        Self { table_width: Some(width), text_width: Some(width.min(READABLE)), colour }
    }
}

/// Sections one after the other, each under its title.
#[must_use]
pub fn sections(sections: &[Section], layout: Layout) -> String {
    let mut printer = Printer { layout, out: String::new() };
    sections.iter().for_each(|section| printer.section(section));
    printer.out
}

/// The report: every page, one after the other, with the provenance at the end.
#[must_use]
pub fn report(pages: &[Page], provenance: &Colophon) -> String {
    let layout = Layout { text_width: Some(READABLE), ..Layout::default() };
    let mut printer = Printer { layout, out: String::new() };
    for page in pages {
        printer.heading(&page.title, '=');
        printer.paragraph(&page.summary.to_plain());
        page.sections.iter().for_each(|section| printer.section(section));
    }
    printer.heading("Provenance", '-');
    printer.gap();
    for (name, value) in provenance.lines() {
        printer.lines(&format!("{name}: {value}"), "");
    }
    printer.out
}

struct Printer {
    layout: Layout,
    out: String,
}

impl Printer {
    /// Sets what follows apart from what stands there.
    fn gap(&mut self) {
        if !self.out.is_empty() {
            self.out.push('\n');
        }
    }

    fn heading(&mut self, title: &str, rule: char) {
        self.gap();
        let [on, off] = if self.layout.colour { ["\x1b[1m", "\x1b[0m"] } else { ["", ""] };
        let rule: String = std::iter::repeat_n(rule, title.chars().count()).collect();
        self.out.push_str(&format!("{on}{title}{off}\n{rule}\n"));
    }

    fn section(&mut self, section: &Section) {
        if !section.title.is_empty() {
            self.heading(&section.title, '-');
        }
        section.blocks.iter().for_each(|block| self.block(block));
    }

    fn block(&mut self, block: &Block) {
        match block {
            Block::Paragraph(text) => self.paragraph(&text.to_plain()),
            Block::List(items) => {
                self.gap();
                items.iter().for_each(|item| self.lines(&item.to_plain(), "- "));
            }
            Block::Table(table) => {
                self.gap();
                self.table(table);
            }
            Block::Figure(figure) => {
                let (stem, caption) = (&figure.file_stem, figure.caption.to_plain());
                self.paragraph(&format!("[figure figures/{stem}.svg] {caption}"));
            }
            Block::Picture(picture) => {
                let (stem, caption) = (&picture.file_stem, picture.caption.to_plain());
                self.paragraph(&format!("[picture figures/{stem}.png] {caption}"));
            }
            Block::Notice { level, text } => {
                self.paragraph(&format!("{}: {}", level.word().to_uppercase(), text.to_plain()));
            }
            Block::Details { summary, blocks } => {
                self.paragraph(&summary.to_plain());
                blocks.iter().for_each(|block| self.block(block));
            }
        }
    }

    fn paragraph(&mut self, text: &str) {
        self.gap();
        self.lines(text, "");
    }

    /// `text` in lines of the layout's width, the first led by `lead`, the others by as many
    /// spaces.
    fn lines(&mut self, text: &str, lead: &str) {
        let Some(width) = self.layout.text_width.map(usize::from) else {
            self.out.push_str(&format!("{lead}{text}\n"));
            return;
        };
        let mut line = lead.to_owned();
        let mut empty = true;
        for word in text.split_whitespace() {
            if !empty && line.chars().count() + 1 + word.chars().count() > width {
                self.out.push_str(&line);
                self.out.push('\n');
                line = " ".repeat(lead.len());
                empty = true;
            }
            if !empty {
                line.push(' ');
            }
            line.push_str(word);
            empty = false;
        }
        self.out.push_str(&line);
        self.out.push('\n');
    }

    fn table(&mut self, table: &PrintedTable) {
        let mut shown = comfy_table::Table::new();
        shown.load_style(STYLE);
        if let Some(width) = self.layout.table_width {
            shown.set_content_arrangement(ContentArrangement::Dynamic).set_width(width);
        }
        if self.layout.colour {
            shown.enforce_styling();
        }
        shown.set_header(table.columns.iter().map(|column| column.heading()));
        for row in table.rows() {
            shown.add_row(row.iter().enumerate().map(|(index, cell)| self.cell(index, cell)));
        }
        for (index, column) in table.columns.iter().enumerate() {
            if let Some(shown) = shown.column_mut(index) {
                shown.set_cell_alignment(match column.align {
                    Align::Left => CellAlignment::Left,
                    Align::Right => CellAlignment::Right,
                });
            }
        }
        let caption = table.caption.to_plain();
        if !caption.is_empty() {
            self.lines(&caption, "");
        }
        for line in shown.to_string().lines() {
            self.out.push_str(line.trim_end());
            self.out.push('\n');
        }
        if table.rows().is_empty() {
            self.out.push_str("nothing to show\n");
        }
    }

    fn cell(&self, index: usize, cell: &Cell) -> comfy_table::Cell {
        // Of a whole row that is the subject, the name says so.
        let mark = if cell.subject && index == 0 { " <" } else { "" };
        let verdict = match cell.value {
            Value::Verdict { verdict, .. } => Some(verdict),
            _ => None,
        };
        // Without colours a failure must stand out too.
        let text = match verdict {
            Some(Verdict::Fail) => cell.to_plain().to_uppercase(),
            _ => cell.to_plain(),
        };
        let shown = comfy_table::Cell::new(text + mark);
        match verdict.filter(|_| self.layout.colour) {
            Some(Verdict::Pass) => shown.fg(Color::Green),
            Some(Verdict::Warn) => shown.fg(Color::Yellow),
            Some(Verdict::Fail) => shown.fg(Color::Red).add_attribute(Attribute::Bold),
            Some(Verdict::NotMeasured) => shown.add_attribute(Attribute::Dim),
            None => shown,
        }
    }
}
