//! What a name stands for: the one way to a candidate.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Project, ProjectError};
use crate::effect::{Candidate, ConstantsOf, FormEntry};
use crate::fit::FitResult;
use crate::fit::outcome::Outcome;
use crate::form::Form;

impl Project {
    /// The candidate called `name`:
    ///
    /// | name | form and constants |
    /// |---|---|
    /// | `FILE.wgsl#function` | a file, constants of its text |
    /// | `form:effect/form` | a registered form, constants of its text |
    /// | `FILE.json`, `FILE.json#member` | a result file |
    /// | `effect/name`, `effect/name#member` | the result in `fits/`; without one the registered form, with constants of the fits that it names, else of its text |
    ///
    /// # Errors
    /// [`ProjectError::Unknown`] with the nearest names; and whatever keeps a file from being read, a
    /// form from being loaded, or a constant from having a value.
    pub fn candidate(&self, name: &str) -> Result<Candidate, ProjectError> {
        self.candidate_with(name, &BTreeMap::new())
    }

    /// As [`Self::candidate`], with `set` in place of these constants.
    ///
    /// # Errors
    /// As [`Self::candidate`]; [`ProjectError::Name`] for a constant that the form has not.
    pub fn candidate_with(
        &self,
        name: &str,
        set: &BTreeMap<String, f64>,
    ) -> Result<Candidate, ProjectError> {
        let (form, mut values, constants_of) = self.parts(name)?;
        let known = form.parameters().iter().map(|parameter| parameter.name.as_str());
        if let Some(stray) = set.keys().find(|stray| !known.clone().any(|known| known == *stray)) {
            let known: Vec<&str> = known.collect();
            let what = format!("no constant `{stray}`; there are: {}", known.join(", "));
            return Err(ProjectError::Name { name: form.origin().to_owned(), what });
        }
        values.extend(set.iter().map(|(name, value)| (name.clone(), (*value, *value as f32))));
        Ok(Candidate::new(name.trim_start_matches("form:"), form, &values, constants_of)?)
    }

    /// Form, known constants and where they come from.
    fn parts(&self, name: &str) -> Result<(Form, Constants, ConstantsOf), ProjectError> {
        if let Some((file, function)) = name.split_once('#')
            && file.ends_with(".wgsl")
        {
            let form = self.form_of_file(Path::new(file), function)?;
            return Ok((form, Constants::new(), ConstantsOf::Text));
        }
        if let Some(form) = name.strip_prefix("form:") {
            let entry = self.registry().form(form).ok_or_else(|| self.unknown(name))?;
            return Ok((entry.load()?, Constants::new(), ConstantsOf::Text));
        }
        if let Some(outcome) = self.outcome(name)? {
            let form = self.form_of(&outcome)?;
            return Ok((form, constants(&outcome), ConstantsOf::Fit(outcome.name)));
        }
        let entry = self.registry().form(name).ok_or_else(|| self.unknown(name))?;
        let (values, constants_of) = self.inherited(entry)?;
        Ok((entry.load()?, values, constants_of))
    }

    /// The result behind a candidate, where it was fitted.
    ///
    /// # Errors
    /// If the result cannot be read.
    pub fn outcome_of(&self, candidate: &Candidate) -> Result<Option<Outcome>, ProjectError> {
        match &candidate.constants_of {
            ConstantsOf::Fit(fit) => self.outcome(fit),
            ConstantsOf::Text | ConstantsOf::Fits(_) => Ok(None),
        }
    }

    /// A registered form without a fit of its own: constants of the fits that it names, else of its
    /// text.
    ///
    /// # Errors
    /// If one of these fits has no result, the form does not load, or a constant has no value.
    pub fn unfitted(&self, entry: &FormEntry) -> Result<Candidate, ProjectError> {
        let (values, constants_of) = self.inherited(entry)?;
        Ok(Candidate::new(&entry.name, entry.load()?, &values, constants_of)?)
    }

    fn inherited(&self, entry: &FormEntry) -> Result<(Constants, ConstantsOf), ProjectError> {
        let mut values = Constants::new();
        for source in &entry.constants_of {
            let constants = match self.outcome(source)? {
                Some(outcome) => constants(&outcome),
                // A form that is not fitted: its text is part of this one, with its constants.
                None if self.registry().form(source).is_some() => Constants::new(),
                None => return Err(ProjectError::NoResult { fit: source.clone() }),
            };
            // What ships: the form is made of the rounded constants.
            values.extend(
                constants.into_iter().map(|(name, (_, f32))| (name, (f64::from(f32), f32))),
            );
        }
        Ok(match entry.constants_of.is_empty() {
            true => (values, ConstantsOf::Text),
            false => (values, ConstantsOf::Fits(entry.constants_of.clone())),
        })
    }

