//! f64 lanes: IEEE arithmetic; the common elementary functions by the kernels of
//! [`super::elementary`], the others correctly rounded (CORE-MATH).

use pulp::Arch;

use super::elementary;
use super::real::{Real, each1};
use crate::form::operation::F1;

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const DEGREES_PER_RADIAN: Self = 180.0 / std::f64::consts::PI;
    const RADIANS_PER_DEGREE: Self = std::f64::consts::PI / 180.0;

    #[inline(always)]
    fn from_f32(value: f32) -> Self {
        Self::from(value)
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self as f32
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        Self::from(value)
    }
    #[inline(always)]
    fn from_u32(value: u32) -> Self {
        Self::from(value)
    }
    #[inline(always)]
    fn to_i32(self) -> i32 {
        // The bounds of f32 lanes, so that both agree on what saturates.
        self.min(2_147_483_520.0) as i32 * i32::from(!self.is_nan())
    }
    #[inline(always)]
    fn to_u32(self) -> u32 {
        self.min(4_294_967_040.0) as u32 * u32::from(!self.is_nan())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.floor()
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        self.ceil()
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        self.trunc()
    }
    #[inline(always)]
    fn round_even(self) -> Self {
        self.round_ties_even()
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.is_nan()
    }
    #[inline(always)]
    fn is_infinite(self) -> bool {
        self.is_infinite()
    }
    #[inline(always)]
    fn scale(self, exponent: i32) -> Self {
        // Two exact steps at most before the last, which rounds: 2¹⁰²³ is the largest power.
        let power = |e: i32| Self::from_bits(((e + 1023) as u64) << 52);
        let exponent = exponent.clamp(-2200, 2200);
        let third = exponent / 3;
        self * power(third) * power(third) * power(exponent - 2 * third)
    }
    #[inline(always)]
    fn split(self) -> (Self, i32) {
        const TWO_54: f64 = 18_014_398_509_481_984.0;
        if self == 0.0 || !self.is_finite() {
            return (self, 0);
        }
        let subnormal = self.abs() < Self::MIN_POSITIVE;
        let scaled = if subnormal { self * TWO_54 } else { self };
        let bits = scaled.to_bits();
        let exponent = ((bits >> 52) & 0x7ff) as i32 - 1022 - if subnormal { 54 } else { 0 };
        let fraction = Self::from_bits((bits & !(0x7ff << 52)) | (1022 << 52));
        (fraction, exponent)
    }
    fn elementary(arch: Arch, op: F1, to: &mut [Self], a: &[Self]) {
        let function = match op {
            F1::InverseSqrt => return each1(arch, to, a, |x| 1.0 / x.sqrt()),
            F1::Sin => return elementary::sin(arch, to, a),
            F1::Cos => return elementary::cos(arch, to, a),
            F1::Tan => core_math::tan,
            F1::Asin => core_math::asin,
            F1::Acos => core_math::acos,
            F1::Atan => core_math::atan,
            F1::Sinh => core_math::sinh,
            F1::Cosh => core_math::cosh,
            F1::Tanh => return elementary::tanh(arch, to, a),
            F1::Asinh => core_math::asinh,
            F1::Acosh => core_math::acosh,
            F1::Atanh => core_math::atanh,
            F1::Exp => return elementary::exp(arch, to, a),
            F1::Exp2 => return elementary::exp2(arch, to, a),
            F1::Log => return elementary::log(arch, to, a),
            F1::Log2 => return elementary::log2(arch, to, a),
            _ => return super::real::float1(arch, op, to, a),
        };
        each1(arch, to, a, function);
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        if self < 0.0 { Self::NAN } else { core_math::pow(self, exponent) }
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        core_math::atan2(self, x)
    }
}
