//! Laws: what a form must satisfy whatever its error.

use serde::{Deserialize, Serialize};

use crate::effect::{Candidate, ConstantsOf, Effect, Law};
use crate::validate::accuracy::Shipped;

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

/// Judges the laws of `effect` that apply to `shipped`, in f32. A form that cannot be evaluated
/// violates.
pub fn judge(effect: &Effect, form_name: &str, shipped: &Shipped) -> Vec<LawVerdict> {
    let entry = effect.forms.iter().find(|form| form.name == form_name);
    let reference = entry.map_or("", |form| form.reference);
    let applies = |law: &&Law| law.references.is_empty() || law.references.contains(&reference);
    effect.laws.iter().filter(applies).map(|law| verdict(law, form_name, shipped)).collect()
}

fn verdict(law: &Law, form_name: &str, shipped: &Shipped) -> LawVerdict {
    let Shipped { name, form, constants, constants_f32 } = shipped.clone();
    let constants_of = ConstantsOf::Fit(name.clone());
    let candidate = Candidate { name, form, constants, constants_f32, constants_of };
    let violation = (law.violation)(&|points| candidate.values_for_laws(points));
    let known =
        law.known_violations.iter().find(|(name, _)| *name == form_name || *name == shipped.name);
    let standing = match known {
        _ if violation <= law.tolerance => LawStanding::Holds,
        // A reason for an error excuses no NaN and no infinity.
        Some((_, reason)) if violation.is_finite() => LawStanding::Known((*reason).to_owned()),
        _ => LawStanding::Violated,
    };
    LawVerdict {
        law: law.name.to_owned(),
        fit: shipped.name.clone(),
        violation,
        tolerance: law.tolerance,
        verdict: standing,
    }
}
