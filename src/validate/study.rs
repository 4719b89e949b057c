//! A study of one effect: every candidate of it on every region, its laws, its parity and its cost.

use rayon::prelude::*;

use crate::document::{NoticeLevel, Section};
use crate::effect::claim::check;
use crate::effect::{
    Candidate, CandidateError, Candidates, ClaimError, Effect, Finding, Member, Reference,
};
use crate::fit::outcome::Outcome;
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::project::{Approximated, Fitted, Project, Subject};
use crate::validate::ValidateError;
use crate::validate::accuracy::{Accuracy, Arithmetic, GroundTruth, accuracy, values};
use crate::validate::draws::DrawsStudy;
use crate::validate::family::{FormOverFamily, GroupSpread, over_family, spreads};
use crate::validate::laws::{LawVerdict, judge};
use crate::validate::parity::{Parity, parity};
use crate::validate::regions::{Atlas, Grounds, served};

/// A candidate for a reference, judged.
#[derive(Debug, Clone)]
pub struct CandidateStudy {
    /// `effect/name`.
    pub name: String,
    /// Registered form, or path of a file.
    pub form: String,
    /// The reference that it approximates.
    pub reference: &'static Reference,
    /// What was judged.
    pub candidate: Candidate,
    /// The result, where something was fitted.
    pub outcome: Option<Outcome>,
    /// Accuracy per region of the effect, by region name.
    pub regions: Vec<(String, Accuracy)>,
    /// Accuracy on the effect's hard cases, by the name of the set.
    pub hard_cases: Vec<(String, Accuracy)>,
    /// Draws in the effect's regions and hard cases, by name, of a form that draws from a distribution,
    /// which has no accuracy.
    pub draws: Vec<(String, DrawsStudy)>,
    /// Device against f32 lanes over all regions together.
    pub parity: Measured<Parity>,
}

/// The candidates for one family, judged on held-out points.
#[derive(Debug, Clone)]
pub struct FamilyStudy {
    /// The family.
    pub family: String,
    /// One entry per subject.
    pub forms: Vec<FormOverFamily>,
    /// How far the sources are apart.
    pub spreads: Vec<GroupSpread>,
}

/// Everything measured about an effect, except time.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name of the effect.
    pub effect: String,
    /// Candidates for references.
    pub candidates: Vec<CandidateStudy>,
    /// Candidates for families.
    pub families: Vec<FamilyStudy>,
    /// Every law against every candidate.
    pub laws: Vec<LawVerdict>,
    /// Claims of papers, checked.
    pub findings: Vec<Finding>,
    /// What the effect shows beyond its candidates.
    pub exhibits: Vec<Section>,
}

/// Studies `effect` with `subjects`, those of it.
///
/// `members` holds the held-out members of each family, in the order of `effect.families`, or is empty
/// where the project has no measured data;
/// `candidates` are those of the project, for claims and exhibits.
///
/// # Errors
/// If a form, a reference or the device fails; a missing device is not an error.
pub fn study(
    effect: &Effect,
    subjects: &[Subject],
    members: &[Vec<Member>],
    candidates: &Candidates,
    project: &Project,
    atlas: &Atlas,
    device: &Measured<Device>,
) -> Result<Study, ValidateError> {
    let ((findings, exhibits), judged) = rayon::join(
        || rayon::join(|| check(effect.claims, candidates), || exhibits(effect, candidates)),
        || {
            let judge = |subject| judge_subject(effect, subject, project, atlas, device);
            subjects.par_iter().map(judge).collect::<Vec<_>>()
        },
    );
    let (mut laws, mut studies) = (Vec::new(), Vec::new());
    for judged in judged {
        let (verdicts, study) = judged?;
        laws.extend(verdicts);
        studies.extend(study);
    }
    Ok(Study {
        effect: effect.name.to_owned(),
        candidates: studies,
        families: judge_families(effect, subjects, members)?,
        laws,
        findings,
        exhibits: exhibits?,
    })
}

/// The accuracy of `subjects` in f64 and f32 and nothing else of [`study`], whose arguments these are.
///
/// # Errors
/// As [`study`].
pub fn accuracy_study(
    effect: &Effect,
    subjects: &[Subject],
    members: &[Vec<Member>],
    project: &Project,
    atlas: &Atlas,
) -> Result<Study, ValidateError> {
    let device = &Measured::NotMeasured("no device was asked".to_owned());
    let judged = subjects
        .par_iter()
        .map(|subject| judge_accuracy(effect, subject, project, atlas, device))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(Study {
        effect: effect.name.to_owned(),
        candidates: judged.into_iter().flatten().collect(),
        families: judge_families(effect, subjects, members)?,
        laws: Vec::new(),
        findings: Vec::new(),
        exhibits: Vec::new(),
    })
}

