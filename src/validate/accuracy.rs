//! Error of a form with given constants against its target, in f64, f32 and on the device.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

#[cfg(doc)]
use crate::effect::Region;
use crate::effect::{Candidate, Distribution, NoValue, Reference, Yardstick};
use crate::fit::outcome::Residuals;
use crate::form::{Form, Input};
use crate::gpu::{Device, DeviceKernel};
use crate::numeric::measured::Measured;
use crate::table::Table;
use crate::validate::ValidateError;

/// Points and what the form should return there.
#[derive(Debug, Clone)]
pub struct GroundTruth {
    /// Argument names, as in [`Form::input_columns`].
    pub arguments: Vec<String>,
    /// One column per argument.
    pub inputs: Vec<Vec<f64>>,
    /// The true values; of several outputs all rows of the first before those of the next.
    pub values: Vec<f64>,
    /// How many outputs are judged together.
    pub outputs: usize,
    /// What the points are grouped by, and its value at each; see [`Region::by`].
    pub groups: Option<(&'static str, Vec<f64>)>,
    /// The error by which forms are compared here.
    pub yardstick: Yardstick,
    /// What draws are held against in place of values: one per run of rows of the same length, whose
    /// means are the values. Empty where values are judged.
    pub distributions: Vec<Distribution>,
}

/// Points of a reference with its values, for forms that may take more than its arguments.
#[derive(Debug, Clone)]
pub struct Judged {
    /// Columns for every argument of the reference, and further ones.
    pub points: Table,
    /// The argument that parts the points into groups.
    pub by: Option<&'static str>,
    /// The true values and distributions, without inputs of a form.
    pub(super) truth: GroundTruth,
}

impl Judged {
    /// The values of `reference` at `points`.
    ///
    /// # Errors
    /// If a column is missing, or the reference has no value at some row.
    pub fn new(
        reference: &Reference,
        points: Table,
        by: Option<&'static str>,
        yardstick: Yardstick,
    ) -> Result<Self, ValidateError> {
        let columns = reference
            .arguments
            .iter()
            .map(|argument| column(&points, argument.name))
            .collect::<Result<Vec<_>, _>>()?;
        let failed = |NoValue { row, source }| ValidateError::Unusable {
            origin: format!("reference `{}`, row {}", reference.name, row + 1),
            what: source.to_string(),
        };
        let truth = GroundTruth {
            values: reference.over(&columns).map_err(failed)?,
            distributions: reference.distributions(&columns).map_err(failed)?,
            outputs: reference.outputs().len(),
            yardstick,
            ..GroundTruth::none()
        };
        Ok(Self { points, by, truth })
    }

    /// Whether the points have every input of `form`, but for what numbers its draws.
    pub fn serves(&self, form: &Form) -> bool {
        let there = |input: &String| self.points.column(input).is_some();
        self.counter(form).is_some() || form.input_columns().iter().all(there)
    }

    /// The points as `form` takes them; of a form that draws, its draws at each of them.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn target(&self, form: &Form) -> Result<GroundTruth, ValidateError> {
        if let Some(counter) = self.counter(form) {
            return self.drawn(form, counter);
        }
        let groups = match self.by {
            None => None,
            Some(by) => Some((by, column(&self.points, by)?.to_vec())),
        };
        let truth = GroundTruth { groups, distributions: Vec::new(), ..self.truth.clone() };
        truth.at(&self.points, form)
    }
}

impl GroundTruth {
    /// The values of `reference` at `points`, which have a column for every input of `form` too.
    ///
    /// # Errors
    /// If a column is missing, or the reference has no value at some row.
    pub fn of_reference(
        reference: &Reference,
        points: Table,
        form: &Form,
    ) -> Result<Self, ValidateError> {
        Judged::new(reference, points, None, Yardstick::MaxAbs)?.target(form)
    }

