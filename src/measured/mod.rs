//! Measured data: one reader per outside format, and the data sets that come with the crate.
//!
//! [`import`] turns a file of an outside format into a [`Table`]. [`optical_constants`] and
//! [`spectra`] load what `data/measured/` holds.

mod dispersion;
pub mod environment;
mod error;
pub mod height_map;
mod interpolation;
pub mod optical_constants;
pub mod pattern;
pub mod refractive_index;
pub mod spectra;
mod tabulation;

use std::path::Path;

pub use self::dispersion::{Dispersion, Formula};
pub use self::error::MeasuredError;
pub use self::interpolation::linear;

use crate::table::Table;

/// An imported file.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The numbers.
    pub table: Table,
    /// Name of the format that was found.
    pub format: &'static str,
    /// What the file says of its origin and how the table was made from it, one line each; meant
    /// to stand as comments above the written table.
    pub notes: Vec<String>,
}

impl Imported {
    /// Writes the table as CSV, whole or not at all, with the notes as comments above it.
    ///
    /// # Errors
    /// As [`Table::write_csv`].
    pub fn write_csv(&self, path: &Path) -> Result<(), MeasuredError> {
        Ok(self.table.write_csv(path, &self.notes)?)
    }
}

/// A format that [`import`] reads.
struct Format {
    name: &'static str,
    extensions: &'static [&'static str],
    read: fn(&Path) -> Result<Imported, MeasuredError>,
}

const FORMATS: &[Format] = &[
    Format {
        name: "refractiveindex.info YAML",
        extensions: &["yml", "yaml"],
        read: refractive_index::import,
    },
    Format { name: "CSV table", extensions: &["csv"], read: import_csv },
];

/// Reads a file of an outside format, told by its extension, as a table.
///
/// # Errors
/// [`MeasuredError::UnknownFormat`], listing the formats, for another extension; otherwise what
/// the format's reader finds wrong, with file and line.
pub fn import(path: &Path) -> Result<Imported, MeasuredError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    match FORMATS.iter().find(|f| f.extensions.contains(&extension.as_str())) {
        Some(format) => (format.read)(path),
        None => Err(MeasuredError::UnknownFormat { path: path.into(), known: known_formats() }),
    }
}

/// The formats that [`import`] reads with their extensions, in words.
pub fn known_formats() -> String {
    FORMATS
        .iter()
        .map(|f| format!("{} (.{})", f.name, f.extensions.join(", .")))
        .collect::<Vec<_>>()
        .join("; ")
}

fn import_csv(path: &Path) -> Result<Imported, MeasuredError> {
    let table = Table::read_csv(path)?;
    let notes = vec![format!("from {}", table.origin)];
    Ok(Imported { table, format: "CSV table", notes })
}
