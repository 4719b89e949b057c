//! What is shown to a reader: sections of paragraphs, tables, figures and notices, as data.
//!
//! Verbs, effects and reports build sections; [`text`] prints them, [`json`] and
//! [`report::html`](crate::report::html) write whole reports. The model says what is meant and
//! nothing about looks. A value that was not measured is a [`Missing`](cell::Value) cell with its
//! reason: it is never a number, a blank or a pass.
//!
//! ```
//! use striae::document::text::{self, Layout};
//! use striae::document::{PrintedTable, Section, Verdict};
//!
//! let costs = PrintedTable::over("Cost on the device.", [("published", 0.51234), ("refitted", 0.5)])
//!     .code("form", |(form, _)| *form)
//!     .number("cost", "ns", |(_, cost)| *cost)
//!     .verdict("gate", |(_, cost)| if *cost <= 0.51 { Verdict::Pass } else { Verdict::Fail });
//! let section = Section::new("Costs").paragraph("Medians of `striae bench`.").block(costs);
//! assert_eq!(
//!     text::sections(&[section], Layout::default()),
//!     "\
//! Costs
//! -----
//!
//! Medians of striae bench.
//!
//! Cost on the device.
//!  form        cost [ns]   gate
//! ──────────────────────────────
//!  published       0.512   FAIL
//!  refitted          0.5   pass
//! "
//! );
//! ```

pub mod cell;
pub mod inline;
pub mod json;
pub mod plot;
pub mod table;
pub mod text;
pub(crate) mod thin;

use serde::{Serialize, Serializer};

pub use cell::{Cell, Value, Verdict, number, place};
pub use inline::{Inline, Span};
use plot::Plot;
pub use table::{Align, ColumnKind, PrintedColumn, PrintedTable, Tabled};

/// One page: `<slug>.html`. The page with the slug `index` leads, and lists the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Page {
    /// File name without extension: lower-case letters, digits, `-` and `_`.
    pub slug: String,
    /// Heading.
    pub title: String,
    /// What the page is about, in a sentence or two; also shown beside its link on the index.
    pub summary: Inline,
    /// Its sections, in order.
    pub sections: Vec<Section>,
}

impl Page {
    /// A page without sections.
    pub fn new(
        slug: impl Into<String>,
        title: impl Into<String>,
        summary: impl Into<Inline>,
    ) -> Self {
        Self {
            slug: slug.into(),
            title: title.into(),
            summary: summary.into(),
            sections: Vec::new(),
        }
    }

    /// The page with one more section.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// Its blocks, in order, those inside [`Block::Details`] after their summary.
    #[must_use]
    pub fn blocks(&self) -> Vec<&Block> {
        fn collect<'a>(blocks: &'a [Block], into: &mut Vec<&'a Block>) {
            for block in blocks {
                into.push(block);
                if let Block::Details { blocks, .. } = block {
                    collect(blocks, into);
                }
            }
        }
        let mut all = Vec::new();
        self.sections.iter().for_each(|section| collect(&section.blocks, &mut all));
        all
    }

    /// Its pictures, in order.
    pub fn pictures(&self) -> impl Iterator<Item = &Raster> {
        self.blocks().into_iter().filter_map(|block| match block {
            Block::Picture(picture) => Some(picture),
            _ => None,
        })
    }

    /// Its figures, in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.blocks().into_iter().filter_map(|block| match block {
            Block::Figure(figure) => Some(figure),
            _ => None,
        })
    }
}

/// A part of a page, with a heading of its own and an entry in the page's contents.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Section {
    /// Heading; text shows none where it is empty.
    pub title: String,
    /// What it holds, in order.
    pub blocks: Vec<Block>,
}

impl Section {
    /// An empty section.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), blocks: Vec::new() }
    }

    /// The section with one more block.
    #[must_use]
    pub fn block(mut self, block: impl Into<Block>) -> Self {
        self.blocks.push(block.into());
        self
    }

    /// The section with more blocks.
    #[must_use]
    pub fn blocks<B: Into<Block>>(mut self, blocks: impl IntoIterator<Item = B>) -> Self {
        self.blocks.extend(blocks.into_iter().map(Into::into));
        self
    }

    /// The section with one more paragraph.
    #[must_use]
    pub fn paragraph(self, text: impl Into<Inline>) -> Self {
        self.block(Block::Paragraph(text.into()))
    }

    /// The section with one more bulleted list.
    #[must_use]
    pub fn list<I: Into<Inline>>(self, items: impl IntoIterator<Item = I>) -> Self {
        self.block(Block::List(items.into_iter().map(Into::into).collect()))
    }

    /// The section with one more table, shown on demand under `summary`.
    #[must_use]
    pub fn details(self, summary: impl Into<Inline>, table: impl Into<Block>) -> Self {
        self.block(Block::Details { summary: summary.into(), blocks: vec![table.into()] })
    }

    /// The section with one more remark that must not be overlooked.
    #[must_use]
    pub fn notice(self, level: NoticeLevel, text: impl Into<Inline>) -> Self {
        self.block(Block::Notice { level, text: text.into() })
    }
}

