//! Evaluators: a machine kept with its form, so that repeated evaluations allocate nothing.

use naga::{Handle, Literal, Override, ScalarKind};

use super::dual::Planes;
use super::machine::{Files, Machine, Tangents, Unbounded, ValuesOnly};
use super::{LANES, MAX_CHUNK_COST, MAX_LOOP_ITERATIONS, Real};
use crate::form::program::{Kind, Reg};
use crate::form::{Dual, Form, FormError, Input};

/// Evaluates one form again and again, in f64 or f32, without allocating.
#[derive(Debug, Clone)]
pub struct Evaluator<R> {
    form: Form,
    machine: Machine<R, ValuesOnly>,
}

macro_rules! evaluator {
    ($real:ty) => {
        impl Evaluator<$real> {
            /// An evaluator that allocates nothing from its second use on.
            pub fn new(form: &Form) -> Self {
                let machine = Machine::new(form.program(), ValuesOnly);
                Self { form: form.clone(), machine }
            }

            /// Evaluates at every point; `values` is resized to one vector per output column.
            ///
            /// `parameters` in the order of [`Form::parameters`]; `inputs` one column per entry of
            /// [`Form::input_columns`], all of one length (a form without inputs has one point).
            ///
            /// # Errors
            /// [`FormError::Shape`] if a count does not fit, [`FormError::Input`] if an integer
            /// argument does not take a number, [`FormError::Unbounded`] if a loop does not end.
            pub fn eval_into<'c>(
                &mut self,
                parameters: &[$real],
                inputs: &[impl Copy + Into<Input<'c>>],
                values: &mut Vec<Vec<$real>>,
            ) -> Result<(), FormError> {
                each_chunk(&self.form, &mut self.machine, parameters, inputs, values, |_, _| {})
            }
        }
    };
}

evaluator!(f64);
evaluator!(f32);

/// Evaluates one form again and again with derivatives by the same free parameters.
#[derive(Debug, Clone)]
pub struct DualEvaluator {
    form: Form,
    free: usize,
    machine: Machine<f64, Planes>,
}

impl DualEvaluator {
    /// An evaluator with derivatives by the parameters whose indices are in `free`; it allocates
    /// nothing from its second use on.
    ///
    /// # Errors
    /// [`FormError::Shape`] if `free` names no parameter or one twice.
    pub fn new(form: &Form, free: &[usize]) -> Result<Self, FormError> {
        let parameters = form.parameters().len();
        if let Some(index) = free.iter().find(|&&index| index >= parameters) {
            let what = format!("free parameter {index} asked for, but it has {parameters}");
            return Err(form.shape_error(what));
        }
        if let Some(index) = free.iter().enumerate().find(|(at, i)| free[..*at].contains(i)) {
            return Err(form.shape_error(format!("free parameter {} is given twice", index.1)));
        }
        let machine = Machine::new(form.program(), Planes::new(form.program(), free));
        Ok(Self { form: form.clone(), free: free.len(), machine })
    }

    /// Evaluates at every point; `dual` is resized as needed and overwritten.
    ///
    /// Arguments and errors as for [`Evaluator::eval_into`].
    ///
    /// # Errors
    /// As [`Evaluator::eval_into`].
    pub fn eval_into(
        &mut self,
        parameters: &[f64],
        inputs: &[&[f64]],
        dual: &mut Dual,
    ) -> Result<(), FormError> {
        let Dual { values, derivatives } = dual;
        let outputs = &self.form.program().outputs;
        let points = inputs.first().map_or(1, |input| input.len());
        derivatives.resize(outputs.len(), Vec::new());
        for planes in &mut *derivatives {
            planes.resize(self.free, Vec::new());
            planes.iter_mut().for_each(|plane| plane.resize(points, 0.0));
        }
        let collect = |machine: &Machine<f64, Planes>, at: std::ops::Range<usize>| {
            for (planes, &slot) in derivatives.iter_mut().zip(outputs) {
                for (k, out) in planes.iter_mut().enumerate() {
                    match machine.tangents.plane(slot, k) {
                        Some(plane) => out[at.clone()].copy_from_slice(&plane[..at.len()]),
                        None => out[at.clone()].fill(0.0),
                    }
                }
            }
        };
        each_chunk(&self.form, &mut self.machine, parameters, inputs, values, collect)
    }
}

