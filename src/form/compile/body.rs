//! Statements and calls.

use naga::{
    Arena, Block, Expression, Function, Handle, Module, Span, Statement, SwitchValue, TypeInner,
    valid::FunctionInfo,
};

use super::access::stores;
use super::value::{Place, Value};
use super::{Compiler, MAX_NESTING};
use crate::form::FormError;
use crate::form::program::{self, Case, Instr, Kind, Node, Reg, Slot};

/// One activation of a function, or the module scope.
pub(super) struct Frame<'m> {
    pub(super) expressions: &'m Arena<Expression>,
    /// `None` at module scope.
    pub(super) info: Option<&'m FunctionInfo>,
    pub(super) values: Vec<Option<Value>>,
    pub(super) arguments: Vec<Value>,
    pub(super) locals: Vec<Vec<Reg>>,
    results: Vec<Reg>,
    targets: Vec<Target>,
}

/// What `break` and `continue` leave.
#[derive(Clone, Copy)]
struct Target {
    exits: u32,
    /// `None` for a switch.
    continues: Option<u32>,
}

impl<'m> Frame<'m> {
    fn new(expressions: &'m Arena<Expression>, info: Option<&'m FunctionInfo>) -> Self {
        Self {
            expressions,
            info,
            values: vec![None; expressions.len()],
            arguments: Vec::new(),
            locals: Vec::new(),
            results: Vec::new(),
            targets: Vec::new(),
        }
    }

    /// The module scope.
    pub(super) fn global(module: &'m Module) -> Self {
        Self::new(&module.global_expressions, None)
    }
}

impl<'m> Compiler<'m> {
    /// Inlines a call; returns the registers of its result.
    pub(super) fn call(
        &mut self,
        handle: Handle<Function>,
        arguments: Vec<Value>,
    ) -> Result<Vec<Reg>, FormError> {
        let function = &self.module.functions[handle];
        let here = std::mem::replace(&mut self.here, self.module.functions.get_span(handle));
        let results = match &function.result {
            Some(result) => {
                let kinds = self.kinds_of(result.ty)?;
                kinds.into_iter().map(|kind| self.new_reg(kind)).collect()
            }
            None => Vec::new(),
        };
        let scope = Frame::new(&function.expressions, Some(&self.info[handle]));
        let mut frame = Frame { arguments, results, ..scope };
        self.open_block()?;
        for (local, variable) in function.local_variables.iter() {
            self.here = function.local_variables.get_span(local);
            let kinds = self.kinds_of(variable.ty)?;
            if kinds.len() > MAX_VARIABLE_SCALARS {
                let what = format!(
                    "a variable of {} scalars (at most {MAX_VARIABLE_SCALARS})",
                    kinds.len()
                );
                return Err(self.too_large(self.here, what));
            }
            let (regs, initial) = self.variable(&mut frame, &kinds, variable.init)?;
            self.store_all(&regs, &initial)?;
            frame.locals.push(regs);
        }
        self.block(&mut frame, &function.body)?;
        let body = self.close_block();
        self.push_node(Node::Call(body));
        self.here = here;
        Ok(frame.results)
    }

    fn store_all(&mut self, to: &[Reg], from: &[Reg]) -> Result<(), FormError> {
        stores(to, from).try_for_each(|store| self.push(store))
    }

    fn open_block(&mut self) -> Result<(), FormError> {
        if self.open.len() >= MAX_NESTING {
            let what = format!("blocks and calls are nested more than {MAX_NESTING} deep");
            return Err(self.too_large(self.here, what));
        }
        self.open.push(Vec::new());
        Ok(())
    }

    fn close_block(&mut self) -> program::Block {
        self.open.pop().unwrap_or_default()
    }

    fn inner_block(
        &mut self,
        frame: &mut Frame<'m>,
        block: &'m Block,
    ) -> Result<program::Block, FormError> {
        self.open_block()?;
        self.block(frame, block)?;
        Ok(self.close_block())
    }

    fn block(&mut self, frame: &mut Frame<'m>, block: &'m Block) -> Result<(), FormError> {
        for (statement, &span) in block.span_iter() {
            if span.is_defined() {
                self.here = span;
            }
            self.statement(frame, statement, span)?;
        }
        Ok(())
    }

