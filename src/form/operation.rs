//! The operations of instructions, by the kinds of what they read and write.

/// Float to float, one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub(crate) enum F1 {
    Neg,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Trunc,
    Degrees,
    Radians,
    FrexpFract,
    QuantizeF16,
    Sqrt,
    InverseSqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Exp2,
    Log,
    Log2,
}

impl F1 {
    /// True for the functions that take a library call or a polynomial.
    pub(crate) fn is_elementary(self) -> bool {
        self as usize >= Self::InverseSqrt as usize
    }
}

/// Float to float, two arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub(crate) enum F2 {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Min,
    Max,
    Step,
    Pow,
    Atan2,
}

/// Float to integer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FToI {
    Signed,
    Unsigned,
    Bits,
    FrexpExponent,
}

/// Integer to float.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum IToF {
    Signed,
    Unsigned,
    Bits,
    /// The low 16 bits as binary16.
    Half,
}

/// Integer to integer, one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum I1 {
    Neg,
    Not,
    Abs,
    Sign,
    CountOneBits,
    CountLeadingZeros,
    CountTrailingZeros,
    ReverseBits,
    FirstTrailingBit,
    FirstLeadingBitSigned,
    FirstLeadingBitUnsigned,
}

/// Integer to integer, two arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum I2 {
    Add,
    Sub,
    Mul,
    DivSigned,
    DivUnsigned,
    RemSigned,
    RemUnsigned,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRightSigned,
    ShiftRightUnsigned,
    MinSigned,
    MinUnsigned,
    MaxSigned,
    MaxUnsigned,
}

/// Comparison; the order of integers is signed or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Compare {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// Truth values, two arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum B2 {
    And,
    Or,
    Equal,
    NotEqual,
}
