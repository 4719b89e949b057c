//! Everything that `striae check` holds a project to.

use serde::Serialize;

use super::{
    Evidence, Gate, GateError, Judgement, Proofs, Reproduction, Verdict, judge, prove, refit,
    reproduce,
};
use crate::counted::Counter;
use crate::fit::{self, Spec};
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::project::Project;
use crate::render::Scenes;
use crate::validate::regions::Atlas;

/// The verdicts on a project.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// One per gate, in the order of the file.
    pub gates: Vec<Judgement>,
    /// One per spec: whether the committed constants come out again.
    pub constants: Vec<Reproduction>,
    /// Whether every gate can fail, if that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proofs: Option<Proofs>,
}

/// What a check takes from a run: a project, and what has been made of it.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'r> {
    /// The project.
    pub project: &'r Project,
    /// Points of regions with the values of references.
    pub atlas: &'r Atlas,
    /// Scenes with their references and pictures.
    pub scenes: &'r Scenes,
    /// What fits share.
    pub fits: &'r fit::Context,
    /// What counts costs, and what it has counted.
    pub counter: &'r Counter,
}

impl Check {
    /// Judges `gates` in the project, whose specs are `specs`; with `proving` also shows
    /// that every gate can fail.
    ///
    /// # Errors
    /// [`GateError`] if gates, specs or results are unusable, as opposed to failing.
    pub fn of(
        of: Sources<'_>,
        gates: &[Gate],
        specs: &[Spec],
        device: &Measured<Device>,
        proving: bool,
    ) -> Result<Self, GateError> {
        let refits = refit(of.fits, specs)?;
        let constants = reproduce::reproduce(of.project.root(), specs, &refits)?;
        let mut evidence = Evidence::new(of, refits);
        let judgements = judge(gates, &mut evidence, device)?;
        let proofs = if proving { Some(prove(gates, &mut evidence, device)?) } else { None };
        Ok(Self { gates: judgements, constants, proofs })
    }

    /// Whether nothing failed. What was not measured did not fail, and is shown as such.
    pub fn passed(&self) -> bool {
        let failed = self.gates.iter().any(|judgement| judgement.verdict == Verdict::Fail)
            || self.constants.iter().any(|constants| constants.verdict == Verdict::Fail);
        !failed && self.proofs.as_ref().is_none_or(|proofs| proofs.defects.is_empty())
    }
}
