//! Shows that gates can fail: moves each constant until its gates notice.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;
use serde::Serialize;

use super::subject::{Instance, Lever, Subject};
use super::{Evidence, Gate, GateError, Metric, Precision, SCENES};
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::render::shading::Moved;

/// Relative steps, tried in this order with both signs. A constant that can move by 30 % unnoticed
/// is not guarded.
const STEPS: [f64; 8] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3];

/// What is moved of a cost.
const COST: &str = "cost";

/// Whether a gate notices a constant.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Proof {
    /// Position of the gate in its file, from 1.
    pub gate: usize,
    /// Its line, from 1.
    pub line: usize,
    /// Its subject.
    pub subject: String,
    /// Its metric.
    pub metric: Metric,
    /// The constant that was moved, or `output` for all values of a form without constants.
    pub constant: String,
    /// The smallest step, relative, that fails the gate; none if no step does.
    pub step: Option<f64>,
    /// What the metric reaches there.
    pub value: Option<f64>,
    /// The gate's limit.
    pub limit: f64,
    /// Fits of the subject that fail the gate when the constant moves in them alone.
    pub alone: usize,
    /// Fits of the subject.
    pub of: usize,
}

/// The proofs of all gates, and what they leave open.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Proofs {
    /// One per gate and constant.
    pub proofs: Vec<Proof>,
    /// Gates that nothing trips, constants that no gate guards, gates that could not be tried.
    pub defects: Vec<String>,
    /// Gates that were tried on f32 lanes because there is no device.
    pub without_device: usize,
}

/// Moves every constant of every gate's subject until the gate fails.
///
/// # Errors
/// [`GateError`], as for [`super::judge`].
pub(super) fn prove(
    gates: &[Gate],
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
) -> Result<Proofs, GateError> {
    let mut found = Proofs::default();
    let mut tasks = Vec::new();
    for gate in gates {
        if gate.precision == Precision::Device && device.value().is_none() {
            found.without_device += 1;
        }
        if gate.scene().is_some() {
            prove_scene(gate, evidence, device, &mut found)?;
            continue;
        }
        if gate.metric == Metric::Cost {
            prove_cost(gate, evidence, &mut found);
            continue;
        }
        match evidence.subject(gate)? {
            Ok(subject) => tasks.push((gate, subject)),
            Err(reason) => {
                found.defects.push(format!("{} cannot be tried: {reason}", name(gate)));
            }
        }
    }
    // Beside each other on lanes; one after the other on a device, whose queue is one.
    let prove = |(gate, subject): &(&Gate, Subject)| prove_subject(gate, subject, device.value());
    let on_device = |gate: &Gate| gate.precision == Precision::Device && device.value().is_some();
    let lanes: Vec<_> = tasks
        .par_iter()
        .map(|task| if on_device(task.0) { Ok(None) } else { prove(task).map(Some) })
        .collect::<Result<_, GateError>>()?;
    for (task, done) in tasks.iter().zip(lanes) {
        match done.map_or_else(|| prove(task), Ok)? {
            Ok(proofs) => found.proofs.extend(proofs),
            Err(defect) => found.defects.push(defect),
        }
    }
    let of_fits = gates.iter().filter(|gate| gate.scene().is_none());
    let sources: BTreeMap<String, Vec<String>> = of_fits
        .map(|gate| (gate.subject.clone(), evidence.sources(gate)))
        .filter(|(_, sources)| !sources.is_empty())
        .collect();
    found.defects.extend(defects(&found.proofs, &sources));
    Ok(found)
}

