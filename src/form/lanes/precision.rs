//! f64 and f32 as the types of lanes: what both have by the same name once, then what differs.
//!
//! f64: IEEE arithmetic; the common elementary functions by the kernels of [`super::elementary`],
//! the others correctly rounded (CORE-MATH). f32: all of them correctly rounded, so that a form
//! gives the same bits on every machine.

use naga::MathFunction as Math;
use pulp::Arch;

use super::elementary;
use super::real::{Real, each1};

/// The items of [`Real`] that read the same for both types.
macro_rules! shared {
    ($pow:path, $atan2:path) => {
        #[inline(always)]
        fn from_f64(value: f64) -> Self {
            value as Self
        }
        #[inline(always)]
        fn signed(self) -> i32 {
            // The largest f32 below 2³¹, what shaders clamp to: both types saturate alike.
            self.min(2_147_483_520.0) as i32 * i32::from(!self.is_nan())
        }
        #[inline(always)]
        fn unsigned(self) -> u32 {
            self.min(4_294_967_040.0) as u32 * u32::from(!self.is_nan())
        }
        #[inline(always)]
        fn round_even(self) -> Self {
            self.round_ties_even()
        }
        #[inline(always)]
        fn power(self, exponent: Self) -> Self {
            if self < 0.0 { Self::NAN } else { $pow(self, exponent) }
        }
        #[inline(always)]
        fn angle(self, x: Self) -> Self {
            $atan2(self, x)
        }
    };
}

type Function<R> = fn(R) -> R;

/// The correctly rounded functions, in f64 and in f32.
pub(super) fn exact(function: Math) -> (Function<f64>, Function<f32>) {
    match function {
        Math::InverseSqrt => (core_math::rsqrt, core_math::rsqrtf),
        Math::Sin => (core_math::sin, core_math::sinf),
        Math::Cos => (core_math::cos, core_math::cosf),
        Math::Tan => (core_math::tan, core_math::tanf),
        Math::Asin => (core_math::asin, core_math::asinf),
        Math::Acos => (core_math::acos, core_math::acosf),
        Math::Atan => (core_math::atan, core_math::atanf),
        Math::Sinh => (core_math::sinh, core_math::sinhf),
        Math::Cosh => (core_math::cosh, core_math::coshf),
        Math::Tanh => (core_math::tanh, core_math::tanhf),
        Math::Asinh => (core_math::asinh, core_math::asinhf),
        Math::Acosh => (core_math::acosh, core_math::acoshf),
        Math::Atanh => (core_math::atanh, core_math::atanhf),
        Math::Exp => (core_math::exp, core_math::expf),
        Math::Exp2 => (core_math::exp2, core_math::exp2f),
        Math::Log => (core_math::log, core_math::logf),
        Math::Log2 => (core_math::log2, core_math::log2f),
        _ => unreachable!("{function:?} is no elementary function of the lanes"),
    }
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
    fn elementary(arch: Arch, function: Math, to: &mut [Self], a: &[Self]) {
        elementary::evaluate(arch, function, to, a);
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
    fn elementary(arch: Arch, function: Math, to: &mut [Self], a: &[Self]) {
        each1(arch, to, a, exact(function).1);
    }
}
