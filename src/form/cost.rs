//! What a form costs, counted in its compiled program.

use serde::{Deserialize, Serialize};

use super::operation::Class;
use super::program::{Instr, Node, Program, each_instr};

/// Operations of one evaluation, by class: each instruction of the compiled program counted once,
/// both sides of branches and loop bodies too, calls inlined. What depends on parameters and
/// constants only is not counted: a compiler folds it once the constants are baked in.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct OpCount {
    /// Additions, multiplications, fused ones, comparisons, selections, minima, roundings and
    /// integer operations.
    pub arithmetic: u32,
    /// Divisions, remainders, square roots and inverse square roots.
    pub divide_sqrt: u32,
    /// Exponentials, logarithms, powers, trigonometric and hyperbolic functions.
    pub elementary: u32,
    /// Branches: `if`, `switch` and loops.
    pub branches: u32,
    /// Reads of constant arrays and of variables by a run-time index.
    pub table_reads: u32,
}

impl OpCount {
    /// All of them.
    pub fn total(&self) -> u32 {
        let Self { arithmetic, divide_sqrt, elementary, branches, table_reads } = self;
        arithmetic + divide_sqrt + elementary + branches + table_reads
    }

    /// Counts a program.
    pub(crate) fn of(program: &Program) -> Self {
        let mut count = Self { branches: branches(&program.body), ..Self::default() };
        each_instr(&program.body, &mut |instr| match *instr {
            Instr::Compute { op, .. } => match op.class() {
                Class::Arithmetic => count.arithmetic += 1,
                Class::DivideSqrt => count.divide_sqrt += 1,
                Class::Elementary => count.elementary += 1,
            },
            Instr::Select { .. } => count.arithmetic += 1,
            Instr::Table { .. } | Instr::Gather { .. } | Instr::Scatter { .. } => {
                count.table_reads += 1;
            }
            Instr::Move { .. } | Instr::Store { .. } => {}
        });
        count
    }
}

fn branches(block: &[Node]) -> u32 {
    let of = |node: &Node| {
        let own = matches!(node, Node::If { .. } | Node::Switch { .. } | Node::Loop { .. });
        u32::from(own) + node.blocks().into_iter().map(|block| branches(block)).sum::<u32>()
    };
    block.iter().map(of).sum()
}
