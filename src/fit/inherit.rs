//! Constants that a fit takes from the results of others.

use super::error::FitError;
use super::run::{Context, FitResult};
use super::spec::{ParameterChoice, Spec};
use crate::form::Form;

/// The spec with every constant fixed that it takes from the results of other fits.
pub(super) fn inherit(spec: &Spec, form: &Form, context: &Context) -> Result<Spec, FitError> {
    let mut spec = spec.clone();
    for name in &spec.constants.clone() {
        let wrong = |what: String| spec.fault("constants", what);
        let path = context.root.join("fits").join(format!("{name}.json"));
        if name.contains("..") || !path.is_file() {
            return Err(wrong(format!("`{name}` has no result; run `striae fit {name}` first")));
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
