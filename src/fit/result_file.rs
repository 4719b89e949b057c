//! Result files: JSON, written whole or not at all.

use std::path::Path;

use serde::Serialize;

use super::error::FitError;
use super::outcome::{FamilyOutcome, Outcome};
use crate::table::store::atomic_write;

/// The version of the format that is written and read.
const SCHEMA: u32 = 1;

/// The result of a spec.
#[derive(Debug, Clone, PartialEq)]
pub enum FitResult {
    /// One fit.
    Single(Box<Outcome>),
    /// One fit per member of a family.
    Family(FamilyOutcome),
}

impl FitResult {
    /// Reads a result; a family is told by its `members`.
    ///
    /// # Errors
    /// [`FitError::Io`], [`FitError::Result`] with line and column, [`FitError::Schema`].
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|source| FitError::Io { path: shown.clone(), source })?;
        let result = Self::parse(&text)
            .map_err(|source| FitError::Result { path: shown.clone(), source })?;
        let got = match &result {
            Self::Single(outcome) => outcome.schema,
            Self::Family(family) => family.schema,
        };
        if got != SCHEMA {
            return Err(FitError::Schema { path: shown, expected: SCHEMA, got });
        }
        Ok(result)
    }

    fn parse(text: &str) -> Result<Self, serde_json::Error> {
        let value: serde_json::Value = serde_json::from_str(text)?;
        match value.get("members") {
            Some(_) => serde_json::from_str(text).map(Self::Family),
            None => serde_json::from_str(text).map(Self::Single),
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
