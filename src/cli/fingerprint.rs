//! Fingerprints of what a stage is made from and of what it made: equal, and it need not run again.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context as _;
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::project::Project;
use super::specs::{SpecFile, entries};
use crate::fit::Spec;

/// SHA-256 of what every stage depends on: this program and the measured data.
#[derive(Debug)]
pub(super) struct Fingerprints {
    base: Vec<u8>,
}

impl Fingerprints {
    /// Reads this program and the data of `project`.
    pub(super) fn new(project: &Project) -> anyhow::Result<Self> {
        let mut hash = Sha256::new();
        let program = std::env::current_exe().context("this program's own path")?;
        add_file(&mut hash, &program)?;
        if project.data().is_dir() {
            add_folder(&mut hash, &project.data())?;
        }
        Ok(Self { base: hash.finalize().to_vec() })
    }

    /// Of a spec, its data, its result and the results that it takes constants from; a result that
    /// is not there is part of it.
    pub(super) fn of_fit(&self, file: &SpecFile, spec: &Spec, project: &Project) -> String {
        let mut hash = Sha256::new();
        hash.update(&self.base);
        let sources = spec.constants.iter().map(|name| project.fits().join(format!("{name}.json")));
        for path in [file.path.clone(), file.result()].into_iter().chain(sources) {
            match std::fs::read(path) {
                Ok(bytes) => add(&mut hash, &bytes),
                Err(_) => hash.update(b"absent"),
            }
        }
        hex(hash)
    }

    /// Of the fits, the gates, the adapter and the report as it stands.
    pub(super) fn of_report(
        &self,
        adapter: &str,
        fits: &BTreeMap<String, String>,
        project: &Project,
    ) -> anyhow::Result<String> {
        let mut hash = Sha256::new();
        hash.update(&self.base);
        add(&mut hash, adapter.as_bytes());
        for (name, fit) in fits {
            add(&mut hash, name.as_bytes());
            add(&mut hash, fit.as_bytes());
        }
        add_file(&mut hash, &project.gates())?;
        if project.scene_folder().is_dir() {
            add_folder(&mut hash, &project.scene_folder())?;
        }
        if project.reports().is_dir() {
            add_folder(&mut hash, &project.reports())?;
        }
        Ok(hex(hash))
    }
}

/// `value` as JSON.
pub(super) fn json<T: Serialize>(value: &T) -> anyhow::Result<String> {
    Ok(format!("{}\n", serde_json::to_string_pretty(value)?))
}

/// Every file below `folder` by name, hidden ones left out.
fn add_folder(hash: &mut Sha256, folder: &Path) -> anyhow::Result<()> {
    for path in entries(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with('.') {
            continue;
        }
        add(hash, name.as_bytes());
        if path.is_dir() {
            add_folder(hash, &path)?;
        } else {
            add_file(hash, &path)?;
        }
    }
    Ok(())
}

fn add_file(hash: &mut Sha256, path: &Path) -> anyhow::Result<()> {
    let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
    add(hash, &bytes);
    Ok(())
}

/// Length first, so that two parts cannot pass for one.
fn add(hash: &mut Sha256, bytes: &[u8]) {
    hash.update((bytes.len() as u64).to_le_bytes());
    hash.update(bytes);
}

fn hex(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
