//! The operations of instructions: those of naga, for the kinds of scalars that they are of, and
//! what has no name there.

use naga::{BinaryOperator, MathFunction, RelationalFunction, ScalarKind, UnaryOperator};

use super::program::Kind;

/// An operation on scalars of one type, which comes with it where it matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Op {
    Unary(UnaryOperator, ScalarKind),
    /// A shift takes its count from an unsigned number.
    Binary(BinaryOperator, ScalarKind),
    /// A function that has a [`Class`], or `frexp`: it gives the fraction alone, `ldexp`
    /// takes its exponent from an integer.
    Math(MathFunction, ScalarKind),
    /// The exponent that `frexp` gives.
    FrexpExponent,
    /// The low 16 bits of an integer as binary16.
    Half,
    /// A test of a float.
    Relational(RelationalFunction),
    /// A conversion by value, from a type to another.
    Convert(ScalarKind, ScalarKind),
    /// The bits of an f32 as an integer, or the other way round: to a type.
    Bitcast(ScalarKind),
}

impl Op {
    /// Kind of the result.
    pub(crate) fn result(self) -> Kind {
        match self {
            Self::Binary(op, _) if is_comparison(op) => Kind::B,
            Self::Unary(_, kind) | Self::Binary(_, kind) | Self::Math(_, kind) => kind.into(),
            Self::Convert(_, to) | Self::Bitcast(to) => to.into(),
            Self::FrexpExponent => Kind::I,
            Self::Half => Kind::F,
            Self::Relational(_) => Kind::B,
        }
    }

    /// What it takes of a processor.
    pub(crate) fn class(self) -> Class {
        match self {
            Self::Binary(BinaryOperator::Divide | BinaryOperator::Modulo, ScalarKind::Float) => {
                Class::DivideSqrt
            }
            Self::Math(function, _) => Class::of(function).unwrap_or(Class::Arithmetic),
            _ => Class::Arithmetic,
        }
    }
}

/// Classes of operations by what they take of a processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    Arithmetic,
    DivideSqrt,
    /// A library call or a polynomial.
    Elementary,
}

impl Class {
    /// That of a built-in function which the lanes have for each component of its arguments; `None`
    /// for the others.
    pub(crate) fn of(function: MathFunction) -> Option<Self> {
        use MathFunction::*;
        Some(match function {
            Abs | Sign | Floor | Ceil | Round | Trunc | Degrees | Radians | QuantizeToF16 | Min
            | Max | Step | Fma | Ldexp | CountOneBits | CountLeadingZeros | CountTrailingZeros
            | ReverseBits | FirstTrailingBit | FirstLeadingBit | ExtractBits | InsertBits => {
                Self::Arithmetic
            }
            Sqrt | InverseSqrt => Self::DivideSqrt,
            Sin | Cos | Tan | Asin | Acos | Atan | Sinh | Cosh | Tanh | Asinh | Acosh | Atanh
            | Exp | Exp2 | Log | Log2 | Pow | Atan2 => Self::Elementary,
            _ => return None,
        })
    }
}

/// True for the operators that give a truth value of two numbers.
pub(crate) fn is_comparison(op: BinaryOperator) -> bool {
    use BinaryOperator::*;
    matches!(op, Equal | NotEqual | Less | LessEqual | Greater | GreaterEqual)
}