/// Runs the form chunk by chunk; `collect` sees the machine after each.
fn each_chunk<'c, R: Real, T: Tangents<R>, C: Copy + Into<Input<'c>>>(
    form: &Form,
    machine: &mut Machine<R, T>,
    parameters: &[R],
    inputs: &[C],
    values: &mut Vec<Vec<R>>,
    mut collect: impl FnMut(&Machine<R, T>, std::ops::Range<usize>),
) -> Result<(), FormError> {
    let program = form.program();
    let count = |what: &str, got: usize, expected: usize| {
        if got == expected {
            return Ok(());
        }
        Err(form.shape_error(format!("it has {expected} {what}, but {got} were given")))
    };
    count("parameters", parameters.len(), program.parameters.len())?;
    count("scalar inputs", inputs.len(), program.inputs.len())?;
    let rows = |input: &C| -> usize { (*input).into().len() };
    let points = inputs.first().map_or(1, rows);
    if let Some(at) = inputs.iter().position(|input| rows(input) != points) {
        let (first, other, rows) = (form.input_column(0), form.input_column(at), rows(&inputs[at]));
        return Err(form.shape_error(format!(
            "column `{first}` has {points} rows, but column `{other}` has {rows}"
        )));
    }
    values.resize(program.outputs.len(), Vec::new());
    values.iter_mut().for_each(|column| column.resize(points, R::zero()));
    machine.prepare(program, parameters);
    for start in (0..points).step_by(LANES) {
        let chunk = start..points.min(start + LANES);
        for (at, (&reg, &input)) in program.inputs.iter().zip(inputs).enumerate() {
            let Files { floats, integers, .. } = &mut machine.files;
            if reg.kind == Kind::F {
                input.into().fill(chunk.clone(), &mut floats[reg.slot as usize]);
                continue;
            }
            let scalar = form.input_type(at);
            for (lane, row) in integers[reg.slot as usize].iter_mut().zip(chunk.clone()) {
                *lane = form.word(at, scalar, input.into(), row)?;
            }
        }
        machine.run(program, chunk.len()).map_err(|unbounded| unbounded_error(form, unbounded))?;
        for (column, &slot) in values.iter_mut().zip(&program.outputs) {
            let lanes = &machine.files.floats[slot as usize];
            column[chunk.clone()].copy_from_slice(&lanes[..chunk.len()]);
        }
        collect(machine, chunk);
    }
    Ok(())
}

/// The value of every override that the form reaches, with the given parameters, in f32.
pub(crate) fn override_values(form: &Form, parameters: &[f32]) -> Vec<(Handle<Override>, Literal)> {
    let mut machine = Machine::<f32, _>::new(form.program(), ValuesOnly);
    machine.prepare(form.program(), parameters);
    let Files { floats, integers, booleans } = &machine.files;
    let literal = |(&handle, reg): (&Handle<Override>, &Reg)| {
        let (slot, ty) = (reg.slot as usize, form.module().overrides[handle].ty);
        let literal = match form.module().types[ty].inner.scalar_kind() {
            Some(ScalarKind::Sint) => Literal::I32(integers[slot][0] as i32),
            Some(ScalarKind::Uint) => Literal::U32(integers[slot][0]),
            Some(ScalarKind::Bool) => Literal::Bool(booleans[slot][0]),
            _ => Literal::F32(floats[slot][0]),
        };
        (handle, literal)
    };
    form.overrides().iter().map(literal).collect()
}

fn unbounded_error(form: &Form, unbounded: Unbounded) -> FormError {
    let limit = if unbounded.by_cost {
        format!("{MAX_CHUNK_COST} instructions")
    } else {
        format!("{MAX_LOOP_ITERATIONS} iterations")
    };
    FormError::Unbounded { origin: form.origin().to_owned(), line: unbounded.line, limit }
}
