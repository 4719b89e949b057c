//! The interpreter's registers, and what each instruction does to them.

use pulp::Arch;

use super::LANES;
use super::integer::{boolean2, compare_integers, extract_bits, insert_bits, integer1, integer2};
use super::mask::Mask;
use super::real::{Real, compare, each1, each2, float1, float2, from_integer, to_integer};
use crate::form::program::{Instr, Program, Reg, Slot};

/// The register files: one vector of lanes per register.
#[derive(Debug, Clone)]
pub(crate) struct Files<R> {
    pub(crate) floats: Vec<Vec<R>>,
    pub(crate) integers: Vec<Vec<u32>>,
    pub(crate) booleans: Vec<Vec<bool>>,
}

/// Follows the derivatives while the machine computes the values.
pub(crate) trait Tangents<R> {
    /// Called after `instr` has written its result; `active` holds for stores.
    fn follow(&mut self, instr: &Instr, files: &Files<R>, active: &[bool]);
}

/// No derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ValuesOnly;

impl<R> Tangents<R> for ValuesOnly {
    #[inline(always)]
    fn follow(&mut self, _: &Instr, _: &Files<R>, _: &[bool]) {}
}

/// A loop that did not end: its line, and which bound it met.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unbounded {
    pub(crate) line: usize,
    pub(crate) by_cost: bool,
}

/// Runs programs over lanes of `R`.
#[derive(Debug, Clone)]
pub(crate) struct Machine<R, T> {
    arch: Arch,
    pub(crate) files: Files<R>,
    pub(crate) tangents: T,
    pub(super) masks: Vec<Mask>,
    pub(super) active_lanes: usize,
    pub(super) spent: u64,
}

impl<R: Real, T: Tangents<R>> Machine<R, T> {
    /// A machine with the program's registers, its constants in place.
    pub(crate) fn new(program: &Program, tangents: T) -> Self {
        let mut files = Files {
            floats: vec![vec![R::ZERO; LANES]; program.floats as usize],
            integers: vec![vec![0; LANES]; program.integers as usize],
            booleans: vec![vec![false; LANES]; program.booleans as usize],
        };
        for &(slot, value) in &program.float_constants {
            files.floats[slot as usize].fill(R::from_f32(value));
        }
        for &(slot, value) in &program.integer_constants {
            files.integers[slot as usize].fill(value);
        }
        for &(slot, value) in &program.boolean_constants {
            files.booleans[slot as usize].fill(value);
        }
        let masks = vec![Mask::NONE; program.masks as usize];
        Self { arch: Arch::new(), files, tangents, masks, active_lanes: 0, spent: 0 }
    }

    /// Sets the parameters and runs the prologue. Before the chunks of every evaluation.
    pub(crate) fn prepare(&mut self, program: &Program, parameters: &[R]) {
        for (&slot, &value) in program.parameters.iter().zip(parameters) {
            self.files.floats[slot as usize].fill(value);
        }
        self.active_lanes = LANES;
        let mask = Mask::first(LANES);
        for instr in &program.prologue {
            self.step(program, instr, &mask, true);
        }
    }

    /// Runs the body over a chunk of `count` ≤ [`LANES`] lanes, whose inputs are in the program's
    /// input registers. The results are in its output registers.
    pub(crate) fn run(&mut self, program: &Program, count: usize) -> Result<(), Unbounded> {
        self.active_lanes = count;
        self.spent = 0;
        let mut mask = Mask::first(count);
        self.block(program, &program.body, &mut mask, 0)
    }

