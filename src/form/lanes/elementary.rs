//! Elementary functions over f64 lanes without branches, so that they use the processor's vectors.
//!
//! They use no fused operations: results are the same on every machine, whatever its vectors.
//! Results differ from the correctly rounded ones by at most 1 unit in the last place (`exp`,
//! `exp2`, `sin`, `cos`, `log`) or 2 (`tanh`, `log2`): the tests below hold this on 200 000 random
//! points per range. Lanes that a kernel does not cover (large or special arguments) are computed
//! again by CORE-MATH.

#![expect(clippy::excessive_precision, reason = "digits as fdlibm publishes them")]

use naga::MathFunction as Math;
use pulp::Arch;

use super::precision::exact;
use super::real::each1;

/// Adding it rounds a small double to an integer, which is then in the low bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// ln 2 in two parts, the first with trailing zeros (fdlibm).
const LN2_HIGH: f64 = 6.931_471_803_691_238_164_9e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_700_02e-10;

/// 1/n! for n = 2 … 13. The remainder of eʳ − 1 on |r| ≤ ln 2 / 2 is below 5e-18.
const EXP: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// Coefficients in ascending order, by Horner's rule.
#[inline(always)]
fn polynomial<const N: usize>(x: f64, coefficients: [f64; N]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, &c| sum * x + c)
}

/// 2ᵏ for the integer k that `rounded` = k + [`ROUNDER`] holds, −1023 < k < 1024.
#[inline(always)]
fn power_of_two(rounded: f64) -> f64 {
    f64::from_bits((rounded.to_bits() << 52).wrapping_add(1023 << 52))
}

/// eʳ − 1 on |r| ≤ ln 2 / 2.
#[inline(always)]
fn exp_m1_reduced(r: f64) -> f64 {
    r + r * r * polynomial(r, EXP)
}

/// k and r with x = k ln 2 + r; k comes with [`ROUNDER`] added too.
#[inline(always)]
fn reduce_exp(x: f64) -> (f64, f64, f64) {
    let rounded = x * std::f64::consts::LOG2_E + ROUNDER;
    let k = rounded - ROUNDER;
    (rounded, k, (x - k * LN2_HIGH) - k * LN2_LOW)
}

/// (1 + p) 2ᵏ, in two steps that keep both factors normal.
#[inline(always)]
fn scaled(p: f64, k: f64) -> f64 {
    let half = k * 0.5 + ROUNDER;
    let rest = (k - (half - ROUNDER)) + ROUNDER;
    (1.0 + p) * power_of_two(half) * power_of_two(rest)
}

#[inline(always)]
fn bounded(x: f64, low: f64, high: f64) -> f64 {
    let x = if x > high { high } else { x };
    if x < low { low } else { x }
}

#[inline(always)]
fn exp_kernel(x: f64) -> f64 {
    let (_, k, r) = reduce_exp(bounded(x, -746.0, 710.0));
    scaled(exp_m1_reduced(r), k)
}

#[inline(always)]
fn exp2_kernel(x: f64) -> f64 {
    let x = bounded(x, -1076.0, 1025.0);
    let k = (x + ROUNDER) - ROUNDER;
    scaled(exp_m1_reduced((x - k) * std::f64::consts::LN_2), k)
}

/// (e²ˣ − 1) / (e²ˣ + 1), from eˣ − 1 so that small arguments keep their digits.
#[inline(always)]
fn tanh_kernel(x: f64) -> f64 {
    let magnitude = bounded(x.abs(), 0.0, 22.0);
    let (rounded, _, r) = reduce_exp(2.0 * magnitude);
    let scale = power_of_two(rounded);
    let exp_m1 = scale * exp_m1_reduced(r) + (scale - 1.0);
    (exp_m1 / (exp_m1 + 2.0)).copysign(x)
}

/// π/2 in parts of 33 bits, and the rest (fdlibm).
const PIO2: [f64; 2] = [1.570_796_326_734_125_614_17, 6.077_100_506_303_965_976_60e-11];
const PIO2_REST: f64 = 2.022_266_248_795_950_631_54e-21;

/// Beyond this, multiples of the parts of π/2 are no longer exact.
const LARGEST_ANGLE: f64 = 1.0e6;

/// A result smaller than this needs more digits of π/2 than there are.
const SMALLEST_RESULT: f64 = 1.0e-9;

/// sin(r + low) / r-terms on |r| ≤ π/4: fdlibm's `k_sin.c`, error below 2⁻⁵⁸.
const SIN: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-1,
    8.333_333_333_322_489_461_24e-3,
    -1.984_126_982_985_794_931_34e-4,
    2.755_731_370_707_006_767_89e-6,
    -2.505_076_025_340_686_341_95e-8,
    1.589_690_995_211_550_102_21e-10,
];