fn judge_families(
    effect: &Effect,
    subjects: &[Subject],
    members: &[Vec<Member>],
) -> Result<Vec<FamilyStudy>, ValidateError> {
    let families = effect.families.iter().zip(members).map(|(family, members)| {
        let over = Approximated::Family(family.name.to_owned());
        let forms = subjects
            .par_iter()
            .filter(|subject| subject.approximates == over)
            .map(|subject| judge_family(subject, members))
            .collect::<Result<_, _>>()?;
        Ok(FamilyStudy { family: family.name.to_owned(), forms, spreads: spreads(members) })
    });
    families.collect()
}

/// The laws that a subject's first candidate stands to, and its study, if it approximates a reference.
fn judge_subject(
    effect: &Effect,
    subject: &Subject,
    project: &Project,
    atlas: &Atlas,
    device: &Measured<Device>,
) -> Result<(Vec<LawVerdict>, Option<CandidateStudy>), ValidateError> {
    let Some(candidate) = subject.candidates.first() else { return Ok((Vec::new(), None)) };
    let laws = judge(effect, &subject.form, registered_reference(project, subject), candidate);
    Ok((laws, judge_accuracy(effect, subject, project, atlas, device)?))
}

/// The study of a subject's first candidate, if it approximates a reference.
fn judge_accuracy(
    effect: &Effect,
    subject: &Subject,
    project: &Project,
    atlas: &Atlas,
    device: &Measured<Device>,
) -> Result<Option<CandidateStudy>, ValidateError> {
    let Some(candidate) = subject.candidates.first() else { return Ok(None) };
    let Approximated::Reference(name) = &subject.approximates else { return Ok(None) };
    let Some((_, reference)) = project.registry().reference(name) else { return Ok(None) };
    let grounds = atlas.grounds(effect, reference)?;
    Ok(Some(one(subject, candidate, reference, &grounds, device)?))
}

/// What the effect shows beyond its candidates; where the project lacks a fit or the data for it, that
/// it was not measured and why.
fn exhibits(effect: &Effect, candidates: &Candidates) -> Result<Vec<Section>, ValidateError> {
    let lacking = match (effect.exhibits)(candidates) {
        Ok(sections) => return Ok(sections),
        Err(ClaimError::Candidate(error @ CandidateError::Unknown { .. })) => error.to_string(),
        Err(ClaimError::Measured(error)) => error.to_string(),
        Err(error) => return Err(error.into()),
    };
    Ok(vec![Section::new("Exhibits").notice(NoticeLevel::NotMeasured, lacking)])
}

/// The reference that the registered form of a subject approximates; empty for a form of the user's.
fn registered_reference<'p>(project: &'p Project, subject: &Subject) -> &'p str {
    let entry = project.registry().form(&subject.form);
    entry.and_then(|entry| entry.reference.as_deref()).unwrap_or_default()
}

fn one(
    subject: &Subject,
    candidate: &Candidate,
    reference: &'static Reference,
    grounds: &Grounds,
    device: &Measured<Device>,
) -> Result<CandidateStudy, ValidateError> {
    let kernel = match device {
        Measured::Value(device) => {
            Measured::Value(device.compile(&candidate.form, &candidate.constants_f32)?)
        }
        Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
    };
    let mut draws = Vec::new();
    let mut judged = |targets: Vec<(&'static str, GroundTruth)>| {
        let mut found = Vec::new();
        for (name, target) in targets {
            if target.distributions.is_empty() {
                found.push((name.to_owned(), accuracy(candidate, &target, &kernel)?));
            } else {
                draws.push((name.to_owned(), DrawsStudy::of(candidate, &target, &kernel)?));
            }
        }
        Ok::<_, ValidateError>(found)
    };
    let regions = judged(served(&grounds.regions, &candidate.form)?)?;
    let hard_cases = judged(served(&grounds.hard_cases, &candidate.form)?)?;
    let parity = match (&kernel, grounds.everywhere(&candidate.form)?) {
        (Measured::Value(kernel), Some(target)) => {
            Measured::Value(parity(candidate, &target, kernel)?)
        }
        (Measured::Value(_), None) => {
            Measured::NotMeasured("the effect has no region for it".into())
        }
        (Measured::NotMeasured(reason), _) => Measured::NotMeasured(reason.clone()),
    };
    Ok(CandidateStudy {
        name: subject.name.clone(),
        form: subject.form.clone(),
        reference,
        candidate: candidate.clone(),
        outcome: subject.outcome().cloned(),
        regions,
        hard_cases,
        draws,
        parity,
    })
}

fn judge_family(subject: &Subject, members: &[Member]) -> Result<FormOverFamily, ValidateError> {
    let mut residuals = Vec::with_capacity(members.len());
    for member in members {
        let candidate = subject.of_member(&member.label).ok_or_else(|| {
            ValidateError::NoMember { fit: subject.name.clone(), member: member.label.clone() }
        })?;
        let target = GroundTruth::of_table(&member.table, &candidate.form)?;
        residuals.push(target.residuals(&values(candidate, &target, Arithmetic::F32)?));
    }
    let outcomes = subject.fitted.as_ref().map(|Fitted { result, .. }| result.outcomes());
    Ok(over_family(&subject.name, members, outcomes.unwrap_or_default(), residuals))
}