/// One proof per lever of a subject, or why there is nothing to show.
fn prove_subject(
    gate: &Gate,
    subject: &Subject,
    device: Option<&Device>,
) -> Result<Result<Vec<Proof>, String>, GateError> {
    // What cannot be measured fails the gate, as what is not a number does.
    let value = |instance: &Instance, moved: Option<(&Lever, f64)>| -> Result<f64, GateError> {
        let reached = subject.reached(instance, gate, moved, device)?;
        Ok(reached.map_or(f64::NAN, |reached| reached.value))
    };
    for instance in &subject.instances {
        if gate.metric.worse(value(instance, None)?, gate.limit) {
            return Ok(Err(format!("{} fails as it stands: nothing to show", name(gate))));
        }
    }
    let mut levers: Vec<&Lever> = Vec::new();
    for lever in subject.instances.iter().flat_map(|instance| &instance.levers) {
        if !levers.iter().any(|known| known.name() == lever.name()) {
            levers.push(lever);
        }
    }
    let proof = |lever: &Lever| {
        let mut proof = unproved(gate, lever.name(), subject.instances.len());
        for instance in &subject.instances {
            proof.take(smallest(|step| {
                let value = value(instance, Some((lever, step)))?;
                Ok::<_, GateError>(gate.metric.worse(value, gate.limit).then_some((step, value)))
            })?);
        }
        Ok(proof)
    };
    Ok(Ok(levers.into_iter().map(proof).collect::<Result<_, GateError>>()?))
}

/// Moves the constants of the forms that shade a scene until one trips the gate: the others are
/// guarded by the gates on the fits that they come from.
fn prove_scene(
    gate: &Gate,
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
    found: &mut Proofs,
) -> Result<(), GateError> {
    let subject = evidence.scene(gate)?;
    if gate.metric.worse(subject.reached(gate, None, device.value())?.value, gate.limit) {
        found.defects.push(format!("{} fails as it stands: nothing to show", name(gate)));
        return Ok(());
    }
    let mut proof = unproved(gate, Lever::Output.name(), 1);
    let constants = subject.constants();
    let trip = smallest(|step| {
        for constant in &constants {
            let moved = Some(Moved { constant, step });
            let value = subject.reached(gate, moved, device.value())?.value;
            if gate.metric.worse(value, gate.limit) {
                return Ok(Some((constant.clone(), step, value)));
            }
        }
        Ok::<_, GateError>(None)
    })?;
    if let Some((constant, step, value)) = trip {
        proof.constant = constant;
        proof.take(Some((step, value)));
    }
    found.proofs.push(proof);
    Ok(())
}

/// Adds to the cost until the gate fails; one that is not counted here is not tried.
fn prove_cost(gate: &Gate, evidence: &Evidence<'_>, found: &mut Proofs) {
    let Some(reached) = evidence.cost(gate).measured else { return };
    if gate.metric.worse(reached.value, gate.limit) {
        found.defects.push(format!("{} fails as it stands: nothing to show", name(gate)));
        return;
    }
    let mut proof = unproved(gate, COST, 1);
    let mut moved = STEPS.into_iter().map(|step| (step, reached.value * (1.0 + step)));
    proof.take(moved.find(|(_, value)| gate.metric.worse(*value, gate.limit)));
    found.proofs.push(proof);
}

fn name(gate: &Gate) -> String {
    format!("gate {} (line {}) on {} {}", gate.index, gate.line, gate.subject, gate.metric)
}

fn unproved(gate: &Gate, constant: &str, of: usize) -> Proof {
    Proof {
        gate: gate.index,
        line: gate.line,
        subject: gate.subject.clone(),
        metric: gate.metric,
        constant: constant.to_owned(),
        step: None,
        value: None,
        limit: gate.limit,
        alone: 0,
        of,
    }
}

impl Proof {
    /// Notes what one fit of the subject shows. The worst of a family fails as soon as one does, so
    /// the smallest step of any fit is that of the whole.
    fn take(&mut self, trip: Option<(f64, f64)>) {
        let Some((step, value)) = trip else { return };
        self.alone += 1;
        if self.step.is_none_or(|smallest| step.abs() < smallest.abs()) {
            (self.step, self.value) = (Some(step), Some(value));
        }
    }
}

