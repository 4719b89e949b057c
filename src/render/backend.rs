//! Where kernels run: on the device, or on the CPU's f32 lanes. The text is the same.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use crate::form::Form;
use crate::form::lanes::Evaluator;
use crate::gpu::{self, Device};

use super::error::RenderError;
use super::shading::Columns;

/// Points that one task on the CPU takes: a few tasks per thread, within these bounds.
const TASK_POINTS: RangeInclusive<usize> = 16..=512;

/// A form that returns R, G, B, with the f32 that ship: what is drawn and timed.
#[derive(Debug, Clone)]
pub struct Kernel {
    /// The form.
    pub form: Form,
    /// One value per parameter of the form.
    pub constants: Vec<f32>,
}

/// Where kernels run.
#[derive(Debug, Clone, Copy)]
pub enum Backend<'d> {
    /// The GPU.
    Device(&'d Device),
    /// f32 lanes on the CPU.
    Lanes,
}

impl Backend<'_> {
    /// The device, or `CPU, f32 lanes`.
    pub fn description(&self) -> String {
        match self {
            Self::Device(device) => device.description().to_string(),
            Self::Lanes => "CPU, f32 lanes".to_owned(),
        }
    }
}

/// Kernels made ready, whose colours add up.
pub(super) enum Painter<'d> {
    Device(Vec<gpu::DeviceKernel<'d>>),
    Lanes(Vec<Kernel>),
}

impl<'d> Painter<'d> {
    /// Compiles for a device; lanes are compiled with their form.
    pub(super) fn new(kernels: Vec<Kernel>, backend: Backend<'d>) -> Result<Self, RenderError> {
        let Backend::Device(device) = backend else { return Ok(Self::Lanes(kernels)) };
        let compile = |kernel: &Kernel| device.compile(&kernel.form, &kernel.constants);
        Ok(Self::Device(kernels.iter().map(compile).collect::<Result<_, _>>()?))
    }

    /// R, G and B at every row of the input columns.
    pub(super) fn colours(&self, inputs: &[Vec<f32>]) -> Result<Columns, RenderError> {
        let rows = inputs.first().map_or(0, Vec::len);
        let mut sums = vec![vec![0.0_f32; rows]; 3];
        match self {
            Self::Device(compiled) => {
                for kernel in compiled {
                    add(&mut sums, kernel.evaluate(inputs)?);
                }
            }
            Self::Lanes(kernels) => {
                for kernel in kernels {
                    add(&mut sums, on_lanes(kernel, inputs, rows)?);
                }
            }
        }
        Ok(sums)
    }
}

/// Adds columns to `sums`, value by value.
pub(super) fn add(sums: &mut [Vec<f32>], columns: Columns) {
    for (sum, column) in sums.iter_mut().zip(columns) {
        sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += value);
    }
}

fn on_lanes(kernel: &Kernel, inputs: &[Vec<f32>], rows: usize) -> Result<Columns, RenderError> {
    let task = rows
        .div_ceil(4 * rayon::current_num_threads())
        .clamp(*TASK_POINTS.start(), *TASK_POINTS.end());
    let starts: Vec<usize> = (0..rows).step_by(task).collect();
    let parts: Vec<Vec<Vec<f32>>> = starts
        .into_par_iter()
        .map_init(
            || Evaluator::<f32>::new(&kernel.form),
            |evaluator, start| {
                let range = start..rows.min(start + task);
                let columns: Vec<&[f32]> =
                    inputs.iter().filter_map(|column| column.get(range.clone())).collect();
                let mut values = Vec::new();
                evaluator.eval_into(&kernel.constants, &columns, &mut values)?;
                Ok(values)
            },
        )
        .collect::<Result<_, RenderError>>()?;
    let mut whole = vec![Vec::new(); 3];
    for part in parts {
        for (column, values) in whole.iter_mut().zip(part) {
            column.extend(values);
        }
    }
    Ok(whole)
}
