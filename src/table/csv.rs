//! Tables as CSV.
//!
//! A header of `name [unit]` cells (`name` alone is a pure number), one row per line, commas
//! between. `u(name) [unit]` holds the standard uncertainty of `name`, in any unit of the same
//! dimension. Lines that begin with `#` are comments. Numbers are written with the fewest digits
//! that read back exactly.

use std::path::Path;

use ::csv::{ReaderBuilder, StringRecord, Trim};

use super::{Column, Table, TableError, store, units};

/// What to let through when reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// Accept NaN and infinities, as evaluating a reference at them needs.
    pub allow_non_finite: bool,
}

/// A header cell taken apart.
struct Header {
    name: String,
    unit: String,
    is_uncertainty: bool,
}

impl Header {
    /// The name as written: `u(name)` for an uncertainty.
    fn label(&self) -> String {
        if self.is_uncertainty { format!("u({})", self.name) } else { self.name.clone() }
    }
}

impl Table {
    /// Reads a CSV file of finite numbers. The origin is the file with its SHA-256.
    ///
    /// # Errors
    /// [`TableError`] naming file, line and column.
    pub fn read_csv(path: impl AsRef<Path>) -> Result<Self, TableError> {
        Self::read_csv_with(path, ReadOptions::default())
    }

    /// As [`Table::read_csv`], with options.
    ///
    /// # Errors
    /// As [`Table::read_csv`].
    pub fn read_csv_with(path: impl AsRef<Path>, options: ReadOptions) -> Result<Self, TableError> {
        let path = path.as_ref();
        let bytes = store::read(path)?;
        let origin = path.display().to_string();
        let mut table = Self::parse_csv(&origin, store::text(&origin, &bytes)?, options)?;
        table.origin = store::origin(path, &bytes);
        Ok(table)
    }

    /// Reads CSV text; `origin` names it in messages and becomes the table's origin.
    ///
    /// # Errors
    /// As [`Table::read_csv`].
    pub fn read_csv_str(origin: &str, text: &str) -> Result<Self, TableError> {
        Self::parse_csv(origin, text, ReadOptions::default())
    }

    /// As [`Table::read_csv_str`], with options.
    ///
    /// # Errors
    /// As [`Table::read_csv`].
    pub fn parse_csv(origin: &str, text: &str, options: ReadOptions) -> Result<Self, TableError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(text.as_bytes());
        let mut records = reader.records();
        let empty = |what| TableError::Empty { origin: origin.into(), what };
        let Some(first) = records.next() else { return Err(empty("no header")) };
        let first = first.map_err(|e| malformed(origin, &e))?;
        let headers = parse_header(origin, line_of(text, &first), &first)?;

        let mut cells: Vec<Vec<f64>> = vec![Vec::new(); headers.len()];
        for (index, record) in records.enumerate() {
            let record = record.map_err(|e| malformed(origin, &e))?;
            let place = Place { origin, line: line_of(text, &record), row: index + 1, text };
            place.read_row(&record, &headers, &mut cells, options)?;
        }
        if cells.first().is_none_or(Vec::is_empty) {
            return Err(empty("no rows under the header"));
        }
        assemble(origin, headers, cells)
    }

    /// The table as CSV text, `notes` first as comment lines.
    ///
    /// # Errors
    /// As [`Table::check`].
    pub fn to_csv(&self, notes: &[String]) -> Result<String, TableError> {
        self.check()?;
        let mut out = String::new();
        for line in notes.iter().flat_map(|note| note.lines()) {
            out.push_str(&format!("# {line}\n"));
        }
        let cells = self.columns.iter().flat_map(|c| {
            let uncertainty = c.uncertainty.as_ref().map(|_| format!("u({})", c.name));
            std::iter::once(c.name.clone()).chain(uncertainty).map(|name| match c.unit.as_str() {
                "1" => quoted(&name),
                unit => quoted(&format!("{name} [{unit}]")),
            })
        });
        out.push_str(&cells.collect::<Vec<_>>().join(","));
        out.push('\n');
        for row in 0..self.rows() {
            let values = self.columns.iter().flat_map(|c| {
                std::iter::once(c.values.get(row))
                    .chain(c.uncertainty.as_ref().map(|u| u.get(row)))
                    .flatten()
            });
            out.push_str(&values.map(|v| shortest_number(*v)).collect::<Vec<_>>().join(","));
            out.push('\n');
        }
        Ok(out)
    }

    /// Writes the table as CSV, whole or not at all ([`store::atomic_write`]).
    ///
    /// # Errors
    /// As [`Table::check`] and [`store::atomic_write`].
    pub fn write_csv(&self, path: impl AsRef<Path>, notes: &[String]) -> Result<(), TableError> {
        store::atomic_write(path.as_ref(), self.to_csv(notes)?.as_bytes())
    }
}

