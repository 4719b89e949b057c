//! The compute kernel around a form: its text with its tables in buffers, otherwise unchanged, with
//! bindings and an entry point appended. Line numbers in the compiler's reports are therefore those
//! of the file.

use super::device::Device;
use super::error::GpuError;
use super::tables::BoundTables;
use crate::form::{Form, Input, ScalarType, guarded};
use std::borrow::Cow;
use std::fmt::Write;
use std::ops::Range;

/// Invocations per workgroup of every kernel; every adapter allows 64.
pub(super) const WORKGROUP: u32 = 64;

/// Evaluations written out in the body of the loop of [`Purpose::Repeat`], so that the loop's own
/// cost, which is subtracted, stays small beside that of a form.
const UNROLLED: u32 = 4;
/// Operations from which a form is written out once: the loop's own cost is small beside it, and a driver
/// compiles it four times as fast.
const LONG: u32 = 64;

/// What the kernel does with the form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    /// One evaluation per point, every result stored.
    Evaluate,
    /// Many evaluations per invocation, their sum stored.
    Repeat,
}

/// A kernel's text with the values of its pipeline constants.
///
/// Binding 0 holds the input columns one after the other, binding 1 the output columns, binding 2
/// four u32: for `Evaluate` the number of points; for `Repeat` the number of points, a power of
/// two, the number of turns of the loop, and the bits of 0.0.
#[derive(Debug, Clone)]
pub(super) struct Program {
    pub(super) form: Form,
    pub(super) text: String,
    /// Evaluations in one turn of the loop of [`Purpose::Repeat`].
    pub(super) unrolled: u32,
    entry: String,
    constants: Vec<(String, f64)>,
}

/// What a compiled kernel is made from: the text, the bits of its constants, and how many tables are
/// bound. Their numbers are not part of it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    text: String,
    constants: Vec<(String, u64)>,
    tables: usize,
}

/// A compiled kernel with its tables.
#[derive(Debug)]
pub(super) struct Pipeline {
    raw: wgpu::ComputePipeline,
    tables: Option<BoundTables>,
}

impl Pipeline {
    /// Makes this the kernel of the next dispatches of `pass`, with `group` as its bindings 0 to 2.
    pub(super) fn set(&self, pass: &mut wgpu::ComputePass<'_>, group: &wgpu::BindGroup) {
        pass.set_pipeline(&self.raw);
        pass.set_bind_group(0, group, &[]);
        if let Some(tables) = &self.tables {
            tables.set(pass);
        }
    }
}

impl Program {
    /// The kernel for `form` with `parameters` in the order of [`Form::parameters`].
    pub(super) fn new(form: &Form, parameters: &[f32], purpose: Purpose) -> Result<Self, GpuError> {
        if parameters.len() != form.parameters().len() {
            return Err(GpuError::ParameterCount {
                origin: form.origin().to_owned(),
                function: form.function().to_owned(),
                expected: form.parameters().len(),
                got: parameters.len(),
            });
        }
        let prefix = unused_prefix(form.source());
        let key = |name| constant_key(form.module(), name);
        let names = form.parameters().iter().map(|parameter| key(&parameter.name));
        let unrolled = if form.op_count().total() < LONG { UNROLLED } else { 1 };
        let wrapper = wrapper(&prefix, form, purpose, unrolled);
        Ok(Self {
            form: form.clone(),
            text: format!("{}\n{wrapper}", form.device_source()),
            unrolled,
            entry: format!("{prefix}main"),
            constants: names.zip(parameters.iter().map(|value| f64::from(*value))).collect(),
        })
    }

    /// The loop of [`Purpose::Repeat`] over inputs of these types with their sum in place of a form.
    pub(super) fn empty_loop(inputs: &[ScalarType]) -> Result<Self, GpuError> {
        let named = || inputs.iter().enumerate().map(|(i, input)| (format!("input_{i}_"), *input));
        let arguments: Vec<String> =
            named().map(|(name, input)| format!("{name}: {}", input.name())).collect();
        let terms: Vec<String> = named()
            .map(|(name, input)| match input {
                ScalarType::F32 => name,
                ScalarType::I32 | ScalarType::U32 => format!("f32({name})"),
            })
            .collect();
        let sum = if terms.is_empty() { "0.0".to_owned() } else { terms.join(" + ") };
        let source = format!("fn identity({}) -> f32 {{ return {sum}; }}", arguments.join(", "));
        Self::new(&Form::parse("empty loop", &source, "identity")?, &[], Purpose::Repeat)
    }

    /// Types of the inputs, one per column.
    pub(super) fn inputs(&self) -> Vec<ScalarType> {
        self.form.input_types()
    }

    /// Number of output columns.
    pub(super) fn outputs(&self) -> usize {
        self.form.result_components()
    }

