//! The compute kernel around a form: the form's own text, its large tables moved into buffers (see
//! [`super::tables`]) and otherwise unchanged, with bindings and an entry point appended. Line
//! numbers in the compiler's reports are therefore those of the file.

use super::device::Device;
use super::error::GpuError;
use super::tables::{self, BoundTables};
use crate::form::Form;
use std::fmt::Write;
use std::sync::Arc;

/// Invocations per workgroup of every kernel; every adapter allows 64.
pub(super) const WORKGROUP: u32 = 64;

/// Evaluations written out in the body of the loop of [`Purpose::Repeat`], so that the loop's own
/// cost, which is subtracted, stays small beside that of a form.
pub(super) const UNROLLED: u32 = 4;

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
    pub(super) origin: String,
    pub(super) function: String,
    pub(super) inputs: usize,
    pub(super) outputs: usize,
    pub(super) text: String,
    entry: String,
    constants: Vec<(String, f64)>,
    tables: Vec<Arc<[f32]>>,
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
        let names = form.parameters().iter().map(|parameter| parameter.name.as_str());
        let values: Vec<_> = names.zip(parameters.iter().copied()).collect();
        let mut program =
            Self::from_text(form.origin(), form.source(), form.function(), &values, purpose)?;
        if !form.tables().is_empty() {
            program.tables = form.tables().iter().map(|table| Arc::clone(&table.values)).collect();
        }
        Ok(program)
    }

    /// The same from text: `parameters` are names of `override` constants with their values.
    pub(super) fn from_text(
        origin: &str,
        source: &str,
        function: &str,
        parameters: &[(&str, f32)],
        purpose: Purpose,
    ) -> Result<Self, GpuError> {
        let rejected = |report| GpuError::Compile {
            origin: origin.to_owned(),
            function: function.to_owned(),
            report,
        };
        let parse = || {
            let module = naga::front::wgsl::parse_str(source)?;
            let lifted = tables::lift(&module, source);
            Ok((module, lifted))
        };
        let (module, lifted) = on_deep_stack(parse).map_err(rejected)?.map_err(
            |error: naga::front::wgsl::ParseError| {
                rejected(error.emit_to_string_with_path(source, origin))
            },
        )?;
        let signature = Signature::of(&module, function).map_err(|what| GpuError::Signature {
            origin: origin.to_owned(),
            function: function.to_owned(),
            what,
        })?;
        let prefix = unused_prefix(source);
        Ok(Self {
            origin: origin.to_owned(),
            function: function.to_owned(),
            inputs: signature.arguments.iter().sum(),
            outputs: signature.result,
            text: format!("{}\n{}", lifted.text, wrapper(&prefix, function, &signature, purpose)),
            entry: format!("{prefix}main"),
            constants: parameters
                .iter()
                .map(|(name, value)| (constant_key(&module, name), f64::from(*value)))
                .collect(),
            tables: lifted.tables,
        })
    }

    /// The loop of [`Purpose::Repeat`] over `columns` inputs with their sum in place of a form.
    pub(super) fn empty_loop(columns: usize) -> Result<Self, GpuError> {
        let names: Vec<String> = (0..columns).map(|i| format!("input_{i}_")).collect();
        let arguments: Vec<String> = names.iter().map(|name| format!("{name}: f32")).collect();
        let sum = if names.is_empty() { "0.0".to_owned() } else { names.join(" + ") };
        let source = format!("fn identity({}) -> f32 {{ return {sum}; }}", arguments.join(", "));
        Self::from_text("empty loop", &source, "identity", &[], Purpose::Repeat)
    }

    /// Number of rows of `inputs`, if they match the form.
    pub(super) fn check(&self, inputs: &[Vec<f32>]) -> Result<usize, GpuError> {
        let origin = || self.origin.clone();
        let function = || self.function.clone();
        if inputs.len() != self.inputs {
            return Err(GpuError::ColumnCount {
                origin: origin(),
                function: function(),
                expected: self.inputs,
                got: inputs.len(),
            });
        }
        let expected = inputs.first().map_or(0, Vec::len);
        match inputs.iter().position(|column| column.len() != expected) {
            None => Ok(expected),
            Some(column) => Err(GpuError::RowCount {
                origin: origin(),
                function: function(),
                column,
                expected,
                got: inputs.get(column).map_or(0, Vec::len),
            }),
        }
    }

    /// Compiles the kernel on `device`.
    pub(super) fn pipeline(&self, device: &Device) -> Result<Pipeline, GpuError> {
        let rejected = |report| GpuError::Compile {
            origin: self.origin.clone(),
            function: self.function.clone(),
            report,
        };
        match on_deep_stack(|| self.compile(device)).map_err(rejected)? {
            Err(GpuError::Device(report)) => Err(rejected(report)),
            other => other,
        }
    }

    fn compile(&self, device: &Device) -> Result<Pipeline, GpuError> {
        let constants: Vec<(&str, f64)> =
            self.constants.iter().map(|(key, value)| (key.as_str(), *value)).collect();
        let tables = match self.tables.as_slice() {
            [] => None,
            tables => Some(BoundTables::new(device, tables)?),
        };
        let layout = tables.as_ref().map_or(&device.layout, |tables| &tables.layout);
        let module = device.guarded(|| {
            device.raw.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(&self.origin),
                source: wgpu::ShaderSource::Wgsl(self.text.as_str().into()),
            })
        })?;
        let raw = device.guarded(|| {
            device.raw.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&self.function),
                layout: Some(layout),
                module: &module,
                entry_point: Some(&self.entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            })
        })?;
        Ok(Pipeline { raw, tables })
    }
}

