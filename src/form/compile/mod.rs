//! Compiles a naga function, with everything that it reaches, to a [`Program`].
//!
//! Calls are inlined; vectors, structs and small arrays become several registers; what depends on
//! constants and parameters only is moved to the prologue. A construct that lanes cannot run is
//! refused with its line.

mod access;
mod body;
mod convert;
mod emit;
mod expression;
mod math;
mod types;
mod value;

use std::collections::{HashMap, HashSet};

use naga::{Handle, Module, Span, TypeInner, valid::ModuleInfo};

use super::program::{Instr, Node, Program, Reg, Slot, Table};
use super::{Argument, DataTable, FormError, Parameter};
use body::Frame;
use value::{Scalar, Value};

/// A program larger than this many instructions is refused: calls are inlined, so that a short
/// text can ask for an exponential one.
const MAX_INSTRUCTIONS: usize = 200_000;

/// Blocks and calls nested deeper than this are refused.
const MAX_NESTING: usize = 160;

/// A compiled form and its signature.
#[derive(Debug)]
pub(crate) struct Compiled {
    pub(crate) program: Program,
    pub(crate) parameters: Vec<Parameter>,
    /// Every override that the function reaches.
    pub(crate) overrides: Vec<CompiledOverride>,
    pub(crate) arguments: Vec<Argument>,
    pub(crate) result_components: usize,
}

/// Where the value of an override is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CompiledOverride {
    pub(crate) handle: Handle<naga::Override>,
    pub(crate) reg: Reg,
    pub(crate) signed: bool,
}

/// State of one compilation.
struct Compiler<'m> {
    origin: &'m str,
    source: &'m str,
    module: &'m Module,
    info: &'m ModuleInfo,
    /// Tables given beside the text, the first of the program's.
    given: &'m [DataTable],
    program: Program,
    /// Registers that hold the same value in every lane.
    uniform: HashSet<Reg>,
    floats: HashMap<u32, Slot>,
    integers: HashMap<u32, Slot>,
    booleans: HashMap<bool, Slot>,
    tables: HashMap<Vec<Scalar>, u32>,
    overrides: HashMap<Handle<naga::Override>, Reg>,
    parameters: Vec<(Handle<naga::Override>, Slot)>,
    globals: HashMap<Handle<naga::GlobalVariable>, Vec<Reg>>,
    /// Stores of the initial values of `globals`.
    initial: Vec<Instr>,
    /// Blocks being written, the innermost last.
    open: Vec<Vec<Node>>,
    instructions: usize,
    /// Where the compilation is, for constructs without a span of their own.
    here: Span,
}

/// Compiles `function` of a validated module.
pub(crate) fn compile(
    origin: &str,
    source: &str,
    module: &Module,
    info: &ModuleInfo,
    function: &str,
    given: &[DataTable],
) -> Result<Compiled, FormError> {
    let Some((handle, naga_function)) =
        module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function))
    else {
        let mut names: Vec<&str> =
            module.functions.iter().filter_map(|(_, f)| f.name.as_deref()).collect();
        names.sort_unstable();
        return Err(FormError::NoFunction {
            origin: origin.to_owned(),
            function: function.to_owned(),
            available: if names.is_empty() { "none".into() } else { names.join(", ") },
        });
    };
    let mut compiler = Compiler {
        origin,
        source,
        module,
        info,
        given,
        program: Program {
            tables: given.iter().map(|table| Table::F(table.values.clone())).collect(),
            ..Program::default()
        },
        uniform: HashSet::new(),
        floats: HashMap::new(),
        integers: HashMap::new(),
        booleans: HashMap::new(),
        tables: HashMap::new(),
        overrides: HashMap::new(),
        parameters: Vec::new(),
        globals: HashMap::new(),
        initial: Vec::new(),
        open: vec![Vec::new()],
        instructions: 0,
        here: module.functions.get_span(handle),
    };
    let arguments = compiler.arguments(naga_function)?;
    let result_components = compiler.result(naga_function)?;
    let inputs: Vec<Reg> =
        arguments.iter().flat_map(|a| 0..a.components).map(|_| compiler.new_float()).collect();
    let mut rest = inputs.as_slice();
    let mut values = Vec::new();
    for argument in &arguments {
        let (own, others) = rest.split_at(argument.components);
        values.push(Value::Regs(own.to_vec()));
        rest = others;
    }
    let outputs = compiler.call(handle, values)?;
    Ok(compiler.finish(arguments, result_components, &inputs, &outputs))
}

impl<'m> Compiler<'m> {
    fn arguments(&self, function: &naga::Function) -> Result<Vec<Argument>, FormError> {
        function
            .arguments
            .iter()
            .enumerate()
            .map(|(at, argument)| {
                let name = argument.name.clone().unwrap_or_else(|| format!("argument{at}"));
                let components = self.float_components(argument.ty).ok_or_else(|| {
                    let ty = self.type_name(&self.module.types[argument.ty].inner);
                    self.unsupported(
                        self.here,
                        format!("the type `{ty}` of argument `{name}` (f32 or a vector of f32 is)"),
                    )
                })?;
                Ok(Argument { name, components })
            })
            .collect()
    }

