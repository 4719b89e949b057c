//! The kernel that is counted: a form evaluated several times with inputs made in registers, the sum
//! stored; and the same kernel without the form.
//!
//! Every scalar input starts from a hash of the invocation and takes one step per evaluation, so that no
//! compiler can relate one to another, hoist an evaluation or share two. The empty kernel takes the same
//! steps and sums the first input in place of the form: what differs between the two is the form.

use std::fmt::Write;

use naga::ShaderStage;
use naga::back::{PipelineConstants, pipeline_constants::process_overrides, spv};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde::{Deserialize, Serialize};

use super::cuda;
use super::target::Compiler;
use crate::form::{Form, ScalarType, guarded};
use crate::gpu::{constant_key, unused_prefix};

/// Evaluations in one kernel: enough that what is not of the form stays small in the difference.
pub(super) const EVALUATIONS: u32 = 8;

/// A kernel as its compiler takes it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum KernelCode {
    /// SPIR-V, for RADV.
    Spirv {
        words: Vec<u32>,
        /// Buffers that it reads beside the one that it writes.
        tables: u32,
    },
    /// C++, for NVRTC.
    Cuda(String),
}

/// The kernels of a form with constants: with it, and without.
pub(super) struct KernelPair {
    pub(super) full: KernelCode,
    pub(super) empty: KernelCode,
}

impl KernelPair {
    /// `constants` in the order of [`Form::parameters`]; they are folded in as they ship.
    pub(super) fn new(form: &Form, constants: &[f32], compiler: Compiler) -> Result<Self, String> {
        if compiler == Compiler::Nvrtc {
            let full = KernelCode::Cuda(cuda::text(form, Some(constants))?);
            return Ok(Self { full, empty: KernelCode::Cuda(cuda::text(form, None)?) });
        }
        let prefix = unused_prefix(form.source());
        let evaluated = text(&prefix, form, true);
        let source = format!("{}\n{evaluated}", form.device_source());
        let tables = form.tables().len() as u32;
        let full = KernelCode::Spirv { words: spirv(form, &source, &prefix, constants)?, tables };
        let empty = text(&prefix, form, false);
        let empty = KernelCode::Spirv { words: spirv(form, &empty, &prefix, &[])?, tables: 0 };
        Ok(Self { full, empty })
    }
}

/// The kernel in WGSL, to stand under the text of the form if that is `evaluated`.
fn text(p: &str, form: &Form, evaluated: bool) -> String {
    let types = form.input_types();
    let (mut starts, mut steps, mut sum_of_inputs) = (String::new(), String::new(), String::new());
    for (at, scalar) in types.iter().enumerate() {
        let name = format!("{p}input_{at}_");
        let multiplier = multiplier(at);
        let hash = format!("(({p}id.x * {multiplier}u) >> 9u)");
        // Writing to a String cannot fail.
        let _ = match scalar {
            ScalarType::F32 => {
                let (growth, shift) = step(at);
                let _ = writeln!(starts, "  var {name} = f32({hash}) * 1.1920929e-7;");
                writeln!(steps, "    {name} = fma({name}, {growth:?}, {shift:?});")
            }
            ScalarType::I32 => {
                let _ = writeln!(starts, "  var {name} = bitcast<i32>({hash});");
                writeln!(steps, "    {name} = {name} + {}i;", 7919 + 2 * at)
            }
            ScalarType::U32 => {
                let _ = writeln!(starts, "  var {name} = {hash};");
                writeln!(steps, "    {name} = {name} + {}u;", 7919 + 2 * at)
            }
        };
        let _ = write!(sum_of_inputs, " + {}", as_f32(&name, *scalar));
    }
    let outputs = form.result_components();
    let parts = || ["x", "y", "z", "w"].iter().take(outputs);
    let evaluation = if evaluated {
        let mut column = 0;
        let mut arguments = Vec::new();
        for argument in form.arguments() {
            let scalars: Vec<String> = (column..column + argument.components)
                .map(|column| format!("{p}input_{column}_"))
                .collect();
            column += argument.components;
            arguments.push(match argument.components {
                1 => scalars.join(""),
                count => format!("{}({})", argument.scalar.wgsl(count), scalars.join(", ")),
            });
        }
        format!("{}({})", form.function(), arguments.join(", "))
    } else {
        let first = format!("{p}input_0_");
        let term = types.first().map_or("1.0".to_owned(), |scalar| as_f32(&first, *scalar));
        match outputs {
            1 => term,
            count => format!("vec{count}<f32>({term})"),
        }
    };
    // Sums start apart, so that those of an empty kernel are not one.
    let zeros: Vec<String> = parts().enumerate().map(|(at, _)| format!("{at}.0")).collect();
    let (start, total) = match outputs {
        1 => ("0.0".to_owned(), format!("{p}sum")),
        count => {
            let terms: Vec<String> = parts().map(|part| format!("{p}sum.{part}")).collect();
            (format!("vec{count}<f32>({})", zeros.join(", ")), terms.join(" + "))
        }
    };
    let turn = format!("{steps}    {p}sum += {evaluation};\n");
    format!(
        "@group(0) @binding(0) var<storage, read_write> {p}outputs: array<f32>;\n\
         @compute @workgroup_size(64)\n\
         fn {p}main(@builtin(global_invocation_id) {p}id: vec3<u32>) {{\n{starts}  \
         var {p}sum = {start};\n{}  {p}outputs[{p}id.x] = {total}{sum_of_inputs};\n}}\n",
        turn.repeat(EVALUATIONS as usize)
    )
}

