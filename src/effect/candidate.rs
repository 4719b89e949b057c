//! Candidates: a form with the constants that ship, and where they come from. What is judged, drawn,
//! timed, gated, rendered, emitted and claimed about is a candidate.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::form::{Form, FormError};
use crate::table::Table;

/// Where the constants of a candidate come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConstantsOf {
    /// The text of the form: nothing in it was fitted.
    Text,
    /// Other fits, by name, which the form is made of.
    Fits(Vec<String>),
    /// A fit of its own, by name (`effect/name`, or `effect/name#member`).
    Fit(String),
}

/// A form and one value per constant of it: the optimum in f64 and the f32 that ships.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// `effect/name`, a member as `effect/name#member`, `FILE.wgsl#function`, or a result file.
    pub name: String,
    /// The form.
    pub form: Form,
    /// The constants in f64, in the order of [`Form::parameters`].
    pub constants: Vec<f64>,
    /// The constants that ship, in the same order.
    pub constants_f32: Vec<f32>,
    /// Where they come from.
    pub constants_of: ConstantsOf,
}

/// Why there is no candidate.
#[derive(Debug, Clone, thiserror::Error)]
pub enum CandidateError {
    /// A constant has a value neither in the fit nor in the text.
    #[error("{name}: the constant `{constant}` has no value, neither fitted nor in the text")]
    NoConstant {
        /// The candidate.
        name: String,
        /// The constant.
        constant: String,
    },
    /// Nothing has this name.
    #[error("there is no candidate `{name}`")]
    Unknown {
        /// The name.
        name: String,
    },
    /// The form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
}

impl Candidate {
    /// `form` with `values` (f64 and f32 by constant), and the values of its text for the others.
    ///
    /// # Errors
    /// [`CandidateError::NoConstant`] if a constant has a value in neither.
    pub fn new(
        name: &str,
        form: Form,
        values: &BTreeMap<String, (f64, f32)>,
        constants_of: ConstantsOf,
    ) -> Result<Self, CandidateError> {
        let pairs = form
            .parameters()
            .iter()
            .map(|parameter| {
                let default = parameter.default.map(|value| (value, value as f32));
                values.get(&parameter.name).copied().or(default).ok_or_else(|| {
                    CandidateError::NoConstant {
                        name: name.to_owned(),
                        constant: parameter.name.clone(),
                    }
                })
            })
            .collect::<Result<Vec<(f64, f32)>, _>>()?;
        let (constants, constants_f32) = pairs.into_iter().unzip();
        Ok(Self { name: name.to_owned(), form, constants, constants_f32, constants_of })
    }

    /// The names of the constants, and the f32 that ship, widened.
    pub fn shipped(&self) -> impl Iterator<Item = (&str, f64)> {
        let values = self.constants_f32.iter().map(|value| f64::from(*value));
        self.form.parameters().iter().map(|parameter| parameter.name.as_str()).zip(values)
    }

    /// Values of the first output in f64 arithmetic with the constants that ship; `inputs` as for
    /// [`Form::eval_f64`].
    ///
    /// # Errors
    /// As [`Form::eval_f64`].
    pub fn values(&self, inputs: &[&[f64]]) -> Result<Vec<f64>, FormError> {
        let shipped: Vec<f64> = self.shipped().map(|(_, value)| value).collect();
        Ok(self.form.eval_f64(&shipped, inputs)?.swap_remove(0))
    }

    /// Values of the first output in f32 with the constants that ship; `inputs` as for
    /// [`Form::eval_f32`].
    ///
    /// # Errors
    /// As [`Form::eval_f32`].
    pub fn values_f32(&self, inputs: &[&[f32]]) -> Result<Vec<f32>, FormError> {
        Ok(self.form.eval_f32(&self.constants_f32, inputs)?.swap_remove(0))
    }

    /// [`Candidate::values`] at the rows of a table that has a column for every input, by name.
    ///
    /// # Errors
    /// [`FormError::Shape`] if a column is missing.
    pub fn values_at(&self, points: &Table) -> Result<Vec<f64>, FormError> {
        self.values(&self.inputs(points)?)
    }

    /// [`Candidate::values_f32`] at the rows of a table that has a column for every input, by name.
    ///
    /// # Errors
    /// [`FormError::Shape`] if a column is missing.
    pub fn values_f32_at(&self, points: &Table) -> Result<Vec<f32>, FormError> {
        let inputs = self.inputs(points)?;
        let rounded = |column: &&[f64]| column.iter().map(|v| *v as f32).collect::<Vec<f32>>();
        let inputs: Vec<Vec<f32>> = inputs.iter().map(rounded).collect();
        self.values_f32(&inputs.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    /// What laws take the candidate for: [`Candidate::values_f32_at`], all NaN where it has no value.
    pub fn values_for_laws(&self, points: &Table) -> Vec<f32> {
        self.values_f32_at(points).unwrap_or_else(|_| vec![f32::NAN; points.rows().max(1)])
    }

    fn inputs<'a>(&self, points: &'a Table) -> Result<Vec<&'a [f64]>, FormError> {
        let of = |name: &String| {
            let column = points.column(name).map(|column| column.values.as_slice());
            column.ok_or_else(|| FormError::Shape {
                origin: self.form.origin().into(),
                function: self.name.clone(),
                what: format!("{} has no column `{name}`", points.origin),
            })
        };
        self.form.input_columns().iter().map(of).collect()
    }
}

/// Candidates by name, as claims and exhibits ask for them.
#[derive(Debug, Clone, Default)]
pub struct Candidates(BTreeMap<String, Arc<Candidate>>);

impl Candidates {
    /// The candidate called `name`.
    ///
    /// # Errors
    /// [`CandidateError::Unknown`] if there is none.
    pub fn get(&self, name: &str) -> Result<&Arc<Candidate>, CandidateError> {
        self.0.get(name).ok_or_else(|| CandidateError::Unknown { name: name.to_owned() })
    }

    /// Every candidate, by name.
    pub fn iter(&self) -> impl Iterator<Item = &Arc<Candidate>> {
        self.0.values()
    }
}

impl FromIterator<Arc<Candidate>> for Candidates {
    fn from_iter<I: IntoIterator<Item = Arc<Candidate>>>(candidates: I) -> Self {
        Self(candidates.into_iter().map(|found| (found.name.clone(), found)).collect())
    }
}
