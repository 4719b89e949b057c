//! What an expression is at compile time.

use crate::form::program::{Kind, Reg, Slot};

/// A scalar known at compile time, by its bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Scalar {
    F(u32),
    I(u32),
    B(bool),
}

impl Scalar {
    pub(super) fn zero(kind: Kind) -> Self {
        match kind {
            Kind::F => Self::F(0),
            Kind::I => Self::I(0),
            Kind::B => Self::B(false),
        }
    }

    /// Kind and bits; a truth value is 0 or 1.
    pub(super) fn parts(self) -> (Kind, u32) {
        match self {
            Self::F(bits) => (Kind::F, bits),
            Self::I(bits) => (Kind::I, bits),
            Self::B(value) => (Kind::B, value.into()),
        }
    }
}

/// The value of an expression.
#[derive(Debug, Clone)]
pub(super) enum Value {
    /// One register per scalar.
    Regs(Vec<Reg>),
    /// An array that is known at compile time; it becomes a table when it is indexed.
    Array(Vec<Scalar>),
    /// A table that is given beside the text: `length` entries of `count` scalars.
    Table { table: u32, kind: Kind, length: u32, count: u32 },
    /// Part of a table: `count` scalars from `index + offset`.
    Row { table: u32, kind: Kind, index: Slot, offset: u32, count: u32 },
    /// A reference to a variable or a part of one.
    Place(Place),
}

/// `count` registers of a variable from `offset`, moved on by `index` if there is one.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) regs: Vec<Reg>,
    pub(super) offset: usize,
    pub(super) count: usize,
    pub(super) index: Option<Slot>,
}
