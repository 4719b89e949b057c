//! Writing instructions: new registers, pooled constants, and what goes to the prologue.

use std::sync::Arc;

use super::value::{Scalar, Value};
use super::{Compiler, MAX_INSTRUCTIONS};
use crate::form::FormError;
use crate::form::operation::{B2, Compare, F1, F2, I1, I2};
use crate::form::program::{Instr, Kind, Node, Reg, Slot};

impl Compiler<'_> {
    pub(super) fn new_reg(&mut self, kind: Kind) -> Reg {
        let (count, make): (&mut u32, fn(Slot) -> Reg) = match kind {
            Kind::F => (&mut self.program.floats, Reg::F),
            Kind::I => (&mut self.program.integers, Reg::I),
            Kind::B => (&mut self.program.booleans, Reg::B),
        };
        *count += 1;
        make(*count - 1)
    }

    pub(super) fn new_mask(&mut self) -> u32 {
        self.program.masks += 1;
        self.program.masks - 1
    }

    pub(super) fn mark_uniform(&mut self, reg: Reg) {
        self.uniform.insert(reg);
    }

    pub(super) fn float(&mut self, value: f32) -> Slot {
        let (bits, next) = (value.to_bits(), self.program.floats);
        let slot = *self.floats.entry(bits).or_insert(next);
        if slot == next {
            self.program.floats += 1;
            self.program.float_constants.push((slot, value));
            self.mark_uniform(Reg::F(slot));
        }
        slot
    }

    pub(super) fn integer(&mut self, value: u32) -> Slot {
        let next = self.program.integers;
        let slot = *self.integers.entry(value).or_insert(next);
        if slot == next {
            self.program.integers += 1;
            self.program.integer_constants.push((slot, value));
            self.mark_uniform(Reg::I(slot));
        }
        slot
    }

    fn boolean(&mut self, value: bool) -> Slot {
        let next = self.program.booleans;
        let slot = *self.booleans.entry(value).or_insert(next);
        if slot == next {
            self.program.booleans += 1;
            self.program.boolean_constants.push((slot, value));
            self.mark_uniform(Reg::B(slot));
        }
        slot
    }

    pub(super) fn scalar(&mut self, scalar: Scalar) -> Reg {
        match scalar {
            Scalar::F(bits) => Reg::F(self.float(f32::from_bits(bits))),
            Scalar::I(bits) => Reg::I(self.integer(bits)),
            Scalar::B(value) => Reg::B(self.boolean(value)),
        }
    }

    /// The table of a constant array; `None` if its scalars are of several kinds.
    pub(super) fn table(&mut self, scalars: &[Scalar]) -> Option<(u32, Kind)> {
        let (kind, _) = scalars.first()?.parts();
        let word = |scalar: &Scalar| Some(scalar.parts()).filter(|p| p.0 == kind).map(|p| p.1);
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
            Value::Array(scalars) => {
                Ok(scalars.into_iter().map(|scalar| self.scalar(scalar)).collect())
            }
            Value::Row { table, kind, index, offset, count } => (offset..offset + count)
                .map(|offset| {
                    let to = self.new_reg(kind);
                    self.push(Instr::Table { to, table, index, offset })?;
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
            self.mark_uniform(reg);
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

    pub(super) fn float1(&mut self, op: F1, a: Slot) -> Result<Slot, FormError> {
        let to = self.program.floats;
        self.program.floats += 1;
        self.push(Instr::F1 { op, to, a })?;
        Ok(to)
    }

    pub(super) fn float2(&mut self, op: F2, a: Slot, b: Slot) -> Result<Slot, FormError> {
        let to = self.program.floats;
        self.program.floats += 1;
        self.push(Instr::F2 { op, to, a, b })?;
        Ok(to)
    }

    pub(super) fn integer1(&mut self, op: I1, a: Slot) -> Result<Slot, FormError> {
        let to = self.program.integers;
        self.program.integers += 1;
        self.push(Instr::I1 { op, to, a })?;
        Ok(to)
    }

    pub(super) fn integer2(&mut self, op: I2, a: Slot, b: Slot) -> Result<Slot, FormError> {
        let to = self.program.integers;
        self.program.integers += 1;
        self.push(Instr::I2 { op, to, a, b })?;
        Ok(to)
    }

    pub(super) fn boolean2(&mut self, op: B2, a: Slot, b: Slot) -> Result<Slot, FormError> {
        let to = self.program.booleans;
        self.program.booleans += 1;
        self.push(Instr::B2 { op, to, a, b })?;
        Ok(to)
    }

    pub(super) fn compare(&mut self, op: Compare, a: Slot, b: Slot) -> Result<Slot, FormError> {
        let to = self.program.booleans;
        self.program.booleans += 1;
        self.push(Instr::CompareF { op, to, a, b })?;
        Ok(to)
    }

    pub(super) fn select(&mut self, when: Slot, yes: Reg, no: Reg) -> Result<Reg, FormError> {
        let to = self.new_reg(match yes {
            Reg::F(_) => Kind::F,
            Reg::I(_) => Kind::I,
            Reg::B(_) => Kind::B,
        });
        self.push(Instr::Select { to, when, yes, no })?;
        Ok(to)
    }
}

/// What an instruction takes of an evaluation's budget.
fn cost(instr: &Instr) -> u64 {
    const ELEMENTARY: u64 = 16;
    match instr {
        Instr::F1 { op, .. } if op.is_elementary() => ELEMENTARY,
        Instr::F2 { op: F2::Pow | F2::Atan2 | F2::Rem, .. } => ELEMENTARY,
        Instr::Gather { .. } | Instr::Scatter { .. } => 4,
        _ => 1,
    }
}
