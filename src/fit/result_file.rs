//! Result files: JSON, written whole or not at all.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::FitError;
use super::outcome::{FamilyOutcome, Outcome};
use super::run::FitResult;
use crate::table::store::atomic_write;

/// The version of the format that is written and read.
const SCHEMA: u32 = 1;

impl Outcome {
    /// Reads a result of a single fit.
    ///
    /// # Errors
    /// [`FitError::Io`], [`FitError::Result`] with line and column, [`FitError::Schema`].
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let outcome: Self = parse(path, &text(path)?)?;
        require_schema(path, outcome.schema)?;
        Ok(outcome)
    }
}

impl FamilyOutcome {
    /// Reads a result of a family.
    ///
    /// # Errors
    /// As [`Outcome::read`].
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let outcome: Self = parse(path, &text(path)?)?;
        require_schema(path, outcome.schema)?;
        Ok(outcome)
    }
}

impl FitResult {
    /// Reads either; a family is told by its `members`.
    ///
    /// # Errors
    /// As [`Outcome::read`].
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let value: serde_json::Value = parse(path, &text(path)?)?;
        if value.get("members").is_some() {
            Ok(Self::Family(FamilyOutcome::read(path)?))
        } else {
            Ok(Self::Single(Box::new(Outcome::read(path)?)))
        }
    }

    /// Every fit in it.
    pub fn outcomes(&self) -> &[Outcome] {
        match self {
            Self::Single(outcome) => std::slice::from_ref(outcome),
            Self::Family(family) => &family.members,
        }
    }

    /// The JSON text; a family has one member per line, so that a diff shows which one moved.
    ///
    /// # Errors
    /// [`FitError::Result`] if the result cannot be written as JSON.
    pub fn to_json(&self) -> Result<String, FitError> {
        let json = match self {
            Self::Single(outcome) => serde_json::to_string_pretty(outcome),
            Self::Family(family) => family_json(family),
        };
        let mut json = json.map_err(|source| FitError::Result {
            path: self.outcomes().first().map(|o| o.name.clone()).unwrap_or_default(),
            source,
        })?;
        json.push('\n');
        Ok(json)
    }

    /// Writes the JSON text to `path`, through a temporary file and a rename.
    ///
    /// # Errors
    /// [`FitError::Data`] if the folder cannot be written, and that of [`FitResult::to_json`].
    pub fn write(&self, path: &Path) -> Result<(), FitError> {
        Ok(atomic_write(path, self.to_json()?.as_bytes())?)
    }
}

fn family_json(family: &FamilyOutcome) -> Result<String, serde_json::Error> {
    let members: Vec<String> = family
        .members
        .iter()
        .map(|member| Ok(format!("    {}", serde_json::to_string(member)?)))
        .collect::<Result<_, serde_json::Error>>()?;
    let fields = [
        field("schema", &family.schema)?,
        field("name", &family.name)?,
        field("form", &family.form)?,
        field("family", &family.family)?,
        format!("  \"members\": [\n{}\n  ]", members.join(",\n")),
        field("provenance", &family.provenance)?,
    ];
    Ok(format!("{{\n{}\n}}", fields.join(",\n")))
}

fn field(name: &str, value: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(format!("  \"{name}\": {}", serde_json::to_string(value)?))
}

fn text(path: &Path) -> Result<String, FitError> {
    std::fs::read_to_string(path)
        .map_err(|source| FitError::Io { path: path.display().to_string(), source })
}

fn parse<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, FitError> {
    serde_json::from_str(text)
        .map_err(|source| FitError::Result { path: path.display().to_string(), source })
}

fn require_schema(path: &Path, schema: u32) -> Result<(), FitError> {
    if schema == SCHEMA {
        return Ok(());
    }
    Err(FitError::Schema { path: path.display().to_string(), expected: SCHEMA, got: schema })
}