/// What the invocation is multiplied with in the hash from which input `at` starts: odd, without a simple ratio
/// between two (Weyl's sequence of the golden section).
pub(super) fn multiplier(at: usize) -> u32 {
    2_654_435_761_u32.wrapping_mul(2 * at as u32 + 1)
}

/// Factor and summand of the step that input `at` takes per evaluation, if it is an f32.
pub(super) fn step(at: usize) -> (f64, f64) {
    let place = at as f64 + 1.0;
    (1.0 + place / 1024.0, 0.37 / place)
}

/// SPIR-V whose loops are asked to be unrolled: in a loop that stays nobody counts the turns.
fn unrolled(mut words: Vec<u32>) -> Vec<u32> {
    /// Words before the first instruction.
    const HEADER: usize = 5;
    /// `OpLoopMerge`, whose third operand is the control, and the control that asks.
    const LOOP_MERGE: u32 = 246;
    const UNROLL: u32 = 1;
    let mut at = HEADER;
    while let Some(&first) = words.get(at) {
        if first & 0xffff == LOOP_MERGE
            && let Some(control) = words.get_mut(at + 3)
        {
            *control |= UNROLL;
        }
        at += (first >> 16).max(1) as usize;
    }
    words
}

/// The bits of an integer stand for a number: nothing is converted.
fn as_f32(name: &str, scalar: ScalarType) -> String {
    match scalar {
        ScalarType::F32 => name.to_owned(),
        ScalarType::I32 | ScalarType::U32 => format!("bitcast<f32>({name})"),
    }
}

fn spirv(form: &Form, source: &str, prefix: &str, constants: &[f32]) -> Result<Vec<u32>, String> {
    let values: PipelineConstants = form
        .parameters()
        .iter()
        .zip(constants)
        .map(|(parameter, value)| (constant_key(form.module(), &parameter.name), f64::from(*value)))
        .collect();
    let entry = format!("{prefix}main");
    let write = || -> Result<Vec<u32>, Box<dyn std::error::Error>> {
        let module = naga::front::wgsl::parse_str(source)?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator.validate(&module)?;
        let stage = ShaderStage::Compute;
        let (mut module, _) = process_overrides(&module, &info, Some((stage, &entry)), &values)?;
        for entry in &mut module.to_mut().entry_points {
            "main".clone_into(&mut entry.name);
        }
        let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
        let options = spv::Options { force_loop_bounding: false, ..spv::Options::default() };
        let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: "main".into() };
        Ok(unrolled(spv::write_vec(&module, &info, &options, Some(&pipeline))?))
    };
    let written = guarded(form.origin(), || Ok(write().map_err(|error| error.to_string())));
    written.map_err(|error| error.to_string())?
}
