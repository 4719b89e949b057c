//! Subjects: what is judged under one name.

use super::{Project, ProjectError, nearest};
use crate::effect::{Candidate, FormEntry};
use crate::fit::outcome::Outcome;
use crate::fit::spec::{FormChoice, Target};
use crate::fit::{FitResult, Spec};

/// What a subject approximates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Approximated {
    /// A reference, by name.
    Reference(String),
    /// Every member of a family, by the family's name.
    Family(String),
    /// A table of the user's.
    Table,
}

/// What is judged under one name: a result of `fits/`, or a registered form in which nothing is fitted.
#[derive(Debug, Clone)]
pub struct Subject {
    /// `effect/name`.
    pub name: String,
    /// Registered form (`effect/form`) or path of a WGSL file.
    pub form: String,
    /// What it approximates.
    pub approximates: Approximated,
    /// One candidate; over a family one per member that was fitted, or one for all if nothing was.
    pub candidates: Vec<Candidate>,
    /// The spec and its result, where something was fitted.
    pub fitted: Option<Fitted>,
}

/// A spec with its result.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The spec.
    pub spec: Spec,
    /// The result.
    pub result: FitResult,
}

impl Subject {
    /// Whether `name` is of the effect called `effect`.
    pub fn is_of(&self, effect: &str) -> bool {
        self.name.split('/').next() == Some(effect)
    }

    /// The result, where one set of constants was fitted.
    pub fn outcome(&self) -> Option<&Outcome> {
        match &self.fitted.as_ref()?.result {
            FitResult::Single(outcome) => Some(outcome),
            FitResult::Family(_) => None,
        }
    }

    /// The candidate of a family's member called `label`; that of all members where nothing was fitted.
    pub fn of_member(&self, label: &str) -> Option<&Candidate> {
        match &self.fitted {
            Some(_) => {
                let name = format!("{}#{label}", self.name);
                self.candidates.iter().find(|candidate| candidate.name == name)
            }
            None => self.candidates.first(),
        }
    }
}

