//! What every verb is given: where it works, and how it talks.

use anyhow::Context as _;

use super::Global;
use super::output::Output;
use super::project::{self, Project, ProjectError};

/// The surroundings of one run.
#[derive(Debug)]
pub(super) struct Context {
    /// Where results and notes go.
    pub(super) output: Output,
    /// Seed given on the command line.
    pub(super) seed: Option<u64>,
    project: Result<Project, ProjectError>,
}

impl Context {
    /// Finds the project and sets the number of threads.
    pub(super) fn new(global: &Global) -> anyhow::Result<Self> {
        if let Some(threads) = global.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(usize::from(threads))
                .build_global()
                .context("--threads")?;
        }
        Ok(Self {
            output: Output::new(global.json, global.quiet, global.color),
            seed: global.seed,
            project: project::find(global.project.as_deref()),
        })
    }

    /// The project, for verbs that cannot do without.
    pub(super) fn project(&self) -> anyhow::Result<&Project> {
        self.project.as_ref().map_err(|error| anyhow::Error::new(error.clone()))
    }

    /// The project, for verbs that can.
    pub(super) fn project_if_any(&self) -> Option<&Project> {
        self.project.as_ref().ok()
    }
}
