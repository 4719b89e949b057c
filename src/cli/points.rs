//! Points of `eval`: a CSV of which only the columns that are needed are numbers.
//!
//! Unlike a table of measured data, the file may hold anything else beside the arguments; it is
//! kept as it is written.

use std::io::Read;
use std::path::Path;

/// Why points cannot be read.
#[derive(Debug, thiserror::Error)]
pub(super) enum PointsError {
    /// The file cannot be read.
    #[error("{file}: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The text is no CSV.
    #[error("{file}: {source}")]
    Malformed {
        /// The file.
        file: String,
        /// Line and fault.
        source: csv::Error,
    },
    /// There is nothing to evaluate at.
    #[error("{file}: no rows under the header")]
    NoRows {
        /// The file.
        file: String,
    },
    /// Two columns have one name.
    #[error("{file}: column `{name}` is there twice")]
    Duplicate {
        /// The file.
        file: String,
        /// Name of the column.
        name: String,
    },
    /// An argument has no column.
    #[error("{file}: no column `{name}`; expected {expected}; there are {known}")]
    Missing {
        /// The file.
        file: String,
        /// Name of the column.
        name: String,
        /// Every argument.
        expected: String,
        /// Names that there are.
        known: String,
    },
    /// A column is in another unit than the argument.
    #[error("{file}: column `{name}`: expected the unit {expected}, got {got}")]
    Unit {
        /// The file.
        file: String,
        /// Name of the column.
        name: String,
        /// Unit of the argument.
        expected: String,
        /// Unit in the header.
        got: String,
    },
    /// A cell is no number.
    #[error("{file}:{line}: column `{name}`: expected a number, got {got:?}")]
    NoNumber {
        /// The file.
        file: String,
        /// Line, from 1.
        line: u64,
        /// Name of the column.
        name: String,
        /// The cell.
        got: String,
    },
    /// The result's name is taken.
    #[error("{file}: there is a column `{name}` already, which the result would repeat; rename it")]
    Taken {
        /// The file.
        file: String,
        /// Name of the column.
        name: String,
    },
    /// The rows cannot be written as CSV.
    #[error("{file}: the rows cannot be written: {reason}")]
    Unwritable {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
}

/// Rows of text under a header.
#[derive(Debug)]
pub(super) struct Points {
    file: String,
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

/// Name and unit of a header such as `mu [1]`.
fn parts(header: &str) -> (&str, Option<&str>) {
    match header.split_once('[') {
        Some((name, unit)) => (name.trim(), Some(unit.trim().trim_end_matches(']').trim())),
        None => (header.trim(), None),
    }
}

impl Points {
    /// Reads a file, or stdin for `-`. Lines that begin with `#` are notes.
    pub(super) fn read(path: &Path) -> Result<Self, PointsError> {
        let (file, mut bytes) = (path.display().to_string(), Vec::new());
        let read = if file == "-" {
            std::io::stdin().lock().read_to_end(&mut bytes).map(|_| ())
        } else {
            std::fs::read(path).map(|content| bytes = content)
        };
        let file = if file == "-" { "stdin".to_owned() } else { file };
        match read {
            Ok(()) => Self::parse(file, &bytes),
            Err(source) => Err(PointsError::Unreadable { file, source }),
        }
    }

    fn parse(file: String, bytes: &[u8]) -> Result<Self, PointsError> {
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(bytes);
        let malformed = |source| PointsError::Malformed { file: file.clone(), source };
        let header = reader.headers().map_err(malformed)?.clone();
        let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(malformed)?;
        let points = Self { file, header, rows };
        let names: Vec<&str> = points.names().collect();
        for (place, name) in names.iter().enumerate() {
            if names.iter().take(place).any(|other| other == name) {
                let (file, name) = (points.file.clone(), (*name).to_owned());
                return Err(PointsError::Duplicate { file, name });
            }
        }
        if points.rows.is_empty() {
            return Err(PointsError::NoRows { file: points.file });
        }
        Ok(points)
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.header.iter().map(|header| parts(header).0)
    }

    /// Line of a row of the file, from 1.
    pub(super) fn place(&self, row: usize) -> String {
        format!("{}:{}", self.file, self.line(row))
    }

    fn line(&self, row: usize) -> u64 {
        let position = self.rows.get(row).and_then(csv::StringRecord::position);
        position.map_or(row as u64 + 2, csv::Position::line)
    }

    /// The columns of `arguments`, given by name and, where it matters, unit.
    pub(super) fn columns(
        &self,
        arguments: &[(String, Option<&str>)],
    ) -> Result<Vec<Vec<f64>>, PointsError> {
        let all: Vec<&str> = arguments.iter().map(|(name, _)| name.as_str()).collect();
        arguments.iter().map(|(name, unit)| self.column(name, *unit, &all)).collect()
    }

    fn column(
        &self,
        name: &str,
        unit: Option<&str>,
        all: &[&str],
    ) -> Result<Vec<f64>, PointsError> {
        let file = || self.file.clone();
        let Some(place) = self.names().position(|other| other == name) else {
            return Err(PointsError::Missing {
                file: file(),
                name: name.to_owned(),
                expected: all.join(", "),
                known: self.names().collect::<Vec<_>>().join(", "),
            });
        };
        let written = self.header.get(place).and_then(|header| parts(header).1);
        if let (Some(expected), Some(got)) = (unit, written)
            && expected != got
        {
            let (name, expected, got) = (name.to_owned(), expected.to_owned(), got.to_owned());
            return Err(PointsError::Unit { file: file(), name, expected, got });
        }
        let cell = |(row, record): (usize, &csv::StringRecord)| {
            let text = record.get(place).unwrap_or_default();
            text.parse::<f64>().map_err(|_| PointsError::NoNumber {
                file: file(),
                line: self.line(row),
                name: name.to_owned(),
                got: text.to_owned(),
            })
        };
        self.rows.iter().enumerate().map(cell).collect()
    }

    /// The file with columns of results beside its own: `results` by name, one text per row.
    pub(super) fn with(&self, results: &[(String, Vec<String>)]) -> Result<Vec<u8>, PointsError> {
        for (name, _) in results {
            if self.names().any(|other| other == name) {
                return Err(PointsError::Taken { file: self.file.clone(), name: name.clone() });
            }
        }
        let fault = |reason: String| PointsError::Unwritable { file: self.file.clone(), reason };
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = self.header.iter().chain(results.iter().map(|(name, _)| name.as_str()));
        writer.write_record(header).map_err(|error| fault(error.to_string()))?;
        for (row, record) in self.rows.iter().enumerate() {
            let values = results.iter().map(|(_, values)| values.get(row).map_or("", |v| v));
            let record = record.iter().chain(values);
            writer.write_record(record).map_err(|error| fault(error.to_string()))?;
        }
        writer.into_inner().map_err(|error| fault(error.to_string()))
    }
}
