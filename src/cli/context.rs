//! What every verb is given: where it works, and how it talks.

use std::sync::Arc;

use anyhow::Context as _;

use super::Global;
use super::output::Output;
use crate::effect::Effect;
use crate::project::{Project, ProjectError, nearest};
use crate::registry::Registry;
use crate::run::{self, Run};

/// The surroundings of one run.
#[derive(Debug)]
pub(super) struct Context {
    pub(super) output: Output,
    pub(super) seed: Option<u64>,
    project: Result<Project, Arc<ProjectError>>,
}

impl Context {
    /// Finds the project, registers its own forms, and sets the number of threads.
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
            project: match Project::find(global.project.as_deref(), Registry::builtin()) {
                // With a form at fault no name is sure to mean what it should: no verb goes on.
                Err(error @ ProjectError::Forms(_)) => return Err(error.into()),
                found => found.map_err(Arc::new),
            },
        })
    }

    /// The project, for verbs that cannot do without.
    pub(super) fn project(&self) -> anyhow::Result<&Project> {
        self.project.as_ref().map_err(|error| anyhow::Error::new(Arc::clone(error)))
    }

    pub(super) fn has_project(&self) -> bool {
        self.project.is_ok()
    }

    /// The project, or the current folder taken as one, for verbs that can do without.
    pub(super) fn project_or_here(&self) -> Project {
        match &self.project {
            Ok(project) => project.clone(),
            Err(_) => Project::at(".", Registry::builtin()),
        }
    }

    /// A run of the project on the device, if there is one.
    pub(super) fn run(&self) -> anyhow::Result<Run> {
        Ok(Run::new(self.project()?, run::device()?))
    }

    /// The effects called `names`, or all of them.
    pub(super) fn effects(&self, names: &[String]) -> anyhow::Result<Vec<&'static Effect>> {
        let registry = self.project_or_here().registry().clone();
        if names.is_empty() {
            return Ok(registry.effects().to_vec());
        }
        let known = || registry.effects().iter().map(|effect| effect.name.to_owned());
        let of = |name: &String| {
            registry.effect(name).with_context(|| {
                let nearest = nearest(name, known()).join(", ");
                format!("there is no effect `{name}`; the nearest: {nearest}")
            })
        };
        names.iter().map(of).collect()
    }
}
