//! A study of one effect: every fit of it on every region, its laws, its parity and its cost.

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;

use crate::document::Section;
use crate::effect::claim::check;
use crate::effect::{Candidate, Candidates, ConstantsOf, Effect, Finding, Member};
use crate::fit::outcome::{FamilyOutcome, Outcome};
use crate::form::Form;
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::registry;
use crate::validate::ValidateError;
use crate::validate::accuracy::{Accuracy, Shipped, Target, accuracy, residuals_f32};
use crate::validate::family::{FormOverFamily, GroupSpread, over_family, spreads};
use crate::validate::laws::{LawVerdict, judge};
use crate::validate::parity::{Parity, parity};
use crate::validate::regions::{Atlas, Grounds};

/// A fit to a reference, judged.
#[derive(Debug, Clone, Serialize)]
pub struct FitStudy {
    /// The result of the fit.
    pub outcome: Outcome,
    /// Accuracy per region of the effect, by region name.
    pub regions: Vec<(String, Accuracy)>,
    /// Accuracy on the effect's hard cases, by the name of the set.
    pub hard_cases: Vec<(String, Accuracy)>,
    /// Device against f32 lanes over all regions together.
    pub parity: Measured<Parity>,
}

/// The fits to one family, judged on held-out points.
#[derive(Debug, Clone, Serialize)]
pub struct FamilyStudy {
    /// The family.
    pub family: String,
    /// One entry per fit.
    pub forms: Vec<FormOverFamily>,
    /// How far the sources are apart.
    pub spreads: Vec<GroupSpread>,
}

/// Everything measured about an effect, except time.
#[derive(Debug, Clone, Serialize)]
pub struct Study {
    /// Name of the effect.
    pub effect: String,
    /// Fits to references.
    pub fits: Vec<FitStudy>,
    /// Fits to families.
    pub families: Vec<FamilyStudy>,
    /// Every law against every fit.
    pub laws: Vec<LawVerdict>,
    /// Claims of papers, checked.
    pub findings: Vec<Finding>,
    /// What the effect shows beyond its fits.
    pub exhibits: Vec<Section>,
}

impl Shipped {
    /// The form of a result with its constants. `root` is the project's folder, for forms that are
    /// files of the user's.
    ///
    /// # Errors
    /// If the form is neither registered nor a readable file, or a constant of it has no value.
    pub fn of(outcome: &Outcome, root: &Path) -> Result<Self, ValidateError> {
        let form = match registry::form(&outcome.form) {
            Some((_, entry)) => entry.load()?,
            None => {
                let path = root.join(&outcome.form);
                let text = std::fs::read_to_string(&path).map_err(|source| {
                    ValidateError::UnreadableForm { name: outcome.form.clone(), source }
                })?;
                Form::parse(&outcome.form, &text, &outcome.function)?
            }
        };
        Self::with_form(outcome, form)
    }