    /// Runs one instruction; `all` says that every lane of the chunk is active.
    pub(super) fn step(&mut self, program: &Program, instr: &Instr, mask: &Mask, all: bool) {
        let count = self.active_lanes;
        let arch = self.arch;
        let Files { floats, integers, booleans } = &mut self.files;
        // The destination is taken out of its file while the sources are read from it; no
        // instruction reads the register that it writes.
        macro_rules! write {
            ($file:ident[$to:expr], |$out:ident| $body:expr) => {{
                let mut taken = std::mem::take(&mut $file[$to as usize]);
                {
                    let $out = &mut taken[..count];
                    $body;
                }
                $file[$to as usize] = taken;
            }};
        }
        macro_rules! read {
            ($file:ident[$from:expr]) => {
                &$file[$from as usize][..count]
            };
        }
        match *instr {
            Instr::F1 { op, to, a } => {
                write!(floats[to], |out| float1(arch, op, out, read!(floats[a])));
            }
            Instr::F2 { op, to, a, b } => {
                write!(floats[to], |out| float2(arch, op, out, read!(floats[a]), read!(floats[b])));
            }
            Instr::Fma { to, a, b, c } => write!(floats[to], |out| {
                let (a, b, c) = (read!(floats[a]), read!(floats[b]), read!(floats[c]));
                fma(arch, out, a, b, c)
            }),
            Instr::Ldexp { to, a, exponent } => write!(floats[to], |out| {
                let scale = |a: R, exponent| a.scale(exponent as i32);
                each2(arch, out, read!(floats[a]), read!(integers[exponent]), scale)
            }),
            Instr::FToI { op, to, a } => {
                write!(integers[to], |out| to_integer(arch, op, out, read!(floats[a])));
            }
            Instr::IToF { op, to, a } => {
                write!(floats[to], |out| from_integer(arch, op, out, read!(integers[a])));
            }
            Instr::CompareF { op, to, a, b } => write!(booleans[to], |out| {
                compare(arch, op, out, read!(floats[a]), read!(floats[b]))
            }),
            Instr::IsNan { to, a } => {
                write!(booleans[to], |out| each1(arch, out, read!(floats[a]), R::is_nan));
            }
            Instr::IsInf { to, a } => {
                write!(booleans[to], |out| each1(arch, out, read!(floats[a]), R::is_infinite));
            }
            Instr::I1 { op, to, a } => {
                write!(integers[to], |out| integer1(arch, op, out, read!(integers[a])));
            }
            Instr::I2 { op, to, a, b } => write!(integers[to], |out| {
                integer2(arch, op, out, read!(integers[a]), read!(integers[b]))
            }),
            Instr::ExtractBits { signed, to, a, offset, count: bits } => {
                write!(integers[to], |out| for (lane, out) in out.iter_mut().enumerate() {
                    let at = |slot: Slot| integers[slot as usize][lane];
                    *out = extract_bits(signed, at(a), at(offset), at(bits));
                });
            }
            Instr::InsertBits { to, a, bits, offset, count: width } => {
                write!(integers[to], |out| for (lane, out) in out.iter_mut().enumerate() {
                    let at = |slot: Slot| integers[slot as usize][lane];
                    *out = insert_bits(at(a), at(bits), at(offset), at(width));
                });
            }
            Instr::CompareI { op, signed, to, a, b } => write!(booleans[to], |out| {
                compare_integers(arch, op, signed, out, read!(integers[a]), read!(integers[b]))
            }),
            Instr::Not { to, a } => {
                write!(booleans[to], |out| each1(arch, out, read!(booleans[a]), |x| !x));
            }
            Instr::B2 { op, to, a, b } => write!(booleans[to], |out| {
                boolean2(arch, op, out, read!(booleans[a]), read!(booleans[b]))
            }),
            Instr::Select { to, when, yes, no } => match (to, yes, no) {
                (Reg::F(to), Reg::F(yes), Reg::F(no)) => write!(floats[to], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(floats[yes]), read!(floats[no]))
                }),
                (Reg::I(to), Reg::I(yes), Reg::I(no)) => write!(integers[to], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(integers[yes]), read!(integers[no]))
                }),
                (Reg::B(to), Reg::B(yes), Reg::B(no)) => write!(booleans[to], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(booleans[yes]), read!(booleans[no]))
                }),
                _ => unreachable!("the compiler selects between registers of one kind"),
            },
            Instr::Table { to, table, index, offset } => {
                let words = &program.tables[table as usize];
                let word = |i: u32| words[(i + offset) as usize];
                match to {
                    Reg::F(to) => write!(floats[to], |out| {
                        let number = |i| R::from_f32(f32::from_bits(word(i)));
                        each1(arch, out, read!(integers[index]), number)
                    }),
                    Reg::I(to) => write!(integers[to], |out| {
                        each1(arch, out, read!(integers[index]), word)
                    }),
                    Reg::B(to) => write!(booleans[to], |out| {
                        each1(arch, out, read!(integers[index]), |i| word(i) != 0)
                    }),
                }
            }
            Instr::Gather { to, ref from, index } => {
                for lane in 0..count {
                    let Some(&from) = from.get(integers[index as usize][lane] as usize) else {
                        continue;
                    };
                    match (to, from) {
                        (Reg::F(to), Reg::F(from)) => {
                            floats[to as usize][lane] = floats[from as usize][lane];
                        }
                        (Reg::I(to), Reg::I(from)) => {
                            integers[to as usize][lane] = integers[from as usize][lane];
                        }
                        (Reg::B(to), Reg::B(from)) => {
                            booleans[to as usize][lane] = booleans[from as usize][lane];
                        }
                        _ => unreachable!("the compiler gathers from registers of one kind"),
                    }
                }
            }
            Instr::Move { to, from } | Instr::Store { to, from } => {
                let all = all || matches!(instr, Instr::Move { .. });
                let when = mask.lanes(count);
                match (to, from) {
                    (Reg::F(to), Reg::F(from)) => {
                        write!(floats[to], |out| copy(arch, out, read!(floats[from]), when, all));
                    }
                    (Reg::I(to), Reg::I(from)) => write!(integers[to], |out| {
                        copy(arch, out, read!(integers[from]), when, all)
                    }),
                    (Reg::B(to), Reg::B(from)) => write!(booleans[to], |out| {
                        copy(arch, out, read!(booleans[from]), when, all)
                    }),
                    _ => unreachable!("the compiler copies between registers of one kind"),
                }
            }
            Instr::Scatter { ref to, index, from } => {
                for (lane, _) in mask.lanes(count).iter().enumerate().filter(|(_, active)| **active)
                {
                    let Some(&to) = to.get(integers[index as usize][lane] as usize) else {
                        continue;
                    };
                    match (to, from) {
                        (Reg::F(to), Reg::F(from)) => {
                            floats[to as usize][lane] = floats[from as usize][lane];
                        }
                        (Reg::I(to), Reg::I(from)) => {
                            integers[to as usize][lane] = integers[from as usize][lane];
                        }
                        (Reg::B(to), Reg::B(from)) => {
                            booleans[to as usize][lane] = booleans[from as usize][lane];
                        }
                        _ => unreachable!("the compiler scatters to registers of one kind"),
                    }
                }
            }
        }
        self.tangents.follow(instr, &self.files, mask.lanes(count));
    }
}

fn fma<R: Real>(arch: Arch, to: &mut [R], a: &[R], b: &[R], c: &[R]) {
    arch.dispatch(
        #[inline(always)]
        || {
            for (((to, &a), &b), &c) in to.iter_mut().zip(a).zip(b).zip(c) {
                *to = a.mul_add(b, c);
            }
        },
    );
}

fn select<V: Copy>(arch: Arch, to: &mut [V], when: &[bool], yes: &[V], no: &[V]) {
    arch.dispatch(
        #[inline(always)]
        || {
            for (((to, &when), &yes), &no) in to.iter_mut().zip(when).zip(yes).zip(no) {
                *to = if when { yes } else { no };
            }
        },
    );
}

fn copy<V: Copy>(arch: Arch, to: &mut [V], from: &[V], when: &[bool], all: bool) {
    if all {
        to.copy_from_slice(from);
    } else {
        arch.dispatch(
            #[inline(always)]
            || {
                for ((to, &from), &when) in to.iter_mut().zip(from).zip(when) {
                    *to = if when { from } else { *to };
                }
            },
        );
    }
}
