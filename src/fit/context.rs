//! Where a fit finds what its spec names.

use std::path::PathBuf;

use super::error::FitError;
use super::result_file::FitResult;
use super::spec::{FormChoice, ParameterChoice, Spec};
use crate::effect::{Effect, Family, Reference, ReferenceValues};
use crate::form::Form;
use crate::registry::Registry;

/// Where a fit finds what its spec names: the project's folder, the registry, and values of
/// references that several fits of a run share.
#[derive(Debug)]
pub struct Context {
    /// The project's root: `fits/`, `data/measured` and relative paths of specs are below it.
    pub root: PathBuf,
    /// References, forms and families by name.
    pub registry: Registry,
    /// Values of references at fitted points.
    pub values: ReferenceValues,
}

impl Context {
    /// A context at `root` in which nothing has been evaluated.
    pub fn new(root: impl Into<PathBuf>, registry: &Registry) -> Self {
        Self { root: root.into(), registry: registry.clone(), values: ReferenceValues::default() }
    }

    /// Loads the form of a spec.
    pub(super) fn form(&self, choice: &FormChoice) -> Result<Form, FitError> {
        match choice {
            FormChoice::Registered(name) => {
                let known = || self.registry.forms().map(|form| &form.name);
                let entry = self.registry.form(name);
                Ok(entry.ok_or_else(|| unknown("form", name, known()))?.load()?)
            }
            FormChoice::File { path, function } => {
                let origin = path.display().to_string();
                let source = std::fs::read_to_string(self.root.join(path))
                    .map_err(|source| FitError::Io { path: origin.clone(), source })?;
                Ok(Form::parse(&origin, &source, function)?)
            }
            FormChoice::Text { origin, source, function } => {
                Ok(Form::parse(origin, source, function)?)
            }
        }
    }

    /// The reference called `name` and its effect.
    pub(super) fn reference(
        &self,
        name: &str,
    ) -> Result<(&'static Effect, &'static Reference), FitError> {
        let known = || self.registry.references().map(|reference| reference.name);
        self.registry.reference(name).ok_or_else(|| unknown("reference", name, known()))
    }

    /// The family called `name`.
    pub(super) fn family(&self, name: &str) -> Result<&'static Family, FitError> {
        let known = || self.registry.families().map(|family| family.name);
        let found = self.registry.family(name).map(|(_, family)| family);
        found.ok_or_else(|| unknown("family", name, known()))
    }

    /// The spec with every constant of `form` fixed that it takes from the results of other fits.
    pub(super) fn inherit(&self, spec: &Spec, form: &Form) -> Result<Spec, FitError> {
        let mut spec = spec.clone();
        for name in &spec.constants.clone() {
            let wrong = |what: String| spec.fault("constants", what);
            let path = self.root.join("fits").join(format!("{name}.json"));
            if name.contains("..") || !path.is_file() {
                return Err(wrong(format!(
                    "`{name}` has no result; run `striae fit {name}` first"
                )));
            }
            let FitResult::Single(outcome) = FitResult::read(&path)? else {
                return Err(wrong(format!("`{name}` is a family of fits")));
            };
            let source = path.with_extension("toml");
            if source.is_file() && !Spec::read(&source)?.constants.is_empty() {
                return Err(wrong(format!(
                    "`{name}` takes constants itself: name where they are fitted"
                )));
            }
            let known = |parameter: &str| form.parameters().iter().any(|p| p.name == parameter);
            if !outcome.parameters.keys().any(|parameter| known(parameter)) {
                return Err(wrong(format!("`{name}` shares no constant with {}", form.origin())));
            }
            for (parameter, found) in outcome.parameters {
                if known(&parameter) {
                    let fixed = ParameterChoice::Fixed(f64::from(found.f32));
                    spec.parameters.entry(parameter).or_insert(fixed);
                }
            }
        }
        Ok(spec)
    }
}

fn unknown<N: AsRef<str>>(
    kind: &'static str,
    name: &str,
    known: impl Iterator<Item = N>,
) -> FitError {
    let known: Vec<String> = known.map(|name| name.as_ref().to_owned()).collect();
    FitError::Unknown { kind, name: name.to_owned(), known: known.join(", ") }
}