impl Project {
    /// Everything that is judged: the result of every spec, then the registered forms without a spec of
    /// their own, in the order of the registry.
    ///
    /// A registered form with a constant that has no value anywhere is none: it waits for its fit. So
    /// does one that takes constants from a fit of which the project has no spec.
    ///
    /// # Errors
    /// [`ProjectError::NoResult`] for a spec without a result; and whatever keeps a spec, a result or a
    /// form from being read.
    pub fn subjects(&self) -> Result<Vec<Subject>, ProjectError> {
        let specs = self.specs()?;
        let mut subjects = Vec::new();
        for file in &specs {
            let path = file.result();
            if !path.is_file() {
                return Err(ProjectError::NoResult { fit: file.name.clone() });
            }
            subjects.push(self.subject_of(Spec::read(&file.path)?, FitResult::read(&path)?)?);
        }
        for entry in self.registry().forms() {
            if specs.iter().any(|spec| spec.name == entry.name) {
                continue;
            }
            match self.subject_of_form(entry) {
                Ok(subject) => subjects.extend(subject),
                Err(ProjectError::NoResult { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(subjects)
    }

    /// The subjects of these names, each once; all of them for no name. A name is an effect's, a
    /// subject's, a pattern of subjects with `*`, or any that [`Project::candidate`] takes.
    ///
    /// # Errors
    /// As [`Project::subjects`] and [`Project::candidate`]; [`ProjectError::Unknown`] for a pattern that
    /// nothing matches.
    pub fn subjects_named(&self, names: &[String]) -> Result<Vec<Subject>, ProjectError> {
        let all = self.subjects()?;
        if names.is_empty() {
            return Ok(all);
        }
        let mut found: Vec<Subject> = Vec::new();
        for name in names {
            let of_effect = self.registry().effect(name).is_some();
            let named = |subject: &&Subject| match of_effect {
                true => subject.is_of(name),
                false => matches(name, &subject.name),
            };
            let mut own: Vec<Subject> = all.iter().filter(named).cloned().collect();
            if own.is_empty() && name.contains('*') {
                let nearest = nearest(name, all.iter().map(|subject| subject.name.clone()));
                let name = name.clone();
                return Err(ProjectError::Unknown { what: "candidate like", name, nearest });
            }
            if own.is_empty() {
                own.push(self.subject_of_candidate(self.candidate(name)?)?);
            }
            own.retain(|subject| !found.iter().any(|known| known.name == subject.name));
            found.extend(own);
        }
        Ok(found)
    }

    /// A candidate by itself: it approximates what its fit or its registered form does. One member of a
    /// family approximates no more than its own table.
    fn subject_of_candidate(&self, candidate: Candidate) -> Result<Subject, ProjectError> {
        let outcome = self.outcome_of(&candidate)?;
        let form = outcome.as_ref().map_or(&candidate.name, |outcome| &outcome.form).clone();
        let reference = match &outcome {
            Some(outcome) => Some(outcome.target.clone()),
            None => self.registry().form(&form).and_then(|entry| entry.reference.clone()),
        };
        let known = reference.filter(|name| self.registry().reference(name).is_some());
        let approximates = known.map_or(Approximated::Table, Approximated::Reference);
        let (name, candidates) = (candidate.name.clone(), vec![candidate]);
        Ok(Subject { name, form, approximates, candidates, fitted: None })
    }

    /// The subject made of a spec and its result.
    ///
    /// # Errors
    /// If the form does not load, or a constant of it has no value.
    pub fn subject_of(&self, spec: Spec, result: FitResult) -> Result<Subject, ProjectError> {
        let approximates = match &spec.target {
            Target::Reference(name) => Approximated::Reference(name.clone()),
            Target::Family(name) => Approximated::Family(name.clone()),
            Target::File { .. } | Target::Table { .. } => Approximated::Table,
        };
        let mut candidates: Vec<Candidate> = Vec::new();
        for outcome in result.outcomes() {
            let form = match candidates.first() {
                Some(first) => first.form.clone(),
                None => self.form_of(outcome)?,
            };
            candidates.push(Self::with_form(outcome, form)?);
        }
        let form = match &spec.form {
            FormChoice::Registered(name) => name.clone(),
            FormChoice::File { path, .. } => path.display().to_string(),
            FormChoice::Text { origin, .. } => origin.clone(),
        };
        let name = spec.name.clone();
        let fitted = Some(Fitted { spec, result });
        Ok(Subject { name, form, approximates, candidates, fitted })
    }

    /// The subject that a registered form is by itself; none if a constant of it has no value.
    ///
    /// # Errors
    /// If the form does not load.
    pub fn subject_of_form(&self, entry: &FormEntry) -> Result<Option<Subject>, ProjectError> {
        let approximates = match (&entry.family, &entry.reference) {
            (Some(family), _) => Approximated::Family(family.clone()),
            (None, Some(reference)) => Approximated::Reference(reference.clone()),
            (None, None) => return Ok(None),
        };
        let candidate = match self.unfitted(entry) {
            Err(ProjectError::Candidate(_)) => return Ok(None),
            other => other?,
        };
        let (name, form) = (entry.name.to_string(), entry.name.to_string());
        Ok(Some(Subject { name, form, approximates, candidates: vec![candidate], fitted: None }))
    }
}

/// Whether `name` is `pattern`, in which `*` stands for anything.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((before, after)) = pattern.split_once('*') else { return pattern == name };
    let Some(rest) = name.strip_prefix(before) else { return false };
    let mut ends = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    ends.any(|at| matches(after, &rest[at..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_anything() {
        for (pattern, name, expected) in [
            ("a/b", "a/b", true),
            ("a/b", "a/bc", false),
            ("a/*", "a/b", true),
            ("*_lean", "a/band_lean", true),
            ("a/*b*", "a/xby", true),
            ("a/*b", "a/bc", false),
            ("*", "", true),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
        }
    }
}
