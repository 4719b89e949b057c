//! Built-in functions, as WGSL defines them: those that it defines by a formula are written out
//! in that formula's order.

use naga::{BinaryOperator, MathFunction as Math, ScalarKind, UnaryOperator};

use super::Compiler;
use crate::form::FormError;
use crate::form::operation::{Class, Op};
use crate::form::program::Reg;

const NEGATE: Op = Op::Unary(UnaryOperator::Negate, ScalarKind::Float);
const ADD: Op = Op::Binary(BinaryOperator::Add, ScalarKind::Float);
const SUB: Op = Op::Binary(BinaryOperator::Subtract, ScalarKind::Float);
const MUL: Op = Op::Binary(BinaryOperator::Multiply, ScalarKind::Float);
const DIV: Op = Op::Binary(BinaryOperator::Divide, ScalarKind::Float);
const LESS: Op = Op::Binary(BinaryOperator::Less, ScalarKind::Float);

fn float(fun: Math) -> Op {
    Op::Math(fun, ScalarKind::Float)
}

impl Compiler<'_> {
    /// `fun` of `arguments`, the first of scalar kind `kind`.
    pub(super) fn math(
        &mut self,
        fun: Math,
        kind: ScalarKind,
        arguments: &[Vec<Reg>],
    ) -> Result<Vec<Reg>, FormError> {
        match (fun, arguments) {
            (Math::Abs, [a]) if kind == ScalarKind::Uint => Ok(a.clone()),
            (Math::Clamp, _) => self.each(arguments, |k, x| k.clamp(kind, x)),
            _ if Class::of(fun).is_some() => {
                self.each(arguments, |compiler, x| compiler.op(Op::Math(fun, kind), x))
            }
            _ if kind == ScalarKind::Float => self.float_math(fun, arguments),
            _ => self.integer_math(fun, kind, arguments),
        }
    }

    fn float_math(&mut self, fun: Math, arguments: &[Vec<Reg>]) -> Result<Vec<Reg>, FormError> {
        let (zero, one, kind) = (self.float(0.0), self.float(1.0), ScalarKind::Float);
        match (fun, arguments) {
            (Math::Saturate, _) => self.each(arguments, |k, x| k.clamp(kind, &[x[0], zero, one])),
            (Math::Fract, _) => self.each(arguments, |k, x| {
                let floor = k.op(float(Math::Floor), x)?;
                k.op(SUB, &[x[0], floor])
            }),
            (Math::Mix, _) => self.each(arguments, |k, x| {
                let rest = k.op(SUB, &[one, x[2]])?;
                let first = k.op(MUL, &[x[0], rest])?;
                let second = k.op(MUL, &[x[1], x[2]])?;
                k.op(ADD, &[first, second])
            }),
            (Math::SmoothStep, _) => {
                let (two, three) = (self.float(2.0), self.float(3.0));
                self.each(arguments, |k, x| {
                    let above = k.op(SUB, &[x[2], x[0]])?;
                    let width = k.op(SUB, &[x[1], x[0]])?;
                    let quotient = k.op(DIV, &[above, width])?;
                    let t = k.clamp(kind, &[quotient, zero, one])?;
                    let squared = k.op(MUL, &[t, t])?;
                    let twice = k.op(MUL, &[two, t])?;
                    let rest = k.op(SUB, &[three, twice])?;
                    k.op(MUL, &[squared, rest])
                })
            }
            (Math::Modf, [a]) => {
                let whole = self.each(arguments, |k, x| k.op(float(Math::Trunc), x))?;
                let fractions = self.each(&[a, &whole], |k, x| k.op(SUB, x))?;
                Ok([fractions, whole].concat())
            }
            (Math::Frexp, _) => {
                let fractions = self.each(arguments, |k, x| k.op(float(Math::Frexp), x))?;
                let exponents = self.each(arguments, |k, x| k.op(Op::FrexpExponent, x))?;
                Ok([fractions, exponents].concat())
            }
            (Math::Dot, [a, b]) => Ok(vec![self.dot(a, b)?]),
            (Math::Length, [a]) => Ok(vec![self.length(a)?]),
            (Math::Distance, _) => {
                let difference = self.each(arguments, |k, x| k.op(SUB, x))?;
                Ok(vec![self.length(&difference)?])
            }
            (Math::Normalize, [a]) => {
                let length = self.length(a)?;
                self.each(arguments, |k, x| k.op(DIV, &[x[0], length]))
            }
            (Math::Cross, [a, b]) => (0..3)
                .map(|at| {
                    let (next, last) = ((at + 1) % 3, (at + 2) % 3);
                    let first = self.op(MUL, &[a[next], b[last]])?;
                    let second = self.op(MUL, &[a[last], b[next]])?;
                    self.op(SUB, &[first, second])
                })
                .collect(),
            (Math::FaceForward, [a, b, c]) => {
                let side = self.dot(b, c)?;
                let facing = self.op(LESS, &[side, zero])?;
                self.each(&[a], |k, x| {
                    let flipped = k.op(NEGATE, x)?;
                    k.select(&[facing, x[0], flipped])
                })
            }
            (Math::Reflect, [a, b]) => {
                let (two, projection) = (self.float(2.0), self.dot(b, a)?);
                let twice = self.op(MUL, &[two, projection])?;
                self.each(arguments, |k, x| {
                    let along = k.op(MUL, &[twice, x[1]])?;
                    k.op(SUB, &[x[0], along])
                })
            }
            (Math::Refract, [a, b, ratio]) => self.refract(a, b, ratio[0]),
            _ => Err(self.refuse(fun)),
        }
    }

    /// e₃·e₁ − (e₃·d + √k)·e₂ with d = e₂·e₁ and k = 1 − e₃²·(1 − d²); zero where k < 0.
    fn refract(&mut self, a: &[Reg], b: &[Reg], ratio: Reg) -> Result<Vec<Reg>, FormError> {
        let (zero, one) = (self.float(0.0), self.float(1.0));
        let d = self.dot(b, a)?;
        let d_squared = self.op(MUL, &[d, d])?;
        let sine_squared = self.op(SUB, &[one, d_squared])?;
        let ratio_squared = self.op(MUL, &[ratio, ratio])?;
        let product = self.op(MUL, &[ratio_squared, sine_squared])?;
        let k = self.op(SUB, &[one, product])?;
        let total = self.op(LESS, &[k, zero])?;
        let root = self.op(float(Math::Sqrt), &[k])?;
        let scaled = self.op(MUL, &[ratio, d])?;
        let factor = self.op(ADD, &[scaled, root])?;
        self.each(&[a, b], |compiler, x| {
            let first = compiler.op(MUL, &[ratio, x[0]])?;
            let second = compiler.op(MUL, &[factor, x[1]])?;
            let refracted = compiler.op(SUB, &[first, second])?;
            compiler.select(&[total, zero, refracted])
        })
    }

    fn dot(&mut self, a: &[Reg], b: &[Reg]) -> Result<Reg, FormError> {
        let products = self.each(&[a, b], |k, x| k.op(MUL, x))?;
        self.fold(ADD, &products)
    }

    fn length(&mut self, a: &[Reg]) -> Result<Reg, FormError> {
        if a.len() == 1 {
            return self.op(float(Math::Abs), a);
        }
        let squared = self.dot(a, a)?;
        self.op(float(Math::Sqrt), &[squared])
    }

    /// A number, at least a second and then at most a third.
    fn clamp(&mut self, kind: ScalarKind, arguments: &[Reg]) -> Result<Reg, FormError> {
        let above = self.op(Op::Math(Math::Max, kind), &arguments[..2])?;
        self.op(Op::Math(Math::Min, kind), &[above, arguments[2]])
    }

    fn integer_math(
        &mut self,
        fun: Math,
        kind: ScalarKind,
        arguments: &[Vec<Reg>],
    ) -> Result<Vec<Reg>, FormError> {
        match (fun, arguments) {
            (Math::Dot, _) => {
                let (product, sum) = (BinaryOperator::Multiply, BinaryOperator::Add);
                let mut dot = self.integer(0);
                for product in self.each(arguments, |k, x| k.op(Op::Binary(product, kind), x))? {
                    dot = self.op(Op::Binary(sum, kind), &[dot, product])?;
                }
                Ok(vec![dot])
            }
            (Math::Unpack2x16float, [pair]) => {
                let (shift, sixteen) = (BinaryOperator::ShiftRight, self.integer(16));
                let high = self.op(Op::Binary(shift, kind), &[pair[0], sixteen])?;
                Ok(vec![self.op(Op::Half, pair)?, self.op(Op::Half, &[high])?])
            }
            _ => Err(self.refuse(fun)),
        }
    }

    fn refuse(&self, fun: Math) -> FormError {
        self.unsupported(self.here, format!("the built-in function {fun:?} of this type"))
    }
}
