//! Judges gates.

use rayon::prelude::*;

use super::drift::drift;
use super::subject::{Subject, reached, worst};
use super::{Evidence, Gate, GateError, Judgement, Metric, Precision};
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::validate::ValidateError;

/// Judges every gate, in the order of the file.
///
/// # Errors
/// [`GateError`] if a gate names what does not exist or does not fit its subject, or something
/// that it needs cannot be read or evaluated. A gate that merely cannot be measured as the project
/// stands fails with the reason; one that lacks a device is not measured.
pub fn judge(
    gates: &[Gate],
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
) -> Result<Vec<Judgement>, GateError> {
    let prepared = gates.iter().map(|gate| prepare(gate, evidence, device));
    let prepared = prepared.collect::<Result<Vec<_>, _>>()?;
    let judged = prepared.into_par_iter().zip(gates).map(|(prepared, gate)| match prepared {
        Prepared::Judged(judgement) => Ok(*judgement),
        Prepared::OnLanes(subject) => on_lanes_or_device(gate, &subject, None),
    });
    judged.collect()
}

/// A gate that is judged, or that lanes will judge beside others.
enum Prepared {
    Judged(Box<Judgement>),
    OnLanes(Box<Subject>),
}

fn prepare(
    gate: &Gate,
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
) -> Result<Prepared, GateError> {
    let judged = |judgement| Ok(Prepared::Judged(Box::new(judgement)));
    if gate.scene().is_some() {
        if let (Precision::Device, Measured::NotMeasured(reason)) = (gate.precision, device) {
            return judged(Judgement::not_measured(gate.clone(), reason.clone()));
        }
        let reached = evidence.scene(gate)?.reached(gate, device.value())?;
        return judged(Judgement::of(gate.clone(), reached));
    }
    let subject = match evidence.subject(gate)? {
        Ok(subject) => subject,
        Err(reason) => return judged(Judgement::failed(gate.clone(), reason)),
    };
    if gate.metric == Metric::Drift {
        return judged(match drift(gate, evidence.project().root(), &subject) {
            Ok(reached) => Judgement::of(gate.clone(), reached),
            Err(reason) => Judgement::failed(gate.clone(), reason),
        });
    }
    match (gate.precision, device) {
        (Precision::Device, Measured::NotMeasured(reason)) => {
            judged(Judgement::not_measured(gate.clone(), reason.clone()))
        }
        (Precision::Device, Measured::Value(device)) => {
            judged(on_lanes_or_device(gate, &subject, Some(device))?)
        }
        (Precision::F64 | Precision::F32, _) => Ok(Prepared::OnLanes(Box::new(subject))),
    }
}

fn on_lanes_or_device(
    gate: &Gate,
    subject: &Subject,
    device: Option<&Device>,
) -> Result<Judgement, GateError> {
    Ok(match measure(gate, subject, device)? {
        Some(reached) => Judgement::of(gate.clone(), reached),
        None => Judgement::failed(gate.clone(), "the fit has no members"),
    })
}

fn measure(
    gate: &Gate,
    subject: &Subject,
    device: Option<&Device>,
) -> Result<Option<super::Reached>, ValidateError> {
    let all = subject.instances.iter().map(|instance| {
        let label = instance.label.as_deref();
        let (candidate, target) = (&instance.candidate, &instance.target);
        reached(label, candidate, target, gate.metric, gate.precision, device)
    });
    Ok(worst(all.collect::<Result<Vec<_>, _>>()?))
}
