//! The specs of a project and what became of them.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{Project, ProjectError};

/// A spec under `fits/`.
#[derive(Debug)]
pub struct SpecFile {
    /// `effect/name`.
    pub name: String,
    /// The spec, `fits/<effect>/<name>.toml`.
    pub path: PathBuf,
}

impl Project {
    /// Every spec under `fits/`, by name; none without the folder.
    ///
    /// # Errors
    /// [`ProjectError::Io`] if a folder cannot be read.
    pub fn specs(&self) -> Result<Vec<SpecFile>, ProjectError> {
        let fits = self.fits();
        let mut specs = Vec::new();
        if !fits.is_dir() {
            return Ok(specs);
        }
        for effect in entries(&fits)?.into_iter().filter(|path| path.is_dir()) {
            for path in entries(&effect)? {
                if path.extension().is_some_and(|extension| extension == "toml") {
                    let name = path.strip_prefix(&fits).unwrap_or(&path).with_extension("");
                    let parts = name.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>();
                    specs.push(SpecFile { name: parts.join("/"), path });
                }
            }
        }
        Ok(specs)
    }

    /// The specs of these names, in the order of the folder; all of them for no name.
    ///
    /// # Errors
    /// [`ProjectError::Unknown`] for a name without a spec.
    pub fn specs_named(&self, names: &[String]) -> Result<Vec<SpecFile>, ProjectError> {
        let all = self.specs()?;
        if let Some(name) = names.iter().find(|name| !all.iter().any(|spec| spec.name == **name)) {
            let nearest = super::nearest(name, all.into_iter().map(|spec| spec.name));
            return Err(ProjectError::Unknown { what: "spec", name: name.clone(), nearest });
        }
        Ok(all.into_iter().filter(|spec| names.is_empty() || names.contains(&spec.name)).collect())
    }
}

/// What a folder holds, sorted by name so that nothing depends on the file system's order.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, ProjectError> {
    let list = std::fs::read_dir(folder).map_err(ProjectError::io(folder))?;
    let mut paths = list
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(ProjectError::io(folder))?;
    paths.sort();
    Ok(paths)
}

impl SpecFile {
    /// The result, `fits/<effect>/<name>.json`.
    pub fn result(&self) -> PathBuf {
        self.path.with_extension("json")
    }

    /// The result's status in a word or two: `converged`, `12 of 14 converged`, `not fitted`.
    pub fn state(&self) -> String {
        let Ok(text) = std::fs::read_to_string(self.result()) else {
            return "not fitted".to_owned();
        };
        let Ok(result) = serde_json::from_str::<Value>(&text) else {
            return "unreadable".to_owned();
        };
        match result["members"].as_array() {
            Some(members) => {
                let good = members.iter().filter(|m| m["status"] == "converged").count();
                format!("{good} of {} converged", members.len())
            }
            None => result["status"].as_str().unwrap_or("no status").to_owned(),
        }
    }

    /// The spec's `description`, or the comment on its first line.
    pub fn description(&self) -> String {
        let text = std::fs::read_to_string(&self.path).unwrap_or_default();
        let described = text.parse::<toml::Table>().ok().and_then(|table| {
            table.get("description").and_then(toml::Value::as_str).map(str::to_owned)
        });
        let comment = || text.lines().next().and_then(|line| line.strip_prefix('#'));
        described.unwrap_or_else(|| comment().unwrap_or_default().trim().to_owned())
    }
}
