//! The linear program over registers that the lanes run.
//!
//! A register holds one scalar per lane; vectors, structs and small arrays are several registers.
//! Registers written by pure instructions are written in one place only, so they may be computed
//! for every lane, also for those that the control flow has left. Variables are registers that
//! [`Instr::Store`] and [`Instr::Scatter`] write, and only those two obey the execution mask.

use std::sync::Arc;

use super::ScalarType;
use super::operation::{B2, Compare, F1, F2, FToI, I1, I2, IToF};

/// Index into the register file of one kind.
pub(crate) type Slot = u32;

/// A register: its kind and its index among the registers of that kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Reg {
    /// A floating-point number of the lanes' type.
    F(Slot),
    /// 32 bits of an `i32` or `u32`.
    I(Slot),
    /// A truth value.
    B(Slot),
}

/// Kind of a scalar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    F,
    I,
    B,
}

impl From<ScalarType> for Kind {
    fn from(scalar: ScalarType) -> Self {
        match scalar {
            ScalarType::F32 => Self::F,
            ScalarType::I32 | ScalarType::U32 => Self::I,
        }
    }
}

/// One instruction over all lanes.
#[derive(Debug, Clone)]
pub(crate) enum Instr {
    F1 {
        op: F1,
        to: Slot,
        a: Slot,
    },
    F2 {
        op: F2,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Fma {
        to: Slot,
        a: Slot,
        b: Slot,
        c: Slot,
    },
    Ldexp {
        to: Slot,
        a: Slot,
        exponent: Slot,
    },
    FToI {
        op: FToI,
        to: Slot,
        a: Slot,
    },
    IToF {
        op: IToF,
        to: Slot,
        a: Slot,
    },
    CompareF {
        op: Compare,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    IsNan {
        to: Slot,
        a: Slot,
    },
    IsInf {
        to: Slot,
        a: Slot,
    },
    I1 {
        op: I1,
        to: Slot,
        a: Slot,
    },
    I2 {
        op: I2,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    ExtractBits {
        signed: bool,
        to: Slot,
        a: Slot,
        offset: Slot,
        count: Slot,
    },
    InsertBits {
        to: Slot,
        a: Slot,
        bits: Slot,
        offset: Slot,
        count: Slot,
    },
    CompareI {
        op: Compare,
        signed: bool,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Not {
        to: Slot,
        a: Slot,
    },
    B2 {
        op: B2,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    /// `to = when ? yes : no`, all three of one kind.
    Select {
        to: Reg,
        when: Slot,
        yes: Reg,
        no: Reg,
    },
    /// `to = table[index + offset]`.
    Table {
        to: Reg,
        table: u32,
        index: Slot,
        offset: u32,
    },
    /// `to = from[index]`.
    Gather {
        to: Reg,
        from: Box<[Reg]>,
        index: Slot,
    },
    /// Copies for every lane.
    Move {
        to: Reg,
        from: Reg,
    },
    /// Copies for the active lanes.
    Store {
        to: Reg,
        from: Reg,
    },
    /// `to[index] = from` for the active lanes.
    Scatter {
        to: Box<[Reg]>,
        index: Slot,
        from: Reg,
    },
}

/// A sequence of nodes.
pub(crate) type Block = Vec<Node>;

/// Structured control flow. `exits` and `continues` are masks that collect the lanes that leave.
#[derive(Debug, Clone)]
pub(crate) enum Node {
    /// Straight-line code; `cost` is what it takes of the evaluation's budget.
    Run { instrs: Vec<Instr>, cost: u64 },
    /// Two-way branch.
    If { when: Slot, accept: Block, reject: Block },
    /// Many-way branch.
    Switch { selector: Slot, cases: Vec<Case>, exits: u32 },
    /// Loop; `break_if` is read after `continuing`.
    Loop {
        body: Block,
        continuing: Block,
        break_if: Option<Slot>,
        exits: u32,
        continues: u32,
        line: usize,
    },
    /// An inlined call: lanes that return come back at its end.
    Call(Block),
    /// The active lanes leave the loop or switch that owns the mask.
    Break(u32),
    /// The active lanes wait for the loop's `continuing`.
    Continue(u32),
    /// The active lanes leave the innermost call.
    Return,
}

/// One case of a switch; `None` is the default.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) value: Option<u32>,
    pub(crate) body: Block,
    pub(crate) falls_through: bool,
}

/// A compiled form.
#[derive(Debug, Clone, Default)]
pub(crate) struct Program {
    /// Runs once per evaluation: what depends on constants and parameters only.
    pub(crate) prologue: Vec<Instr>,
    /// Runs for every chunk of lanes.
    pub(crate) body: Block,
    pub(crate) floats: u32,
    pub(crate) integers: u32,
    pub(crate) booleans: u32,
    pub(crate) masks: u32,
    pub(crate) float_constants: Vec<(Slot, f32)>,
    pub(crate) integer_constants: Vec<(Slot, u32)>,
    pub(crate) boolean_constants: Vec<(Slot, bool)>,
    /// The scalars of tables and constant arrays, by their bits; a truth value is 0 or 1.
    pub(crate) tables: Vec<Arc<[u32]>>,
    /// Registers of the parameters, in their order.
    pub(crate) parameters: Vec<Slot>,
    /// Registers of the scalar inputs, in their order.
    pub(crate) inputs: Vec<Reg>,
    /// Registers of the scalar outputs, in their order.
    pub(crate) outputs: Vec<Slot>,
}

impl Instr {
    /// The registers that the instruction reads and those it writes.
    pub(crate) fn visit(&self, mut reads: impl FnMut(Reg), mut writes: impl FnMut(Reg)) {
        use Reg::{B, F, I};
        match *self {
            Self::F1 { to, a, .. } => {
                reads(F(a));
                writes(F(to));
            }
            Self::F2 { to, a, b, .. } => {
                reads(F(a));
                reads(F(b));
                writes(F(to));
            }
            Self::Fma { to, a, b, c } => {
                reads(F(a));
                reads(F(b));
                reads(F(c));
                writes(F(to));
            }
            Self::Ldexp { to, a, exponent } => {
                reads(F(a));
                reads(I(exponent));
                writes(F(to));
            }
            Self::FToI { to, a, .. } => {
                reads(F(a));
                writes(I(to));
            }
            Self::IToF { to, a, .. } => {
                reads(I(a));
                writes(F(to));
            }
            Self::CompareF { to, a, b, .. } => {
                reads(F(a));
                reads(F(b));
                writes(B(to));
            }
            Self::IsNan { to, a } | Self::IsInf { to, a } => {
                reads(F(a));
                writes(B(to));
            }
            Self::I1 { to, a, .. } => {
                reads(I(a));
                writes(I(to));
            }
            Self::I2 { to, a, b, .. } => {
                reads(I(a));
                reads(I(b));
                writes(I(to));
            }
            Self::ExtractBits { to, a, offset, count, .. } => {
                reads(I(a));
                reads(I(offset));
                reads(I(count));
                writes(I(to));
            }
            Self::InsertBits { to, a, bits, offset, count } => {
                reads(I(a));
                reads(I(bits));
                reads(I(offset));
                reads(I(count));
                writes(I(to));
            }
            Self::CompareI { to, a, b, .. } => {
                reads(I(a));
                reads(I(b));
                writes(B(to));
            }
            Self::Not { to, a } => {
                reads(B(a));
                writes(B(to));
            }
            Self::B2 { to, a, b, .. } => {
                reads(B(a));
                reads(B(b));
                writes(B(to));
            }
            Self::Select { to, when, yes, no } => {
                reads(B(when));
                reads(yes);
                reads(no);
                writes(to);
            }
            Self::Table { to, index, .. } => {
                reads(I(index));
                writes(to);
            }
            Self::Gather { to, ref from, index } => {
                from.iter().for_each(|&reg| reads(reg));
                reads(I(index));
                writes(to);
            }
            Self::Move { to, from } | Self::Store { to, from } => {
                reads(from);
                writes(to);
            }
            Self::Scatter { ref to, index, from } => {
                reads(I(index));
                reads(from);
                to.iter().for_each(|&reg| writes(reg));
            }
        }
    }
}

/// Calls `visit` with every instruction of a block, those of inner blocks included.
pub(crate) fn each_instr<'b>(block: &'b [Node], visit: &mut impl FnMut(&'b Instr)) {
    for node in block {
        match node {
            Node::Run { instrs, .. } => instrs.iter().for_each(&mut *visit),
            Node::If { accept, reject, .. } => {
                each_instr(accept, visit);
                each_instr(reject, visit);
            }
            Node::Switch { cases, .. } => {
                cases.iter().for_each(|case| each_instr(&case.body, visit));
            }
            Node::Loop { body, continuing, .. } => {
                each_instr(body, visit);
                each_instr(continuing, visit);
            }
            Node::Call(body) => each_instr(body, visit),
            Node::Break(_) | Node::Continue(_) | Node::Return => {}
        }
    }
}
