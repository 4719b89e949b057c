//! Files of outside formats, told by their extension, as what this crate writes.

use std::path::Path;

use super::{Environment, HeightMap, MeasuredError, Negative, refractive_index};
use crate::table::{Table, sidecar_path};

/// An imported file.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// What it holds.
    pub content: Content,
    /// Name of the format that was found.
    pub format: &'static str,
    /// What the file says of its origin and how the content was made from it, one line each; meant
    /// to stand as comments above a written table.
    pub notes: Vec<String>,
}

/// What an imported file holds.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Content {
    /// Columns of numbers.
    Table(Table),
    /// Heights of a surface.
    HeightMap(HeightMap),
    /// Radiance from every direction.
    Environment(Environment),
}

impl Content {
    /// What it is, in words.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Table(_) => "a table",
            Self::HeightMap(_) => "a height map",
            Self::Environment(_) => "an environment map",
        }
    }
}

impl Imported {
    /// The table, if it is one.
    pub fn table(&self) -> Option<&Table> {
        match &self.content {
            Content::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Writes the content, whole or not at all: a table as CSV with the notes as comments above it,
    /// a height map as an EXR grid with its sidecar ([`HeightMap::to_grid`]), an environment map as
    /// EXR ([`Environment::write_exr`]).
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] if `path` ends in `.exr` for a table or in anything else for a
    /// map; else as [`Table::write_csv`], [`crate::table::Grid::write_exr`] and
    /// [`Environment::write_exr`].
    pub fn write(&self, path: &Path) -> Result<(), MeasuredError> {
        let is_exr = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
        let is_table = matches!(self.content, Content::Table(_));
        if is_exr == is_table {
            let expected = if is_table { ".csv" } else { ".exr" };
            let reason = format!("{} is written as {expected}", self.content.name());
            return Err(MeasuredError::unusable(path.display().to_string(), reason));
        }
        match &self.content {
            Content::Table(table) => Ok(table.write_csv(path, &self.notes)?),
            Content::HeightMap(map) => Ok(map.to_grid()?.write_exr(path)?),
            Content::Environment(map) => map.write_exr(path),
        }
    }
}

/// The formats that [`import`] reads with their extensions, in words.
const KNOWN_FORMATS: &str = "refractiveindex.info YAML (.yml, .yaml); CSV table (.csv); Radiance \
                             environment map (.hdr); raw height map (.f32); EXR environment map or \
                             height map (.exr)";

/// Reads a file of an outside format, told by its extension. An `.exr` file with a sidecar of axes
/// is a height map, else an environment map, of which `negative` says what becomes of negative values.
///
/// # Errors
/// [`MeasuredError::Unusable`], listing the formats, for another extension; otherwise what the
/// format's reader finds wrong, with the file and, in text, the line.
pub fn import(path: &Path, negative: Negative) -> Result<Imported, MeasuredError> {
    let height_map = || HeightMap::read(path).map(Content::HeightMap);
    let environment = || Environment::read_with(path, negative).map(Content::Environment);
    let (format, content) = match extension(path).as_str() {
        "yml" | "yaml" => return refractive_index::import(path),
        "csv" => ("CSV table", Content::Table(Table::read_csv(path)?)),
        "hdr" => ("Radiance environment map", environment()?),
        "f32" => ("raw height map", height_map()?),
        "exr" if sidecar_path(path).exists() => ("EXR height map", height_map()?),
        "exr" => ("EXR environment map", environment()?),
        _ => return Err(unknown_format(path, KNOWN_FORMATS)),
    };
    let origin = match &content {
        Content::Table(table) => &table.origin,
        Content::HeightMap(map) => &map.origin,
        Content::Environment(map) => &map.origin,
    };
    let notes = vec![format!("from {origin}")];
    Ok(Imported { content, format, notes })
}

/// What the name of a file ends in, in lower case.
pub(super) fn extension(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase()
}

/// A file whose extension says none of the `known` formats.
pub(super) fn unknown_format(path: &Path, known: &str) -> MeasuredError {
    let reason = format!("unknown format; known formats: {known}");
    MeasuredError::unusable(path.display().to_string(), reason)
}
