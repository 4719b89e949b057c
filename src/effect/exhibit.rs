//! The text of an exhibit: its prose, captions, axes and columns stand in `exhibits.toml` beside the
//! code, which draws the curves and fills the rows.

use std::collections::BTreeMap;
use std::vec::IntoIter;

use serde::Deserialize;

use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedTable, Section};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExhibitText {
    title: String,
    paragraphs: Vec<String>,
    /// Of the figures that have none of their own.
    #[serde(default)]
    caption: String,
    #[serde(default)]
    figure: Vec<FigureText>,
    #[serde(default)]
    table: Vec<TableText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FigureText {
    stem: String,
    caption: Option<String>,
    title: String,
    x: PlotAxis,
    y: PlotAxis,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TableText {
    caption: String,
    /// Title and unit of each, an empty unit for words.
    columns: Vec<(String, String)>,
}

/// A section in the making: what the text says of its figures and tables, in order.
#[derive(Debug)]
pub(crate) struct Exhibit {
    section: Section,
    caption: String,
    figures: IntoIter<FigureText>,
    tables: IntoIter<TableText>,
}

/// Texts are built in: a fault in one of them is a fault of the program, which a test rules out.
impl Exhibit {
    /// The text called `name` of `texts`, with `values` for what it has in braces.
    pub(crate) fn of(texts: &str, name: &str, values: &[(&str, String)]) -> Self {
        let filled = |text: String, (name, value): &(&str, String)| {
            text.replace(&format!("{{{name}}}"), value)
        };
        let texts = values.iter().fold(texts.to_owned(), filled);
        let mut texts: BTreeMap<String, ExhibitText> =
            toml::from_str(&texts).unwrap_or_else(|error| panic!("exhibits.toml: {error}"));
        let text = texts.remove(name).unwrap_or_else(|| panic!("there is no exhibit `{name}`"));
        let paragraphs = text.paragraphs.into_iter();
        Self {
            section: paragraphs.fold(Section::new(text.title), Section::paragraph),
            caption: text.caption,
            figures: text.figure.into_iter(),
            tables: text.table.into_iter(),
        }
    }

    /// With the curves of the next figure.
    pub(crate) fn figure(mut self, curves: impl IntoIterator<Item = Series>) -> Self {
        let text = self.figures.next().expect("the text of a figure");
        let plot = Plot::new(text.title, text.x, text.y);
        let plot = curves.into_iter().fold(plot, Plot::series);
        let caption = text.caption.unwrap_or_else(|| self.caption.clone());
        self.section = self.section.block(Figure::new(text.stem, caption, plot));
        self
    }

    /// With the rows of the next table.
    pub(crate) fn table(self, rows: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        self.wider_table([], rows)
    }

    /// With the rows of the next table, which has more columns of numbers than the text says.
    pub(crate) fn wider_table(
        mut self,
        more: impl IntoIterator<Item = (String, String)>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        let text = self.tables.next().expect("the text of a table");
        let columns = text.columns.into_iter().chain(more);
        self.section = self.section.block(PrintedTable::of_rows(text.caption, columns, rows));
        self
    }

    /// The section, once all that its text speaks of is there.
    pub(crate) fn section(self) -> Section {
        assert!(
            self.figures.len() == 0 && self.tables.len() == 0,
            "{} is not complete",
            self.section.title
        );
        self.section
    }
}