    pub(super) fn form_of(&self, outcome: &Outcome) -> Result<Form, ProjectError> {
        match self.registry().form(&outcome.form) {
            Some(entry) => Ok(entry.load()?),
            None => self.form_of_file(Path::new(&outcome.form), &outcome.function),
        }
    }

    /// `form` with the constants of a result.
    pub(super) fn with_form(outcome: &Outcome, form: Form) -> Result<Candidate, ProjectError> {
        let constants_of = ConstantsOf::Fit(outcome.name.clone());
        Ok(Candidate::new(&outcome.name, form, &constants(outcome), constants_of)?)
    }

    fn form_of_file(&self, path: &Path, function: &str) -> Result<Form, ProjectError> {
        let origin = path.display().to_string();
        let text =
            std::fs::read_to_string(self.root().join(path)).map_err(ProjectError::io(path))?;
        Ok(Form::parse(&origin, &text, function)?)
    }

    /// The result called `name` in `fits/`, or in the file that `name` is; `#member` names one of a
    /// family.
    fn outcome(&self, name: &str) -> Result<Option<Outcome>, ProjectError> {
        let (fit, member) = name.split_once('#').map_or((name, None), |(f, m)| (f, Some(m)));
        let path = match fit.ends_with(".json") {
            true => Path::new(fit).to_path_buf(),
            false => self.fits().join(format!("{fit}.json")),
        };
        if !path.is_file() {
            return Ok(None);
        }
        let fault = |what: String| ProjectError::Name { name: self.shown(&path), what };
        let family = match (FitResult::read(&path)?, member) {
            (FitResult::Single(outcome), None) => return Ok(Some(*outcome)),
            (FitResult::Single(_), Some(label)) => {
                return Err(fault(format!("a single fit, without a member `{label}`")));
            }
            (FitResult::Family(family), _) => family,
        };
        let known = || family.members.iter().map(Outcome::label).collect::<Vec<_>>().join(", ");
        let Some(member) = member else {
            let what = format!("a family; name a member, as in '{fit}#LABEL'; labels: {}", known());
            return Err(fault(what));
        };
        match family.members.iter().find(|outcome| outcome.label() == member) {
            Some(outcome) => Ok(Some(outcome.clone())),
            None => Err(fault(format!("no member `{member}`; there are: {}", known()))),
        }
    }

    /// That nothing is called `name`, with the nearest names; or that its fit was not run yet.
    fn unknown(&self, name: &str) -> ProjectError {
        let specs = self.specs().unwrap_or_default().into_iter().map(|spec| spec.name);
        let specs: Vec<String> = specs.collect();
        if specs.iter().any(|spec| spec == name) {
            return ProjectError::NoResult { fit: name.to_owned() };
        }
        let references = self.registry().references().map(|reference| reference.name.to_owned());
        let forms = self.registry().forms().map(|form| form.name.to_owned());
        let known = references.chain(forms).chain(specs);
        ProjectError::Unknown {
            what: "reference, fit or form",
            name: name.to_owned(),
            nearest: nearest(name.trim_start_matches("form:"), known),
        }
    }
}

/// Constants in f64 and f32, by name.
type Constants = BTreeMap<String, (f64, f32)>;

fn constants(outcome: &Outcome) -> Constants {
    let constants = outcome.parameters.iter();
    constants.map(|(name, found)| (name.clone(), (found.value, found.f32))).collect()
}

/// The three of `known` that are nearest to `name` by Levenshtein's distance.
pub fn nearest(name: &str, known: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut ranked: Vec<(usize, String)> =
        known.into_iter().map(|other| (strsim::levenshtein(name, &other), other)).collect();
    ranked.sort();
    ranked.dedup();
    ranked.into_iter().take(3).map(|(_, other)| other).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_names_come_first() {
        let known = ["footprint/eq16", "footprint/eq18", "fresnel/schlick", "sine_integral"];
        let found = nearest("footprint/eq61", known.map(str::to_owned));
        assert_eq!(found[0], "footprint/eq16");
        assert_eq!(found.len(), 3);
    }
}