    /// Number of rows of `inputs`, if they match the form.
    pub(super) fn check(&self, inputs: &[Input<'_>]) -> Result<usize, GpuError> {
        let origin = || self.form.origin().to_owned();
        let function = || self.form.function().to_owned();
        let columns = self.inputs().len();
        if inputs.len() != columns {
            return Err(GpuError::ColumnCount {
                origin: origin(),
                function: function(),
                expected: columns,
                got: inputs.len(),
            });
        }
        let expected = inputs.first().map_or(0, |column| column.len());
        match inputs.iter().enumerate().find(|(_, column)| column.len() != expected) {
            None => Ok(expected),
            Some((column, ragged)) => Err(GpuError::RowCount {
                origin: origin(),
                function: function(),
                column,
                expected,
                got: ragged.len(),
            }),
        }
    }

    /// What the buffer of inputs holds for some rows of column `at`.
    pub(super) fn words<'a>(
        &self,
        at: usize,
        column: Input<'a>,
        rows: Range<usize>,
    ) -> Result<Cow<'a, [u32]>, GpuError> {
        let scalar = self.form.input_type(at);
        Ok(match (scalar, column) {
            (ScalarType::F32, Input::F32(column)) => bytemuck::cast_slice(&column[rows]).into(),
            (ScalarType::I32, Input::I32(column)) => bytemuck::cast_slice(&column[rows]).into(),
            (ScalarType::U32, Input::U32(column)) => (&column[rows]).into(),
            _ => {
                let words = rows.map(|row| self.form.word(at, scalar, column, row));
                words.collect::<Result<Vec<u32>, _>>()?.into()
            }
        })
    }

    /// What the pipeline is known by.
    pub(super) fn key(&self) -> PipelineKey {
        PipelineKey {
            text: self.text.clone(),
            constants: self.constants.iter().map(|(key, v)| (key.clone(), v.to_bits())).collect(),
            tables: self.form.tables().len(),
        }
    }

    /// The kernel compiled on `device`, or the one that it has compiled before, with its tables.
    pub(super) fn pipeline(&self, device: &Device) -> Result<Pipeline, GpuError> {
        let tables = match self.form.tables() {
            [] => None,
            tables => Some(BoundTables::new(device, tables)?),
        };
        let layout = tables.as_ref().map_or(&device.layout, |tables| &tables.layout);
        let raw = device.pipelines.get(self.key(), || self.compile(device, layout))?;
        device.check_faults()?;
        Ok(Pipeline { raw, tables })
    }

    /// Compiles on a deep stack: naga and the driver recurse with the nesting of a form.
    fn compile(
        &self,
        device: &Device,
        layout: &wgpu::PipelineLayout,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let rejected = |report| GpuError::Compile {
            origin: self.form.origin().to_owned(),
            function: self.form.function().to_owned(),
            report,
        };
        let constants: Vec<(&str, f64)> =
            self.constants.iter().map(|(key, value)| (key.as_str(), *value)).collect();
        let compile = || {
            let module = device.guarded(|| {
                device.raw.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(self.form.origin()),
                    source: wgpu::ShaderSource::Wgsl(self.text.as_str().into()),
                })
            })?;
            device.guarded(|| {
                device.raw.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(self.form.function()),
                    layout: Some(layout),
                    module: &module,
                    entry_point: Some(&self.entry),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        ..Default::default()
                    },
                    cache: None,
                })
            })
        };
        match guarded(self.form.origin(), || Ok(compile()))? {
            Err(GpuError::Device(report)) => Err(rejected(report)),
            other => other,
        }
    }
}

/// A pipeline constant is set by its `@id` where it has one, else by its name.
pub(crate) fn constant_key(module: &naga::Module, name: &str) -> String {
    module
        .overrides
        .iter()
        .find(|(_, constant)| constant.name.as_deref() == Some(name))
        .and_then(|(_, constant)| constant.id)
        .map_or_else(|| name.to_owned(), |id| id.to_string())
}

/// A prefix that occurs nowhere in `source`, so that no name made with it collides.
pub(crate) fn unused_prefix(source: &str) -> String {
    let mut prefix = "striae_kernel_".to_owned();
    while source.contains(&prefix) {
        prefix.push_str("x_");
    }
    prefix
}

