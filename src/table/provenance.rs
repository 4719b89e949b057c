//! Where the files of a data set come from: `SOURCE.toml` in its folder.
//!
//! Who measured, with what, where it was published and under which licence stands either for the
//! whole set or with the file; what neither states is an error, so no file goes unattributed.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;

use super::{TableError, store};

/// Name of the record in a data set's folder.
pub const FILE_NAME: &str = "SOURCE.toml";

/// The provenance of a data set.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// What the set is.
    pub title: String,
    /// Licence under which it may be redistributed.
    pub licence: String,
    /// How it was obtained.
    pub obtained: Obtained,
    /// Who measured, with what, and where it was published, where that is one for the whole set.
    #[serde(default)]
    pub measurement: Measurement,
    /// The files of the set.
    #[serde(default, rename = "file")]
    pub files: Vec<SourceFile>,
}

/// How a data set was obtained.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Obtained {
    /// Package that carries the data, with its registry.
    pub package: String,
    /// Version of the package.
    pub version: String,
    /// Commands that make the files again.
    pub command: String,
    /// What was done to the numbers on the way, if anything.
    #[serde(default)]
    pub note: String,
}

/// Who measured, with what, and where it was published.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measurement {
    /// Who measured.
    pub measured_by: Option<String>,
    /// Instrument or method.
    pub instrument: Option<String>,
    /// Publication.
    pub reference: Option<String>,
    /// DOI of the publication, or a word on why there is none.
    pub doi: Option<String>,
}

/// One file of a data set.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SourceFile {
    /// Name of the file in the folder.
    pub name: String,
    /// SHA-256, 64 lower-case hexadecimal digits.
    pub sha256: String,
    /// The record of the source that it was made from.
    pub record: String,
    /// What differs from the set's [`Provenance::measurement`].
    #[serde(default)]
    pub measurement: Measurement,
}

impl Provenance {
    /// Reads `folder`/`SOURCE.toml`.
    ///
    /// # Errors
    /// [`TableError`] naming the file: unreadable, not TOML of this shape (with the line), or a
    /// file without measurer, instrument, reference or DOI.
    pub fn read(folder: impl AsRef<Path>) -> Result<Self, TableError> {
        let path = folder.as_ref().join(FILE_NAME);
        Self::parse(&path.display().to_string(), &store::read_text(&path)?)
    }

    /// Reads the text of a `SOURCE.toml`; `origin` names it in messages.
    ///
    /// # Errors
    /// As [`Provenance::read`].
    pub fn parse(origin: &str, text: &str) -> Result<Self, TableError> {
        let fault = |reason: &str| TableError::malformed(origin, reason);
        let provenance: Self = toml::from_str(text).map_err(|e| fault(e.to_string().trim_end()))?;
        for file in &provenance.files {
            let m = provenance.measurement_of(file);
            let missing = [
                ("measured_by", m.measured_by),
                ("instrument", m.instrument),
                ("reference", m.reference),
                ("doi", m.doi),
            ]
            .into_iter()
            .find(|(_, value)| value.as_ref().is_none_or(|v| v.trim().is_empty()));
            if let Some((field, _)) = missing {
                return Err(fault(&format!("file {:?}: no {field}", file.name)));
            }
        }
        Ok(provenance)
    }

    /// The measurement of one file: its own fields where it has them, else those of the set.
    pub fn measurement_of(&self, file: &SourceFile) -> Measurement {
        let own = file.measurement.clone();
        let set = self.measurement.clone();
        Measurement {
            measured_by: own.measured_by.or(set.measured_by),
            instrument: own.instrument.or(set.instrument),
            reference: own.reference.or(set.reference),
            doi: own.doi.or(set.doi),
        }
    }

    /// Compares the record with the folder: every file but `SOURCE.toml` is listed once with the
    /// right SHA-256, and nothing is listed that is not there.
    ///
    /// # Errors
    /// [`TableError::Content`] for the first disagreement, [`TableError::Unreadable`] for a file that
    /// cannot be read.
    pub fn verify(&self, folder: impl AsRef<Path>) -> Result<(), TableError> {
        let folder = folder.as_ref();
        let fault = |name: &str, reason: &str| {
            let place = folder.display().to_string();
            Err(TableError::content(place, format!("{name}: {reason}")))
        };
        let mut listed = BTreeSet::new();
        for file in &self.files {
            if !listed.insert(file.name.as_str()) {
                return fault(&file.name, "listed twice");
            }
            if file.name.contains(['/', '\\']) {
                return fault(&file.name, "not a file of this folder");
            }
            let path = folder.join(&file.name);
            if !path.is_file() {
                return fault(&file.name, "listed in SOURCE.toml but not there");
            }
            let got = store::sha256_hex(&store::read(&path)?);
            if got != file.sha256 {
                let expected = &file.sha256;
                return fault(&file.name, &format!("sha256 is {got}, expected {expected}"));
            }
        }
        for name in names_in(folder)? {
            if name != FILE_NAME && !listed.contains(name.as_str()) {
                return fault(&name, "not listed in SOURCE.toml");
            }
        }
        Ok(())
    }
}

fn names_in(folder: &Path) -> Result<BTreeSet<String>, TableError> {
    let unreadable = |source| TableError::Unreadable { path: folder.into(), source };
    std::fs::read_dir(folder)
        .map_err(unreadable)?
        .map(|entry| Ok(entry.map_err(unreadable)?.file_name().to_string_lossy().into_owned()))
        .collect()
}
