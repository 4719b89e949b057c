//! What candidates cost on GPUs that need not be there, beside their errors.

use rayon::prelude::*;
use serde::Serialize;

use super::{Run, RunError};
use crate::counted::{CountedCost, GpuTarget};
use crate::effect::Effect;
use crate::form::Form;
use crate::numeric::measured::Measured;
use crate::numeric::statistics::largest;
use crate::project::Subject;
use crate::validate::cost::{Cost, costs};
use crate::validate::standing::errors;
use crate::validate::study::accuracy_study;
use crate::validate::timed::{baseline, timed};

/// A candidate and its costs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CountedCandidate {
    /// Its name.
    pub name: String,
    /// The candidate that ratios refer to; none beside what approximates no reference.
    pub baseline: Option<String>,
    /// What it costs on each target.
    pub costs: Vec<OnTarget>,
}

/// A cost on one target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OnTarget {
    /// The target.
    pub target: GpuTarget,
    /// The cost of one evaluation.
    pub counted: Measured<CountedCost>,
    /// The cost over that of the baseline; none without one.
    pub ratio: Option<f64>,
}

impl Run {
    /// Counts what `subjects`, and their baselines, cost on `targets`.
    ///
    /// # Errors
    /// If the subjects of the project, among which baselines are, cannot be read.
    pub fn counted(
        &self,
        subjects: &[Subject],
        targets: &[GpuTarget],
    ) -> Result<Vec<CountedCandidate>, RunError> {
        let all = self.project.subjects()?;
        let beside = |subject: &Subject| {
            let effect = self.effect_of(subject)?;
            baseline(effect, &all, subject)
        };
        let baselines: Vec<Option<&Subject>> = subjects.iter().map(beside).collect();
        let candidate = |subject: &'_ Subject| subject.candidates.first().cloned();
        let counted: Vec<_> = subjects.iter().chain(baselines.iter().copied().flatten()).collect();
        let mut names = Vec::new();
        let mut candidates = Vec::new();
        for subject in counted {
            if let Some(candidate) = candidate(subject)
                && !names.contains(&subject.name.as_str())
            {
                names.push(subject.name.as_str());
                candidates.push(candidate);
            }
        }
        let forms: Vec<(&Form, &[f32])> =
            candidates.iter().map(|of| (&of.form, of.constants_f32.as_slice())).collect();
        let costs = self.counter.costs(targets, &forms);
        let place = |name: &str| names.iter().position(|known| *known == name);
        let on = |subject: &Subject, baseline: Option<&Subject>| {
            let (own, base) = (place(&subject.name), baseline.and_then(|base| place(&base.name)));
            let on_target = |(target, costs): (&GpuTarget, &Vec<Measured<CountedCost>>)| {
                let cost = |at: Option<usize>| costs.get(at?)?.value();
                let missing = || Measured::NotMeasured("it has no constants yet".to_owned());
                OnTarget {
                    target: *target,
                    counted: own.map_or_else(missing, |at| costs[at].clone()),
                    ratio: cost(own).zip(cost(base)).and_then(|(own, base)| own.over(base)),
                }
            };
            targets.iter().zip(&costs).map(on_target).collect()
        };
        let counted = subjects.iter().zip(baselines).map(|(subject, base)| CountedCandidate {
            name: subject.name.clone(),
            baseline: base.map(|base| base.name.clone()),
            costs: on(subject, base),
        });
        Ok(counted.collect())
    }

    /// The largest error in f32 over all regions of each subject by itself, in the unit of its yardstick;
    /// none of what approximates neither a reference nor a family.
    ///
    /// # Errors
    /// If a form or a reference fails, or a family cannot be made.
    pub fn errors(&self, subjects: &[Subject]) -> Result<Vec<Option<f64>>, RunError> {
        let own = |effect: &Effect| -> Vec<Subject> {
            let of = |subject: &&Subject| {
                self.effect_of(subject).is_some_and(|own| own.name == effect.name)
            };
            subjects.iter().filter(of).cloned().collect()
        };
        let effects: Vec<(&'static Effect, Vec<Subject>)> = self
            .project
            .registry()
            .effects()
            .iter()
            .map(|effect| (*effect, own(effect)))
            .filter(|(_, own)| !own.is_empty())
            .collect();
        let studies = effects
            .par_iter()
            .map(|(effect, own)| {
                let members = self.members(effect)?;
                Ok(accuracy_study(effect, own, &members, &self.project, &self.atlas)?)
            })
            .collect::<Result<Vec<_>, RunError>>()?;
        let error = |subject: &Subject| {
            let found = studies.iter().map(|study| errors(study, &subject.name));
            let found: Vec<_> = found.flatten().collect();
            (!found.is_empty()).then(|| largest(found.into_iter().map(|(_, error)| error)))
        };
        Ok(subjects.iter().map(error).collect())
    }

    /// Times of `subjects` and their baselines on the device.
    ///
    /// # Errors
    /// If a form or the device fails.
    pub fn timed(&self, subjects: &[Subject]) -> Result<Vec<Cost>, RunError> {
        let all = self.project.subjects()?;
        let mut found = Vec::new();
        for effect in self.project.registry().effects() {
            let own = |subject: &&Subject| {
                self.effect_of(subject).is_some_and(|own| own.name == effect.name)
            };
            let mut together: Vec<Subject> = subjects.iter().filter(own).cloned().collect();
            let baselines: Vec<Subject> = together
                .iter()
                .filter_map(|subject| baseline(effect, &all, subject).cloned())
                .collect();
            for subject in baselines {
                if !together.iter().any(|known| known.name == subject.name) {
                    together.insert(0, subject);
                }
            }
            if together.is_empty() {
                continue;
            }
            let members = self.members(effect)?;
            let groups = timed(effect, &together, &members, &self.project, &self.atlas)?;
            found.extend(
                costs(effect.name, &groups, &[], &self.device, &self.timing, &self.counter)?.forms,
            );
        }
        Ok(found)
    }

    /// The effect whose reference or family a subject approximates.
    fn effect_of(&self, subject: &Subject) -> Option<&'static Effect> {
        use crate::project::Approximated::{Family, Reference, Table};
        let registry = self.project.registry();
        match &subject.approximates {
            Reference(name) => registry.reference(name).map(|(effect, _)| effect),
            Family(name) => registry.family(name).map(|(effect, _)| effect),
            Table => None,
        }
    }
}
