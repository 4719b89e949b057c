//! The folder a run works in.

use std::path::{Path, PathBuf};

/// A folder with specs, results and gates under `fits/`.
#[derive(Debug, Clone)]
pub(super) struct Project {
    root: PathBuf,
}

/// Why there is no project.
#[derive(Debug, Clone, thiserror::Error)]
pub(super) enum ProjectError {
    /// No folder upwards is one.
    #[error(
        "no project in {from} or above: expected a folder with `fits/` and Cargo.toml or \
         fits/gates.toml; name one with --project or STRIAE_PROJECT"
    )]
    NotFound {
        /// Where the search began.
        from: PathBuf,
    },
    /// The folder that was named is none.
    #[error("{folder}: named by {by} as the project, but it has no folder `fits/`")]
    NotOne {
        /// The folder.
        folder: PathBuf,
        /// Option or variable.
        by: &'static str,
    },
}

impl Project {
    /// The folder itself.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }
    /// Specs, results and gates.
    pub(super) fn fits(&self) -> PathBuf {
        self.root.join("fits")
    }
    /// The gates.
    pub(super) fn gates(&self) -> PathBuf {
        self.fits().join("gates.toml")
    }
    /// The report.
    pub(super) fn reports(&self) -> PathBuf {
        self.root.join("reports")
    }
    /// Measured data.
    pub(super) fn data(&self) -> PathBuf {
        self.root.join("data/measured")
    }
    /// Scenes by name, `data/scenes/*.toml`; none without the folder.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub(super) fn scenes(&self) -> anyhow::Result<Vec<PathBuf>> {
        let folder = self.scene_folder();
        if !folder.is_dir() {
            return Ok(Vec::new());
        }
        let toml = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
        Ok(super::specs::entries(&folder)?.into_iter().filter(toml).collect())
    }
    /// Where scenes are.
    pub(super) fn scene_folder(&self) -> PathBuf {
        self.root.join("data/scenes")
    }
    /// `path` relative to the project where it is inside it, for messages that read the same
    /// everywhere.
    pub(super) fn shown(&self, path: &Path) -> String {
        path.strip_prefix(&self.root).unwrap_or(path).display().to_string()
    }
}

/// Finds the project: `named`, else `STRIAE_PROJECT`, else from the current folder upwards.
pub(super) fn find(named: Option<&Path>) -> Result<Project, ProjectError> {
    if let Some(folder) = named {
        return named_project(folder, "--project");
    }
    if let Some(folder) = std::env::var_os("STRIAE_PROJECT").filter(|value| !value.is_empty()) {
        return named_project(Path::new(&folder), "STRIAE_PROJECT");
    }
    let from = std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."));
    from.ancestors()
        .find(|folder| {
            folder.join("fits").is_dir()
                && (folder.join("Cargo.toml").is_file() || folder.join("fits/gates.toml").is_file())
        })
        .map(|folder| Project { root: folder.to_path_buf() })
        .ok_or(ProjectError::NotFound { from })
}

fn named_project(folder: &Path, by: &'static str) -> Result<Project, ProjectError> {
    if folder.join("fits").is_dir() {
        Ok(Project { root: folder.to_path_buf() })
    } else {
        Err(ProjectError::NotOne { folder: folder.to_path_buf(), by })
    }
}
