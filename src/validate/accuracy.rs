//! Error of a form with given constants against its target, in f64, f32 and on the device.

use serde::{Deserialize, Serialize};

use crate::effects::registry::Reference;
use crate::fit::outcome::Residuals;
use crate::form::Form;
use crate::gpu::Device;
use crate::table::Table;
use crate::validate::ValidateError;
use crate::validate::measured::Measured;

/// A form with its constants, in the order of [`Form::parameters`].
#[derive(Debug, Clone)]
pub struct Shipped {
    /// Name under which it is reported: a fit, or a member of a family.
    pub name: String,
    /// The form.
    pub form: Form,
    /// Constants before rounding.
    pub constants: Vec<f64>,
    /// Constants as shipped.
    pub constants_f32: Vec<f32>,
}

/// Points and what the form should return there.
#[derive(Debug, Clone)]
pub struct Target {
    /// Argument names, as in [`Form::input_columns`].
    pub arguments: Vec<String>,
    /// One column per argument.
    pub inputs: Vec<Vec<f64>>,
    /// The true values.
    pub values: Vec<f64>,
}

impl Target {
    /// The values of `reference` at `points`, for the arguments that `form` takes.
    ///
    /// # Errors
    /// If a column is missing, or the reference has no value at some row.
    pub fn of_reference(reference: &Reference, points: &Table) -> Result<Self, ValidateError> {
        let columns = reference
            .arguments
            .iter()
            .map(|argument| column(points, argument.name))
            .collect::<Result<Vec<_>, _>>()?;
        let values = (0..points.rows())
            .map(|row| {
                let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
                (reference.evaluate)(&point).map_err(|source| ValidateError::Reference {
                    reference: reference.name,
                    row: row + 1,
                    source,
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            arguments: reference
                .arguments
                .iter()
                .map(|argument| argument.name.to_owned())
                .collect(),
            inputs: columns.into_iter().map(<[f64]>::to_vec).collect(),
            values,
        })
    }

    /// The `value` column of a family member's table, at the arguments that `form` takes.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn of_table(table: &Table, form: &Form) -> Result<Self, ValidateError> {
        let arguments = form.input_columns();
        let inputs = arguments
            .iter()
            .map(|argument| column(table, argument).map(<[f64]>::to_vec))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self { arguments, inputs, values: column(table, "value")?.to_vec() })
    }

    /// The points of all, for targets of the same arguments; none of none.
    pub fn all(targets: impl IntoIterator<Item = Self>) -> Option<Self> {
        targets.into_iter().reduce(|mut all, more| {
            for (column, added) in all.inputs.iter_mut().zip(more.inputs) {
                column.extend(added);
            }
            all.values.extend(more.values);
            all
        })
    }

    /// Residuals of `values` against the target.
    fn residuals(&self, values: &[f64]) -> Residuals {
        Residuals::measure(&self.inputs, &self.arguments, values, &self.values)
    }
}

fn column<'t>(table: &'t Table, name: &str) -> Result<&'t [f64], ValidateError> {
    table.column(name).map(|column| column.values.as_slice()).ok_or_else(|| {
        ValidateError::MissingColumn {
            table: table.origin.clone(),
            column: name.to_owned(),
            known: table.columns.iter().map(|column| column.name.clone()).collect(),
        }
    })
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
}

/// Measures `shipped` against `target` in f64, in f32 and, where there is one, on the device.
///
/// # Errors
/// If the form cannot be evaluated, or the device fails.
pub fn accuracy(
    shipped: &Shipped,
    target: &Target,
    device: &Measured<Device>,
) -> Result<Accuracy, ValidateError> {
    let device = match device {
        Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
        Measured::Value(device) => {
            let values = device_values(shipped, target, device)?;
            Measured::Value(target.residuals(&widened(&values)))
        }
    };
    Ok(Accuracy {
        f64: residuals_f64(shipped, target)?,
        f32: residuals_f32(shipped, target)?,
        device,
    })
}

/// Residuals of the f64 constants in f64.
///
/// # Errors
/// If the form cannot be evaluated.
pub fn residuals_f64(shipped: &Shipped, target: &Target) -> Result<Residuals, ValidateError> {
    let inputs: Vec<&[f64]> = target.inputs.iter().map(Vec::as_slice).collect();
    let values = shipped.form.eval_f64(&shipped.constants, &inputs)?;
    Ok(target.residuals(&values[0]))
}

/// Residuals of the shipped constants in f32.
///
/// # Errors
/// If the form cannot be evaluated.
pub fn residuals_f32(shipped: &Shipped, target: &Target) -> Result<Residuals, ValidateError> {
    Ok(target.residuals(&widened(&values_f32(shipped, target)?)))
}

/// Residuals of the shipped constants on the device.
///
/// # Errors
/// If the device fails.
pub fn residuals_device(
    shipped: &Shipped,
    target: &Target,
    device: &Device,
) -> Result<Residuals, ValidateError> {
    Ok(target.residuals(&widened(&device_values(shipped, target, device)?)))
}

/// Values in f32 at the target's points.
pub(crate) fn values_f32(shipped: &Shipped, target: &Target) -> Result<Vec<f32>, ValidateError> {
    let narrow = narrowed(&target.inputs);
    let inputs: Vec<&[f32]> = narrow.iter().map(Vec::as_slice).collect();
    let mut values = shipped.form.eval_f32(&shipped.constants_f32, &inputs)?;
    Ok(values.swap_remove(0))
}

/// Values on the device at the target's points.
pub(crate) fn device_values(
    shipped: &Shipped,
    target: &Target,
    device: &Device,
) -> Result<Vec<f32>, ValidateError> {
    let kernel = device.compile(&shipped.form, &shipped.constants_f32)?;
    let mut values = kernel.evaluate(&narrowed(&target.inputs))?;
    Ok(values.swap_remove(0))
}

fn narrowed(columns: &[Vec<f64>]) -> Vec<Vec<f32>> {
    columns.iter().map(|column| column.iter().map(|value| *value as f32).collect()).collect()
}

fn widened(values: &[f32]) -> Vec<f64> {
    values.iter().map(|value| f64::from(*value)).collect()
}
