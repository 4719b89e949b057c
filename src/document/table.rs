//! Tables and their columns.

use serde::Serialize;

use super::cell::Cell;
use super::inline::Inline;

/// A table. Every row has one cell per column; the first column heads its row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// What is tabulated, and over which points.
    pub caption: Inline,
    /// Columns, in order.
    pub columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new(caption: impl Into<Inline>, columns: Vec<Column>) -> Self {
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// A table of words and numbers: title and unit per column, an empty unit for words.
    pub fn of_rows<T: Into<String>>(
        caption: impl Into<Inline>,
        columns: impl IntoIterator<Item = (T, &'static str)>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        let columns = columns.into_iter().map(|(title, unit)| match unit {
            "" => Column::text(title),
            unit => Column::number(title, unit),
        });
        let mut table = Self::new(caption, columns.collect());
        rows.into_iter().for_each(|row| table.push(row));
        table
    }

    /// Rows, in order; each has one cell per column.
    #[must_use]
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Adds a row. A short row is filled with `not measured: no value given`, so that an omission
    /// shows; cells beyond the last column are left out.
    pub fn push(&mut self, mut row: Vec<Cell>) {
        row.resize_with(self.columns.len(), || Cell::missing("no value given"));
        self.rows.push(row);
    }
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Heading.
    pub title: String,
    /// What it shares with its neighbours of the same group, as in a region; shown once above them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Unit, `1` for a pure number; absent where a unit means nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Where cells stand.
    pub align: Align,
    /// What the cells are.
    pub kind: ColumnKind,
}

impl Column {
    /// A column of words.
    pub fn text(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            group: None,
            unit: None,
            align: Align::Left,
            kind: ColumnKind::Text,
        }
    }

    /// A column of identifiers, commands or constants as programs print them.
    pub fn code(title: impl Into<String>) -> Self {
        Self { kind: ColumnKind::Code, ..Self::text(title) }
    }

    /// A column of numbers in `unit`.
    pub fn number(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            unit: Some(unit.into()),
            align: Align::Right,
            kind: ColumnKind::Number,
            ..Self::text(title)
        }
    }

    /// A column of verdicts.
    pub fn verdict(title: impl Into<String>) -> Self {
        Self { kind: ColumnKind::Verdict, ..Self::text(title) }
    }

    /// The column with its cells elsewhere.
    #[must_use]
    pub fn aligned(mut self, align: Align) -> Self {
        self.align = align;
        self
    }

    /// The column under a heading that it shares with neighbours of the same group.
    #[must_use]
    pub fn grouped(mut self, group: impl Into<String>) -> Self {
        self.group = Some(group.into());
        self
    }

    /// Group, title and unit, as in `scene: max |error| [1]`.
    #[must_use]
    pub fn heading(&self) -> String {
        let group = self.group.as_ref().map(|g| format!("{g}: ")).unwrap_or_default();
        let unit = self.unit.as_ref().map(|u| format!(" [{u}]")).unwrap_or_default();
        format!("{group}{}{unit}", self.title)
    }
}

/// Where the cells of a column stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Align {
    /// At the left.
    Left,
    /// In the middle.
    Centre,
    /// At the right.
    Right,
}

/// What the cells of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ColumnKind {
    /// Words.
    Text,
    /// Identifiers, commands.
    Code,
    /// Numbers.
    Number,
    /// Verdicts.
    Verdict,
}