    fn result(&self, function: &naga::Function) -> Result<usize, FormError> {
        let Some(result) = &function.result else {
            return Err(self.unsupported(self.here, "a function that returns nothing"));
        };
        self.float_components(result.ty).ok_or_else(|| {
            let ty = self.type_name(&self.module.types[result.ty].inner);
            self.unsupported(
                self.here,
                format!("a result of type `{ty}` (f32 or a vector of f32 is)"),
            )
        })
    }

    /// 1 for f32, 2 to 4 for a vector of f32.
    fn float_components(&self, ty: Handle<naga::Type>) -> Option<usize> {
        match self.module.types[ty].inner {
            TypeInner::Scalar(naga::Scalar::F32) => Some(1),
            TypeInner::Vector { size, scalar: naga::Scalar::F32 } => Some(size as usize),
            _ => None,
        }
    }

    /// The register of an override: a parameter, or derived from others, or a constant.
    fn override_value(&mut self, handle: Handle<naga::Override>) -> Result<Reg, FormError> {
        if let Some(&reg) = self.overrides.get(&handle) {
            return Ok(reg);
        }
        let span = self.module.overrides.get_span(handle);
        let item = &self.module.overrides[handle];
        let name = item.name.clone().unwrap_or_default();
        let is_float = self.module.types[item.ty].inner == TypeInner::Scalar(naga::Scalar::F32);
        let constant = item.init.and_then(|init| self.constant_global(init));
        let reg = match (is_float, item.init, constant) {
            (true, None, _) | (true, Some(_), Some(_)) => {
                let reg = self.new_float();
                if let Reg::F(slot) = reg {
                    self.parameters.push((handle, slot));
                }
                self.mark_uniform(reg);
                reg
            }
            (false, None, _) => {
                return Err(self.unsupported(span, format!("override `{name}` without a value")));
            }
            (_, Some(init), _) => {
                let mut frame = Frame::global(self.module);
                let value = self.value(&mut frame, init)?;
                let regs = self.regs(value)?;
                match regs.as_slice() {
                    &[reg] => reg,
                    _ => return Err(self.unsupported(span, format!("the type of `{name}`"))),
                }
            }
        };
        self.overrides.insert(handle, reg);
        Ok(reg)
    }

    fn finish(
        mut self,
        arguments: Vec<Argument>,
        result_components: usize,
        inputs: &[Reg],
        outputs: &[Reg],
    ) -> Compiled {
        let slots = |regs: &[Reg]| -> Vec<Slot> {
            regs.iter().map(|&(Reg::F(slot) | Reg::I(slot) | Reg::B(slot))| slot).collect()
        };
        let start = |handle| {
            self.module.overrides.get_span(handle).to_range().map_or(usize::MAX, |r| r.start)
        };
        self.parameters.sort_by_key(|&(handle, slot)| (start(handle), slot));
        let parameters = self
            .parameters
            .iter()
            .map(|&(handle, _)| {
                let item = &self.module.overrides[handle];
                let default = item.init.and_then(|init| self.constant_global(init));
                Parameter {
                    name: item.name.clone().unwrap_or_default(),
                    default: match default.as_deref() {
                        Some(&[Scalar::F(bits)]) => Some(f64::from(f32::from_bits(bits))),
                        _ => None,
                    },
                }
            })
            .collect();
        let mut overrides: Vec<CompiledOverride> = self
            .overrides
            .iter()
            .map(|(&handle, &reg)| {
                let ty = &self.module.types[self.module.overrides[handle].ty].inner;
                let signed = *ty == TypeInner::Scalar(naga::Scalar::I32);
                CompiledOverride { handle, reg, signed }
            })
            .collect();
        overrides.sort_by_key(|item| item.handle.index());
        self.program.parameters = self.parameters.iter().map(|&(_, slot)| slot).collect();
        self.program.inputs = slots(inputs);
        self.program.outputs = slots(outputs);
        let cost = self.initial.len() as u64;
        self.program.body = vec![Node::Run { instrs: self.initial, cost }];
        self.program.body.extend(self.open.pop().unwrap_or_default());
        Compiled { program: self.program, parameters, overrides, arguments, result_components }
    }

    fn line(&self, span: Span) -> usize {
        let span = if span.is_defined() { span } else { self.here };
        if span.is_defined() { span.location(self.source).line_number as usize } else { 1 }
    }

    fn unsupported(&self, span: Span, what: impl Into<String>) -> FormError {
        FormError::Unsupported {
            origin: self.origin.to_owned(),
            line: self.line(span),
            what: what.into(),
        }
    }

    fn too_large(&self, span: Span, what: impl Into<String>) -> FormError {
        FormError::TooLarge {
            origin: self.origin.to_owned(),
            line: self.line(span),
            what: what.into(),
        }
    }
}
