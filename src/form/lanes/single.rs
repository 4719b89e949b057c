//! f32 lanes: IEEE arithmetic and correctly rounded elementary functions (CORE-MATH), so that a
//! form gives the same bits on every machine.

use pulp::Arch;

use super::real::{Real, each1};
use crate::form::operation::F1;

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const DEGREES_PER_RADIAN: Self = (180.0 / std::f64::consts::PI) as Self;
    const RADIANS_PER_DEGREE: Self = (std::f64::consts::PI / 180.0) as Self;

    #[inline(always)]
    fn from_f32(value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self
    }
    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        value as Self
    }
    #[inline(always)]
    fn from_u32(value: u32) -> Self {
        value as Self
    }
    #[inline(always)]
    fn to_i32(self) -> i32 {
        // The largest f32 below 2³¹: what shaders clamp to.
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
        // In f64 the product is exact for every exponent that matters, so one rounding remains.
        let factor = f64::from_bits(((exponent.clamp(-700, 700) + 1023) as u64) << 52);
        (f64::from(self) * factor) as Self
    }
    #[inline(always)]
    fn split(self) -> (Self, i32) {
        let (fraction, exponent) = f64::from(self).split();
        (fraction as Self, exponent)
    }
    fn elementary(arch: Arch, op: F1, to: &mut [Self], a: &[Self]) {
        let function = match op {
            F1::InverseSqrt => core_math::rsqrtf,
            F1::Sin => core_math::sinf,
            F1::Cos => core_math::cosf,
            F1::Tan => core_math::tanf,
            F1::Asin => core_math::asinf,
            F1::Acos => core_math::acosf,
            F1::Atan => core_math::atanf,
            F1::Sinh => core_math::sinhf,
            F1::Cosh => core_math::coshf,
            F1::Tanh => core_math::tanhf,
            F1::Asinh => core_math::asinhf,
            F1::Acosh => core_math::acoshf,
            F1::Atanh => core_math::atanhf,
            F1::Exp => core_math::expf,
            F1::Exp2 => core_math::exp2f,
            F1::Log => core_math::logf,
            F1::Log2 => core_math::log2f,
            _ => return super::real::float1(arch, op, to, a),
        };
        each1(arch, to, a, function);
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        if self < 0.0 { Self::NAN } else { core_math::powf(self, exponent) }
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        core_math::atan2f(self, x)
    }
}
