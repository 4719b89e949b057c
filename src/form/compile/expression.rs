//! Expressions other than built-in functions.

use naga::{BinaryOperator, Expression, Handle, RelationalFunction, ScalarKind, TypeInner};

use super::Compiler;
use super::access::scalar_of;
use super::body::Frame;
use super::value::{Place, Scalar, Value};
use crate::form::FormError;
use crate::form::operation::Op;
use crate::form::program::{Kind, Reg};

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

    /// The registers of an expression.
    pub(super) fn regs_of(
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
        resolution.inner_with(&self.module.types).clone()
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
        let regs = match &expressions[handle] {
            &Expression::Literal(literal) => match scalar_of(literal) {
                Some(scalar) => vec![self.scalar(scalar)],
                None => {
                    let what = "a literal that is not f32, i32, u32 or bool";
                    return Err(self.unsupported(span, what));
                }
            },
            &Expression::Constant(constant) => {
                match self.constant_global(self.module.constants[constant].init) {
                    Some(scalars) => self.scalars(scalars),
                    None => return Err(self.unsupported(span, "the type of this constant")),
                }
            }
            &Expression::Override(handle) => vec![self.override_value(handle)?],
            &Expression::ZeroValue(ty) => {
                let kinds = self.kinds_of(ty)?;
                self.scalars(kinds.into_iter().map(Scalar::zero))
            }
            Expression::Compose { ty, components } => {
                self.kinds_of(*ty)?;
                let mut regs = Vec::new();
                for &component in components {
                    regs.extend(self.regs_of(frame, component)?);
                }
                regs
            }
            &Expression::Access { base, index } => {
                let inner = self.inner(frame, base);
                let base = self.value(frame, base)?;
                let index = self.regs_of(frame, index)?;
                return self.access(&inner, base, index[0]);
            }
            &Expression::AccessIndex { base, index } => {
                let inner = self.inner(frame, base);
                let base = self.value(frame, base)?;
                return self.access_index(&inner, base, index as usize);
            }
            &Expression::Splat { size, value } => self.regs_of(frame, value)?.repeat(size as usize),
            &Expression::Swizzle { size, vector, pattern } => {
                let regs = self.regs_of(frame, vector)?;
                pattern.iter().take(size as usize).map(|&c| regs[c as usize]).collect()
            }
            &Expression::FunctionArgument(index) => {
                return Ok(frame.arguments[index as usize].clone());
            }
            &Expression::GlobalVariable(variable) => return self.global(variable),
            &Expression::LocalVariable(variable) => {
                return Ok(Value::Place(Place::whole(frame.locals[variable.index()].clone())));
            }
            &Expression::Load { pointer } => match self.value(frame, pointer)? {
                Value::Place(place) => self.load(&place)?,
                row @ Value::Row { .. } => self.regs(row)?,
                _ => return Err(self.unsupported(span, "reading through this pointer")),
            },
            &Expression::Unary { op, expr } => {
                let op = Op::Unary(op, self.scalar_kind(frame, expr));
                let regs = self.regs_of(frame, expr)?;
                self.each(&[regs], |compiler, x| compiler.op(op, x))?
            }
            &Expression::Binary { op, left, right } => {
                let op = Op::Binary(op, self.scalar_kind(frame, left));
                for side in [left, right] {
                    let inner = self.inner(frame, side);
                    self.kinds(&inner)?;
                }
                let sides = [self.regs_of(frame, left)?, self.regs_of(frame, right)?];
                self.each(&sides, |compiler, x| compiler.op(op, x))?
            }
            &Expression::Select { condition, accept, reject } => {
                let when = self.regs_of(frame, condition)?;
                let (yes, no) = (self.regs_of(frame, accept)?, self.regs_of(frame, reject)?);
                self.each(&[when, yes, no], Self::select)?
            }
            &Expression::Relational { fun, argument } => {
                let regs = self.regs_of(frame, argument)?;
                let of_bools = |op| Op::Binary(op, ScalarKind::Bool);
                match fun {
                    RelationalFunction::All => {
                        vec![self.fold(of_bools(BinaryOperator::LogicalAnd), &regs)?]
                    }
                    RelationalFunction::Any => {
                        vec![self.fold(of_bools(BinaryOperator::LogicalOr), &regs)?]
                    }
                    _ => self.each(&[regs], |compiler, x| compiler.op(Op::Relational(fun), x))?,
                }
            }
            &Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let kind = self.scalar_kind(frame, arg);
                let inner = self.inner(frame, arg);
                self.kinds(&inner)?;
                let mut arguments = vec![self.regs_of(frame, arg)?];
                for argument in [arg1, arg2, arg3].into_iter().flatten() {
                    arguments.push(self.regs_of(frame, argument)?);
                }
                self.math(fun, kind, &arguments)?
            }
            &Expression::As { expr, kind, convert } => {
                let from = self.scalar_kind(frame, expr);
                if let Some(width) = convert {
                    self.kind(naga::Scalar { kind, width })?;
                }
                let regs = self.regs_of(frame, expr)?;
                self.each(&[regs], |k, x| k.convert(from, kind, convert.is_some(), x[0]))?
            }
            other => return Err(self.unsupported(span, expression_name(other))),
        };
        Ok(Value::Regs(regs))
    }

    /// A conversion of values, or a bitcast if not `by_value`.
    fn convert(
        &mut self,
        from: ScalarKind,
        to: ScalarKind,
        by_value: bool,
        reg: Reg,
    ) -> Result<Reg, FormError> {
        let not_equal = Op::Binary(BinaryOperator::NotEqual, from);
        match (reg.kind, to.into()) {
            (Kind::F, Kind::F) | (Kind::I, Kind::I) | (Kind::B, Kind::B) => Ok(reg),
            (kind, Kind::B) => {
                let zero = self.scalar(Scalar::zero(kind));
                self.op(not_equal, &[reg, zero])
            }
            (Kind::B, Kind::F) => {
                let choice = [reg, self.float(1.0), self.float(0.0)];
                self.select(&choice)
            }
            (Kind::B, Kind::I) => {
                let choice = [reg, self.integer(1), self.integer(0)];
                self.select(&choice)
            }
            _ if by_value => self.op(Op::Convert(from, to), &[reg]),
            _ => self.op(Op::Bitcast(to), &[reg]),
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