    fn statement(
        &mut self,
        frame: &mut Frame<'m>,
        statement: &'m Statement,
        span: Span,
    ) -> Result<(), FormError> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.evaluate(frame, handle)?;
                    frame.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(inner) => self.block(frame, inner)?,
            Statement::If { condition, accept, reject } => {
                let when = self.scalar_of_kind(frame, *condition, Kind::B)?;
                let accept = self.inner_block(frame, accept)?;
                let reject = self.inner_block(frame, reject)?;
                self.push_node(Node::If { when, accept, reject });
            }
            Statement::Switch { selector, cases } => {
                let selector = self.scalar_of_kind(frame, *selector, Kind::I)?;
                let exits = self.new_mask();
                frame.targets.push(Target { exits, continues: None });
                let mut compiled = Vec::with_capacity(cases.len());
                for case in cases {
                    let value = match case.value {
                        SwitchValue::I32(value) => Some(value as u32),
                        SwitchValue::U32(value) => Some(value),
                        SwitchValue::Default => None,
                    };
                    let body = self.inner_block(frame, &case.body)?;
                    compiled.push(Case { value, body, falls_through: case.fall_through });
                }
                frame.targets.pop();
                self.push_node(Node::Switch { selector, cases: compiled, exits });
            }
            Statement::Loop { body, continuing, break_if } => {
                let line = self.line(span);
                let (exits, continues) = (self.new_mask(), self.new_mask());
                frame.targets.push(Target { exits, continues: Some(continues) });
                let body = self.inner_block(frame, body)?;
                self.open_block()?;
                self.block(frame, continuing)?;
                let break_if = break_if
                    .map(|condition| self.scalar_of_kind(frame, condition, Kind::B))
                    .transpose()?;
                let continuing = self.close_block();
                frame.targets.pop();
                self.push_node(Node::Loop { body, continuing, break_if, exits, continues, line });
            }
            Statement::Break => match frame.targets.last() {
                Some(target) => self.push_node(Node::Break(target.exits)),
                None => return Err(self.unsupported(span, "`break` outside a loop")),
            },
            Statement::Continue => {
                match frame.targets.iter().rev().find_map(|target| target.continues) {
                    Some(continues) => self.push_node(Node::Continue(continues)),
                    None => return Err(self.unsupported(span, "`continue` outside a loop")),
                }
            }
            Statement::Return { value } => {
                if let Some(value) = *value {
                    let regs = self.regs_of(frame, value)?;
                    let results = std::mem::take(&mut frame.results);
                    self.store_all(&results, &regs)?;
                    frame.results = results;
                }
                self.push_node(Node::Return);
            }
            Statement::Store { pointer, value } => {
                let regs = self.regs_of(frame, *value)?;
                match self.value(frame, *pointer)? {
                    Value::Place(place) => self.store(&place, &regs)?,
                    _ => return Err(self.unsupported(span, "this assignment")),
                }
            }
            Statement::Call { function, arguments, result } => {
                let callee = &self.module.functions[*function];
                let mut values = Vec::with_capacity(arguments.len());
                for (&argument, formal) in arguments.iter().zip(&callee.arguments) {
                    if let TypeInner::Pointer { .. } = self.module.types[formal.ty].inner {
                        let name = callee.name.as_deref().unwrap_or("?");
                        let what = format!("a pointer passed to function `{name}`");
                        return Err(self.unsupported(span, what));
                    }
                    values.push(self.value(frame, argument)?);
                }
                let regs = self.call(*function, values)?;
                if let Some(result) = *result {
                    frame.values[result.index()] = Some(Value::Regs(regs));
                }
            }
            other => return Err(self.unsupported(span, statement_name(other))),
        }
        Ok(())
    }

    /// The register of a condition or a selector.
    fn scalar_of_kind(
        &mut self,
        frame: &mut Frame<'m>,
        expression: Handle<Expression>,
        kind: Kind,
    ) -> Result<Slot, FormError> {
        match self.regs_of(frame, expression)?.as_slice() {
            &[reg] if reg.kind == kind => Ok(reg.slot),
            _ => Err(self.unsupported(self.here, "a condition of this type")),
        }
    }

    fn store(&mut self, place: &Place, from: &[Reg]) -> Result<(), FormError> {
        let Some(index) = place.index else {
            let to = &place.regs[place.offset..place.offset + place.count];
            return self.store_all(to, from);
        };
        for (component, &from) in from.iter().enumerate() {
            let to = place.slots(place.offset + component);
            self.push(Instr::Scatter { to, index: index.slot, from })?;
        }
        Ok(())
    }
}

/// A variable takes this many registers at most.
const MAX_VARIABLE_SCALARS: usize = 4096;

fn statement_name(statement: &Statement) -> &'static str {
    match statement {
        Statement::Kill => "`discard`",
        Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => "a barrier",
        Statement::ImageStore { .. } => "`textureStore`",
        Statement::Atomic { .. } | Statement::ImageAtomic { .. } => "an atomic operation",
        Statement::WorkGroupUniformLoad { .. } => "`workgroupUniformLoad`",
        Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => "ray tracing",
        Statement::SubgroupBallot { .. }
        | Statement::SubgroupGather { .. }
        | Statement::SubgroupCollectiveOperation { .. } => "a subgroup operation",
        Statement::CooperativeStore { .. } => "a cooperative matrix",
        _ => "this statement",
    }
}
