//! f64 and f32 as the types of lanes: what both have by the same name once, then what differs.
//!
//! f64: IEEE arithmetic; the common elementary functions by the kernels of [`super::elementary`],
//! the others correctly rounded (CORE-MATH). f32: all of them correctly rounded, so that a form
//! gives the same bits on every machine.

use pulp::Arch;

use super::elementary;
use super::real::{Real, each1, float1};
use crate::form::operation::F1;

/// The items of [`Real`] that read the same for both types.
macro_rules! shared {
    ($pow:path, $atan2:path) => {
        const ZERO: Self = 0.0;
        const ONE: Self = 1.0;
        const DEGREES_PER_RADIAN: Self = (180.0 / std::f64::consts::PI) as Self;
        const RADIANS_PER_DEGREE: Self = (std::f64::consts::PI / 180.0) as Self;

        #[inline(always)]
        fn from_f32(value: f32) -> Self {
            value as Self
        }
        #[inline(always)]
        fn from_f64(value: f64) -> Self {
            value as Self
        }
        #[inline(always)]
        fn to_f32(self) -> f32 {
            self as f32
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
            // The largest f32 below 2³¹, what shaders clamp to: both types saturate alike.
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
        fn pow(self, exponent: Self) -> Self {
            if self < 0.0 { Self::NAN } else { $pow(self, exponent) }
        }
        #[inline(always)]
        fn atan2(self, x: Self) -> Self {
            $atan2(self, x)
        }
    };
}

impl Real for f64 {
    shared!(core_math::pow, core_math::atan2);

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
            _ => return float1(arch, op, to, a),
        };
        each1(arch, to, a, function);
    }
}

impl Real for f32 {
    shared!(core_math::powf, core_math::atan2f);

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
            _ => return float1(arch, op, to, a),
        };
        each1(arch, to, a, function);
    }
}
