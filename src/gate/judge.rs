//! Judges gates.

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
    gates.iter().map(|gate| judge_one(gate, evidence, device)).collect()
}

fn judge_one(
    gate: &Gate,
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
) -> Result<Judgement, GateError> {
    if gate.scene().is_some() {
        if let (Precision::Device, Measured::NotMeasured(reason)) = (gate.precision, device) {
            return Ok(Judgement::not_measured(gate.clone(), reason.clone()));
        }
        let reached = evidence.scene(gate)?.reached(gate, device.value())?;
        return Ok(Judgement::of(gate.clone(), reached));
    }
    let subject = match evidence.subject(gate)? {
        Ok(subject) => subject,
        Err(reason) => return Ok(Judgement::failed(gate.clone(), reason)),
    };
    if gate.metric == Metric::Drift {
        return Ok(match drift(gate, evidence.project().root(), &subject) {
            Ok(reached) => Judgement::of(gate.clone(), reached),
            Err(reason) => Judgement::failed(gate.clone(), reason),
        });
    }
    if let (Precision::Device, Measured::NotMeasured(reason)) = (gate.precision, device) {
        return Ok(Judgement::not_measured(gate.clone(), reason.clone()));
    }
    Ok(match measure(gate, &subject, device.value())? {
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
