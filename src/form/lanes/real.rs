//! The floating-point types of the lanes, and the instructions that read the same for both.

use pulp::Arch;

use naga::{BinaryOperator as Operator, MathFunction as Math};

use crate::form::half;

/// A floating-point type that lanes can hold.
pub(crate) trait Real:
    num_traits::Float + Default + std::fmt::Debug + Into<f64> + 'static
{
    /// Rounds to the nearest, ties to even.
    fn from_f64(value: f64) -> Self;
    /// Towards zero, saturating, NaN to 0.
    fn signed(self) -> i32;
    /// Towards zero, saturating, NaN to 0.
    fn unsigned(self) -> u32;
    /// To the nearest integer, ties to even.
    fn round_even(self) -> Self;
    /// `self · 2^exponent`, rounded once.
    fn scale(self, exponent: i32) -> Self;
    /// Fraction in [0.5, 1) with the sign of `self`, and exponent; 0, ∞ and NaN come back with 0.
    fn split(self) -> (Self, i32);
    /// Elementary functions of one argument.
    fn elementary(arch: Arch, function: Math, to: &mut [Self], a: &[Self]);
    /// Power with WGSL's domain: NaN for a negative base.
    fn power(self, exponent: Self) -> Self;
    /// The angle of the point `(x, self)`.
    fn angle(self, x: Self) -> Self;
}

/// An f32, exactly.
#[inline(always)]
pub(super) fn from_f32<R: Real>(value: f32) -> R {
    R::from_f64(value.into())
}

/// Rounds to f32, ties to even.
#[inline(always)]
pub(super) fn to_f32<R: Real>(value: R) -> f32 {
    Into::<f64>::into(value) as f32
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
pub(super) fn sign<R: Real>(a: R) -> R {
    if a > R::zero() {
        R::one()
    } else if a < R::zero() {
        -R::one()
    } else {
        a
    }
}

pub(super) const DEGREES_PER_RADIAN: f64 = 180.0 / std::f64::consts::PI;
pub(super) const RADIANS_PER_DEGREE: f64 = std::f64::consts::PI / 180.0;

/// A built-in function of one or two arguments; the functions that are missing here are elementary.
pub(crate) fn math<R: Real>(arch: Arch, function: Math, to: &mut [R], a: &[R], b: &[R]) {
    match function {
        Math::Abs => each1(arch, to, a, R::abs),
        Math::Sign => each1(arch, to, a, sign),
        Math::Floor => each1(arch, to, a, R::floor),
        Math::Ceil => each1(arch, to, a, R::ceil),
        Math::Round => each1(arch, to, a, R::round_even),
        Math::Trunc => each1(arch, to, a, R::trunc),
        Math::Degrees => each1(arch, to, a, |x| x * R::from_f64(DEGREES_PER_RADIAN)),
        Math::Radians => each1(arch, to, a, |x| x * R::from_f64(RADIANS_PER_DEGREE)),
        Math::Frexp => each1(arch, to, a, |x| x.split().0),
        Math::QuantizeToF16 => each1(arch, to, a, |x| from_f32(half::quantized(to_f32(x)))),
        Math::Sqrt => each1(arch, to, a, R::sqrt),
        Math::Min => each2(arch, to, a, b, minimum),
        Math::Max => each2(arch, to, a, b, maximum),
        Math::Step => {
            each2(arch, to, a, b, |edge, x| if edge <= x { R::one() } else { R::zero() });
        }
        Math::Pow => each2(arch, to, a, b, R::power),
        Math::Atan2 => each2(arch, to, a, b, R::angle),
        _ => R::elementary(arch, function, to, a),
    }
}

/// Arithmetic between floats.
pub(crate) fn arithmetic<R: Real>(arch: Arch, op: Operator, to: &mut [R], a: &[R], b: &[R]) {
    match op {
        Operator::Add => each2(arch, to, a, b, |a, b| a + b),
        Operator::Subtract => each2(arch, to, a, b, |a, b| a - b),
        Operator::Multiply => each2(arch, to, a, b, |a, b| a * b),
        Operator::Divide => each2(arch, to, a, b, |a, b| a / b),
        Operator::Modulo => each2(arch, to, a, b, |a, b| a % b),
        _ => unreachable!("naga has no operator {op:?} between floats"),
    }
}

/// Comparison; false if an operand is NaN, except `!=`.
pub(crate) fn compare<T: Copy + PartialOrd>(
    arch: Arch,
    op: Operator,
    to: &mut [bool],
    a: &[T],
    b: &[T],
) {
    match op {
        Operator::Equal => each2(arch, to, a, b, |a, b| a == b),
        Operator::NotEqual => each2(arch, to, a, b, |a, b| a != b),
        Operator::Less => each2(arch, to, a, b, |a, b| a < b),
        Operator::LessEqual => each2(arch, to, a, b, |a, b| a <= b),
        Operator::Greater => each2(arch, to, a, b, |a, b| a > b),
        Operator::GreaterEqual => each2(arch, to, a, b, |a, b| a >= b),
        _ => unreachable!("{op:?} is no comparison"),
    }
}
