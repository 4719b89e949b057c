//! What is fitted: values and exact derivatives at every point as functions of the free constants.

use std::cell::RefCell;

use crate::form::lanes::{DualEvaluator, Evaluator};
use crate::form::{Dual, Form, FormError};

/// Values with their derivatives by the free constants.
#[derive(Debug, Clone)]
pub struct Linearisation {
    /// One value per point.
    pub values: Vec<f64>,
    /// `derivatives[free constant][point]`.
    pub derivatives: Vec<Vec<f64>>,
}

/// Where the value of one `override` comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Origin {
    /// The free constant of this index.
    Free(usize),
    /// A fixed value.
    Fixed(f64),
}

impl Origin {
    /// The value for given free constants; not a number for one that is not among them.
    pub(super) fn value<T: Copy>(self, free: &[T], of: fn(f64) -> T) -> T {
        match self {
            Self::Free(owner) => free.get(owner).copied().unwrap_or(of(f64::NAN)),
            Self::Fixed(value) => of(value),
        }
    }
}

/// A [`Form`] at the points of a table: some of its output columns, all rows of the first before those of
/// the next.
pub struct FormModel<'a> {
    inputs: Vec<&'a [f64]>,
    outputs: &'a [usize],
    origins: &'a [Origin],
    owners: Vec<usize>,
    free: usize,
    evaluator: RefCell<Evaluator<f64>>,
    dual: RefCell<(DualEvaluator, Dual)>,
}

impl<'a> FormModel<'a> {
    /// `origins` in the order of [`Form::parameters`]; `inputs` one column per input column;
    /// `outputs` the indices of the output columns. Several `override`s may share a free constant:
    /// they are tied.
    ///
    /// # Errors
    /// [`FormError::Shape`] if there are more origins than parameters.
    pub fn new(
        form: &Form,
        inputs: &'a [Vec<f64>],
        outputs: &'a [usize],
        origins: &'a [Origin],
    ) -> Result<Self, FormError> {
        let (varying, owners): (Vec<_>, Vec<_>) = origins
            .iter()
            .enumerate()
            .filter_map(|(index, origin)| match origin {
                Origin::Free(owner) => Some((index, *owner)),
                Origin::Fixed(_) => None,
            })
            .unzip();
        let empty = Dual { values: Vec::new(), derivatives: Vec::new() };
        Ok(Self {
            inputs: inputs.iter().map(Vec::as_slice).collect(),
            outputs,
            origins,
            free: owners.iter().max().map_or(0, |last| last + 1),
            owners,
            evaluator: RefCell::new(Evaluator::<f64>::new(form)),
            dual: RefCell::new((DualEvaluator::new(form, &varying)?, empty)),
        })
    }

    /// The value of every `override`, in the order of [`Form::parameters`].
    fn overrides(&self, free: &[f64]) -> Vec<f64> {
        self.origins.iter().map(|origin| origin.value(free, |value| value)).collect()
    }

    /// The values at every point.
    ///
    /// # Errors
    /// [`FormError`] if the form cannot be evaluated, because a loop does not end, say.
    pub fn values(&self, free: &[f64]) -> Result<Vec<f64>, FormError> {
        let mut columns = Vec::new();
        let overrides = self.overrides(free);
        self.evaluator.borrow_mut().eval_into(&overrides, &self.inputs, &mut columns)?;
        let column = |output: &usize| columns.get(*output).into_iter().flatten().copied();
        Ok(self.outputs.iter().flat_map(column).collect())
    }

    /// The values and their exact derivatives.
    ///
    /// # Errors
    /// As [`FormModel::values`].
    pub fn linearise(&self, free: &[f64]) -> Result<Linearisation, FormError> {
        let mut kept = self.dual.borrow_mut();
        let (evaluator, dual) = &mut *kept;
        evaluator.eval_into(&self.overrides(free), &self.inputs, dual)?;
        let value = |output: &usize| dual.values.get(*output).into_iter().flatten().copied();
        let values = self.outputs.iter().flat_map(value).collect();
        let mut derivatives: Vec<Vec<f64>> = vec![Vec::new(); self.free];
        for (place, owner) in self.owners.iter().enumerate() {
            let of = |output: &usize| dual.derivatives.get(*output)?.get(place);
            let column = self.outputs.iter().filter_map(of).flatten().copied();
            if let Some(sum) = derivatives.get_mut(*owner) {
                if sum.is_empty() {
                    sum.extend(column);
                } else {
                    sum.iter_mut().zip(column).for_each(|(s, c)| *s += c);
                }
            }
        }
        Ok(Linearisation { values, derivatives })
    }
}
