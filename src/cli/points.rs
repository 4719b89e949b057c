//! Points of `eval`: a CSV of which only the columns that are needed are numbers.
//!
//! Unlike a table of measured data, the file may hold anything else beside the arguments; it is
//! kept as it is written.

use std::io::Read;
use std::path::Path;

use anyhow::{anyhow, bail};

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
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let stdin = path == Path::new("-");
        let file = if stdin { "stdin".to_owned() } else { path.display().to_string() };
        let mut bytes = Vec::new();
        let read = match stdin {
            true => std::io::stdin().lock().read_to_end(&mut bytes).map(|_| ()),
            false => std::fs::read(path).map(|content| bytes = content),
        };
        read.map_err(|error| anyhow!("{file}: {error}"))?;
        let malformed = |error: csv::Error| anyhow!("{file}: {error}");
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(bytes.as_slice());
        let header = reader.headers().map_err(malformed)?.clone();
        let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(malformed)?;
        let points = Self { file, header, rows };
        let names: Vec<&str> = points.names().collect();
        for (place, name) in names.iter().enumerate() {
            if names[..place].contains(name) {
                bail!("{}: column `{name}` is there twice", points.file);
            }
        }
        if points.rows.is_empty() {
            bail!("{}: no rows under the header", points.file);
        }
        Ok(points)
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.header.iter().map(|header| parts(header).0)
    }

    /// File and line of a row, the line from 1.
    pub(super) fn place(&self, row: usize) -> String {
        let position = self.rows.get(row).and_then(csv::StringRecord::position);
        format!("{}:{}", self.file, position.map_or(row as u64 + 2, csv::Position::line))
    }

    /// The columns of `arguments`, given by name and, where it matters, unit.
    pub(super) fn columns(
        &self,
        arguments: &[(String, Option<&str>)],
    ) -> anyhow::Result<Vec<Vec<f64>>> {
        let column = |(name, unit): &(String, Option<&str>)| {
            let Some(place) = self.names().position(|other| other == name) else {
                let expected: Vec<&str> = arguments.iter().map(|(name, _)| name.as_str()).collect();
                let known: Vec<&str> = self.names().collect();
                bail!(
                    "{}: no column `{name}`; expected {}; there are {}",
                    self.file,
                    expected.join(", "),
                    known.join(", ")
                );
            };
            if let (Some(expected), Some(got)) = (unit, parts(&self.header[place]).1)
                && *expected != got
            {
                bail!("{}: column `{name}`: expected the unit {expected}, got {got}", self.file);
            }
            let number = |(row, record): (usize, &csv::StringRecord)| {
                let text = record.get(place).unwrap_or_default();
                text.parse::<f64>().map_err(|_| {
                    let place = self.place(row);
                    anyhow!("{place}: column `{name}`: expected a number, got {text:?}")
                })
            };
            self.rows.iter().enumerate().map(number).collect()
        };
        arguments.iter().map(column).collect()
    }

    /// The file with columns of results beside its own: `results` by name, one text per row.
    pub(super) fn with(&self, results: &[(String, Vec<String>)]) -> anyhow::Result<Vec<u8>> {
        let file = &self.file;
        if let Some((name, _)) = results.iter().find(|(name, _)| self.names().any(|n| n == name)) {
            bail!(
                "{file}: there is a column `{name}` already, which the result would repeat; rename it"
            );
        }
        let written = || -> anyhow::Result<Vec<u8>> {
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(self.header.iter().chain(results.iter().map(|r| r.0.as_str())))?;
            for (row, record) in self.rows.iter().enumerate() {
                let values = results.iter().map(|(_, values)| values.get(row).map_or("", |v| v));
                writer.write_record(record.iter().chain(values))?;
            }
            Ok(writer.into_inner()?)
        };
        written().map_err(|error| anyhow!("{file}: the rows cannot be written: {error}"))
    }
}
