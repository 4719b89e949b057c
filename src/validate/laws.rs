//! Laws: what a form must satisfy whatever its error.

use serde::{Deserialize, Serialize};

use crate::effect::{Candidate, Effect, Law};

/// How a form stands to a law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawVerdict {
    /// The law.
    pub law: String,
    /// The fit.
    pub fit: String,
    /// Worst violation found.
    pub violation: f64,
    /// Largest violation accepted.
    pub tolerance: f64,
    /// `holds`, `known violation: …` or `violated`.
    pub verdict: LawStanding,
}

/// Verdict on a law.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LawStanding {
    /// Within the tolerance.
    Holds,
    /// Beyond it, as registered, with the reason.
    Known(String),
    /// Beyond it, and nobody has said so.
    Violated,
}

/// Judges the laws of `effect` that apply to `candidate`, in f32. A form that cannot be evaluated
/// violates.
pub fn judge(
    effect: &Effect,
    form_name: &str,
    reference: &str,
    candidate: &Candidate,
) -> Vec<LawVerdict> {
    let applies = |law: &&Law| law.references.is_empty() || law.references.contains(&reference);
    effect.laws.iter().filter(applies).map(|law| verdict(law, form_name, candidate)).collect()
}

fn verdict(law: &Law, form_name: &str, candidate: &Candidate) -> LawVerdict {
    let violation = (law.violation)(&|points| candidate.values_for_laws(points));
    let known =
        law.known_violations.iter().find(|(name, _)| *name == form_name || *name == candidate.name);
    let standing = match known {
        _ if violation <= law.tolerance => LawStanding::Holds,
        // A reason for an error excuses no NaN and no infinity.
        Some((_, reason)) if violation.is_finite() => LawStanding::Known((*reason).to_owned()),
        _ => LawStanding::Violated,
    };
    LawVerdict {
        law: law.name.to_owned(),
        fit: candidate.name.clone(),
        violation,
        tolerance: law.tolerance,
        verdict: standing,
    }
}
