//! Writing instructions: new registers, pooled constants, and what goes to the prologue.

use std::sync::Arc;

use naga::{BinaryOperator, MathFunction, ScalarKind};

use super::value::{Scalar, Value};
use super::{Compiler, MAX_INSTRUCTIONS};
use crate::form::FormError;
use crate::form::operation::{Class, Op};
use crate::form::program::{Instr, Kind, Node, Reg};

impl Compiler<'_> {
    pub(super) fn new_reg(&mut self, kind: Kind) -> Reg {
        let count = &mut self.program.registers[kind as usize];
        *count += 1;
        kind.reg(*count - 1)
    }

    pub(super) fn new_mask(&mut self) -> u32 {
        self.program.masks += 1;
        self.program.masks - 1
    }

    /// The register of a constant.
    pub(super) fn scalar(&mut self, scalar: Scalar) -> Reg {
        if let Some(&reg) = self.constants.get(&scalar) {
            return reg;
        }
        let reg = self.new_reg(scalar.kind);
        self.constants.insert(scalar, reg);
        self.program.constants.push((reg, scalar.bits));
        self.uniform.insert(reg);
        reg
    }

    pub(super) fn scalars(&mut self, scalars: impl IntoIterator<Item = Scalar>) -> Vec<Reg> {
        scalars.into_iter().map(|scalar| self.scalar(scalar)).collect()
    }

    pub(super) fn float(&mut self, value: f32) -> Reg {
        self.scalar(Scalar { kind: Kind::F, bits: value.to_bits() })
    }

    pub(super) fn integer(&mut self, value: u32) -> Reg {
        self.scalar(Scalar { kind: Kind::I, bits: value })
    }

    /// The table of a constant array; `None` if its scalars are of several kinds.
    pub(super) fn table(&mut self, scalars: &[Scalar]) -> Option<(u32, Kind)> {
        let kind = scalars.first()?.kind;
        let word = |scalar: &Scalar| (scalar.kind == kind).then_some(scalar.bits);
        let words: Arc<[u32]> = scalars.iter().map(word).collect::<Option<_>>()?;
        let next = self.program.tables.len() as u32;
        let table = *self.tables.entry((kind, Arc::clone(&words))).or_insert(next);
        if table == next {
            self.program.tables.push(words);
        }
        Some((table, kind))
    }

    /// The registers of a value; constants and table rows are brought into registers.
    pub(super) fn regs(&mut self, value: Value) -> Result<Vec<Reg>, FormError> {
        match value {
            Value::Regs(regs) => Ok(regs),
            Value::Array(scalars) => Ok(self.scalars(scalars)),
            Value::Row { table, kind, index, offset, count } => (offset..offset + count)
                .map(|offset| {
                    let to = self.new_reg(kind);
                    self.push(Instr::Table { to, table, index: index.slot, offset })?;
                    Ok(to)
                })
                .collect(),
            Value::Place(_) | Value::Table { .. } => {
                Err(self.unsupported(self.here, "a pointer passed around as a value"))
            }
        }
    }

    /// Appends a node to the innermost open block.
    pub(super) fn push_node(&mut self, node: Node) {
        if let Some(block) = self.open.last_mut() {
            block.push(node);
        }
    }

    /// Appends an instruction, to the prologue if it depends on constants and parameters only.
    pub(super) fn push(&mut self, instr: Instr) -> Result<(), FormError> {
        self.instructions += 1;
        if self.instructions > MAX_INSTRUCTIONS {
            let what = format!("the form compiles to more than {MAX_INSTRUCTIONS} instructions");
            return Err(self.too_large(self.here, what));
        }
        let pure = !matches!(instr, Instr::Store { .. } | Instr::Scatter { .. });
        let mut uniform = pure;
        let mut written = None;
        instr.visit(|reg| uniform &= self.uniform.contains(&reg), |reg| written = Some(reg));
        if let (true, Some(reg)) = (uniform, written) {
            self.uniform.insert(reg);
            self.program.prologue.push(instr);
            return Ok(());
        }
        let spent = cost(&instr);
        match self.open.last_mut().and_then(|block| block.last_mut()) {
            Some(Node::Run { instrs, cost }) => {
                instrs.push(instr);
                *cost += spent;
            }
            _ => self.push_node(Node::Run { instrs: vec![instr], cost: spent }),
        }
        Ok(())
    }

    /// The result of an operation.
    pub(super) fn op(&mut self, op: Op, arguments: &[Reg]) -> Result<Reg, FormError> {
        let mut from = [arguments[0]; 4];
        from[..arguments.len()].copy_from_slice(arguments);
        let to = self.new_reg(op.result());
        self.push(Instr::Compute { op, to, from })?;
        Ok(to)
    }

    /// `when ? yes : no`, of three registers.
    pub(super) fn select(&mut self, arguments: &[Reg]) -> Result<Reg, FormError> {
        match *arguments {
            [when, yes, no] if when.kind == Kind::B && yes.kind == no.kind => {
                let to = self.new_reg(yes.kind);
                self.push(Instr::Select { to, when: when.slot, yes: yes.slot, no: no.slot })?;
                Ok(to)
            }
            _ => Err(self.unsupported(self.here, "a choice between values of these types")),
        }
    }

    /// Applies `f` component by component; a scalar goes with every component of a vector.
    pub(super) fn each(
        &mut self,
        arguments: &[impl AsRef<[Reg]>],
        mut f: impl FnMut(&mut Self, &[Reg]) -> Result<Reg, FormError>,
    ) -> Result<Vec<Reg>, FormError> {
        let count = arguments.iter().map(|regs| regs.as_ref().len()).max().unwrap_or(0);
        let component = |regs: &[Reg], at: usize| regs.get(at).or(regs.first()).copied();
        let mut results = Vec::with_capacity(count);
        for at in 0..count {
            let regs = arguments.iter().filter_map(|regs| component(regs.as_ref(), at));
            results.push(f(self, &regs.collect::<Vec<_>>())?);
        }
        Ok(results)
    }

    /// `op` between all of `regs`, from the first to the last.
    pub(super) fn fold(&mut self, op: Op, regs: &[Reg]) -> Result<Reg, FormError> {
        match regs {
            [] => Err(self.unsupported(self.here, "a value without components")),
            &[first, ref rest @ ..] => rest.iter().try_fold(first, |a, &b| self.op(op, &[a, b])),
        }
    }
}

/// What an instruction takes of an evaluation's budget.
fn cost(instr: &Instr) -> u64 {
    match instr {
        Instr::Compute { op: Op::Math(MathFunction::InverseSqrt, _), .. }
        | Instr::Compute { op: Op::Binary(BinaryOperator::Modulo, ScalarKind::Float), .. } => 16,
        Instr::Compute { op, .. } if op.class() == Class::Elementary => 16,
        Instr::Gather { .. } | Instr::Scatter { .. } => 4,
        _ => 1,
    }
}