    /// The `value` column of a family member's table, at the arguments that `form` takes.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn of_table(table: &Table, form: &Form) -> Result<Self, ValidateError> {
        let values = column(table, "value")?.to_vec();
        Self { values, ..Self::none() }.at(table, form)
    }

    /// True values at the columns of `table` that `form` takes.
    fn at(mut self, table: &Table, form: &Form) -> Result<Self, ValidateError> {
        self.arguments = form.input_columns();
        let inputs = self.arguments.iter().map(|argument| Ok(column(table, argument)?.to_vec()));
        self.inputs = inputs.collect::<Result<_, ValidateError>>()?;
        Ok(self)
    }

    /// The points of all in one group, for targets of the same arguments; none of none.
    pub fn all(targets: impl IntoIterator<Item = Self>) -> Option<Self> {
        targets.into_iter().reduce(|mut all, more| {
            all.groups = None;
            all.distributions.clear();
            let rows = [&all, &more].map(|target| target.values.len() / target.outputs.max(1));
            let parts = all.values.chunks(rows[0].max(1)).zip(more.values.chunks(rows[1].max(1)));
            all.values = parts.flat_map(|(own, added)| own.iter().chain(added).copied()).collect();
            for (column, added) in all.inputs.iter_mut().zip(more.inputs) {
                column.extend(added);
            }
            all
        })
    }

    /// Error of `values` relative to the target in the L2 norm over each group of points, or over
    /// all of them without groups: the worst, and its group. Groups whose target is 0 everywhere
    /// are left out.
    pub fn relative_l2(&self, values: &[f64]) -> RelativeL2 {
        let mut sums: BTreeMap<u64, (f64, f64, f64)> = BTreeMap::new();
        for (at, (value, target)) in values.iter().zip(&self.values).enumerate() {
            let of = |(_, column): &(_, Vec<f64>)| column[at % column.len()];
            let group = self.groups.as_ref().map_or(0.0, of);
            let sum = sums.entry(group.to_bits()).or_insert((group, 0.0, 0.0));
            sum.1 += (value - target) * (value - target);
            sum.2 += target * target;
        }
        let (at, value) = sums
            .values()
            .filter(|(_, _, norm)| *norm > 0.0)
            .map(|(group, error, norm)| (*group, (error / norm).sqrt()))
            .reduce(|worst, other| {
                let worse = other.1.is_nan() || other.1 > worst.1;
                if worse && !worst.1.is_nan() { other } else { worst }
            })
            .unwrap_or((f64::NAN, f64::NAN));
        let at = self.groups.as_ref().map(|(by, _)| ((*by).to_owned(), at));
        RelativeL2 { value, at: at.into_iter().collect() }
    }

    /// No points.
    pub(crate) fn none() -> Self {
        Self {
            arguments: Vec::new(),
            inputs: Vec::new(),
            values: Vec::new(),
            outputs: 1,
            groups: None,
            yardstick: Yardstick::MaxAbs,
            distributions: Vec::new(),
        }
    }

    /// Residuals of `values` against the target.
    pub fn residuals(&self, values: &[f64]) -> Residuals {
        Residuals::measure(&self.inputs, &self.arguments, values, &self.values)
    }
}

pub(super) fn column<'t>(table: &'t Table, name: &str) -> Result<&'t [f64], ValidateError> {
    let column = table.column(name).map(|column| column.values.as_slice());
    column.ok_or_else(|| ValidateError::Unusable {
        origin: table.origin.clone(),
        what: format!("no column `{name}`; there are: {}", table.names().join(", ")),
    })
}

/// An error relative to the target in the L2 norm: the worst over groups of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RelativeL2 {
    /// √(Σ error² / Σ target²), 1; NaN if the target is 0 everywhere.
    pub value: f64,
    /// The worst group; empty if the points are one group.
    pub at: BTreeMap<String, f64>,
}

/// Residuals in each precision, over the same points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// f64 constants, f64 arithmetic: what the formula itself costs.
    pub f64: Residuals,
    /// Shipped constants, f32 arithmetic with correctly rounded elementary functions.
    pub f32: Residuals,
    /// Shipped constants on the device.
    pub device: Measured<Residuals>,
    /// Relative L2 error in f32: the worst group of points.
    pub relative_l2: RelativeL2,
    /// The error by which forms are compared here.
    pub yardstick: Yardstick,
    /// That error on the device; NaN where it has no value.
    pub headline_device: Measured<f64>,
    /// The error of the f64 optimum by the yardstick.
    pub headline_f64: f64,
}

impl Accuracy {
    /// The error in f32 by which forms are compared; NaN where it has no value.
    pub fn headline(&self) -> f64 {
        headline(self.yardstick, &self.f32, self.relative_l2.value)
    }
}

