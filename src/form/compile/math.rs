//! Built-in functions, as WGSL defines them: those that it defines by a formula are written out
//! in that formula's order.

use naga::{MathFunction as Math, ScalarKind};

use super::Compiler;
use super::value::Value;
use crate::form::FormError;
use crate::form::operation::{Compare, F1, F2, FToI, I1, I2, IToF};
use crate::form::program::{Instr, Reg, Slot};

impl Compiler<'_> {
    /// `fun` of `arguments`, the first of scalar kind `kind`.
    pub(super) fn math(
        &mut self,
        fun: Math,
        kind: ScalarKind,
        arguments: &[Vec<Reg>],
    ) -> Result<Value, FormError> {
        if kind == ScalarKind::Float {
            self.float_math(fun, arguments)
        } else {
            self.integer_math(fun, kind == ScalarKind::Sint, arguments)
        }
    }

    fn float_math(&mut self, fun: Math, arguments: &[Vec<Reg>]) -> Result<Value, FormError> {
        let argument = |at: usize| -> Vec<Slot> {
            let regs = arguments.get(at).map_or(&[][..], Vec::as_slice);
            regs.iter()
                .filter_map(|&r| if let Reg::F(slot) = r { Some(slot) } else { None })
                .collect()
        };
        let (a, b, c) = (argument(0), argument(1), argument(2));
        if let Some(op) = one_argument(fun) {
            return self.map(&[&a], |compiler, x| compiler.float1(op, x[0]));
        }
        let two = match fun {
            Math::Min => Some(F2::Min),
            Math::Max => Some(F2::Max),
            Math::Step => Some(F2::Step),
            Math::Pow => Some(F2::Pow),
            Math::Atan2 => Some(F2::Atan2),
            _ => None,
        };
        if let Some(op) = two {
            return self.map(&[&a, &b], |compiler, x| compiler.float2(op, x[0], x[1]));
        }
        match fun {
            Math::Clamp => self.map(&[&a, &b, &c], |k, x| k.clamp(x[0], x[1], x[2])),
            Math::Saturate => {
                let (zero, one) = (self.float(0.0), self.float(1.0));
                self.map(&[&a], |k, x| k.clamp(x[0], zero, one))
            }
            Math::Fract => self.map(&[&a], |k, x| {
                let floor = k.float1(F1::Floor, x[0])?;
                k.float2(F2::Sub, x[0], floor)
            }),
            Math::Fma => self.map(&[&a, &b, &c], |k, x| {
                let to = k.program.floats;
                k.program.floats += 1;
                k.push(Instr::Fma { to, a: x[0], b: x[1], c: x[2] })?;
                Ok(to)
            }),
            Math::Mix => {
                let one = self.float(1.0);
                self.map(&[&a, &b, &c], |k, x| {
                    let rest = k.float2(F2::Sub, one, x[2])?;
                    let first = k.float2(F2::Mul, x[0], rest)?;
                    let second = k.float2(F2::Mul, x[1], x[2])?;
                    k.float2(F2::Add, first, second)
                })
            }
            Math::SmoothStep => {
                let (zero, one) = (self.float(0.0), self.float(1.0));
                let (two, three) = (self.float(2.0), self.float(3.0));
                self.map(&[&a, &b, &c], |k, x| {
                    let above = k.float2(F2::Sub, x[2], x[0])?;
                    let width = k.float2(F2::Sub, x[1], x[0])?;
                    let quotient = k.float2(F2::Div, above, width)?;
                    let t = k.clamp(quotient, zero, one)?;
                    let squared = k.float2(F2::Mul, t, t)?;
                    let twice = k.float2(F2::Mul, two, t)?;
                    let rest = k.float2(F2::Sub, three, twice)?;
                    k.float2(F2::Mul, squared, rest)
                })
            }
            Math::Ldexp => {
                let exponents = arguments.get(1).cloned().unwrap_or_default();
                let mut results = Vec::with_capacity(a.len());
                for (&a, exponent) in a.iter().zip(exponents) {
                    let (Reg::I(exponent), to) = (exponent, self.program.floats) else {
                        return Err(self.unsupported(self.here, "`ldexp` of these types"));
                    };
                    self.program.floats += 1;
                    self.push(Instr::Ldexp { to, a, exponent })?;
                    results.push(Reg::F(to));
                }
                Ok(Value::Regs(results))
            }
            Math::Modf => {
                let whole = self.floats(&[&a], |k, x| k.float1(F1::Trunc, x[0]))?;
                let mut regs = self.floats(&[&a, &whole], |k, x| k.float2(F2::Sub, x[0], x[1]))?;
                regs.extend(whole);
                Ok(Value::Regs(regs.into_iter().map(Reg::F).collect()))
            }
            Math::Frexp => {
                let fractions = self.floats(&[&a], |k, x| k.float1(F1::FrexpFract, x[0]))?;
                let mut regs: Vec<Reg> = fractions.into_iter().map(Reg::F).collect();
                for &x in &a {
                    regs.push(self.float_to_integer(FToI::FrexpExponent, x)?);
                }
                Ok(Value::Regs(regs))
            }
            Math::Dot => Ok(scalar(self.dot(&a, &b)?)),
            Math::Length => Ok(scalar(self.length(&a)?)),
            Math::Distance => {
                let difference = self.floats(&[&a, &b], |k, x| k.float2(F2::Sub, x[0], x[1]))?;
                Ok(scalar(self.length(&difference)?))
            }
            Math::Normalize => {
                let length = self.length(&a)?;
                self.map(&[&a], |k, x| k.float2(F2::Div, x[0], length))
            }
            Math::Cross => self.cross(&a, &b),
            Math::FaceForward => {
                let side = self.dot(&b, &c)?;
                let zero = self.float(0.0);
                let facing = self.compare(Compare::Less, side, zero)?;
                self.map(&[&a], |k, x| {
                    let flipped = k.float1(F1::Neg, x[0])?;
                    k.pick(facing, x[0], flipped)
                })
            }
            Math::Reflect => {
                let (two, projection) = (self.float(2.0), self.dot(&b, &a)?);
                let twice = self.float2(F2::Mul, two, projection)?;
                self.map(&[&a, &b], |k, x| {
                    let along = k.float2(F2::Mul, twice, x[1])?;
                    k.float2(F2::Sub, x[0], along)
                })
            }
            Math::Refract => self.refract(&a, &b, &c),
            _ => Err(self.refuse(fun)),
        }
    }

    /// e₃·e₁ − (e₃·d + √k)·e₂ with d = e₂·e₁ and k = 1 − e₃²·(1 − d²); zero where k < 0.
    fn refract(&mut self, a: &[Slot], b: &[Slot], ratio: &[Slot]) -> Result<Value, FormError> {
        let &[ratio] = ratio else { return Err(self.refuse(Math::Refract)) };
        let (zero, one) = (self.float(0.0), self.float(1.0));
        let d = self.dot(b, a)?;
        let d_squared = self.float2(F2::Mul, d, d)?;
        let sine_squared = self.float2(F2::Sub, one, d_squared)?;
        let ratio_squared = self.float2(F2::Mul, ratio, ratio)?;
        let product = self.float2(F2::Mul, ratio_squared, sine_squared)?;
        let k = self.float2(F2::Sub, one, product)?;
        let total = self.compare(Compare::Less, k, zero)?;
        let root = self.float1(F1::Sqrt, k)?;
        let scaled = self.float2(F2::Mul, ratio, d)?;
        let factor = self.float2(F2::Add, scaled, root)?;
        self.map(&[a, b], |compiler, x| {
            let first = compiler.float2(F2::Mul, ratio, x[0])?;
            let second = compiler.float2(F2::Mul, factor, x[1])?;
            let refracted = compiler.float2(F2::Sub, first, second)?;
            compiler.pick(total, zero, refracted)
        })
    }

    fn cross(&mut self, a: &[Slot], b: &[Slot]) -> Result<Value, FormError> {
        let (&[ax, ay, az], &[bx, by, bz]) = (a, b) else {
            return Err(self.refuse(Math::Cross));
        };
        let mut difference = |p: Slot, q: Slot, r: Slot, s: Slot| {
            let first = self.float2(F2::Mul, p, q)?;
            let second = self.float2(F2::Mul, r, s)?;
            Ok(Reg::F(self.float2(F2::Sub, first, second)?))
        };
        Ok(Value::Regs(vec![
            difference(ay, bz, az, by)?,
            difference(az, bx, ax, bz)?,
            difference(ax, by, ay, bx)?,
        ]))
    }

    fn dot(&mut self, a: &[Slot], b: &[Slot]) -> Result<Slot, FormError> {
        let products = self.floats(&[a, b], |k, x| k.float2(F2::Mul, x[0], x[1]))?;
        let mut sum = None;
        for product in products {
            sum = Some(match sum {
                None => product,
                Some(sum) => self.float2(F2::Add, sum, product)?,
            });
        }
        sum.ok_or_else(|| self.refuse(Math::Dot))
    }

    fn length(&mut self, a: &[Slot]) -> Result<Slot, FormError> {
        if let &[x] = a {
            return self.float1(F1::Abs, x);
        }
        let squared = self.dot(a, a)?;
        self.float1(F1::Sqrt, squared)
    }

    fn clamp(&mut self, x: Slot, low: Slot, high: Slot) -> Result<Slot, FormError> {
        let above = self.float2(F2::Max, x, low)?;
        self.float2(F2::Min, above, high)
    }

    fn pick(&mut self, when: Slot, yes: Slot, no: Slot) -> Result<Slot, FormError> {
        match self.select(when, Reg::F(yes), Reg::F(no))? {
            Reg::F(slot) | Reg::I(slot) | Reg::B(slot) => Ok(slot),
        }
    }

    /// Applies `f` component by component; a scalar goes with every component of a vector.
    fn floats(
        &mut self,
        arguments: &[&[Slot]],
        mut f: impl FnMut(&mut Self, &[Slot]) -> Result<Slot, FormError>,
    ) -> Result<Vec<Slot>, FormError> {
        let count = arguments.iter().map(|argument| argument.len()).max().unwrap_or(0);
        let mut results = Vec::with_capacity(count);
        for at in 0..count {
            let components: Option<Vec<Slot>> =
                arguments.iter().map(|a| a.get(at).or(a.first()).copied()).collect();
            match components {
                Some(components) => results.push(f(self, &components)?),
                None => return Err(self.unsupported(self.here, "these arguments")),
            }
        }
        Ok(results)
    }

    fn map(
        &mut self,
        arguments: &[&[Slot]],
        f: impl FnMut(&mut Self, &[Slot]) -> Result<Slot, FormError>,
    ) -> Result<Value, FormError> {
        let slots = self.floats(arguments, f)?;
        Ok(Value::Regs(slots.into_iter().map(Reg::F).collect()))
    }

    fn integer_math(
        &mut self,
        fun: Math,
        signed: bool,
        arguments: &[Vec<Reg>],
    ) -> Result<Value, FormError> {
        let pick = |yes: I2, no: I2| if signed { yes } else { no };
        let (min, max) =
            (pick(I2::MinSigned, I2::MinUnsigned), pick(I2::MaxSigned, I2::MaxUnsigned));
        if let (Math::Unpack2x16float, [pair]) = (fun, arguments)
            && let &[Reg::I(low)] = pair.as_slice()
        {
            let sixteen = self.integer(16);
            let high = self.integer2(I2::ShiftRightUnsigned, low, sixteen)?;
            let low = self.integer_to_float(IToF::Half, low)?;
            return Ok(Value::Regs(vec![low, self.integer_to_float(IToF::Half, high)?]));
        }
        let one = match fun {
            Math::Abs if signed => Some(I1::Abs),
            Math::Sign => Some(I1::Sign),
            Math::CountOneBits => Some(I1::CountOneBits),
            Math::CountLeadingZeros => Some(I1::CountLeadingZeros),
            Math::CountTrailingZeros => Some(I1::CountTrailingZeros),
            Math::ReverseBits => Some(I1::ReverseBits),
            Math::FirstTrailingBit => Some(I1::FirstTrailingBit),
            Math::FirstLeadingBit if signed => Some(I1::FirstLeadingBitSigned),
            Math::FirstLeadingBit => Some(I1::FirstLeadingBitUnsigned),
            _ => None,
        };
        if fun == Math::Dot {
            return self.integer_dot(arguments);
        }
        let count = arguments.iter().map(Vec::len).max().unwrap_or(0);
        let mut results = Vec::with_capacity(count);
        for at in 0..count {
            let slots: Vec<Slot> = arguments
                .iter()
                .filter_map(|a| match a.get(at).or(a.first()) {
                    Some(&Reg::I(slot)) => Some(slot),
                    _ => None,
                })
                .collect();
            results.push(Reg::I(match (fun, one, slots.as_slice()) {
                (_, Some(op), &[a]) => self.integer1(op, a)?,
                (Math::Abs, _, &[a]) => a,
                (Math::Min, _, &[a, b]) => self.integer2(min, a, b)?,
                (Math::Max, _, &[a, b]) => self.integer2(max, a, b)?,
                (Math::Clamp, _, &[a, low, high]) => {
                    let above = self.integer2(max, a, low)?;
                    self.integer2(min, above, high)?
                }
                (Math::ExtractBits, _, &[a, offset, count]) => {
                    let to = self.program.integers;
                    self.program.integers += 1;
                    self.push(Instr::ExtractBits { signed, to, a, offset, count })?;
                    to
                }
                (Math::InsertBits, _, &[a, bits, offset, count]) => {
                    let to = self.program.integers;
                    self.program.integers += 1;
                    self.push(Instr::InsertBits { to, a, bits, offset, count })?;
                    to
                }
                _ => return Err(self.refuse(fun)),
            }));
        }
        Ok(Value::Regs(results))
    }

    fn integer_dot(&mut self, arguments: &[Vec<Reg>]) -> Result<Value, FormError> {
        let mut sum = self.integer(0);
        if let [a, b] = arguments {
            for pair in a.iter().zip(b) {
                if let (&Reg::I(a), &Reg::I(b)) = pair {
                    let product = self.integer2(I2::Mul, a, b)?;
                    sum = self.integer2(I2::Add, sum, product)?;
                }
            }
        }
        Ok(Value::Regs(vec![Reg::I(sum)]))
    }

    fn refuse(&self, fun: Math) -> FormError {
        self.unsupported(self.here, format!("the built-in function {fun:?} of this type"))
    }
}