fn wrapper(p: &str, form: &Form, purpose: Purpose, unrolled: u32) -> String {
    let (function, inputs) = (form.function(), form.input_types());
    // Integers do not survive as f32, but every f32 does as the bits of an integer.
    let as_words = inputs.iter().any(|input| *input != ScalarType::F32);
    let stored = if as_words { "u32" } else { "f32" };
    let load = |c: usize| {
        let word = format!("{p}inputs[{c}u * {p}size.x + {p}point]");
        let name = inputs[c].name();
        if name == stored { word } else { format!("bitcast<{name}>({word})") }
    };
    let turned = |c: usize| match inputs[c] {
        ScalarType::F32 => format!("{p}input_{c}_ + {p}offset"),
        other => format!("{p}input_{c}_ + bitcast<{}>({p}offset)", other.name()),
    };
    let mut column = 0;
    let mut arguments = Vec::with_capacity(form.arguments().len());
    for argument in form.arguments() {
        let count = argument.components;
        let scalars: Vec<String> = (column..column + count)
            .map(|c| match purpose {
                Purpose::Evaluate => load(c),
                Purpose::Repeat => turned(c),
            })
            .collect();
        column += count;
        arguments.push(match count {
            1 => scalars.join(""),
            _ => format!("{}({})", argument.scalar.wgsl(count), scalars.join(", ")),
        });
    }
    let call = format!("{function}({})", arguments.join(", "));
    let parts: Vec<String> = match form.result_components() {
        1 => vec![format!("{p}value")],
        count => ["x", "y", "z", "w"].iter().take(count).map(|c| format!("{p}value.{c}")).collect(),
    };
    let mut text = format!(
        "@group(0) @binding(0) var<storage, read> {p}inputs: array<{stored}>;\n\
         @group(0) @binding(1) var<storage, read_write> {p}outputs: array<f32>;\n\
         @group(0) @binding(2) var<uniform> {p}size: vec4<u32>;\n\
         @compute @workgroup_size({WORKGROUP})\n\
         fn {p}main(@builtin(global_invocation_id) {p}id: vec3<u32>,\n\
         \x20   @builtin(num_workgroups) {p}groups: vec3<u32>) {{\n\
         \x20 let {p}lane = {p}id.x + {p}id.y * {p}groups.x * {WORKGROUP}u;\n"
    );
    // Writing to a String cannot fail.
    let _ = match purpose {
        Purpose::Evaluate => {
            let stores: String = parts
                .iter()
                .enumerate()
                .map(|(c, part)| format!("  {p}outputs[{c}u * {p}size.x + {p}point] = {part};\n"))
                .collect();
            write!(
                text,
                "  let {p}point = {p}lane;\n  if ({p}point >= {p}size.x) {{ return; }}\n  \
                 let {p}value = {call};\n{stores}}}\n"
            )
        }
        // The offset is 0, which the compiler cannot know: no evaluation can be hoisted or shared.
        // Loads stay outside the loop, since on a software device they cost more than most forms.
        Purpose::Repeat => {
            let loads: String =
                (0..column).map(|c| format!("  let {p}input_{c}_ = {};\n", load(c))).collect();
            let evaluation = format!(
                "    {{\n      let {p}value = {call};\n      {p}sum += {};\n      \
                 {p}offset += {p}step;\n    }}\n",
                parts.join(" + ")
            );
            write!(
                text,
                "  let {p}point = {p}lane & ({p}size.x - 1u);\n{loads}  \
                 let {p}step = bitcast<f32>({p}size.z);\n  \
                 var {p}offset = 0.0;\n  var {p}sum = 0.0;\n  \
                 for (var {p}i = 0u; {p}i < {p}size.y; {p}i++) {{\n{}  }}\n  \
                 {p}outputs[{p}lane] = {p}sum;\n}}\n",
                evaluation.repeat(unrolled as usize)
            )
        }
    };
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "@id(7) override a: f32 = 2.0;\n\
        fn striae_kernel_main(p: vec2<f32>, s: f32) -> vec3<f32> { return vec3<f32>(p, a * s); } // end";
    const INTEGERS: &str =
        "fn f(i: vec3<i32>, x: f32, n: u32) -> f32 { return x * f32(i.y) + f32(n); }";

    fn valid(text: &str) -> bool {
        let Ok(module) = naga::front::wgsl::parse_str(text) else { return false };
        naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::default(),
        )
        .validate(&module)
        .is_ok()
    }

    #[test]
    fn kernels_are_valid_and_collide_with_no_name() -> Result<(), GpuError> {
        let form = Form::parse("f.wgsl", SOURCE, "striae_kernel_main")?;
        let integers = Form::parse("i.wgsl", INTEGERS, "f")?;
        for purpose in [Purpose::Evaluate, Purpose::Repeat] {
            let program = Program::new(&form, &[3.0], purpose)?;
            assert!(valid(&program.text), "{}", program.text);
            assert_eq!((program.inputs().len(), program.outputs()), (3, 3));
            assert_eq!(program.constants, [("7".to_owned(), 3.0)]);
            let program = Program::new(&integers, &[], purpose)?;
            assert!(valid(&program.text), "{}", program.text);
            assert_eq!((program.inputs().len(), program.outputs()), (5, 1));
        }
        assert!(valid(&Program::empty_loop(&integers.input_types())?.text));
        Ok(())
    }
}
