//! Conversions between scalar types, and tests of values.

use naga::{RelationalFunction, ScalarKind};

use super::Compiler;
use super::value::Value;
use crate::form::FormError;
use crate::form::operation::{B2, Compare, FToI, IToF};
use crate::form::program::{Instr, Reg, Slot};

impl Compiler<'_> {
    pub(super) fn relational(
        &mut self,
        fun: RelationalFunction,
        regs: &[Reg],
    ) -> Result<Value, FormError> {
        match fun {
            RelationalFunction::All | RelationalFunction::Any => {
                let op = if fun == RelationalFunction::All { B2::And } else { B2::Or };
                let mut slots = regs.iter().filter_map(|&reg| match reg {
                    Reg::B(slot) => Some(slot),
                    _ => None,
                });
                let Some(mut result) = slots.next() else {
                    return Err(self.unsupported(self.here, "`all` or `any` of this"));
                };
                for slot in slots {
                    result = self.boolean2(op, result, slot)?;
                }
                Ok(Value::Regs(vec![Reg::B(result)]))
            }
            RelationalFunction::IsNan | RelationalFunction::IsInf => {
                self.each(regs, |compiler, reg| {
                    let (Reg::F(a), to) = (reg, compiler.program.booleans) else {
                        return Err(compiler.unsupported(compiler.here, "a test of this type"));
                    };
                    compiler.program.booleans += 1;
                    compiler.push(match fun {
                        RelationalFunction::IsNan => Instr::IsNan { to, a },
                        _ => Instr::IsInf { to, a },
                    })?;
                    Ok(Reg::B(to))
                })
            }
        }
    }

    /// A conversion of values, or a bitcast if not `by_value`.
    pub(super) fn convert(
        &mut self,
        from: ScalarKind,
        to: ScalarKind,
        by_value: bool,
        reg: Reg,
    ) -> Result<Reg, FormError> {
        let signed = |kind| kind == ScalarKind::Sint;
        match (reg, to) {
            (Reg::F(_), ScalarKind::Float) | (Reg::B(_), ScalarKind::Bool) => Ok(reg),
            (Reg::F(a), ScalarKind::Bool) => {
                let zero = self.float(0.0);
                Ok(Reg::B(self.compare(Compare::NotEqual, a, zero)?))
            }
            (Reg::F(a), _) => {
                let op = match (by_value, signed(to)) {
                    (false, _) => FToI::Bits,
                    (true, true) => FToI::Signed,
                    (true, false) => FToI::Unsigned,
                };
                self.float_to_integer(op, a)
            }
            (Reg::I(a), ScalarKind::Float) => {
                let op = match (by_value, signed(from)) {
                    (false, _) => IToF::Bits,
                    (true, true) => IToF::Signed,
                    (true, false) => IToF::Unsigned,
                };
                self.integer_to_float(op, a)
            }
            (Reg::I(a), ScalarKind::Bool) => {
                let (b, to) = (self.integer(0), self.program.booleans);
                self.program.booleans += 1;
                self.push(Instr::CompareI { op: Compare::NotEqual, signed: false, to, a, b })?;
                Ok(Reg::B(to))
            }
            (Reg::I(_), _) => Ok(reg),
            (Reg::B(when), ScalarKind::Float) => {
                let (one, zero) = (self.float(1.0), self.float(0.0));
                self.select(when, Reg::F(one), Reg::F(zero))
            }
            (Reg::B(when), _) => {
                let (one, zero) = (self.integer(1), self.integer(0));
                self.select(when, Reg::I(one), Reg::I(zero))
            }
        }
    }

    pub(super) fn integer_to_float(&mut self, op: IToF, a: Slot) -> Result<Reg, FormError> {
        let to = self.program.floats;
        self.program.floats += 1;
        self.push(Instr::IToF { op, to, a })?;
        Ok(Reg::F(to))
    }

    pub(super) fn float_to_integer(&mut self, op: FToI, a: Slot) -> Result<Reg, FormError> {
        let to = self.program.integers;
        self.program.integers += 1;
        self.push(Instr::FToI { op, to, a })?;
        Ok(Reg::I(to))
    }
}
