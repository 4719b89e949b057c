//! Integer and truth-value instructions, with WGSL's rules for what C leaves undefined.

use naga::{BinaryOperator as Operator, MathFunction as Math};
use pulp::Arch;

use super::real::{compare, each1, each2};

/// A built-in function of one or two arguments.
pub(crate) fn math(
    arch: Arch,
    (function, signed): (Math, bool),
    to: &mut [u32],
    a: &[u32],
    b: &[u32],
) {
    match (function, signed) {
        (Math::Abs, _) => each1(arch, to, a, |x| (x as i32).wrapping_abs() as u32),
        (Math::Sign, _) => each1(arch, to, a, |x| (x as i32).signum() as u32),
        (Math::CountOneBits, _) => each1(arch, to, a, u32::count_ones),
        (Math::CountLeadingZeros, _) => each1(arch, to, a, u32::leading_zeros),
        (Math::CountTrailingZeros, _) => each1(arch, to, a, u32::trailing_zeros),
        (Math::ReverseBits, _) => each1(arch, to, a, u32::reverse_bits),
        (Math::FirstTrailingBit, _) => {
            each1(arch, to, a, |x| if x == 0 { u32::MAX } else { x.trailing_zeros() });
        }
        (Math::FirstLeadingBit, false) => each1(arch, to, a, first_leading_bit),
        (Math::FirstLeadingBit, true) => {
            each1(arch, to, a, |x| first_leading_bit(if (x as i32) < 0 { !x } else { x }));
        }
        (Math::Min, true) => each2(arch, to, a, b, |a, b| (a as i32).min(b as i32) as u32),
        (Math::Min, false) => each2(arch, to, a, b, u32::min),
        (Math::Max, true) => each2(arch, to, a, b, |a, b| (a as i32).max(b as i32) as u32),
        (Math::Max, false) => each2(arch, to, a, b, u32::max),
        _ => unreachable!("{function:?} is no function of integers of the lanes"),
    }
}

/// Position of the highest set bit, all ones if there is none.
fn first_leading_bit(x: u32) -> u32 {
    31_u32.wrapping_sub(x.leading_zeros())
}

/// Arithmetic. Division by zero, and the one signed quotient that overflows, give the dividend; their
/// remainders are zero. Shifts take the count modulo 32.
pub(crate) fn arithmetic(
    arch: Arch,
    (op, signed): (Operator, bool),
    to: &mut [u32],
    a: &[u32],
    b: &[u32],
) {
    match (op, signed) {
        (Operator::Add, _) => each2(arch, to, a, b, u32::wrapping_add),
        (Operator::Subtract, _) => each2(arch, to, a, b, u32::wrapping_sub),
        (Operator::Multiply, _) => each2(arch, to, a, b, u32::wrapping_mul),
        (Operator::Divide, true) => each2(arch, to, a, b, |a, b| {
            (a as i32).checked_div(b as i32).map_or(a, |quotient| quotient as u32)
        }),
        (Operator::Divide, false) => each2(arch, to, a, b, |a, b| a.checked_div(b).unwrap_or(a)),
        (Operator::Modulo, true) => each2(arch, to, a, b, |a, b| {
            (a as i32).checked_rem(b as i32).unwrap_or_default() as u32
        }),
        (Operator::Modulo, false) => {
            each2(arch, to, a, b, |a, b| a.checked_rem(b).unwrap_or_default());
        }
        (Operator::And, _) => each2(arch, to, a, b, |a, b| a & b),
        (Operator::InclusiveOr, _) => each2(arch, to, a, b, |a, b| a | b),
        (Operator::ExclusiveOr, _) => each2(arch, to, a, b, |a, b| a ^ b),
        (Operator::ShiftLeft, _) => each2(arch, to, a, b, u32::wrapping_shl),
        (Operator::ShiftRight, true) => {
            each2(arch, to, a, b, |a, b| (a as i32).wrapping_shr(b) as u32);
        }
        (Operator::ShiftRight, false) => each2(arch, to, a, b, u32::wrapping_shr),
        _ => unreachable!("naga has no operator {op:?} between integers"),
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
    (op, signed): (Operator, bool),
    to: &mut [bool],
    a: &[u32],
    b: &[u32],
) {
    if signed {
        compare::<i32>(arch, op, to, bytemuck::cast_slice(a), bytemuck::cast_slice(b));
    } else {
        compare(arch, op, to, a, b);
    }
}

/// Two truth values.
pub(crate) fn logic(arch: Arch, op: Operator, to: &mut [bool], a: &[bool], b: &[bool]) {
    match op {
        Operator::And | Operator::LogicalAnd => each2(arch, to, a, b, |a, b| a & b),
        Operator::InclusiveOr | Operator::LogicalOr => each2(arch, to, a, b, |a, b| a | b),
        Operator::ExclusiveOr => each2(arch, to, a, b, |a, b| a ^ b),
        _ => compare(arch, op, to, a, b),
    }
}
