//! The specs of a project and what became of them.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde_json::Value;

/// A spec under `fits/`.
#[derive(Debug)]
pub(super) struct SpecFile {
    /// `effect/name`.
    pub(super) name: String,
    /// The spec, `fits/<effect>/<name>.toml`.
    pub(super) path: PathBuf,
}

/// Every spec under `fits`, by name.
pub(super) fn find(fits: &Path) -> anyhow::Result<Vec<SpecFile>> {
    let mut specs = Vec::new();
    for effect in entries(fits)?.into_iter().filter(|path| path.is_dir()) {
        for path in entries(&effect)? {
            if path.extension().is_some_and(|extension| extension == "toml") {
                let name = path.strip_prefix(fits).unwrap_or(&path).with_extension("");
                let parts = name.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>();
                specs.push(SpecFile { name: parts.join("/"), path });
            }
        }
    }
    Ok(specs)
}

/// What a folder holds, sorted by name so that nothing depends on the file system's order.
pub(super) fn entries(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let list = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths = list
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .with_context(|| folder.display().to_string())?;
    paths.sort();
    Ok(paths)
}

impl SpecFile {
    /// The result, `fits/<effect>/<name>.json`.
    pub(super) fn result(&self) -> PathBuf {
        self.path.with_extension("json")
    }

    /// The result's status in a word or two: `converged`, `12 of 14 converged`, `not fitted`.
    pub(super) fn state(&self) -> String {
        let Ok(text) = std::fs::read_to_string(self.result()) else {
            return "not fitted".to_owned();
        };
        let status = |outcome: &Value| outcome["status"].as_str().map(str::to_owned);
        match serde_json::from_str::<Value>(&text) {
            Ok(result) => match result["members"].as_array() {
                Some(members) => {
                    let good = members.iter().filter(|m| m["status"] == "converged").count();
                    format!("{good} of {} converged", members.len())
                }
                None => status(&result).unwrap_or_else(|| "no status".to_owned()),
            },
            Err(_) => "unreadable".to_owned(),
        }
    }

    /// The spec's `description`, or the comment on its first line.
    pub(super) fn description(&self) -> String {
        let text = std::fs::read_to_string(&self.path).unwrap_or_default();
        let described = text.parse::<toml::Table>().ok().and_then(|table| {
            table.get("description").and_then(toml::Value::as_str).map(str::to_owned)
        });
        let comment = || text.lines().next().and_then(|line| line.strip_prefix('#'));
        described.unwrap_or_else(|| comment().unwrap_or_default().trim().to_owned())
    }
}