    /// The same for a form that is loaded already.
    ///
    /// # Errors
    /// If a constant of the form has no value in the result.
    pub fn with_form(outcome: &Outcome, form: Form) -> Result<Self, ValidateError> {
        let constants = form
            .parameters()
            .iter()
            .map(|parameter| {
                outcome.parameters.get(&parameter.name).ok_or_else(|| ValidateError::NoConstant {
                    fit: outcome.name.clone(),
                    constant: parameter.name.clone(),
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            name: outcome.name.clone(),
            constants: constants.iter().map(|constant| constant.value).collect(),
            constants_f32: constants.iter().map(|constant| constant.f32).collect(),
            form,
        })
    }
}

/// Studies `effect` with the results of its fits.
///
/// `members` holds the held-out members of each family, in the order of `effect.families`; `root`
/// is the project's folder.
///
/// # Errors
/// If a form, a reference or the device fails; a missing device is not an error.
pub fn study(
    effect: &Effect,
    singles: &[Outcome],
    families: &[FamilyOutcome],
    members: &[Vec<Member>],
    root: &Path,
    device: &Measured<Device>,
) -> Result<Study, ValidateError> {
    let candidates = candidates(effect, singles, root)?;
    let mut found = Study {
        effect: effect.name.to_owned(),
        fits: Vec::new(),
        families: Vec::new(),
        laws: Vec::new(),
        findings: check(effect.claims, &candidates),
        exhibits: (effect.exhibits)(&candidates)?,
    };
    let mut atlas = Atlas::new(effect);
    for outcome in singles {
        let shipped = Shipped::of(outcome, root)?;
        found.laws.extend(judge(effect, &outcome.form, &shipped));
        if let Some((_, reference)) = registry::reference(&outcome.target) {
            found.fits.push(fit_study(outcome, &shipped, atlas.of(reference)?, device)?);
        }
    }
    for (family, members) in effect.families.iter().zip(members) {
        let mut forms = Vec::new();
        for outcome in families.iter().filter(|outcome| outcome.family == family.name) {
            if let Some((_, entry)) = registry::form(&outcome.form) {
                let form = entry.load()?;
                let judged = judge_family(&form, outcome, members)?;
                if let Some(first) = outcome.members.first() {
                    let shipped = Shipped::with_form(first, form)?;
                    found.laws.extend(judge(effect, &outcome.form, &shipped));
                }
                forms.push(judged);
            }
        }
        let spreads = spreads(members);
        found.families.push(FamilyStudy { family: family.name.to_owned(), forms, spreads });
    }
    Ok(found)
}

/// The forms of `effect` with the constants of their text, and its fits with theirs.
fn candidates(
    effect: &Effect,
    singles: &[Outcome],
    root: &Path,
) -> Result<Candidates, ValidateError> {
    let fitted = singles.iter().map(|outcome| {
        let Shipped { name, form, constants, constants_f32 } = Shipped::of(outcome, root)?;
        let constants_of = ConstantsOf::Fit(name.clone());
        Ok(Arc::new(Candidate { name, form, constants, constants_f32, constants_of }))
    });
    let fitted = fitted.collect::<Result<Vec<_>, ValidateError>>()?;
    // Of one name the later counts.
    Ok(effect.written()?.iter().cloned().chain(fitted).collect())
}

fn fit_study(
    outcome: &Outcome,
    shipped: &Shipped,
    grounds: &Grounds,
    device: &Measured<Device>,
) -> Result<FitStudy, ValidateError> {
    let kernel = match device {
        Measured::Value(device) => {
            Measured::Value(device.compile(&shipped.form, &shipped.constants_f32)?)
        }
        Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
    };
    let judged = |targets: Vec<(&'static str, Target)>| {
        targets
            .iter()
            .map(|(name, target)| Ok(((*name).to_owned(), accuracy(shipped, target, &kernel)?)))
            .collect::<Result<Vec<_>, ValidateError>>()
    };
    let regions = judged(grounds.regions(&shipped.form)?)?;
    let hard_cases = judged(grounds.hard_cases(&shipped.form)?)?;
    let parity = match (&kernel, grounds.everywhere(&shipped.form)?) {
        (Measured::Value(kernel), Some(target)) => {
            Measured::Value(parity(shipped, &target, kernel)?)
        }
        (Measured::Value(_), None) => {
            Measured::NotMeasured("the effect has no region for it".into())
        }
        (Measured::NotMeasured(reason), _) => Measured::NotMeasured(reason.clone()),
    };
    Ok(FitStudy { outcome: outcome.clone(), regions, hard_cases, parity })
}

fn judge_family(
    form: &Form,
    outcome: &FamilyOutcome,
    members: &[Member],
) -> Result<FormOverFamily, ValidateError> {
    let mut outcomes = Vec::new();
    let mut residuals = Vec::new();
    for member in members {
        let name = format!("{}#{}", outcome.name, member.label);
        let fitted = outcome.members.iter().find(|fitted| fitted.name == name);
        let fitted = fitted.ok_or_else(|| ValidateError::NoMember {
            fit: outcome.name.clone(),
            member: member.label.clone(),
        })?;
        let shipped = Shipped::with_form(fitted, form.clone())?;
        residuals.push(residuals_f32(&shipped, &Target::of_table(&member.table, form)?)?);
        outcomes.push(fitted);
    }
    Ok(over_family(&outcome.name, members, &outcomes, residuals))
}
