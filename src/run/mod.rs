//! A run: what a project is measured with, each expensive thing once, whoever asks.

mod accuracy;
mod checking;
mod costs;
mod counting;
mod fitting;
mod reporting;

use rayon::prelude::*;

pub use accuracy::{accuracy_table, write_accuracy};
pub use costs::{cost_table, counted_table, write_costs, write_counted};
pub use counting::{CountedCandidate, OnTarget};
pub use fitting::{Job, fit};

use crate::counted::Counter;
use crate::effect::{Candidates, Effect, Member};
use crate::fit;
use crate::gpu::{self, Device, TimingOptions};
use crate::numeric::measured::Measured;
use crate::project::{Project, Subject};
use crate::render::Scenes;
use crate::validate::ValidateError;
use crate::validate::cost::{Costs, Timed, TimedReference, costs, counted};
use crate::validate::regions::Atlas;
use crate::validate::study::{Study, study};
use crate::validate::timed::{timed, timed_references};

/// A project, the device, and what was made of them so far.
#[derive(Debug)]
pub struct Run {
    /// The project.
    pub project: Project,
    /// The device, or why there is none.
    pub device: Measured<Device>,
    /// Points of regions with the values of references.
    pub atlas: Atlas,
    /// Scenes with their references and pictures.
    pub scenes: Scenes,
    /// What fits share.
    pub fits: fit::Context,
    /// What counts costs on GPUs that need not be there, and what it has counted.
    pub counter: Counter,
    /// How kernels are timed: briefly, unless a caller wants more.
    pub timing: TimingOptions,
}

/// An effect, measured.
#[derive(Debug)]
pub struct Studied {
    /// The effect.
    pub effect: &'static Effect,
    /// What was judged.
    pub subjects: Vec<Subject>,
    /// Accuracy, laws, parity, claims and exhibits.
    pub study: Study,
    /// Costs.
    pub costs: Costs,
    /// Held-out members of each family; none where the project has no folder of measured data.
    pub members: Vec<Vec<Member>>,
}

/// An effect, measured but for its costs, with what is timed.
struct Judged {
    effect: &'static Effect,
    subjects: Vec<Subject>,
    study: Study,
    forms: Vec<Vec<Timed>>,
    references: Vec<TimedReference>,
    members: Vec<Vec<Member>>,
}

/// Why a run ended.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Something of the project could not be had.
    #[error(transparent)]
    Project(#[from] crate::project::ProjectError),
    /// A fit could not be run.
    #[error(transparent)]
    Fit(#[from] fit::FitError),
    /// A fit takes constants from one that failed.
    #[error("{fit}: its source {source_fit} failed")]
    Source {
        /// The fit.
        fit: String,
        /// The fit that failed.
        source_fit: String,
    },
    /// A candidate could not be judged.
    #[error(transparent)]
    Validate(Box<ValidateError>),
    /// Gates could not be judged.
    #[error(transparent)]
    Gate(Box<crate::gate::GateError>),
    /// A scene could not be rendered.
    #[error("{scene}: {source}")]
    Scene {
        /// Its file.
        scene: String,
        /// Why.
        source: Box<crate::render::RenderError>,
    },
    /// A family of tables could not be made.
    #[error("{family}: {source}")]
    Family {
        /// The family.
        family: &'static str,
        /// Why.
        source: crate::effect::FamilyError,
    },
    /// The report could not be written.
    #[error(transparent)]
    Site(#[from] crate::report::html::SiteError),
    /// A folder could not be made.
    #[error("{path}: {source}")]
    Io {
        /// The folder.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] crate::table::TableError),
    /// A picture of the report could not be made.
    #[error(transparent)]
    Render(Box<crate::render::RenderError>),
}

impl From<ValidateError> for RunError {
    fn from(error: ValidateError) -> Self {
        Self::Validate(Box::new(error))
    }
}

impl From<crate::gate::GateError> for RunError {
    fn from(error: crate::gate::GateError) -> Self {
        Self::Gate(Box::new(error))
    }
}

impl From<crate::render::RenderError> for RunError {
    fn from(error: crate::render::RenderError) -> Self {
        Self::Render(Box::new(error))
    }
}

/// The device, or why there is none.
///
/// # Errors
/// [`gpu::NoDevice`] if one is required (`STRIAE_REQUIRE_GPU=1`).
pub fn device() -> Result<Measured<Device>, gpu::NoDevice> {
    match Device::open() {
        Ok(device) => Ok(Measured::Value(device)),
        Err(error) if gpu::required() => Err(error),
        Err(error) => Ok(Measured::NotMeasured(error.to_string())),
    }
}

impl Run {
    /// A run of `project` in which nothing has been made.
    pub fn new(project: &Project, device: Measured<Device>) -> Self {
        Self {
            project: project.clone(),
            device,
            atlas: Atlas::default(),
            scenes: Scenes::default(),
            fits: fit::Context::new(project.root(), project.registry()),
            counter: Counter::default(),
            timing: TimingOptions::brief(),
        }
    }

    /// Measures every effect of `effects` that is judged.
    ///
    /// # Errors
    /// If a result, a form, a reference or the device fails; a missing device is not an error.
    pub fn studies(
        &self,
        effects: &[&'static Effect],
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Vec<Studied>, RunError> {
        let subjects = self.project.subjects()?;
        let all = subjects.iter().flat_map(|subject| &subject.candidates).cloned();
        let candidates: Candidates = all.map(std::sync::Arc::new).collect();
        let judged: Vec<Result<Judged, RunError>> = effects
            .par_iter()
            .map(|effect| {
                watch(effect.name);
                let own = subjects.iter().filter(|subject| subject.is_of(effect.name)).cloned();
                self.judge(effect, own.collect(), &candidates)
            })
            .collect();
        // Every effect together: one process counts on a target.
        let judged = judged.into_iter().collect::<Result<Vec<_>, _>>()?;
        let timed = judged.iter().flat_map(|judged| &judged.forms).flatten();
        counted(&self.counter, &timed.map(|timed| &timed.candidate).collect::<Vec<_>>());
        // Nothing else runs beside what is timed.
        judged.into_iter().map(|judged| self.with_costs(judged)).collect()
    }

    fn judge(
        &self,
        effect: &'static Effect,
        subjects: Vec<Subject>,
        candidates: &Candidates,
    ) -> Result<Judged, RunError> {
        let members = self.members(effect)?;
        let Self { project, atlas, device, .. } = self;
        let study = study(effect, &subjects, &members, candidates, project, atlas, device)?;
        let forms = timed(effect, &subjects, &members, project, atlas)?;
        let references = timed_references(effect, atlas)?;
        Ok(Judged { effect, subjects, study, forms, references, members })
    }

    /// Held-out members of each family of `effect`.
    fn members(&self, effect: &'static Effect) -> Result<Vec<Vec<Member>>, RunError> {
        // A project of the user's own may have no measured data: its families are not measured.
        let families = match self.project.data().is_dir() {
            true => effect.families,
            false => &[],
        };
        families
            .par_iter()
            .map(|family| {
                (family.members)(&self.project.data(), true)
                    .map_err(|source| RunError::Family { family: family.name, source })
            })
            .collect()
    }

    fn with_costs(&self, judged: Judged) -> Result<Studied, RunError> {
        let Judged { effect, subjects, study, forms, references, members } = judged;
        let Self { device, timing, counter, .. } = self;
        let costs = costs(effect.name, &forms, &references, device, timing, counter)?;
        Ok(Studied { effect, subjects, study, costs, members })
    }
}