fn headline(yardstick: Yardstick, residuals: &Residuals, relative_l2: f64) -> f64 {
    match yardstick {
        Yardstick::MaxAbs => residuals.max_abs,
        Yardstick::MaxRelative => residuals.max_rel.unwrap_or(f64::NAN),
        Yardstick::RelativeL2 => relative_l2,
    }
}

/// Measures `candidate` against `target` in f64, in f32 and, where there is one, on the device with
/// the form's `kernel`.
///
/// # Errors
/// If the form cannot be evaluated, or the device fails.
pub fn accuracy(
    candidate: &Candidate,
    target: &GroundTruth,
    kernel: &Measured<DeviceKernel<'_>>,
) -> Result<Accuracy, ValidateError> {
    let judged = |values: &[f64]| {
        let (residuals, norm) = (target.residuals(values), target.relative_l2(values));
        let headline = headline(target.yardstick, &residuals, norm.value);
        (residuals, norm, headline)
    };
    let (device, headline_device) = match kernel {
        Measured::NotMeasured(reason) => {
            (Measured::NotMeasured(reason.clone()), Measured::NotMeasured(reason.clone()))
        }
        Measured::Value(kernel) => {
            let (residuals, _, headline) = judged(&widened(&kernel_values(kernel, target)?));
            (Measured::Value(residuals), Measured::Value(headline))
        }
    };
    let (f64, _, headline_f64) = judged(&values(candidate, target, Arithmetic::F64)?);
    let (f32, relative_l2, _) = judged(&values(candidate, target, Arithmetic::F32)?);
    let yardstick = target.yardstick;
    Ok(Accuracy { f64, f32, device, relative_l2, yardstick, headline_device, headline_f64 })
}

/// In which arithmetic a form is evaluated.
#[derive(Debug, Clone, Copy)]
pub enum Arithmetic<'d> {
    /// f64 constants in f64.
    F64,
    /// Shipped constants in f32 with correctly rounded elementary functions.
    F32,
    /// Shipped constants on a device.
    Device(&'d Device),
}

/// Values at the target's points in one arithmetic.
///
/// # Errors
/// If the form cannot be evaluated, or the device fails.
pub fn values(
    candidate: &Candidate,
    target: &GroundTruth,
    arithmetic: Arithmetic<'_>,
) -> Result<Vec<f64>, ValidateError> {
    let Candidate { form, constants, constants_f32, .. } = candidate;
    match arithmetic {
        Arithmetic::F64 => {
            let inputs: Vec<&[f64]> = target.inputs.iter().map(Vec::as_slice).collect();
            joined(form.origin(), target, form.eval_f64(constants, &inputs)?)
        }
        Arithmetic::F32 => Ok(widened(&values_f32(candidate, target)?)),
        Arithmetic::Device(device) => {
            Ok(widened(&kernel_values(&device.compile(form, constants_f32)?, target)?))
        }
    }
}

/// Values in f32 at the target's points.
pub(crate) fn values_f32(
    candidate: &Candidate,
    target: &GroundTruth,
) -> Result<Vec<f32>, ValidateError> {
    let Candidate { form, constants_f32, .. } = candidate;
    let values = form.eval_f32_inputs(constants_f32, &as_inputs(&target.inputs))?;
    joined(form.origin(), target, values)
}

/// Values of a compiled form at the target's points.
pub(crate) fn kernel_values(
    kernel: &DeviceKernel<'_>,
    target: &GroundTruth,
) -> Result<Vec<f32>, ValidateError> {
    let values = kernel.evaluate_inputs(&as_inputs(&target.inputs))?;
    joined(kernel.origin(), target, values)
}

/// The outputs that `target` has values for, one after the other.
fn joined<T: Copy>(
    form: &str,
    target: &GroundTruth,
    mut outputs: Vec<Vec<T>>,
) -> Result<Vec<T>, ValidateError> {
    match target.outputs {
        1 => Ok(outputs.swap_remove(0)),
        wanted if wanted == outputs.len() => Ok(outputs.concat()),
        expected => Err(ValidateError::Unusable {
            origin: form.to_owned(),
            what: format!("returns {} values, its reference {expected}", outputs.len()),
        }),
    }
}

fn as_inputs(inputs: &[Vec<f64>]) -> Vec<Input<'_>> {
    inputs.iter().map(Input::from).collect()
}

pub(super) fn widened(values: &[f32]) -> Vec<f64> {
    values.iter().map(|value| f64::from(*value)).collect()
}
