//! Fingerprints of what a stage is made from and of what it made: equal, and it need not run again.

use std::collections::BTreeMap;
use std::path::Path;

use sha2::{Digest, Sha256};

use super::specs::entries;
use super::{Project, ProjectError, SpecFile};
use crate::fit::Spec;

/// SHA-256 of what every stage depends on: this program, the measured data and the forms of the
/// project's own.
#[derive(Debug)]
pub struct Fingerprints {
    base: Vec<u8>,
}

impl Fingerprints {
    /// Reads this program, the data and the forms of `project`.
    ///
    /// # Errors
    /// [`ProjectError::Io`] if either cannot be read.
    pub fn new(project: &Project) -> Result<Self, ProjectError> {
        let mut hash = Sha256::new();
        let program =
            std::env::current_exe().map_err(ProjectError::io(Path::new("this program")))?;
        add_file(&mut hash, &program)?;
        for folder in [project.data(), project.forms()] {
            if folder.is_dir() {
                add_folder(&mut hash, &folder)?;
            }
        }
        Ok(Self { base: hash.finalize().to_vec() })
    }

    /// Of a spec, its data, its result and the results that it takes constants from; a result that
    /// is not there is part of it.
    pub fn of_fit(&self, file: &SpecFile, spec: &Spec, project: &Project) -> String {
        let mut hash = Sha256::new();
        hash.update(&self.base);
        let sources = spec.constants.iter().map(|name| project.fits().join(format!("{name}.json")));
        for path in [file.path.clone(), file.result()].into_iter().chain(sources) {
            add_if_there(&mut hash, &path);
        }
        hex(hash)
    }

    /// Of the fits, the gates, the adapter and the report as it stands.
    ///
    /// # Errors
    /// [`ProjectError::Io`] if any of it cannot be read.
    pub fn of_report(
        &self,
        adapter: &str,
        fits: &BTreeMap<String, String>,
        project: &Project,
    ) -> Result<String, ProjectError> {
        let mut hash = Sha256::new();
        hash.update(&self.base);
        add(&mut hash, adapter.as_bytes());
        for (name, fit) in fits {
            add(&mut hash, name.as_bytes());
            add(&mut hash, fit.as_bytes());
        }
        if project.gates().is_file() {
            add_file(&mut hash, &project.gates())?;
        }
        if project.scene_folder().is_dir() {
            add_folder(&mut hash, &project.scene_folder())?;
        }
        add_if_there(&mut hash, &project.accuracy());
        if project.report().is_dir() {
            add_folder(&mut hash, &project.report())?;
        }
        Ok(hex(hash))
    }
}

/// Every file below `folder` by name, hidden ones left out.
fn add_folder(hash: &mut Sha256, folder: &Path) -> Result<(), ProjectError> {
    for path in entries(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name == "state.json" {
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

fn add_file(hash: &mut Sha256, path: &Path) -> Result<(), ProjectError> {
    let bytes = std::fs::read(path).map_err(ProjectError::io(path))?;
    add(hash, &bytes);
    Ok(())
}

fn add_if_there(hash: &mut Sha256, path: &Path) {
    match std::fs::read(path) {
        Ok(bytes) => add(hash, &bytes),
        Err(_) => hash.update(b"absent"),
    }
}

/// Length first, so that two parts cannot pass for one.
fn add(hash: &mut Sha256, bytes: &[u8]) {
    hash.update((bytes.len() as u64).to_le_bytes());
    hash.update(bytes);
}

fn hex(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
