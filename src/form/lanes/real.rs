//! The floating-point types of the lanes, and the instructions that read the same for both.

use pulp::Arch;

use crate::form::half;
use crate::form::operation::{Compare, F1, F2, FToI, IToF};

/// A floating-point type that lanes can hold.
pub(crate) trait Real:
    Copy
    + Default
    + PartialOrd
    + std::fmt::Debug
    + std::ops::Neg<Output = Self>
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + std::ops::Rem<Output = Self>
    + 'static
{
    const ZERO: Self;
    const ONE: Self;
    const DEGREES_PER_RADIAN: Self;
    const RADIANS_PER_DEGREE: Self;

    fn from_f32(value: f32) -> Self;
    fn from_f64(value: f64) -> Self;
    /// Rounds to f32, ties to even.
    fn to_f32(self) -> f32;
    fn from_i32(value: i32) -> Self;
    fn from_u32(value: u32) -> Self;
    /// Towards zero, saturating, NaN to 0.
    fn to_i32(self) -> i32;
    /// Towards zero, saturating, NaN to 0.
    fn to_u32(self) -> u32;
    fn abs(self) -> Self;
    fn sqrt(self) -> Self;
    fn floor(self) -> Self;
    fn ceil(self) -> Self;
    fn trunc(self) -> Self;
    /// To the nearest integer, ties to even.
    fn round_even(self) -> Self;
    fn mul_add(self, factor: Self, addend: Self) -> Self;
    fn is_nan(self) -> bool;
    fn is_infinite(self) -> bool;
    /// `self · 2^exponent`, rounded once.
    fn scale(self, exponent: i32) -> Self;
    /// Fraction in [0.5, 1) with the sign of `self`, and exponent; 0, ∞ and NaN come back with 0.
    fn split(self) -> (Self, i32);
    /// Elementary functions of one argument.
    fn elementary(arch: Arch, op: F1, to: &mut [Self], a: &[Self]);
    /// Power with WGSL's domain: NaN for a negative base.
    fn pow(self, exponent: Self) -> Self;
    fn atan2(self, x: Self) -> Self;
}

/// `to[i] = f(a[i])`, compiled for the widest vectors that the processor has.
#[inline(always)]
pub(crate) fn each1<A: Copy, R>(arch: Arch, to: &mut [R], a: &[A], f: impl Fn(A) -> R) {
    arch.dispatch(
        #[inline(always)]
        || {
            for (to, &a) in to.iter_mut().zip(a) {
                *to = f(a);
            }
        },
    );
}

/// `to[i] = f(a[i], b[i])`, compiled for the widest vectors that the processor has.
#[inline(always)]
pub(crate) fn each2<A: Copy, B: Copy, R>(
    arch: Arch,
    to: &mut [R],
    a: &[A],
    b: &[B],
    f: impl Fn(A, B) -> R,
) {
    arch.dispatch(
        #[inline(always)]
        || {
            for ((to, &a), &b) in to.iter_mut().zip(a).zip(b) {
                *to = f(a, b);
            }
        },
    );
}

/// NaN if one operand is NaN, as IEEE 754-2019 `minimum`; WGSL leaves it open.
#[inline(always)]
fn minimum<R: Real>(a: R, b: R) -> R {
    let least = if a < b { a } else { b };
    if a.is_nan() { a } else { least }
}

/// NaN if one operand is NaN, as IEEE 754-2019 `maximum`; WGSL leaves it open.
#[inline(always)]
fn maximum<R: Real>(a: R, b: R) -> R {
    let greatest = if a > b { a } else { b };
    if a.is_nan() { a } else { greatest }
}

/// Zero and NaN keep themselves.
#[inline(always)]
fn sign<R: Real>(a: R) -> R {
    if a > R::ZERO {
        R::ONE
    } else if a < R::ZERO {
        -R::ONE
    } else {
        a
    }
}