/// cos(r) − 1 + r²/2 on |r| ≤ π/4: fdlibm's `k_cos.c`, error below 2⁻⁵⁸.
const COS: [f64; 6] = [
    4.166_666_666_666_660_190_37e-2,
    -1.388_888_888_887_410_957_49e-3,
    2.480_158_728_947_672_941_78e-5,
    -2.755_731_435_139_066_330_35e-7,
    2.087_572_321_298_174_827_90e-9,
    -1.135_964_755_778_819_482_65e-11,
];

/// sin(x + quarter · π/2).
#[inline(always)]
fn sin_kernel(x: f64, quarter: u64) -> f64 {
    let rounded = x * std::f64::consts::FRAC_2_PI + ROUNDER;
    let k = rounded - ROUNDER;
    // Cody and Waite in two exact steps, the rounding of the second carried on.
    let first = x - k * PIO2[0];
    let second = k * PIO2[1];
    let difference = first - second;
    let rest = k * PIO2_REST - ((first - difference) - second);
    let r = difference - rest;
    let low = (difference - r) - rest;
    let square = r * r;
    let [s, sines @ ..] = SIN;
    let tail = polynomial(square, sines);
    let cube = square * r;
    let sin = r - ((square * (0.5 * low - cube * tail) - low) - cube * s);
    let half = 0.5 * square;
    let leading = 1.0 - half;
    let cos = leading
        + (((1.0 - leading) - half) + (square * square * polynomial(square, COS) - r * low));
    let quadrant = rounded.to_bits().wrapping_add(quarter);
    let value = if quadrant & 1 == 0 { sin } else { cos };
    f64::from_bits(value.to_bits() ^ ((quadrant & 2) << 62))
}

/// The exponent k and log(m) with x = 2ᵏ m, m in [√½, √2): fdlibm's `e_log.c`, x normal.
#[inline(always)]
fn log_parts(x: f64) -> (f64, f64, f64) {
    const SQRT_HALF: u64 = 0x3fe6_a09e_0000_0000;
    const TWO_52: u64 = 0x4330_0000_0000_0000;
    const LOG: [f64; 7] = [
        6.666_666_666_666_735_130e-1,
        3.999_999_999_940_941_908e-1,
        2.857_142_874_366_239_149e-1,
        2.222_219_843_214_978_396e-1,
        1.818_357_216_161_805_012e-1,
        1.531_383_769_920_937_332e-1,
        1.479_819_860_511_658_591e-1,
    ];
    let shifted = x.to_bits().wrapping_add((1023 << 52) - SQRT_HALF);
    let k = f64::from_bits(TWO_52 | (shifted >> 52)) - (f64::from_bits(TWO_52) + 1023.0);
    let m = f64::from_bits((shifted & 0x000f_ffff_ffff_ffff) + SQRT_HALF);
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let half_square = 0.5 * f * f;
    let square = s * s;
    // log(1 + f) = f − (f²/2 − s (f²/2 + R)).
    (k, f, half_square - s * (half_square + square * polynomial(square, LOG)))
}

#[inline(always)]
fn log_kernel(x: f64) -> f64 {
    let (k, f, correction) = log_parts(x);
    k * LN2_HIGH - ((correction - k * LN2_LOW) - f)
}

#[inline(always)]
fn log2_kernel(x: f64) -> f64 {
    let (k, f, correction) = log_parts(x);
    k + (f - correction) * std::f64::consts::LOG2_E
}

/// Computes lanes again that `covered(argument, result)` rejects.
#[inline(always)]
fn repair(
    arch: Arch,
    to: &mut [f64],
    a: &[f64],
    covered: impl Fn(f64, f64) -> bool,
    exact: fn(f64) -> f64,
) {
    let all = arch.dispatch(
        #[inline(always)]
        || to.iter().zip(a).fold(true, |all, (&value, &x)| all & covered(x, value)),
    );
    if !all {
        for (value, &x) in to.iter_mut().zip(a) {
            if !covered(x, *value) {
                *value = exact(x);
            }
        }
    }
}

#[inline(always)]
fn angle_covered(x: f64, value: f64) -> bool {
    // Near zero the reduction is exact, and small results are right.
    (x.abs() <= LARGEST_ANGLE) & ((value.abs() >= SMALLEST_RESULT) | (x.abs() <= 0.5))
}

#[inline(always)]
fn normal_positive(x: f64, _: f64) -> bool {
    (f64::MIN_POSITIVE..f64::INFINITY).contains(&x)
}

