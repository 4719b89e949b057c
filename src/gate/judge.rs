//! Judges gates.

use rayon::prelude::*;

use super::evidence::Found;
use super::subject::Subject;
use super::{Evidence, Gate, GateError, Judgement, Metric, Precision, Reached};
use crate::gpu::Device;
use crate::numeric::measured::Measured;

/// Judges every gate, in the order of the file.
///
/// # Errors
/// [`GateError`] if a gate names what does not exist or does not fit its subject, or something
/// that it needs cannot be read or evaluated. A gate that merely cannot be measured as the project
/// stands fails with the reason; one that lacks a device is not measured.
pub(super) fn judge(
    gates: &[Gate],
    evidence: &mut Evidence<'_>,
    device: &Measured<Device>,
) -> Result<Vec<Judgement>, GateError> {
    evidence.count(gates)?;
    let prepared = gates.iter().map(|gate| prepare(gate, evidence, device));
    let prepared = prepared.collect::<Result<Vec<_>, _>>()?;
    let judged = prepared.into_par_iter().zip(gates).map(|(prepared, gate)| match prepared {
        Prepared::Judged(judgement) => Ok(*judgement),
        Prepared::OnLanes(subject) => judgement(gate, &subject, None),
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
    if gate.metric == Metric::Cost {
        return judged(evidence.cost(gate));
    }
    let on_device = gate.precision == Precision::Device;
    if gate.scene().is_some() {
        return judged(match device {
            Measured::NotMeasured(reason) if on_device => {
                Judgement::not_measured(gate.clone(), reason)
            }
            _ => {
                let reached = evidence.scene(gate)?.reached(gate, None, device.value())?;
                Judgement::of(gate.clone(), reached)
            }
        });
    }
    match (evidence.subject(gate)?, device) {
        (Err(reason), _) => judged(Judgement::failed(gate.clone(), reason)),
        (Ok(subject), _) if !on_device || subject.shipped.is_some() => {
            Ok(Prepared::OnLanes(Box::new(subject)))
        }
        (Ok(_), Measured::NotMeasured(reason)) => {
            judged(Judgement::not_measured(gate.clone(), reason))
        }
        (Ok(subject), Measured::Value(device)) => judged(judgement(gate, &subject, Some(device))?),
    }
}

/// Holds the worst fit of the subject against the gate; a value that is not a number is worse than any.
fn judgement(
    gate: &Gate,
    subject: &Subject,
    device: Option<&Device>,
) -> Result<Judgement, GateError> {
    let all = subject.instances.iter().map(|of| subject.reached(of, gate, None, device));
    let all: Found<Vec<Reached>> = all.collect::<Result<Vec<_>, _>>()?.into_iter().collect();
    let worse = |worst: &Reached, other: &Reached| {
        !worst.value.is_nan() && gate.metric.worse(other.value, worst.value)
    };
    let worst = |worst, other| if worse(&worst, &other) { other } else { worst };
    Ok(match all.map(|all| all.into_iter().reduce(worst)) {
        Ok(Some(reached)) => Judgement::of(gate.clone(), reached),
        Ok(None) => Judgement::failed(gate.clone(), "the fit has no members"),
        Err(reason) => Judgement::failed(gate.clone(), reason),
    })
}