/// What trips at the smallest of [`STEPS`], of either sign, at which something does.
///
/// Looked for by bisection, since an error grows with the step; where that finds nothing, step by step.
fn smallest<T, E>(mut trips: impl FnMut(f64) -> Result<Option<T>, E>) -> Result<Option<T>, E> {
    let mut trips = |size: f64| match trips(size)? {
        None => trips(-size),
        found => Ok(found),
    };
    let (mut low, mut high) = (0, STEPS.len());
    let mut found = None;
    let mut tried = [false; STEPS.len()];
    while low < high {
        let middle = (low + high) / 2;
        tried[middle] = true;
        match trips(STEPS[middle])? {
            Some(trip) => (found, high) = (Some(trip), middle),
            None => low = middle + 1,
        }
    }
    for (step, tried) in STEPS.iter().zip(tried) {
        if found.is_none() && !tried {
            found = trips(*step)?;
        }
    }
    Ok(found)
}

/// What the proofs leave open. A constant that a fit takes from another is guarded where it is
/// fitted.
fn defects(proofs: &[Proof], sources: &BTreeMap<String, Vec<String>>) -> Vec<String> {
    let mut defects = Vec::new();
    let mut gates: BTreeMap<usize, (bool, &Proof)> = BTreeMap::new();
    let mut guarded: BTreeSet<(&str, &str)> = BTreeSet::new();
    for proof in proofs {
        let tripped = proof.step.is_some();
        gates.entry(proof.gate).or_insert((false, proof)).0 |= tripped;
        if tripped {
            guarded.insert((fit(proof), &proof.constant));
        }
    }
    for (tripped, proof) in gates.values() {
        if !tripped {
            defects.push(format!(
                "gate {} (line {}) on {} {} cannot fail: no constant trips its limit {}",
                proof.gate, proof.line, proof.subject, proof.metric, proof.limit
            ));
        }
    }
    let constants: BTreeSet<(&str, &str)> =
        proofs.iter().map(|proof| (fit(proof), proof.constant.as_str())).collect();
    let inherited = |fit: &str, constant: &str| {
        sources.get(fit).is_some_and(|from| {
            from.iter().any(|source| guarded.contains(&(source.as_str(), constant)))
        })
    };
    let unguarded =
        constants.difference(&guarded).filter(|(fit, constant)| !inherited(fit, constant));
    for (fit, constant) in unguarded.filter(|(fit, _)| !fit.starts_with(SCENES)) {
        defects.push(format!("{fit}: no gate guards the constant `{constant}`"));
    }
    defects
}

fn fit(proof: &Proof) -> &str {
    proof.subject.split('#').next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proof(gate: usize, constant: &str, step: Option<f64>) -> Proof {
        Proof {
            gate,
            line: gate,
            subject: "e/f".to_owned(),
            metric: Metric::Rms,
            constant: constant.to_owned(),
            step,
            value: step,
            limit: 1.0,
            alone: usize::from(step.is_some()),
            of: 1,
        }
    }

    #[test]
    fn a_constant_guarded_by_another_gate_is_guarded() {
        let proofs = [proof(1, "a", Some(0.1)), proof(1, "b", None), proof(2, "b", Some(0.1))];
        assert!(defects(&proofs, &BTreeMap::new()).is_empty());
    }

    #[test]
    fn a_constant_of_another_fit_is_guarded_there() {
        let of = |fit: &str, gate, constant, step| Proof {
            subject: fit.to_owned(),
            ..proof(gate, constant, step)
        };
        let proofs = [
            of("e/whole", 1, "a", Some(0.1)),
            of("e/whole", 1, "b", None),
            of("e/part", 2, "b", Some(0.1)),
        ];
        let sources = BTreeMap::from([("e/whole".to_owned(), vec!["e/part".to_owned()])]);
        assert!(defects(&proofs, &sources).is_empty());
        assert_eq!(defects(&proofs, &BTreeMap::new()).len(), 1);
    }

    #[test]
    fn a_gate_that_nothing_trips_and_its_constant_are_defects() {
        let proofs = [proof(1, "a", Some(0.1)), proof(2, "b", None)];
        let defects = defects(&proofs, &BTreeMap::new());
        assert_eq!(defects.len(), 2, "{defects:?}");
        assert!(defects[0].contains("cannot fail") && defects[1].contains("`b`"), "{defects:?}");
    }
}