/// One argument.
pub(crate) fn float1<R: Real>(arch: Arch, op: F1, to: &mut [R], a: &[R]) {
    match op {
        F1::Neg => each1(arch, to, a, |x| -x),
        F1::Abs => each1(arch, to, a, R::abs),
        F1::Sign => each1(arch, to, a, sign),
        F1::Floor => each1(arch, to, a, R::floor),
        F1::Ceil => each1(arch, to, a, R::ceil),
        F1::Round => each1(arch, to, a, R::round_even),
        F1::Trunc => each1(arch, to, a, R::trunc),
        F1::Degrees => each1(arch, to, a, |x| x * R::DEGREES_PER_RADIAN),
        F1::Radians => each1(arch, to, a, |x| x * R::RADIANS_PER_DEGREE),
        F1::FrexpFract => each1(arch, to, a, |x| x.split().0),
        F1::QuantizeF16 => each1(arch, to, a, |x| R::from_f32(half::quantized(x.to_f32()))),
        F1::Sqrt => each1(arch, to, a, R::sqrt),
        F1::InverseSqrt
        | F1::Sin
        | F1::Cos
        | F1::Tan
        | F1::Asin
        | F1::Acos
        | F1::Atan
        | F1::Sinh
        | F1::Cosh
        | F1::Tanh
        | F1::Asinh
        | F1::Acosh
        | F1::Atanh
        | F1::Exp
        | F1::Exp2
        | F1::Log
        | F1::Log2 => R::elementary(arch, op, to, a),
    }
}

/// Two arguments.
pub(crate) fn float2<R: Real>(arch: Arch, op: F2, to: &mut [R], a: &[R], b: &[R]) {
    match op {
        F2::Add => each2(arch, to, a, b, |a, b| a + b),
        F2::Sub => each2(arch, to, a, b, |a, b| a - b),
        F2::Mul => each2(arch, to, a, b, |a, b| a * b),
        F2::Div => each2(arch, to, a, b, |a, b| a / b),
        F2::Rem => each2(arch, to, a, b, |a, b| a % b),
        F2::Min => each2(arch, to, a, b, minimum),
        F2::Max => each2(arch, to, a, b, maximum),
        F2::Step => each2(arch, to, a, b, |edge, x| if edge <= x { R::ONE } else { R::ZERO }),
        F2::Pow => each2(arch, to, a, b, R::pow),
        F2::Atan2 => each2(arch, to, a, b, R::atan2),
    }
}

/// Comparison; false if an operand is NaN, except `!=`.
pub(crate) fn compare<T: Copy + PartialOrd>(
    arch: Arch,
    op: Compare,
    to: &mut [bool],
    a: &[T],
    b: &[T],
) {
    match op {
        Compare::Equal => each2(arch, to, a, b, |a, b| a == b),
        Compare::NotEqual => each2(arch, to, a, b, |a, b| a != b),
        Compare::Less => each2(arch, to, a, b, |a, b| a < b),
        Compare::LessEqual => each2(arch, to, a, b, |a, b| a <= b),
        Compare::Greater => each2(arch, to, a, b, |a, b| a > b),
        Compare::GreaterEqual => each2(arch, to, a, b, |a, b| a >= b),
    }
}

/// Float to integer.
pub(crate) fn to_integer<R: Real>(arch: Arch, op: FToI, to: &mut [u32], a: &[R]) {
    match op {
        FToI::Signed => each1(arch, to, a, |x| x.to_i32() as u32),
        FToI::Unsigned => each1(arch, to, a, R::to_u32),
        FToI::Bits => each1(arch, to, a, |x| x.to_f32().to_bits()),
        FToI::FrexpExponent => each1(arch, to, a, |x| x.split().1 as u32),
    }
}

/// Integer to float.
pub(crate) fn from_integer<R: Real>(arch: Arch, op: IToF, to: &mut [R], a: &[u32]) {
    match op {
        IToF::Signed => each1(arch, to, a, |bits| R::from_i32(bits as i32)),
        IToF::Unsigned => each1(arch, to, a, R::from_u32),
        IToF::Bits => each1(arch, to, a, |bits| R::from_f32(f32::from_bits(bits))),
        IToF::Half => each1(arch, to, a, |bits| R::from_f32(half::value(bits))),
    }
}
