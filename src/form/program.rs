//! The linear program over registers that the lanes run.
//!
//! A register holds one scalar per lane; vectors, structs and small arrays are several registers.
//! Registers written by pure instructions are written in one place only, so they may be computed
//! for every lane, also for those that the control flow has left. Variables are registers that
//! [`Instr::Store`] and [`Instr::Scatter`] write, and only those two obey the execution mask.

use std::sync::Arc;

use naga::ScalarKind;

use super::ScalarType;
use super::operation::Op;

/// Index into the register file of one kind.
pub(crate) type Slot = u32;

/// Kind of a scalar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    /// A floating-point number of the lanes' type.
    F,
    /// 32 bits of an `i32` or `u32`.
    I,
    /// A truth value.
    B,
}

impl Kind {
    /// Register `slot` of this kind.
    pub(crate) fn reg(self, slot: Slot) -> Reg {
        Reg { kind: self, slot }
    }
}

impl From<ScalarKind> for Kind {
    fn from(kind: ScalarKind) -> Self {
        match kind {
            ScalarKind::Float | ScalarKind::AbstractFloat => Self::F,
            ScalarKind::Sint | ScalarKind::Uint | ScalarKind::AbstractInt => Self::I,
            ScalarKind::Bool => Self::B,
        }
    }
}

impl From<ScalarType> for Kind {
    fn from(scalar: ScalarType) -> Self {
        if scalar == ScalarType::F32 { Self::F } else { Self::I }
    }
}

/// A register: its kind and its index among the registers of that kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Reg {
    pub(crate) kind: Kind,
    pub(crate) slot: Slot,
}

/// One instruction over all lanes. Registers without a kind of their own are of the kind of the
/// one register that has one; conditions are truth values, and indices integers.
#[derive(Debug, Clone)]
pub(crate) enum Instr {
    /// `to = op(from …)`; the places beyond its arguments repeat the first.
    Compute { op: Op, to: Reg, from: [Reg; 4] },
    /// `to = when ? yes : no`.
    Select { to: Reg, when: Slot, yes: Slot, no: Slot },
    /// `to = table[index + offset]`.
    Table { to: Reg, table: u32, index: Slot, offset: u32 },
    /// `to = from[index]`.
    Gather { to: Reg, from: Box<[Slot]>, index: Slot },
    /// Copies for every lane.
    Move { to: Reg, from: Slot },
    /// Copies for the active lanes.
    Store { to: Reg, from: Slot },
    /// `to[index] = from` for the active lanes.
    Scatter { to: Box<[Slot]>, index: Slot, from: Reg },
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
    /// Number of registers, by [`Kind`].
    pub(crate) registers: [u32; 3],
    pub(crate) masks: u32,
    /// Registers that never change, and the bits of an f32, an integer or a truth value.
    pub(crate) constants: Vec<(Reg, u32)>,
    /// The scalars of tables and constant arrays, by their bits; a truth value is 0 or 1.
    pub(crate) tables: Vec<Arc<[u32]>>,
    /// Registers of the parameters, in their order; floats.
    pub(crate) parameters: Vec<Slot>,
    /// Registers of the scalar inputs, in their order.
    pub(crate) inputs: Vec<Reg>,
    /// Registers of the scalar outputs, in their order; floats.
    pub(crate) outputs: Vec<Slot>,
}

impl Instr {
    /// The registers that the instruction reads and those it writes.
    pub(crate) fn visit(&self, mut reads: impl FnMut(Reg), mut writes: impl FnMut(Reg)) {
        use Kind::{B, I};
        match *self {
            Self::Compute { to, from, .. } => {
                from.into_iter().for_each(&mut reads);
                writes(to);
            }
            Self::Select { to, when, yes, no } => {
                reads(B.reg(when));
                reads(to.kind.reg(yes));
                reads(to.kind.reg(no));
                writes(to);
            }
            Self::Table { to, index, .. } => {
                reads(I.reg(index));
                writes(to);
            }
            Self::Gather { to, ref from, index } => {
                from.iter().for_each(|&slot| reads(to.kind.reg(slot)));
                reads(I.reg(index));
                writes(to);
            }
            Self::Move { to, from } | Self::Store { to, from } => {
                reads(to.kind.reg(from));
                writes(to);
            }
            Self::Scatter { ref to, index, from } => {
                reads(I.reg(index));
                reads(from);
                to.iter().for_each(|&slot| writes(from.kind.reg(slot)));
            }
        }
    }
}

impl Node {
    /// The blocks inside.
    pub(crate) fn blocks(&self) -> Vec<&Block> {
        match self {
            Self::If { accept, reject, .. } => vec![accept, reject],
            Self::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
            Self::Loop { body, continuing, .. } => vec![body, continuing],
            Self::Call(body) => vec![body],
            Self::Run { .. } | Self::Break(_) | Self::Continue(_) | Self::Return => Vec::new(),
        }
    }
}

/// Calls `visit` with every instruction of a block, those of inner blocks included.
pub(crate) fn each_instr<'b>(block: &'b [Node], visit: &mut impl FnMut(&'b Instr)) {
    for node in block {
        if let Node::Run { instrs, .. } = node {
            instrs.iter().for_each(&mut *visit);
        }
        node.blocks().into_iter().for_each(|block| each_instr(block, visit));
    }
}
