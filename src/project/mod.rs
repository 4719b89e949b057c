//! Projects: a folder with forms, specs, results, gates, data and scenes, and the registry of what its
//! names mean.
//!
//! | place | what | if it is missing |
//! |---|---|---|
//! | `forms/<folder>/<name>.wgsl` | forms of the user's own, called `<folder>/<name>`; `forms/<name>.wgsl` is `own/<name>` | there are none beside those of the registry |
//! | `fits/<effect>/<name>.toml`, `.json` | specs and results | nothing is fitted |
//! | `fits/gates.toml` | gates | a check refuses; a report says that nothing holds the project |
//! | `data/measured` | measured tables | families and environments are refused by name |
//! | `data/scenes/*.toml` | scenes | there are none |
//! | `reports` | errors and recorded costs, to be committed | it is made |
//! | `reports/latest` | the report, not to be committed | it is made |

mod error;
mod fingerprint;
mod names;
mod specs;
mod subject;

use std::path::{Path, PathBuf};

pub use error::ProjectError;
pub use fingerprint::Fingerprints;
pub use names::nearest;
pub use specs::SpecFile;
pub(crate) use specs::entries;
pub use subject::{Approximated, Fitted, Subject};

use crate::registry::Registry;

/// A folder to work in, and the registry of what its names mean.
#[derive(Debug, Clone)]
pub struct Project {
    root: PathBuf,
    registry: Registry,
}

impl Project {
    /// `root` taken as a project, whether or not anything is in it; its folder `forms/` is not read
    /// ([`Project::open`] does), so that names mean what they mean in `registry`.
    pub fn at(root: impl Into<PathBuf>, registry: &Registry) -> Self {
        Self { root: root.into(), registry: registry.clone() }
    }

    /// `root` as a project, whose folder `forms/`, where there is one, is registered too, as
    /// [`Registry::with_forms_of`] names its forms.
    ///
    /// # Errors
    /// [`ProjectError::Forms`] if a text there is at fault or cannot be read.
    pub fn open(root: impl Into<PathBuf>, registry: &Registry) -> Result<Self, ProjectError> {
        let mut project = Self::at(root, registry);
        if project.forms().is_dir() {
            project.registry = project.registry.clone().with_forms_of(&project.forms())?;
        }
        Ok(project)
    }

    /// The project `named`, else that of `STRIAE_PROJECT`, else the first folder from the current one
    /// upwards that has `fits/` and Cargo.toml, `fits/gates.toml` or `forms/`; opened as by
    /// [`Project::open`].
    ///
    /// # Errors
    /// [`ProjectError::NotFound`], [`ProjectError::Name`] and [`ProjectError::Forms`].
    pub fn find(named: Option<&Path>, registry: &Registry) -> Result<Self, ProjectError> {
        let checked = |folder: &Path, by: &str| match folder.join("fits").is_dir() {
            true => Self::open(folder, registry),
            false => {
                let what = format!("named by {by} as the project, but it has no folder `fits/`");
                Err(ProjectError::Name { name: folder.display().to_string(), what })
            }
        };
        if let Some(folder) = named {
            return checked(folder, "--project");
        }
        if let Some(folder) = std::env::var_os("STRIAE_PROJECT").filter(|value| !value.is_empty()) {
            return checked(Path::new(&folder), "STRIAE_PROJECT");
        }
        let from = std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."));
        let marked = |folder: &&Path| {
            folder.join("fits").is_dir()
                && (folder.join("Cargo.toml").is_file()
                    || folder.join("fits/gates.toml").is_file()
                    || folder.join("forms").is_dir())
        };
        match from.ancestors().find(marked) {
            Some(folder) => Self::open(folder, registry),
            None => Err(ProjectError::NotFound { from }),
        }
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// What names mean here.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// Folder of forms of the user's own.
    pub fn forms(&self) -> PathBuf {
        self.root.join("forms")
    }

    /// Folder of specs, results and gates.
    pub fn fits(&self) -> PathBuf {
        self.root.join("fits")
    }

    /// File of the gates.
    pub fn gates(&self) -> PathBuf {
        self.fits().join("gates.toml")
    }

    /// Folder of what is committed about the project: errors, recorded costs, figures.
    pub fn reports(&self) -> PathBuf {
        self.root.join("reports")
    }

    /// The table of errors.
    pub fn accuracy(&self) -> PathBuf {
        self.reports().join("accuracy.tsv")
    }

    /// Folder of recorded costs.
    pub fn costs(&self) -> PathBuf {
        self.reports().join("costs")
    }

    /// Folder of the full report, which is made anew and not committed.
    pub fn report(&self) -> PathBuf {
        self.reports().join("latest")
    }

    /// Folder of measured data.
    pub fn data(&self) -> PathBuf {
        self.root.join("data/measured")
    }

    /// Folder of scenes.
    pub fn scene_folder(&self) -> PathBuf {
        self.root.join("data/scenes")
    }

    /// Scenes, `data/scenes/*.toml`, by name; none without the folder.
    ///
    /// # Errors
    /// [`ProjectError::Io`] if the folder cannot be read.
    pub fn scenes(&self) -> Result<Vec<PathBuf>, ProjectError> {
        let folder = self.scene_folder();
        if !folder.is_dir() {
            return Ok(Vec::new());
        }
        let toml = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
        Ok(specs::entries(&folder)?.into_iter().filter(toml).collect())
    }

    /// `path` relative to the project where it is inside it, for messages that read the same
    /// everywhere.
    pub fn shown(&self, path: &Path) -> String {
        path.strip_prefix(&self.root).unwrap_or(path).display().to_string()
    }
}