/// Stack of the thread that compiles: naga and the driver recurse with the nesting of a form.
const COMPILER_STACK_BYTES: usize = 64 << 20;

/// Runs `work` on a thread with a deep stack. A panic inside becomes an error, since neither naga
/// nor a driver is written for any text whatever.
fn on_deep_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, String> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .stack_size(COMPILER_STACK_BYTES)
            .spawn_scoped(scope, work)
            .map_err(|error| format!("no thread to compile on: {error}"))?;
        thread.join().map_err(|_| "the compiler failed on this text".to_owned())
    })
}

/// Components of each argument and of the result, all of them f32.
struct Signature {
    arguments: Vec<usize>,
    result: usize,
}

impl Signature {
    fn of(module: &naga::Module, function: &str) -> Result<Self, String> {
        let found = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function));
        let Some((_, found)) = found else { return Err("is not in the text".to_owned()) };
        let mut arguments = Vec::with_capacity(found.arguments.len());
        for argument in &found.arguments {
            let name = argument.name.as_deref().unwrap_or("_");
            arguments.push(
                components(module, argument.ty)
                    .ok_or_else(|| format!("argument {name} is not f32 or a vector of f32"))?,
            );
        }
        let result = found.result.as_ref().ok_or("returns nothing")?;
        let result = components(module, result.ty).ok_or("result is not f32 or a vector of f32")?;
        Ok(Self { arguments, result })
    }
}

fn components(module: &naga::Module, ty: naga::Handle<naga::Type>) -> Option<usize> {
    match module.types[ty].inner {
        naga::TypeInner::Scalar(naga::Scalar::F32) => Some(1),
        naga::TypeInner::Vector { size, scalar: naga::Scalar::F32 } => Some(size as usize),
        _ => None,
    }
}

/// A pipeline constant is set by its `@id` where it has one, else by its name.
fn constant_key(module: &naga::Module, name: &str) -> String {
    module
        .overrides
        .iter()
        .find(|(_, constant)| constant.name.as_deref() == Some(name))
        .and_then(|(_, constant)| constant.id)
        .map_or_else(|| name.to_owned(), |id| id.to_string())
}

/// A prefix that occurs nowhere in `source`, so that no name made with it collides.
fn unused_prefix(source: &str) -> String {
    let mut prefix = "striae_kernel_".to_owned();
    while source.contains(&prefix) {
        prefix.push_str("x_");
    }
    prefix
}

fn wrapper(p: &str, function: &str, signature: &Signature, purpose: Purpose) -> String {
    let mut column = 0;
    let mut arguments = Vec::with_capacity(signature.arguments.len());
    for &count in &signature.arguments {
        let scalars: Vec<String> = (column..column + count)
            .map(|c| match purpose {
                Purpose::Evaluate => format!("{p}inputs[{c}u * {p}size.x + {p}point]"),
                Purpose::Repeat => format!("{p}input_{c}_ + {p}offset"),
            })
            .collect();
        column += count;
        arguments.push(match count {
            1 => scalars.join(""),
            _ => format!("vec{count}<f32>({})", scalars.join(", ")),
        });
    }
    let call = format!("{function}({})", arguments.join(", "));
    let parts: Vec<String> = match signature.result {
        1 => vec![format!("{p}value")],
        count => ["x", "y", "z", "w"].iter().take(count).map(|c| format!("{p}value.{c}")).collect(),
    };
    let mut text = format!(
        "@group(0) @binding(0) var<storage, read> {p}inputs: array<f32>;\n\
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
            let loads: String = (0..column)
                .map(|c| format!("  let {p}input_{c}_ = {p}inputs[{c}u * {p}size.x + {p}point];\n"))
                .collect();
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
                evaluation.repeat(UNROLLED as usize)
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
        for purpose in [Purpose::Evaluate, Purpose::Repeat] {
            let program =
                Program::from_text("f.wgsl", SOURCE, "striae_kernel_main", &[("a", 3.0)], purpose)?;
            assert!(valid(&program.text), "{}", program.text);
            assert_eq!((program.inputs, program.outputs), (3, 3));
            assert_eq!(program.constants, [("7".to_owned(), 3.0)]);
        }
        assert!(valid(&Program::empty_loop(3)?.text));
        Ok(())
    }

    #[test]
    fn a_signature_without_f32_is_refused() {
        let integer = Program::from_text(
            "i.wgsl",
            "fn f(i: i32) -> f32 { return f32(i); }",
            "f",
            &[],
            Purpose::Evaluate,
        );
        assert!(matches!(integer, Err(GpuError::Signature { .. })));
        let absent = Program::from_text("i.wgsl", "", "f", &[], Purpose::Evaluate);
        assert!(matches!(absent, Err(GpuError::Signature { .. })));
    }
}
