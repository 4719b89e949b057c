//! Integer and truth-value instructions, with WGSL's rules for what C leaves undefined.

use pulp::Arch;

use super::real::{compare, each1, each2};
use crate::form::operation::{B2, Compare, I1, I2};

/// One argument.
pub(crate) fn integer1(arch: Arch, op: I1, to: &mut [u32], a: &[u32]) {
    match op {
        I1::Neg => each1(arch, to, a, u32::wrapping_neg),
        I1::Not => each1(arch, to, a, |x| !x),
        I1::Abs => each1(arch, to, a, |x| (x as i32).wrapping_abs() as u32),
        I1::Sign => each1(arch, to, a, |x| (x as i32).signum() as u32),
        I1::CountOneBits => each1(arch, to, a, u32::count_ones),
        I1::CountLeadingZeros => each1(arch, to, a, u32::leading_zeros),
        I1::CountTrailingZeros => each1(arch, to, a, u32::trailing_zeros),
        I1::ReverseBits => each1(arch, to, a, u32::reverse_bits),
        I1::FirstTrailingBit => {
            each1(arch, to, a, |x| if x == 0 { u32::MAX } else { x.trailing_zeros() });
        }
        I1::FirstLeadingBitUnsigned => each1(arch, to, a, first_leading_bit),
        I1::FirstLeadingBitSigned => {
            each1(arch, to, a, |x| first_leading_bit(if (x as i32) < 0 { !x } else { x }));
        }
    }
}

/// Position of the highest set bit, all ones if there is none.
fn first_leading_bit(x: u32) -> u32 {
    31_u32.wrapping_sub(x.leading_zeros())
}

/// Two arguments. Division by zero, and the one signed quotient that overflows, give the dividend;
/// their remainders are zero. Shifts take the count modulo 32.
pub(crate) fn integer2(arch: Arch, op: I2, to: &mut [u32], a: &[u32], b: &[u32]) {
    match op {
        I2::Add => each2(arch, to, a, b, u32::wrapping_add),
        I2::Sub => each2(arch, to, a, b, u32::wrapping_sub),
        I2::Mul => each2(arch, to, a, b, u32::wrapping_mul),
        I2::DivSigned => each2(arch, to, a, b, |a, b| {
            (a as i32).checked_div(b as i32).map_or(a, |quotient| quotient as u32)
        }),
        I2::DivUnsigned => each2(arch, to, a, b, |a, b| a.checked_div(b).unwrap_or(a)),
        I2::RemSigned => each2(arch, to, a, b, |a, b| {
            (a as i32).checked_rem(b as i32).unwrap_or_default() as u32
        }),
        I2::RemUnsigned => each2(arch, to, a, b, |a, b| a.checked_rem(b).unwrap_or_default()),
        I2::And => each2(arch, to, a, b, |a, b| a & b),
        I2::Or => each2(arch, to, a, b, |a, b| a | b),
        I2::Xor => each2(arch, to, a, b, |a, b| a ^ b),
        I2::ShiftLeft => each2(arch, to, a, b, u32::wrapping_shl),
        I2::ShiftRightSigned => {
            each2(arch, to, a, b, |a, b| (a as i32).wrapping_shr(b) as u32);
        }
        I2::ShiftRightUnsigned => each2(arch, to, a, b, u32::wrapping_shr),
        I2::MinSigned => each2(arch, to, a, b, |a, b| (a as i32).min(b as i32) as u32),
        I2::MinUnsigned => each2(arch, to, a, b, u32::min),
        I2::MaxSigned => each2(arch, to, a, b, |a, b| (a as i32).max(b as i32) as u32),
        I2::MaxUnsigned => each2(arch, to, a, b, u32::max),
    }
}

/// `count` bits of `a` from bit `offset`, sign-extended if `signed`.
pub(crate) fn extract_bits(signed: bool, a: u32, offset: u32, count: u32) -> u32 {
    let offset = offset.min(32);
    let count = count.min(32 - offset);
    if count == 0 {
        return 0;
    }
    let aligned = a << (32 - offset - count);
    if signed { ((aligned as i32) >> (32 - count)) as u32 } else { aligned >> (32 - count) }
}

/// `a` with `count` bits from bit `offset` replaced by the low bits of `bits`.
pub(crate) fn insert_bits(a: u32, bits: u32, offset: u32, count: u32) -> u32 {
    let offset = offset.min(32);
    let count = count.min(32 - offset);
    if count == 0 {
        return a;
    }
    let field = (u32::MAX >> (32 - count)) << offset;
    (a & !field) | ((bits << offset) & field)
}

/// Comparison of integers.
pub(crate) fn compare_integers(
    arch: Arch,
    op: Compare,
    signed: bool,
    to: &mut [bool],
    a: &[u32],
    b: &[u32],
) {
    // Flipping the top bit maps the order of i32 to that of u32.
    const FLIP: u32 = 1 << 31;
    match (op, signed) {
        (Compare::Less, true) => each2(arch, to, a, b, |a, b| (a ^ FLIP) < (b ^ FLIP)),
        (Compare::LessEqual, true) => each2(arch, to, a, b, |a, b| (a ^ FLIP) <= (b ^ FLIP)),
        (Compare::Greater, true) => each2(arch, to, a, b, |a, b| (a ^ FLIP) > (b ^ FLIP)),
        (Compare::GreaterEqual, true) => each2(arch, to, a, b, |a, b| (a ^ FLIP) >= (b ^ FLIP)),
        _ => compare(arch, op, to, a, b),
    }
}

/// Two truth values.
pub(crate) fn boolean2(arch: Arch, op: B2, to: &mut [bool], a: &[bool], b: &[bool]) {
    match op {
        B2::And => each2(arch, to, a, b, |a, b| a & b),
        B2::Or => each2(arch, to, a, b, |a, b| a | b),
        B2::Equal => each2(arch, to, a, b, |a, b| a == b),
        B2::NotEqual => each2(arch, to, a, b, |a, b| a != b),
    }
}
