//! A registered form with the constants that it ships with: what findings and exhibits evaluate.

use super::{FittedConstants, FormEntry};
use crate::form::{Form, FormError};

/// A form and one value per parameter of it.
#[derive(Debug, Clone)]
pub struct FittedForm {
    form: Form,
    constants: Vec<f64>,
}

impl FittedForm {
    /// `entry` with the constants of the fit called `fit`, or those of its text where there is no
    /// such fit.
    ///
    /// # Errors
    /// [`FormError`] if the text is not a form; [`FormError::Shape`] if a constant has a value in
    /// neither.
    pub fn new(entry: &FormEntry, fit: &str, fitted: &FittedConstants) -> Result<Self, FormError> {
        let form = entry.load()?;
        let known = fitted.0.get(fit);
        let constants = form
            .parameters()
            .iter()
            .map(|p| known.and_then(|values| values.get(&p.name)).copied().or(p.default))
            .collect::<Option<_>>()
            .ok_or_else(|| FormError::Shape {
                origin: entry.path.clone(),
                function: entry.function.clone(),
                what: "a constant has neither a fitted value nor one in the text".into(),
            })?;
        Ok(Self { form, constants })
    }

    /// The form.
    pub fn form(&self) -> &Form {
        &self.form
    }

    /// Values in f64; `inputs` as for [`Form::eval_f64`].
    ///
    /// # Errors
    /// As [`Form::eval_f64`].
    pub fn double(&self, inputs: &[&[f64]]) -> Result<Vec<f64>, FormError> {
        Ok(self.form.eval_f64(&self.constants, inputs)?.into_iter().flatten().collect())
    }

    /// Values in f32 with the constants rounded; `inputs` as for [`Form::eval_f32`].
    ///
    /// # Errors
    /// As [`Form::eval_f32`].
    pub fn single(&self, inputs: &[&[f32]]) -> Result<Vec<f32>, FormError> {
        let constants: Vec<f32> = self.constants.iter().map(|value| *value as f32).collect();
        Ok(self.form.eval_f32(&constants, inputs)?.into_iter().flatten().collect())
    }
}
