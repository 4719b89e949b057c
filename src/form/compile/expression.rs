//! Expressions other than built-in functions.

use naga::{BinaryOperator, Expression, Handle, ScalarKind, TypeInner, UnaryOperator};

use super::Compiler;
use super::access::scalar_of;
use super::body::Frame;
use super::value::{Place, Scalar, Value};
use crate::form::FormError;
use crate::form::operation::{B2, Compare, F1, F2, I1, I2};
use crate::form::program::{Instr, Kind, Reg};

impl<'m> Compiler<'m> {
    /// The value of an expression: what was emitted for it, or what needs no emitting.
    pub(super) fn value(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<Value, FormError> {
        if let Some(Some(value)) = frame.values.get(handle.index()) {
            return Ok(value.clone());
        }
        let value = self.evaluate(frame, handle)?;
        if let Some(known) = frame.values.get_mut(handle.index()) {
            *known = Some(value.clone());
        }
        Ok(value)
    }

    fn regs_of(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<Vec<Reg>, FormError> {
        let value = self.value(frame, handle)?;
        self.regs(value)
    }

    /// The type of an expression.
    pub(super) fn inner(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> TypeInner {
        let resolution = match frame.info {
            Some(info) => &info[handle].ty,
            None => &self.info[handle],
        };
        self.resolve(resolution).clone()
    }

    /// Kind of the scalars of an expression.
    pub(super) fn scalar_kind(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> ScalarKind {
        self.inner(frame, handle).scalar_kind().unwrap_or(ScalarKind::Float)
    }

    /// Computes an expression here.
    pub(super) fn evaluate(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<Value, FormError> {
        let span = frame.expressions.get_span(handle);
        if span.is_defined() {
            self.here = span;
        }
        if let Some(array) = self.constant_array(frame, handle) {
            return Ok(array);
        }
        let expressions = frame.expressions;
        match &expressions[handle] {
            &Expression::Literal(literal) => match scalar_of(literal) {
                Some(scalar) => Ok(Value::Regs(vec![self.scalar(scalar)])),
                None => Err(self.unsupported(span, "a literal that is not f32, i32, u32 or bool")),
            },
            &Expression::Constant(constant) => {
                match self.constant_global(self.module.constants[constant].init) {
                    Some(scalars) => {
                        Ok(Value::Regs(scalars.into_iter().map(|s| self.scalar(s)).collect()))
                    }
                    None => Err(self.unsupported(span, "the type of this constant")),
                }
            }
            &Expression::Override(handle) => Ok(Value::Regs(vec![self.override_value(handle)?])),
            &Expression::ZeroValue(ty) => {
                let kinds = self.kinds_of(ty)?;
                let zeros = kinds.into_iter().map(|kind| self.scalar(Scalar::zero(kind)));
                Ok(Value::Regs(zeros.collect()))
            }
            Expression::Compose { ty, components } => {
                self.kinds_of(*ty)?;
                let mut regs = Vec::new();
                for &component in components {
                    regs.extend(self.regs_of(frame, component)?);
                }
                Ok(Value::Regs(regs))
            }
            &Expression::Access { base, index } => {
                let inner = self.inner(frame, base);
                let base = self.value(frame, base)?;
                match self.regs_of(frame, index)?.as_slice() {
                    &[Reg::I(index)] => self.access(&inner, base, index),
                    _ => Err(self.unsupported(span, "this index")),
                }
            }
            &Expression::AccessIndex { base, index } => {
                let inner = self.inner(frame, base);
                let base = self.value(frame, base)?;
                self.access_index(&inner, base, index as usize)
            }
            &Expression::Splat { size, value } => {
                Ok(Value::Regs(self.regs_of(frame, value)?.repeat(size as usize)))
            }
            &Expression::Swizzle { size, vector, pattern } => {
                let regs = self.regs_of(frame, vector)?;
                let picked = pattern.iter().take(size as usize);
                Ok(Value::Regs(picked.filter_map(|&c| regs.get(c as usize).copied()).collect()))
            }
            &Expression::FunctionArgument(index) => match frame.arguments.get(index as usize) {
                Some(value) => Ok(value.clone()),
                None => Err(self.unsupported(span, "this argument")),
            },
            &Expression::GlobalVariable(variable) => self.global(variable),
            &Expression::LocalVariable(variable) => match frame.locals.get(variable.index()) {
                Some(regs) => Ok(Value::Place(Place {
                    regs: regs.clone(),
                    offset: 0,
                    count: regs.len(),
                    index: None,
                })),
                None => Err(self.unsupported(span, "this variable")),
            },
            &Expression::Load { pointer } => match self.value(frame, pointer)? {
                Value::Place(place) => self.load(&place),
                row @ Value::Row { .. } => Ok(Value::Regs(self.regs(row)?)),
                _ => Err(self.unsupported(span, "reading through this pointer")),
            },
            &Expression::Unary { op, expr } => {
                let regs = self.regs_of(frame, expr)?;
                self.each(&regs, |compiler, reg| compiler.unary(op, reg))
            }
            &Expression::Binary { op, left, right } => {
                let kind = self.scalar_kind(frame, left);
                for side in [left, right] {
                    let inner = self.inner(frame, side);
                    self.kinds(&inner)?;
                }
                let (left, right) = (self.regs_of(frame, left)?, self.regs_of(frame, right)?);
                self.each2(&left, &right, |compiler, a, b| compiler.binary(op, kind, a, b))
            }
            &Expression::Select { condition, accept, reject } => {
                let when = self.regs_of(frame, condition)?;
                let (yes, no) = (self.regs_of(frame, accept)?, self.regs_of(frame, reject)?);
                let mut picked = Vec::with_capacity(yes.len());
                for (at, (&yes, &no)) in yes.iter().zip(&no).enumerate() {
                    let Some(&Reg::B(when)) = when.get(at).or(when.first()) else {
                        return Err(self.unsupported(span, "this condition"));
                    };
                    picked.push(self.select(when, yes, no)?);
                }
                Ok(Value::Regs(picked))
            }
            &Expression::Relational { fun, argument } => {
                let regs = self.regs_of(frame, argument)?;
                self.relational(fun, &regs)
            }
            &Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let kind = self.scalar_kind(frame, arg);
                let inner = self.inner(frame, arg);
                self.kinds(&inner)?;
                let mut arguments = vec![self.regs_of(frame, arg)?];
                for argument in [arg1, arg2, arg3].into_iter().flatten() {
                    arguments.push(self.regs_of(frame, argument)?);
                }
                self.math(fun, kind, &arguments)
            }
            &Expression::As { expr, kind, convert } => {
                let from = self.scalar_kind(frame, expr);
                if let Some(width) = convert {
                    self.kind(naga::Scalar { kind, width })?;
                }
                let regs = self.regs_of(frame, expr)?;
                self.each(&regs, |compiler, reg| {
                    compiler.convert(from, kind, convert.is_some(), reg)
                })
            }
            other => Err(self.unsupported(span, expression_name(other))),
        }
    }

    /// Applies `f` to each component.
    pub(super) fn each(
        &mut self,
        regs: &[Reg],
        mut f: impl FnMut(&mut Self, Reg) -> Result<Reg, FormError>,
    ) -> Result<Value, FormError> {
        let results: Result<Vec<Reg>, _> = regs.iter().map(|&reg| f(self, reg)).collect();
        Ok(Value::Regs(results?))
    }

    /// Applies `f` to each pair of components; a scalar goes with every component of a vector.
    pub(super) fn each2(
        &mut self,
        a: &[Reg],
        b: &[Reg],
        mut f: impl FnMut(&mut Self, Reg, Reg) -> Result<Reg, FormError>,
    ) -> Result<Value, FormError> {
        let count = a.len().max(b.len());
        let component = |regs: &[Reg], at: usize| regs.get(at).or(regs.first()).copied();
        let mut results = Vec::with_capacity(count);
        for at in 0..count {
            if let (Some(a), Some(b)) = (component(a, at), component(b, at)) {
                results.push(f(self, a, b)?);
            }
        }
        Ok(Value::Regs(results))
    }

    fn unary(&mut self, op: UnaryOperator, reg: Reg) -> Result<Reg, FormError> {
        match (op, reg) {
            (UnaryOperator::Negate, Reg::F(a)) => Ok(Reg::F(self.float1(F1::Neg, a)?)),
            (UnaryOperator::Negate, Reg::I(a)) => Ok(Reg::I(self.integer1(I1::Neg, a)?)),
            (UnaryOperator::BitwiseNot, Reg::I(a)) => Ok(Reg::I(self.integer1(I1::Not, a)?)),
            (UnaryOperator::LogicalNot, Reg::B(a)) => {
                let to = self.new_reg(Kind::B);
                if let Reg::B(to) = to {
                    self.push(Instr::Not { to, a })?;
                }
                Ok(to)
            }
            _ => Err(self.unsupported(self.here, "this operator")),
        }
    }

    fn binary(
        &mut self,
        op: BinaryOperator,
        kind: ScalarKind,
        a: Reg,
        b: Reg,
    ) -> Result<Reg, FormError> {
        use BinaryOperator as Op;
        let comparison = match op {
            Op::Equal => Some(Compare::Equal),
            Op::NotEqual => Some(Compare::NotEqual),
            Op::Less => Some(Compare::Less),
            Op::LessEqual => Some(Compare::LessEqual),
            Op::Greater => Some(Compare::Greater),
            Op::GreaterEqual => Some(Compare::GreaterEqual),
            _ => None,
        };
        let signed = kind == ScalarKind::Sint;
        let pick = |yes: I2, no: I2| if signed { yes } else { no };
        match (a, b) {
            (Reg::F(a), Reg::F(b)) => {
                if let Some(op) = comparison {
                    return Ok(Reg::B(self.compare(op, a, b)?));
                }
                let op = match op {
                    Op::Add => F2::Add,
                    Op::Subtract => F2::Sub,
                    Op::Multiply => F2::Mul,
                    Op::Divide => F2::Div,
                    Op::Modulo => F2::Rem,
                    _ => return Err(self.unsupported(self.here, "this operator on f32")),
                };
                Ok(Reg::F(self.float2(op, a, b)?))
            }
            (Reg::I(a), Reg::I(b)) => {
                if let Some(op) = comparison {
                    let to = self.program.booleans;
                    self.program.booleans += 1;
                    self.push(Instr::CompareI { op, signed, to, a, b })?;
                    return Ok(Reg::B(to));
                }
                let op = match op {
                    Op::Add => I2::Add,
                    Op::Subtract => I2::Sub,
                    Op::Multiply => I2::Mul,
                    Op::Divide => pick(I2::DivSigned, I2::DivUnsigned),
                    Op::Modulo => pick(I2::RemSigned, I2::RemUnsigned),
                    Op::And => I2::And,
                    Op::InclusiveOr => I2::Or,
                    Op::ExclusiveOr => I2::Xor,
                    Op::ShiftLeft => I2::ShiftLeft,
                    Op::ShiftRight => pick(I2::ShiftRightSigned, I2::ShiftRightUnsigned),
                    _ => return Err(self.unsupported(self.here, "this operator on integers")),
                };
                Ok(Reg::I(self.integer2(op, a, b)?))
            }
            (Reg::B(a), Reg::B(b)) => {
                let op = match op {
                    Op::And | Op::LogicalAnd => B2::And,
                    Op::InclusiveOr | Op::LogicalOr => B2::Or,
                    Op::Equal => B2::Equal,
                    Op::NotEqual | Op::ExclusiveOr => B2::NotEqual,
                    _ => return Err(self.unsupported(self.here, "this operator on bool")),
                };
                Ok(Reg::B(self.boolean2(op, a, b)?))
            }
            _ => Err(self.unsupported(self.here, "operands of different types")),
        }
    }
}

fn expression_name(expression: &Expression) -> &'static str {
    match expression {
        Expression::ImageSample { .. } => "sampling a texture",
        Expression::ImageLoad { .. } => "`textureLoad`",
        Expression::ImageQuery { .. } => "a query of a texture",
        Expression::Derivative { .. } => "a screen-space derivative",
        Expression::ArrayLength(_) => "`arrayLength`",
        Expression::AtomicResult { .. } => "an atomic operation",
        Expression::SubgroupBallotResult | Expression::SubgroupOperationResult { .. } => {
            "a subgroup operation"
        }
        Expression::WorkGroupUniformLoadResult { .. } => "`workgroupUniformLoad`",
        _ => "this expression",
    }
}