/// `value` in the fewest digits that read back exactly: `1.5`, `2`, `1e-9`, `NaN`, `inf`.
pub fn shortest_number(value: f64) -> String {
    let mut text = format!("{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}

/// Why `name` cannot be a column's name, if it cannot.
pub(super) fn name_fault(name: &str) -> Option<&'static str> {
    if name.trim().is_empty() {
        Some("the column has no name")
    } else if name.trim() != name {
        Some("a name does not begin or end with space")
    } else if name.starts_with('#') {
        Some("a name does not begin with #, which begins a comment")
    } else if name.starts_with("u(") && name.ends_with(')') {
        Some("u(…) is kept for uncertainties")
    } else if name.contains(['[', ']', '"']) || name.chars().any(char::is_control) {
        Some("a name holds no brackets, quotes or control characters")
    } else {
        None
    }
}

fn quoted(cell: &str) -> String {
    if cell.contains(',') { format!("\"{cell}\"") } else { cell.into() }
}

/// Line that a record stands on. The reader's own position is before any comments and blank lines
/// above the record.
fn line_of(text: &str, record: &StringRecord) -> u64 {
    let Some(position) = record.position() else { return 1 };
    let mut line = position.line();
    let mut rest = text.as_bytes().get(position.byte() as usize..).unwrap_or_default();
    loop {
        rest = match rest {
            [b'\n', after @ ..] => {
                line += 1;
                after
            }
            [b'\r', after @ ..] => after,
            [b'#', ..] => {
                let end = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
                rest.get(end..).unwrap_or_default()
            }
            _ => return line,
        }
    }
}

fn malformed(origin: &str, error: &::csv::Error) -> TableError {
    let line = error.position().map_or(String::new(), |p| format!(":{}", p.line()));
    TableError::Malformed { origin: format!("{origin}{line}"), reason: error.to_string() }
}

fn parse_header(origin: &str, line: u64, record: &StringRecord) -> Result<Vec<Header>, TableError> {
    let mut headers: Vec<Header> = Vec::with_capacity(record.len());
    for (i, cell) in record.iter().enumerate() {
        let header = parse_header_cell(cell).map_err(|reason| TableError::Header {
            origin: origin.into(),
            line,
            position: i + 1,
            header: cell.into(),
            reason,
        })?;
        units::require(&header.unit, origin, &header.name)?;
        let same = |h: &Header| h.name == header.name && h.is_uncertainty == header.is_uncertainty;
        if headers.iter().any(same) {
            return Err(TableError::DuplicateColumn {
                origin: origin.into(),
                line,
                name: header.label(),
            });
        }
        headers.push(header);
    }
    Ok(headers)
}

fn parse_header_cell(cell: &str) -> Result<Header, &'static str> {
    let (label, unit) = match cell.split_once('[') {
        None => (cell, "1"),
        Some((label, rest)) => {
            (label, rest.strip_suffix(']').ok_or("the unit's bracket is not closed at the end")?)
        }
    };
    let label = label.trim();
    let inner = label.strip_prefix("u(").and_then(|l| l.strip_suffix(')'));
    let name = inner.unwrap_or(label).trim();
    match name_fault(name) {
        Some(reason) => Err(reason),
        None => Ok(Header {
            name: name.into(),
            unit: unit.trim().into(),
            is_uncertainty: inner.is_some(),
        }),
    }
}

/// Where a row stands, for messages.
struct Place<'a> {
    origin: &'a str,
    line: u64,
    row: usize,
    text: &'a str,
}

impl Place<'_> {
    fn read_row(
        &self,
        record: &StringRecord,
        headers: &[Header],
        cells: &mut [Vec<f64>],
        options: ReadOptions,
    ) -> Result<(), TableError> {
        if record.len() != headers.len() {
            let at_end = record.position().is_some_and(|p| {
                let rest = self.text.as_bytes().get(p.byte() as usize..).unwrap_or_default();
                !rest.contains(&b'\n')
            });
            return Err(TableError::RaggedRow {
                origin: self.origin.into(),
                line: self.line,
                row: self.row,
                expected: headers.len(),
                got: record.len(),
                hint: if at_end { "; the file ends here, it may be truncated" } else { "" },
            });
        }
        for ((cell, header), values) in record.iter().zip(headers).zip(cells) {
            values.push(self.read_cell(cell, header, options)?);
        }
        Ok(())
    }

    fn read_cell(
        &self,
        cell: &str,
        header: &Header,
        options: ReadOptions,
    ) -> Result<f64, TableError> {
        let value: f64 = cell.parse().map_err(|_| TableError::NotANumber {
            origin: self.origin.into(),
            line: self.line,
            row: self.row,
            column: header.label(),
            got: cell.into(),
        })?;
        if !value.is_finite() && !options.allow_non_finite {
            return Err(TableError::NonFinite {
                origin: format!("{}:{}", self.origin, self.line),
                row: self.row.to_string(),
                column: header.label(),
                got: value,
            });
        }
        if header.is_uncertainty && value < 0.0 {
            return Err(TableError::NegativeUncertainty {
                origin: self.origin.into(),
                line: self.line,
                row: self.row,
                column: header.name.clone(),
                got: value,
            });
        }
        Ok(value)
    }
}

/// Joins uncertainties to their columns, converted to the column's unit.
fn assemble(origin: &str, headers: Vec<Header>, cells: Vec<Vec<f64>>) -> Result<Table, TableError> {
    let (uncertain, plain): (Vec<_>, Vec<_>) =
        headers.into_iter().zip(cells).partition(|(h, _)| h.is_uncertainty);
    let mut columns: Vec<Column> =
        plain.into_iter().map(|(h, values)| Column::new(h.name, h.unit, values)).collect();
    for (header, values) in uncertain {
        let Some(column) = columns.iter_mut().find(|c| c.name == header.name) else {
            return Err(TableError::OrphanUncertainty {
                origin: origin.into(),
                column: header.name,
            });
        };
        let factor = units::conversion(&header.unit, &column.unit, origin, &header.label())?;
        column.uncertainty = Some(values.into_iter().map(|v| v * factor).collect());
    }
    Ok(Table { columns, origin: origin.into() })
}
