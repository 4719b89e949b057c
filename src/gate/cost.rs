//! Gates on what a candidate costs relative to another, counted in machine code.

use std::collections::BTreeMap;

use super::evidence::{Found, parted};
use super::{Evidence, Gate, GateError, Judgement, Metric, Reached};
use crate::counted::GpuTarget;
use crate::effect::Candidate;
use crate::form::Form;
use crate::numeric::measured::Measured;

/// The ratio of each gate on a cost, by the position of the gate; or why the gate fails.
pub(super) type CostRatios = BTreeMap<usize, Found<Measured<f64>>>;

/// A gate with its candidate and the one that it is relative to.
type Pair<'g> = (&'g Gate, GpuTarget, Candidate, Candidate);

impl Evidence<'_> {
    /// Counts what every gate on a cost needs, a target in one process.
    pub(super) fn count(&mut self, gates: &[Gate]) -> Result<(), GateError> {
        let mut pairs: Vec<Pair<'_>> = Vec::new();
        for gate in gates.iter().filter(|gate| gate.metric == Metric::Cost) {
            let (Some(target), Some(other)) = (gate.target, &gate.relative_to) else {
                return Err(gate.fault("cost needs relative_to and target".to_owned()));
            };
            let own = self.candidate(gate, &gate.subject)?;
            match (own, self.candidate(gate, other)?) {
                (Ok(own), Ok(other)) => pairs.push((gate, target, own, other)),
                (Err(reason), _) | (_, Err(reason)) => {
                    self.costs.insert(gate.index, Err(reason));
                }
            }
        }
        for target in GpuTarget::ALL {
            let own = || pairs.iter().filter(|(_, of, ..)| *of == target);
            let of = |candidate: &'_ Candidate| -> (Form, Vec<f32>) {
                (candidate.form.clone(), candidate.constants_f32.clone())
            };
            let forms: Vec<(Form, Vec<f32>)> =
                own().flat_map(|(_, _, own, other)| [of(own), of(other)]).collect();
            if forms.is_empty() {
                continue;
            }
            let forms: Vec<(&Form, &[f32])> =
                forms.iter().map(|(form, constants)| (form, constants.as_slice())).collect();
            let costs = self.of.counter.costs(&[target], &forms).swap_remove(0);
            for ((gate, ..), costs) in own().zip(costs.chunks(2)) {
                let ratio = match costs {
                    [Measured::Value(own), Measured::Value(other)] => match own.over(other) {
                        Some(ratio) => Ok(Measured::Value(ratio)),
                        None => Err("what it is relative to costs as good as nothing".to_owned()),
                    },
                    [Measured::NotMeasured(reason), _] | [_, Measured::NotMeasured(reason)] => {
                        Ok(Measured::NotMeasured(reason.clone()))
                    }
                    _ => Err("was not counted".to_owned()),
                };
                self.costs.insert(gate.index, ratio);
            }
        }
        Ok(())
    }

    /// The candidate that `subject` names: of a family the first.
    fn candidate(&mut self, gate: &Gate, subject: &str) -> Result<Found<Candidate>, GateError> {
        let (name, member) = parted(subject);
        let standing = match self.standing(gate, name)? {
            Ok(standing) => standing,
            Err(reason) => return Ok(Err(reason)),
        };
        let wanted = |candidate: &&Candidate| {
            member.is_none_or(|_| candidate.name == subject || candidate.name == name)
        };
        let found = standing.candidates.iter().find(wanted).cloned();
        found.map(Ok).ok_or_else(|| gate.unknown(format!("there is no candidate `{subject}`")))
    }

    /// The verdict of a gate on a cost.
    pub(super) fn cost(&self, gate: &Gate) -> Judgement {
        match self.costs.get(&gate.index) {
            Some(Ok(Measured::Value(ratio))) => Judgement::of(gate.clone(), reached(gate, *ratio)),
            Some(Ok(Measured::NotMeasured(reason))) => {
                Judgement::not_measured(gate.clone(), reason)
            }
            Some(Err(reason)) => Judgement::failed(gate.clone(), reason),
            None => Judgement::failed(gate.clone(), "was not counted"),
        }
    }
}

fn reached(gate: &Gate, value: f64) -> Reached {
    let of = gate.target.map(|target| target.to_string());
    Reached { value, at: BTreeMap::new(), of, count: 1 }
}
