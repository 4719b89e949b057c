//! Tables and their columns.

use serde::Serialize;

use super::cell::Cell;
use super::inline::Inline;

/// A table. Every row has one cell per column; the first column heads its row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PrintedTable {
    /// What is tabulated, and over which points.
    pub caption: Inline,
    /// Columns, in order.
    pub columns: Vec<PrintedColumn>,
    rows: Vec<Vec<Cell>>,
}

impl PrintedTable {
    /// A table without rows.
    pub fn new(caption: impl Into<Inline>, columns: Vec<PrintedColumn>) -> Self {
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// A table with a row per record; [`Tabled::column`] says what is shown of each.
    ///
    /// ```
    /// use striae::document::PrintedTable;
    /// let table = PrintedTable::over("Squares.", [1.0, 2.0, 3.0])
    ///     .number("x", "1", |x| (*x, 2))
    ///     .number("x²", "1", |x| (x * x, 2))
    ///     .table();
    /// assert_eq!(table.rows().len(), 3);
    /// ```
    pub fn over<R>(caption: impl Into<Inline>, records: impl IntoIterator<Item = R>) -> Tabled<R> {
        let records: Vec<R> = records.into_iter().collect();
        let rows = records.iter().map(|_| Vec::new()).collect();
        Tabled { table: Self { caption: caption.into(), columns: Vec::new(), rows }, records }
    }

    /// A table of words and numbers: title and unit per column, an empty unit for words.
    pub fn of_rows<T: Into<String>, U: Into<String>>(
        caption: impl Into<Inline>,
        columns: impl IntoIterator<Item = (T, U)>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        let columns = columns.into_iter().map(|(title, unit)| match unit.into() {
            unit if unit.is_empty() => PrintedColumn::text(title),
            unit => PrintedColumn::number(title, unit),
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

/// A table in the making: a row per record, growing column by column.
#[derive(Debug, Clone)]
pub struct Tabled<R> {
    table: PrintedTable,
    records: Vec<R>,
}

impl<R> Tabled<R> {
    /// One more column, and what it shows of a record.
    #[must_use]
    pub fn column<C: Into<Cell>>(mut self, column: PrintedColumn, cell: impl Fn(&R) -> C) -> Self {
        self.table.columns.push(column);
        for (row, record) in self.table.rows.iter_mut().zip(&self.records) {
            row.push(cell(record).into());
        }
        self
    }

    /// One more column of words.
    #[must_use]
    pub fn text<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(&R) -> C) -> Self {
        self.column(PrintedColumn::text(title), cell)
    }

    /// One more column of identifiers.
    #[must_use]
    pub fn code<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(&R) -> C) -> Self {
        self.column(PrintedColumn::code(title), cell)
    }

    /// One more column of numbers in `unit`.
    #[must_use]
    pub fn number<C: Into<Cell>>(
        self,
        title: impl Into<String>,
        unit: impl Into<String>,
        cell: impl Fn(&R) -> C,
    ) -> Self {
        self.column(PrintedColumn::number(title, unit), cell)
    }

    /// One more column of numbers whose unit is the row's, or stands in the heading.
    #[must_use]
    pub fn figures<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(&R) -> C) -> Self {
        self.column(PrintedColumn::figures(title), cell)
    }

    /// One more column of verdicts.
    #[must_use]
    pub fn verdict<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(&R) -> C) -> Self {
        self.column(PrintedColumn::verdict(title), cell)
    }

    /// One more column per item, and what each shows of a record.
    #[must_use]
    pub fn columns<I, C: Into<Cell>>(
        self,
        items: impl IntoIterator<Item = I>,
        column: impl Fn(&I) -> PrintedColumn,
        cell: impl Fn(&R, &I) -> C,
    ) -> Self {
        items
            .into_iter()
            .fold(self, |table, item| table.column(column(&item), |record| cell(record, &item)))
    }

    /// The rows of the records that the text is about, standing out.
    #[must_use]
    pub fn subject(mut self, which: impl Fn(&R) -> bool) -> Self {
        let rows = self.table.rows.iter_mut().zip(&self.records);
        for (row, _) in rows.filter(|(_, record)| which(record)) {
            row.iter_mut().for_each(|cell| cell.subject = true);
        }
        self
    }

    /// The table.
    #[must_use]
    pub fn table(self) -> PrintedTable {
        self.table
    }
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PrintedColumn {
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

impl PrintedColumn {
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
        Self { unit: Some(unit.into()), ..Self::figures(title) }
    }

    /// A column of numbers whose unit is the row's, or stands in the heading.
    pub fn figures(title: impl Into<String>) -> Self {
        Self { align: Align::Right, kind: ColumnKind::Number, ..Self::text(title) }
    }

    /// A column of verdicts.
    pub fn verdict(title: impl Into<String>) -> Self {
        Self { kind: ColumnKind::Verdict, ..Self::text(title) }
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