/// `to[i] = function(a[i])`.
pub(super) fn evaluate(arch: Arch, function: Math, to: &mut [f64], a: &[f64]) {
    let (exact, _) = exact(function);
    match function {
        Math::InverseSqrt => each1(arch, to, a, |x| 1.0 / x.sqrt()),
        Math::Exp => each1(arch, to, a, exp_kernel),
        Math::Exp2 => each1(arch, to, a, exp2_kernel),
        Math::Tanh => each1(arch, to, a, tanh_kernel),
        Math::Sin => {
            each1(arch, to, a, |x| sin_kernel(x, 0));
            repair(arch, to, a, angle_covered, exact);
        }
        Math::Cos => {
            each1(arch, to, a, |x| sin_kernel(x, 1));
            repair(arch, to, a, angle_covered, exact);
        }
        Math::Log => {
            each1(arch, to, a, log_kernel);
            repair(arch, to, a, normal_positive, exact);
        }
        Math::Log2 => {
            each1(arch, to, a, log2_kernel);
            repair(arch, to, a, normal_positive, exact);
        }
        _ => each1(arch, to, a, exact),
    }
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Function, range, and the largest difference from the correctly rounded one in ulp.
    const FUNCTIONS: &[(Math, f64, f64, f64)] = &[
        (Math::Exp, -760.0, 720.0, 1.0),
        (Math::Exp, -1.0, 1.0, 1.0),
        (Math::Exp2, -1080.0, 1030.0, 1.0),
        (Math::Exp2, -1.0, 1.0, 1.0),
        (Math::Tanh, -25.0, 25.0, 2.0),
        (Math::Tanh, -1.0, 1.0, 2.0),
        (Math::Tanh, -1e-4, 1e-4, 2.0),
        (Math::Sin, -10.0, 10.0, 1.0),
        (Math::Sin, -2e6, 2e6, 1.0),
        (Math::Sin, -1e-6, 1e-6, 1.0),
        (Math::Cos, -10.0, 10.0, 1.0),
        (Math::Cos, -2e6, 2e6, 1.0),
        (Math::Log, 0.0, 3.0, 1.0),
        (Math::Log, 0.999, 1.001, 1.0),
        (Math::Log, 0.0, 1e300, 1.0),
        (Math::Log2, 0.0, 3.0, 2.0),
        (Math::Log2, 0.999, 1.001, 2.0),
    ];

    const SPECIAL: &[f64] = &[
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MAX,
        f64::MIN,
        f64::MIN_POSITIVE,
        5e-324,
        -5e-324,
        1e-310,
        -745.2,
        709.78,
        709.79,
        -708.5,
        1e22,
        std::f64::consts::PI,
        std::f64::consts::FRAC_PI_2,
        6381956970095103.0,
        22.0,
        -1074.0,
        -1074.6,
        1023.9999,
        1024.0,
    ];

    fn error_ulps(got: f64, exact: f64) -> f64 {
        if got == exact || (got.is_nan() && exact.is_nan()) {
            return 0.0;
        }
        let ulp = (exact.abs().next_up() - exact.abs()).max(5e-324);
        (got - exact).abs() / ulp
    }

    #[test]
    fn within_the_stated_errors() {
        let mut rng = ChaCha8Rng::seed_from_u64(11);
        for &(name, low, high, bound) in FUNCTIONS {
            let (exact, _) = exact(name);
            let mut xs: Vec<f64> = (0..200_000).map(|_| rng.random_range(low..high)).collect();
            xs.extend(SPECIAL);
            let mut values = vec![0.0; xs.len()];
            evaluate(Arch::new(), name, &mut values, &xs);
            let mut worst = (0.0, 0.0);
            for (&x, &value) in xs.iter().zip(&values) {
                let error = error_ulps(value, exact(x));
                assert!(error <= bound, "{name:?}({x:e}) = {value:e}, not {:e}", exact(x));
                if exact(x) == 0.0 {
                    assert_eq!(value.to_bits(), exact(x).to_bits(), "{name:?}({x:e})");
                }
                if error > worst.0 {
                    worst = (error, x);
                }
            }
            println!("{name:?} on [{low}, {high}]: {} ulp at {:e}", worst.0, worst.1);
        }
    }

    #[test]
    fn the_same_without_vectors() {
        let mut rng = ChaCha8Rng::seed_from_u64(12);
        let xs: Vec<f64> = (0..10_000).map(|_| rng.random_range(-20.0..20.0)).collect();
        for &(name, ..) in FUNCTIONS {
            let (mut vector, mut scalar) = (vec![0.0; xs.len()], vec![0.0; xs.len()]);
            evaluate(Arch::new(), name, &mut vector, &xs);
            evaluate(Arch::Scalar, name, &mut scalar, &xs);
            for (a, b) in vector.iter().zip(&scalar) {
                assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()), "{name:?}");
            }
        }
    }
}
