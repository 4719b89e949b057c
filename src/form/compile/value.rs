//! What an expression is at compile time.

use crate::form::program::{Kind, Reg, Slot};

/// A scalar known at compile time, by its bits; a truth value is 0 or 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Scalar {
    pub(super) kind: Kind,
    pub(super) bits: u32,
}

impl Scalar {
    pub(super) fn zero(kind: Kind) -> Self {
        Self { kind, bits: 0 }
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
    Row { table: u32, kind: Kind, index: Reg, offset: u32, count: u32 },
    /// A reference to a variable or a part of one.
    Place(Place),
}

/// `count` registers of a variable from `offset`, moved on by `index` if there is one.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) regs: Vec<Reg>,
    pub(super) offset: usize,
    pub(super) count: usize,
    pub(super) index: Option<Reg>,
}

impl Place {
    /// A whole variable.
    pub(super) fn whole(regs: Vec<Reg>) -> Self {
        Self { count: regs.len(), regs, offset: 0, index: None }
    }

    /// The slots of its registers from `component` on.
    pub(super) fn slots(&self, component: usize) -> Box<[Slot]> {
        self.regs[component..].iter().map(|reg| reg.slot).collect()
    }
}
