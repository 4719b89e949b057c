//! The interpreter's registers, and what each instruction does to them.

use naga::{MathFunction as Math, RelationalFunction, ScalarKind, UnaryOperator};
use pulp::Arch;

use super::LANES;
use super::integer::{self, compare_integers, extract_bits, insert_bits, logic};
use super::mask::Mask;
use super::real::{self, Real, compare, each1, each2, from_f32, to_f32};
use crate::form::half;
use crate::form::operation::{Op, is_comparison};
use crate::form::program::{Instr, Kind, Program, Reg, Slot};

/// The register files: the lanes of every register.
#[derive(Debug, Clone)]
pub(crate) struct Files<R> {
    pub(crate) floats: Vec<Box<[R]>>,
    pub(crate) integers: Vec<Box<[u32]>>,
    pub(crate) booleans: Vec<Box<[bool]>>,
}

impl<R: Copy> Files<R> {
    /// Copies one lane between registers of one kind.
    fn copy_lane(&mut self, kind: Kind, lane: usize, to: Slot, from: Slot) {
        let (to, from) = (to as usize, from as usize);
        match kind {
            Kind::F => self.floats[to][lane] = self.floats[from][lane],
            Kind::I => self.integers[to][lane] = self.integers[from][lane],
            Kind::B => self.booleans[to][lane] = self.booleans[from][lane],
        }
    }
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
        let [floats, integers, booleans] = program.registers.map(|count| count as usize);
        let mut files = Files {
            floats: vec![[R::zero(); LANES].into(); floats],
            integers: vec![[0; LANES].into(); integers],
            booleans: vec![[false; LANES].into(); booleans],
        };
        for &(reg, bits) in &program.constants {
            let slot = reg.slot as usize;
            match reg.kind {
                Kind::F => files.floats[slot].fill(from_f32(f32::from_bits(bits))),
                Kind::I => files.integers[slot].fill(bits),
                Kind::B => files.booleans[slot].fill(bits != 0),
            }
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
            Instr::Compute { op, to: Reg { slot: to, .. }, from: [a, b, c, d] } => {
                use ScalarKind::{Bool, Float, Sint};
                // `map!(to <- from, f)`: lane by lane. `zip!(to <- from, f, op)`: of two arguments.
                macro_rules! map {
                    ($to:ident <- $from:ident, $f:expr) => {
                        write!($to[to], |out| each1(arch, out, read!($from[a.slot]), $f))
                    };
                }
                macro_rules! zip {
                    ($to:ident <- $from:ident, $f:path, $op:expr) => {
                        write!($to[to], |out| $f(
                            arch,
                            $op,
                            out,
                            read!($from[a.slot]),
                            read!($from[b.slot])
                        ))
                    };
                }
                match op {
                    Op::Math(Math::Fma, _) => write!(floats[to], |out| {
                        let (a, b, c) =
                            (read!(floats[a.slot]), read!(floats[b.slot]), read!(floats[c.slot]));
                        fma(arch, out, a, b, c)
                    }),
                    Op::Math(Math::Ldexp, _) => write!(floats[to], |out| {
                        let scale = |a: R, exponent| a.scale(exponent as i32);
                        each2(arch, out, read!(floats[a.slot]), read!(integers[b.slot]), scale)
                    }),
                    Op::Math(function, Float) => zip!(floats <- floats, real::math, function),
                    Op::Math(Math::ExtractBits, kind) => write!(integers[to], |out| {
                        for (lane, out) in out.iter_mut().enumerate() {
                            let [bits, at, count] =
                                [a, b, c].map(|r| integers[r.slot as usize][lane]);
                            *out = extract_bits(kind == Sint, bits, at, count);
                        }
                    }),
                    Op::Math(Math::InsertBits, _) => write!(integers[to], |out| {
                        for (lane, out) in out.iter_mut().enumerate() {
                            let [a, bits, at, count] =
                                [a, b, c, d].map(|r| integers[r.slot as usize][lane]);
                            *out = insert_bits(a, bits, at, count);
                        }
                    }),
                    Op::Math(function, kind) => {
                        zip!(integers <- integers, integer::math, (function, kind == Sint));
                    }
                    Op::Unary(_, Float) => map!(floats <- floats, |x: R| -x),
                    Op::Unary(_, Bool) => map!(booleans <- booleans, |x| !x),
                    Op::Unary(UnaryOperator::Negate, _) => {
                        map!(integers <- integers, u32::wrapping_neg);
                    }
                    Op::Unary(..) => map!(integers <- integers, |x| !x),
                    Op::Binary(op, Bool) => zip!(booleans <- booleans, logic, op),
                    Op::Binary(op, Float) if is_comparison(op) => {
                        zip!(booleans <- floats, compare, op);
                    }
                    Op::Binary(op, Float) => zip!(floats <- floats, real::arithmetic, op),
                    Op::Binary(op, kind) if is_comparison(op) => {
                        zip!(booleans <- integers, compare_integers, (op, kind == Sint));
                    }
                    Op::Binary(op, kind) => {
                        zip!(integers <- integers, integer::arithmetic, (op, kind == Sint));
                    }
                    Op::FrexpExponent => map!(integers <- floats, |x: R| x.split().1 as u32),
                    Op::Half => map!(floats <- integers, |bits| from_f32(half::value(bits))),
                    Op::Relational(RelationalFunction::IsNan) => {
                        map!(booleans <- floats, R::is_nan);
                    }
                    Op::Relational(_) => map!(booleans <- floats, R::is_infinite),
                    Op::Convert(Float, Sint) => {
                        map!(integers <- floats, |x: R| x.signed() as u32);
                    }
                    Op::Convert(Float, _) => map!(integers <- floats, R::unsigned),
                    Op::Convert(Sint, _) => {
                        map!(floats <- integers, |bits| R::from_f64((bits as i32).into()));
                    }
                    Op::Convert(..) => map!(floats <- integers, |bits| R::from_f64(bits.into())),
                    Op::Bitcast(Float) => {
                        map!(floats <- integers, |bits| from_f32(f32::from_bits(bits)));
                    }
                    Op::Bitcast(_) => map!(integers <- floats, |x: R| to_f32(x).to_bits()),
                }
            }
            Instr::Select { to, when, yes, no } => match to.kind {
                Kind::F => write!(floats[to.slot], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(floats[yes]), read!(floats[no]))
                }),
                Kind::I => write!(integers[to.slot], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(integers[yes]), read!(integers[no]))
                }),
                Kind::B => write!(booleans[to.slot], |out| {
                    let when = read!(booleans[when]);
                    select(arch, out, when, read!(booleans[yes]), read!(booleans[no]))
                }),
            },
            Instr::Table { to, table, index, offset } => {
                let words = &program.tables[table as usize][offset as usize..];
                let word = |i: u32| words[i as usize];
                match to.kind {
                    Kind::F => write!(floats[to.slot], |out| {
                        let number = |i| from_f32(f32::from_bits(word(i)));
                        each1(arch, out, read!(integers[index]), number)
                    }),
                    Kind::I => write!(integers[to.slot], |out| {
                        each1(arch, out, read!(integers[index]), word)
                    }),
                    Kind::B => write!(booleans[to.slot], |out| {
                        each1(arch, out, read!(integers[index]), |i| word(i) != 0)
                    }),
                }
            }
            Instr::Move { to, from } | Instr::Store { to, from } => {
                let all = all || matches!(instr, Instr::Move { .. });
                let when = mask.lanes(count);
                match to.kind {
                    Kind::F => write!(floats[to.slot], |out| {
                        copy(arch, out, read!(floats[from]), when, all)
                    }),
                    Kind::I => write!(integers[to.slot], |out| {
                        copy(arch, out, read!(integers[from]), when, all)
                    }),
                    Kind::B => write!(booleans[to.slot], |out| {
                        copy(arch, out, read!(booleans[from]), when, all)
                    }),
                }
            }
            Instr::Gather { to, ref from, index } => {
                for lane in 0..count {
                    let at = self.files.integers[index as usize][lane] as usize;
                    if let Some(&from) = from.get(at) {
                        self.files.copy_lane(to.kind, lane, to.slot, from);
                    }
                }
            }
            Instr::Scatter { ref to, index, from } => {
                for (lane, _) in mask.lanes(count).iter().enumerate().filter(|lane| *lane.1) {
                    let at = self.files.integers[index as usize][lane] as usize;
                    if let Some(&to) = to.get(at) {
                        self.files.copy_lane(from.kind, lane, to, from.slot);
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