fn scalar(slot: Slot) -> Value {
    Value::Regs(vec![Reg::F(slot)])
}

/// Functions of one f32 that are one instruction.
fn one_argument(fun: Math) -> Option<F1> {
    Some(match fun {
        Math::Abs => F1::Abs,
        Math::Sign => F1::Sign,
        Math::Floor => F1::Floor,
        Math::Ceil => F1::Ceil,
        Math::Round => F1::Round,
        Math::Trunc => F1::Trunc,
        Math::Degrees => F1::Degrees,
        Math::Radians => F1::Radians,
        Math::QuantizeToF16 => F1::QuantizeF16,
        Math::Sqrt => F1::Sqrt,
        Math::InverseSqrt => F1::InverseSqrt,
        Math::Sin => F1::Sin,
        Math::Cos => F1::Cos,
        Math::Tan => F1::Tan,
        Math::Asin => F1::Asin,
        Math::Acos => F1::Acos,
        Math::Atan => F1::Atan,
        Math::Sinh => F1::Sinh,
        Math::Cosh => F1::Cosh,
        Math::Tanh => F1::Tanh,
        Math::Asinh => F1::Asinh,
        Math::Acosh => F1::Acosh,
        Math::Atanh => F1::Atanh,
        Math::Exp => F1::Exp,
        Math::Exp2 => F1::Exp2,
        Math::Log => F1::Log,
        Math::Log2 => F1::Log2,
        _ => return None,
    })
}
