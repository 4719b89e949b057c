//! Compiles a naga function, with everything that it reaches, to a [`Program`].
//!
//! Calls are inlined; vectors, structs and small arrays become several registers; what depends on
//! constants and parameters only is moved to the prologue. A construct that lanes cannot run is
//! refused with its line.

mod access;
mod body;
mod emit;
mod expression;
mod math;
mod types;
mod value;

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use naga::{Handle, Module, Span, TypeInner, valid::ModuleInfo};

use super::data_table::Tables;
use super::program::{Instr, Kind, Node, Program, Reg, Slot};
use super::{Argument, FormError, Parameter, ScalarType};
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
    /// Where the value is of every override that the function reaches.
    pub(crate) overrides: BTreeMap<Handle<naga::Override>, Reg>,
    pub(crate) arguments: Vec<Argument>,
    pub(crate) result_components: usize,
}

/// State of one compilation.
struct Compiler<'m> {
    origin: &'m str,
    source: &'m str,
    module: &'m Module,
    info: &'m ModuleInfo,
    /// The form's tables, the first of the program's.
    given: &'m Tables,
    program: Program,
    /// Registers that hold the same value in every lane.
    uniform: HashSet<Reg>,
    /// Registers of the constants so far.
    constants: HashMap<Scalar, Reg>,
    /// The tables that constant arrays have become.
    tables: HashMap<(Kind, Arc<[u32]>), u32>,
    overrides: BTreeMap<Handle<naga::Override>, Reg>,
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
    given: &Tables,
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
            tables: given.list.iter().map(|table| Arc::clone(table.words())).collect(),
            ..Program::default()
        },
        uniform: HashSet::new(),
        constants: HashMap::new(),
        tables: given.constants(),
        overrides: BTreeMap::new(),
        parameters: Vec::new(),
        globals: HashMap::new(),
        initial: Vec::new(),
        open: vec![Vec::new()],
        instructions: 0,
        here: module.functions.get_span(handle),
    };
    let arguments = compiler.arguments(naga_function)?;
    let result_components = compiler.result(naga_function)?;
    let mut values = Vec::new();
    for argument in &arguments {
        let regs: Vec<Reg> =
            (0..argument.components).map(|_| compiler.new_reg(argument.scalar.into())).collect();
        compiler.program.inputs.extend(&regs);
        values.push(Value::Regs(regs));
    }
    let outputs = compiler.call(handle, values)?;
    Ok(compiler.finish(arguments, result_components, &outputs))
}

impl<'m> Compiler<'m> {
    fn arguments(&self, function: &naga::Function) -> Result<Vec<Argument>, FormError> {
        function
            .arguments
            .iter()
            .enumerate()
            .map(|(at, argument)| {
                let name = argument.name.clone().unwrap_or_else(|| format!("argument{at}"));
                let inner = &self.module.types[argument.ty].inner;
                let (scalar, components) = ScalarType::of(inner).ok_or_else(|| {
                    let what = format!(
                        "the type `{}` of argument `{name}` (f32, i32, u32 or a vector of them is)",
                        self.type_name(inner)
                    );
                    self.unsupported(self.here, what)
                })?;
                Ok(Argument { name, scalar, components })
            })
            .collect()
    }

    fn result(&self, function: &naga::Function) -> Result<usize, FormError> {
        let Some(result) = &function.result else {
            return Err(self.unsupported(self.here, "a function that returns nothing"));
        };
        let inner = &self.module.types[result.ty].inner;
        match ScalarType::of(inner) {
            Some((ScalarType::F32, components)) => Ok(components),
            _ => {
                let ty = self.type_name(inner);
                let what = format!("a result of type `{ty}` (f32 or a vector of f32 is)");
                Err(self.unsupported(self.here, what))
            }
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
        let reg = match item.init {
            Some(init) if !is_float || self.constant_global(init).is_none() => {
                self.regs_of(&mut Frame::global(self.module), init)?[0]
            }
            None if !is_float => {
                return Err(self.unsupported(span, format!("override `{name}` without a value")));
            }
            _ => {
                let reg = self.new_reg(Kind::F);
                self.parameters.push((handle, reg.slot));
                self.uniform.insert(reg);
                reg
            }
        };
        self.overrides.insert(handle, reg);
        Ok(reg)
    }

    fn finish(
        mut self,
        arguments: Vec<Argument>,
        result_components: usize,
        outputs: &[Reg],
    ) -> Compiled {
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
                        Some(&[Scalar { bits, .. }]) => Some(f32::from_bits(bits).into()),
                        _ => None,
                    },
                }
            })
            .collect();
        self.program.parameters = self.parameters.iter().map(|&(_, slot)| slot).collect();
        self.program.outputs = outputs.iter().map(|reg| reg.slot).collect();
        let cost = self.initial.len() as u64;
        self.program.body = vec![Node::Run { instrs: self.initial, cost }];
        self.program.body.extend(self.open.pop().unwrap_or_default());
        let Self { program, overrides, .. } = self;
        Compiled { program, parameters, overrides, arguments, result_components }
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
