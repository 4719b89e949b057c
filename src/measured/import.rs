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
    /// [`MeasuredError::OutputFormat`] if `path` ends in `.exr` for a table or in anything else for
    /// a map; else as [`Table::write_csv`], [`crate::table::Grid::write_exr`] and
    /// [`Environment::write_exr`].
    pub fn write(&self, path: &Path) -> Result<(), MeasuredError> {
        let is_exr = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
        let is_table = matches!(self.content, Content::Table(_));
        if is_exr == is_table {
            let expected = if is_table { ".csv" } else { ".exr" };
            let what = self.content.name();
            return Err(MeasuredError::OutputFormat { path: path.into(), what, expected });
        }
        match &self.content {
            Content::Table(table) => Ok(table.write_csv(path, &self.notes)?),
            Content::HeightMap(map) => Ok(map.to_grid()?.write_exr(path)?),
            Content::Environment(map) => map.write_exr(path),
        }
    }
}

/// A format that [`import`] reads.
struct Format {
    name: &'static str,
    extensions: &'static [&'static str],
    read: fn(&Path, Negative) -> Result<Imported, MeasuredError>,
}

const FORMATS: &[Format] = &[
    Format {
        name: "refractiveindex.info YAML",
        extensions: &["yml", "yaml"],
        read: |path, _| refractive_index::import(path),
    },
    Format { name: "CSV table", extensions: &["csv"], read: |path, _| import_csv(path) },
    Format {
        name: RADIANCE_MAP,
        extensions: &["hdr"],
        read: |path, negative| environment(path, negative, RADIANCE_MAP),
    },
    Format {
        name: RAW_HEIGHTS,
        extensions: &["f32"],
        read: |path, _| height_map(path, RAW_HEIGHTS),
    },
    Format { name: "EXR environment map or height map", extensions: &["exr"], read: import_exr },
];

const RADIANCE_MAP: &str = "Radiance environment map";
const RAW_HEIGHTS: &str = "raw height map";

/// Reads a file of an outside format, told by its extension. An `.exr` file with a sidecar of axes
/// is a height map, else an environment map.
///
/// # Errors
/// [`MeasuredError::UnknownFormat`], listing the formats, for another extension; otherwise what
/// the format's reader finds wrong, with the file and, in text, the line.
pub fn import(path: &Path) -> Result<Imported, MeasuredError> {
    import_with(path, Negative::Refused)
}

/// As [`import`], with a say in what becomes of negative values of an environment map.
///
/// # Errors
/// As [`import`].
pub fn import_with(path: &Path, negative: Negative) -> Result<Imported, MeasuredError> {
    let extension = extension(path);
    match FORMATS.iter().find(|f| f.extensions.contains(&extension.as_str())) {
        Some(format) => (format.read)(path, negative),
        None => Err(MeasuredError::unknown_format(path, known_formats())),
    }
}

/// What the name of a file ends in, in lower case.
pub(super) fn extension(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase()
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
    Ok(Imported { content: Content::Table(table), format: "CSV table", notes })
}

fn import_exr(path: &Path, negative: Negative) -> Result<Imported, MeasuredError> {
    if sidecar_path(path).exists() {
        height_map(path, "EXR height map")
    } else {
        environment(path, negative, "EXR environment map")
    }
}

fn environment(
    path: &Path,
    negative: Negative,
    format: &'static str,
) -> Result<Imported, MeasuredError> {
    let map = Environment::read_with(path, negative)?;
    let notes = vec![format!("from {}", map.origin)];
    Ok(Imported { content: Content::Environment(map), format, notes })
}

fn height_map(path: &Path, format: &'static str) -> Result<Imported, MeasuredError> {
    let map = HeightMap::read(path)?;
    let notes = vec![format!("from {}", map.origin)];
    Ok(Imported { content: Content::HeightMap(map), format, notes })
}
