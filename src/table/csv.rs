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
        let first = records.next().ok_or_else(|| TableError::content(origin, "no header"))?;
        let first = first.map_err(|e| malformed(origin, &e))?;
        let headers = parse_header(origin, line_of(text, &first), &first)?;

        let mut cells: Vec<Vec<f64>> = vec![Vec::new(); headers.len()];
        for (index, record) in records.enumerate() {
            let record = record.map_err(|e| malformed(origin, &e))?;
            let place = Place { origin, line: line_of(text, &record), row: index + 1 };
            place.read_row(text, &record, &headers, &mut cells, options)?;
        }
        if cells.first().is_none_or(Vec::is_empty) {
            return Err(TableError::content(origin, "no rows under the header"));
        }
        assemble(origin, headers, cells)
    }

    /// The table as CSV text, `notes` first as comment lines.
    ///
    /// # Errors
    /// As [`Table::check`].
    pub fn to_csv(&self, notes: &[String]) -> Result<String, TableError> {
        self.check()?;
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let parts: Vec<(String, &str, &[f64])> = self
            .columns
            .iter()
            .flat_map(|c| {
                let uncertainty = c.uncertainty.as_ref().map(|u| (format!("u({})", c.name), u));
                let columns = std::iter::once((c.name.clone(), &c.values)).chain(uncertainty);
                columns.map(|(name, values)| (name, c.unit.as_str(), values.as_slice()))
            })
            .collect();
        let header = parts.iter().map(|(name, unit, _)| match *unit {
            "1" => quoted(name),
            unit => quoted(&format!("{name} [{unit}]")),
        });
        let notes = notes.iter().flat_map(|note| note.lines()).map(|line| format!("# {line}\n"));
        let mut out: String = notes.chain([line(header.collect())]).collect();
        for row in 0..self.rows() {
            out += &line(parts.iter().map(|(.., values)| shortest_number(values[row])).collect());
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
    TableError::malformed(format!("{origin}{line}"), error)
}

fn parse_header(origin: &str, line: u64, record: &StringRecord) -> Result<Vec<Header>, TableError> {
    let mut headers: Vec<Header> = Vec::with_capacity(record.len());
    for (i, cell) in record.iter().enumerate() {
        let header = parse_header_cell(cell)
            .map_err(|reason| header_error(origin, line, i + 1, cell, reason))?;
        units::require(&header.unit, origin, &header.name)?;
        let same = |h: &Header| h.name == header.name && h.is_uncertainty == header.is_uncertainty;
        if headers.iter().any(same) {
            return Err(duplicate_error(origin, line, &header.label()));
        }
        headers.push(header);
    }
    Ok(headers)
}

/// What is wrong with a header cell, that of the column at `position` from 1.
pub(super) fn header_error(
    origin: &str,
    line: u64,
    position: usize,
    header: &str,
    reason: &str,
) -> TableError {
    let reason = format!("column {position}: header {header:?}: {reason}");
    TableError::content(format!("{origin}:{line}"), reason)
}

pub(super) fn duplicate_error(origin: &str, line: u64, name: &str) -> TableError {
    TableError::content(format!("{origin}:{line}"), format!("column {name:?} appears twice"))
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
}

impl Place<'_> {
    fn line(&self) -> String {
        format!("{}:{}", self.origin, self.line)
    }

    fn read_row(
        &self,
        text: &str,
        record: &StringRecord,
        headers: &[Header],
        cells: &mut [Vec<f64>],
        options: ReadOptions,
    ) -> Result<(), TableError> {
        let (row, got, expected) = (self.row, record.len(), headers.len());
        if got != expected {
            let at_end = record.position().is_some_and(|p| {
                let rest = text.as_bytes().get(p.byte() as usize..).unwrap_or_default();
                !rest.contains(&b'\n')
            });
            let hint = if at_end { "; the file ends here, it may be truncated" } else { "" };
            let reason = format!("row {row} has {got} cells, the header has {expected}{hint}");
            return Err(TableError::content(self.line(), reason));
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
        let row = self.row;
        let value: f64 = cell.parse().map_err(|_| {
            let column = header.label();
            let reason = format!("row {row}, column {column:?}: expected a number, got {cell:?}");
            TableError::content(self.line(), reason)
        })?;
        if !value.is_finite() && !options.allow_non_finite {
            let column = header.label();
            return Err(TableError::non_finite(&self.line(), &row.to_string(), &column, value));
        }
        if header.is_uncertainty && value < 0.0 {
            return Err(TableError::negative(self.line(), row, &header.name, value));
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
            let name = &header.name;
            let reason = format!("uncertainty column \"u({name})\" has no column {name:?}");
            return Err(TableError::content(origin, reason));
        };
        let factor = units::conversion(&header.unit, &column.unit, origin, &header.label())?;
        column.uncertainty = Some(values.into_iter().map(|v| v * factor).collect());
    }
    Ok(Table { columns, origin: origin.into() })
}
