//! What a name on the command line stands for.

use std::path::Path;

use anyhow::{Context as _, anyhow, bail};

use super::project::Project;
use crate::effect::Reference;
use crate::fit::FitResult;
use crate::fit::outcome::Outcome;
use crate::form::Form;
use crate::registry::{self, EFFECTS};

/// Something that has values at points.
pub(super) enum Evaluable {
    /// An exact quantity.
    Reference(&'static Reference),
    /// A form with constants.
    Form(Box<Shipped>),
}

/// A form with values for its constants, as far as they are known.
pub(super) struct Shipped {
    /// The form.
    pub(super) form: Form,
    /// The fit that the constants come from.
    pub(super) outcome: Option<Outcome>,
    constants: Vec<Option<(f64, f32)>>,
}

impl Evaluable {
    /// Looks `name` up as a reference, a fit, a registered form, a WGSL file; `form:` before it
    /// skips the fits.
    pub(super) fn find(
        name: &str,
        function: Option<&str>,
        project: Option<&Project>,
    ) -> anyhow::Result<Self> {
        if name.ends_with(".wgsl") {
            let function = function.context("a WGSL file needs --function NAME")?;
            return Ok(Self::Form(Box::new(Shipped::unfitted(read_form(
                Path::new(name),
                function,
            )?))));
        }
        if function.is_some() {
            bail!("--function is for WGSL files; `{name}` is none");
        }
        if let Some(form) = name.strip_prefix("form:") {
            let (_, entry) = registry::form(form).ok_or_else(|| unknown(form, project))?;
            return Ok(Self::Form(Box::new(Shipped::unfitted(entry.load()?))));
        }
        if let Some((_, reference)) = registry::reference(name) {
            return Ok(Self::Reference(reference));
        }
        if let Some(outcome) = project.map(|project| fitted(name, project)).transpose()?.flatten() {
            return Ok(Self::Form(Box::new(Shipped::of(outcome, project)?)));
        }
        let (_, entry) = registry::form(name).ok_or_else(|| unknown(name, project))?;
        Ok(Self::Form(Box::new(Shipped::unfitted(entry.load()?))))
    }
}

impl Shipped {
    /// A form with the values written in its text.
    fn unfitted(form: Form) -> Self {
        let defaults = form.parameters().iter().map(|p| p.default.map(|v| (v, v as f32)));
        Self { constants: defaults.collect(), outcome: None, form }
    }

    /// The form of a fit with the fitted constants.
    pub(super) fn of(outcome: Outcome, project: Option<&Project>) -> anyhow::Result<Self> {
        let form = match registry::form(&outcome.form) {
            Some((_, entry)) => entry.load()?,
            None => {
                let root = project.map(Project::root).unwrap_or(Path::new("."));
                read_form(&root.join(&outcome.form), &outcome.function)?
            }
        };
        let mut shipped = Self::unfitted(form);
        for (parameter, constant) in
            shipped.form.parameters().iter().zip(shipped.constants.iter_mut())
        {
            if let Some(fitted) = outcome.parameters.get(&parameter.name) {
                *constant = Some((fitted.value, fitted.f32));
            }
        }
        shipped.outcome = Some(outcome);
        Ok(shipped)
    }

    /// Gives the constant `name` a value.
    pub(super) fn set(&mut self, name: &str, value: f64) -> anyhow::Result<()> {
        let parameters = self.form.parameters();
        let known = || parameters.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
        let place = parameters.iter().position(|p| p.name == name).ok_or_else(|| {
            anyhow!(
                "--set {name}: {} has no such constant; there are: {}",
                self.form.origin(),
                known()
            )
        })?;
        if let Some(constant) = self.constants.get_mut(place) {
            *constant = Some((value, value as f32));
        }
        Ok(())
    }

    /// The constants in f64, in the order of the form.
    pub(super) fn constants(&self) -> anyhow::Result<Vec<f64>> {
        Ok(self.values()?.into_iter().map(|(value, _)| value).collect())
    }

    /// The constants as they ship, in the order of the form.
    pub(super) fn constants_f32(&self) -> anyhow::Result<Vec<f32>> {
        Ok(self.values()?.into_iter().map(|(_, value)| value).collect())
    }

    fn values(&self) -> anyhow::Result<Vec<(f64, f32)>> {
        let named = self.form.parameters().iter().zip(&self.constants);
        named
            .map(|(parameter, constant)| {
                constant.ok_or_else(|| {
                    let (name, origin) = (&parameter.name, self.form.origin());
                    anyhow!(
                        "{origin}: the constant `{name}` has no value; give one with --set {name}=…"
                    )
                })
            })
            .collect()
    }
}

/// The form in a WGSL file.
pub(super) fn read_form(path: &Path, function: &str) -> anyhow::Result<Form> {
    let origin = path.display().to_string();
    let text = std::fs::read_to_string(path).with_context(|| origin.clone())?;
    Ok(Form::parse(&origin, &text, function)?)
}

/// The result of the fit `effect/name` or of the member `effect/name#label`, if there is one.
pub(super) fn fitted(name: &str, project: &Project) -> anyhow::Result<Option<Outcome>> {
    let (fit, member) = name.split_once('#').map_or((name, None), |(f, m)| (f, Some(m)));
    let path = project.fits().join(format!("{fit}.json"));
    if !path.is_file() {
        return Ok(None);
    }
    let shown = project.shown(&path);
    let family = match (FitResult::read(&path)?, member) {
        (FitResult::Single(outcome), None) => return Ok(Some(*outcome)),
        (FitResult::Single(_), Some(label)) => {
            bail!("{shown}: a single fit, without a member `{label}`")
        }
        (FitResult::Family(family), _) => family,
    };
    let label = |outcome: &Outcome| {
        outcome.name.split_once('#').map_or(String::new(), |(_, label)| label.to_owned())
    };
    let known = || family.members.iter().map(label).collect::<Vec<_>>().join(", ");
    let Some(member) = member else {
        bail!("{shown}: a family; name a member, as in '{fit}#LABEL'; labels: {}", known());
    };
    match family.members.iter().find(|outcome| label(outcome) == member) {
        Some(outcome) => Ok(Some(outcome.clone())),
        None => bail!("{shown}: no member `{member}`; there are: {}", known()),
    }
}

fn unknown(name: &str, project: Option<&Project>) -> anyhow::Error {
    let references = EFFECTS.iter().flat_map(|effect| effect.references).map(|r| r.name);
    let forms =
        EFFECTS.iter().flat_map(|effect| registry::forms_of(effect)).map(|f| f.name.as_str());
    let known: Vec<&str> = references.chain(forms).collect();
    let without = if project.is_none() { " (fits were not searched: no project)" } else { "" };
    anyhow!("there is no reference, fit or form `{name}`; known: {}{without}", known.join(", "))
}
