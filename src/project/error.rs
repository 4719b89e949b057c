//! Why something of a project could not be had.

use std::path::PathBuf;

use crate::effect::CandidateError;
use crate::fit::FitError;
use crate::form::FormError;
use crate::registry::RegistryError;

/// Why a project, or something in it, could not be had.
#[derive(Debug, thiserror::Error)]
pub enum ProjectError {
    /// No folder upwards is a project.
    #[error(
        "no project in {from} or above: expected a folder with `fits/` and Cargo.toml, \
         fits/gates.toml or forms/; name one with --project or STRIAE_PROJECT"
    )]
    NotFound {
        /// Where the search began.
        from: PathBuf,
    },
    /// A form of the folder `forms/` cannot be registered.
    #[error(transparent)]
    Forms(#[from] RegistryError),
    /// A file or folder cannot be read.
    #[error("{path}: {source}")]
    Io {
        /// The path.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// A spec has no result.
    #[error("{fit} has no result yet: run `striae fit {fit}`")]
    NoResult {
        /// The fit.
        fit: String,
    },
    /// A name stands for nothing.
    #[error("there is no {what} `{name}`{}", nearest_words(.nearest))]
    Unknown {
        /// What was looked for.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest that there are.
        nearest: Vec<String>,
    },
    /// A name stands for something else than was asked for, or for nothing in particular.
    #[error("{name}: {what}")]
    Name {
        /// The name, or the file or folder that it stands for.
        name: String,
        /// What is wrong with it.
        what: String,
    },
    /// A form cannot be loaded.
    #[error(transparent)]
    Form(#[from] FormError),
    /// A constant has no value.
    #[error(transparent)]
    Candidate(#[from] CandidateError),
    /// A spec or a result cannot be read.
    #[error(transparent)]
    Fit(#[from] FitError),
}

fn nearest_words(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        names => format!("; the nearest: {}", names.join(", ")),
    }
}

impl ProjectError {
    pub(super) fn io(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.display().to_string();
        move |source| Self::Io { path, source }
    }
}