/// A piece of a section.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "block", content = "content", rename_all = "snake_case")]
pub enum Block {
    /// Running text.
    Paragraph(Inline),
    /// A bulleted list.
    List(Vec<Inline>),
    /// A table.
    Table(PrintedTable),
    /// One or more plots under one caption.
    Figure(Figure),
    /// An image.
    Picture(Raster),
    /// A remark that must not be overlooked.
    Notice {
        /// What kind of remark.
        level: NoticeLevel,
        /// The remark.
        text: Inline,
    },
    /// Blocks shown on demand: long tables that few readers need.
    Details {
        /// What is inside.
        summary: Inline,
        /// The blocks.
        blocks: Vec<Block>,
    },
}

impl From<PrintedTable> for Block {
    fn from(table: PrintedTable) -> Self {
        Self::Table(table)
    }
}

impl<R> From<Tabled<R>> for Block {
    fn from(table: Tabled<R>) -> Self {
        Self::Table(table.table())
    }
}

impl From<Raster> for Block {
    fn from(picture: Raster) -> Self {
        Self::Picture(picture)
    }
}

impl From<Figure> for Block {
    fn from(figure: Figure) -> Self {
        Self::Figure(figure)
    }
}

/// What kind of remark a notice is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoticeLevel {
    /// Worth knowing.
    Info,
    /// Something is close to its limit, or unusual.
    Warning,
    /// Something is wrong.
    Failure,
    /// Something was not measured, and why.
    NotMeasured,
}

impl NoticeLevel {
    /// The word that opens the notice.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Info => "note",
            Self::Warning => "warning",
            Self::Failure => "failure",
            Self::NotMeasured => "not measured",
        }
    }
}

/// Plots under one caption, drawn as one SVG with one legend: `figures/<file_stem>.svg`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// What is shown and what to see in it.
    pub caption: Inline,
    /// File name without extension, unique in the report: lower-case letters, digits, `-`, `_`.
    pub file_stem: String,
    /// The plots, row by row. A series of the same name looks the same in all of them.
    pub plots: Vec<Plot>,
    /// Plots per row, from 1 to 4.
    pub per_row: usize,
}

impl Figure {
    /// A figure of one plot.
    pub fn new(file_stem: impl Into<String>, caption: impl Into<Inline>, plot: Plot) -> Self {
        Self::grid(file_stem, caption, vec![plot], 1)
    }

    /// Small multiples, `per_row` plots in a row.
    pub fn grid(
        file_stem: impl Into<String>,
        caption: impl Into<Inline>,
        plots: Vec<Plot>,
        per_row: usize,
    ) -> Self {
        Self { caption: caption.into(), file_stem: file_stem.into(), plots, per_row }
    }
}

/// An image under a caption: `figures/<file_stem>.png`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Raster {
    /// What is shown and what to see in it.
    pub caption: Inline,
    /// File name without extension, unique in the report: lower-case letters, digits, `-`, `_`.
    pub file_stem: String,
    /// What is to be seen, for those who cannot see it.
    pub alt: String,
    /// The PNG file.
    #[serde(skip)]
    pub png: Vec<u8>,
}

/// Where a report comes from: in the footer of every page and at the head of the JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Colophon {
    /// Version of striae.
    pub version: String,
    /// Adapter, driver and backend; absent when no device was measured.
    #[serde(serialize_with = "or_not_measured")]
    pub adapter: Option<String>,
    /// The command that regenerates the report.
    pub command: String,
}

impl Colophon {
    /// Every fact in words: name and value, in order.
    #[must_use]
    pub fn lines(&self) -> [(&str, &str); 3] {
        [("striae", &self.version), ("adapter", shown(&self.adapter)), ("command", &self.command)]
    }
}

/// The adapter, or that there was none.
fn shown(adapter: &Option<String>) -> &str {
    adapter.as_deref().unwrap_or("not measured: no adapter found")
}

fn or_not_measured<S: Serializer>(adapter: &Option<String>, to: S) -> Result<S::Ok, S::Error> {
    shown(adapter).serialize(to)
}
