//! Structured control flow under execution masks.

use super::machine::{Machine, Tangents, Unbounded};
use super::mask::Mask;
use super::real::Real;
use super::{LANES, MAX_CHUNK_COST, MAX_LOOP_ITERATIONS};
use crate::form::program::{Case, Node, Program, Slot};

impl<R: Real, T: Tangents<R>> Machine<R, T> {
    /// Runs `block` for the lanes in `mask`, which comes back without those that left it early.
    pub(super) fn block(
        &mut self,
        program: &Program,
        block: &[Node],
        mask: &mut Mask,
        line: usize,
    ) -> Result<(), Unbounded> {
        for node in block {
            match node {
                Node::Run { instrs, cost } => {
                    self.spent += cost;
                    if self.spent > MAX_CHUNK_COST {
                        return Err(Unbounded { line, by_cost: true });
                    }
                    let all = mask.all(self.active_lanes);
                    for instr in instrs {
                        self.step(program, instr, mask, all);
                    }
                    continue;
                }
                Node::If { when, accept, reject } => {
                    let (mut yes, mut no) = mask.split(&self.files.booleans[*when as usize]);
                    if yes.any() {
                        self.block(program, accept, &mut yes, line)?;
                    }
                    if no.any() {
                        self.block(program, reject, &mut no, line)?;
                    }
                    yes.join(&no);
                    *mask = yes;
                }
                Node::Switch { selector, cases, exits } => {
                    self.switch(program, (*selector, cases, *exits), mask, line)?;
                }
                Node::Loop { body, continuing, break_if, exits, continues, line } => {
                    let (exits, continues) = (*exits as usize, *continues as usize);
                    self.masks[exits] = Mask::NONE;
                    let mut iterations = 0;
                    while mask.any() {
                        iterations += 1;
                        if iterations > MAX_LOOP_ITERATIONS {
                            return Err(Unbounded { line: *line, by_cost: false });
                        }
                        self.spent += 1;
                        self.masks[continues] = Mask::NONE;
                        self.block(program, body, mask, *line)?;
                        mask.join(&self.masks[continues]);
                        if mask.any() {
                            self.block(program, continuing, mask, *line)?;
                        }
                        if let Some(when) = break_if {
                            let (done, again) = mask.split(&self.files.booleans[*when as usize]);
                            self.masks[exits].join(&done);
                            *mask = again;
                        }
                    }
                    *mask = self.masks[exits];
                }
                Node::Call(body) => {
                    let entered = *mask;
                    self.block(program, body, mask, line)?;
                    *mask = entered;
                }
                Node::Break(target) | Node::Continue(target) => {
                    self.masks[*target as usize].join(mask);
                    *mask = Mask::NONE;
                }
                Node::Return => *mask = Mask::NONE,
            }
            if !mask.any() {
                break;
            }
        }
        Ok(())
    }

    fn switch(
        &mut self,
        program: &Program,
        (selector, cases, exits): (Slot, &[Case], u32),
        mask: &mut Mask,
        line: usize,
    ) -> Result<(), Unbounded> {
        self.masks[exits as usize] = Mask::NONE;
        // Which lanes match: computed before any case runs, as the cases may reuse registers.
        let selector = self.files.integers[selector as usize].clone();
        let mut otherwise = *mask;
        let mut matching = Vec::with_capacity(cases.len());
        for case in cases {
            let chosen = case.value.map_or(Mask::NONE, |value| {
                let mut equal = [false; LANES];
                equal.iter_mut().zip(&selector).for_each(|(equal, &s)| *equal = s == value);
                mask.split(&equal).0
            });
            otherwise = otherwise.split(chosen.lanes(LANES)).1;
            matching.push(chosen);
        }
        let mut falling = Mask::NONE;
        let mut ended = Mask::NONE;
        for (case, chosen) in cases.iter().zip(&matching) {
            let mut lanes = if case.value.is_some() { *chosen } else { otherwise };
            lanes.join(&falling);
            falling = Mask::NONE;
            if lanes.any() {
                self.block(program, &case.body, &mut lanes, line)?;
            }
            if case.falls_through {
                falling = lanes;
            } else {
                ended.join(&lanes);
            }
        }
        ended.join(&falling);
        ended.join(&self.masks[exits as usize]);
        *mask = ended;
        Ok(())
    }
}
