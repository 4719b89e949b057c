//! Derivatives by the free parameters, carried beside the values of f64 lanes.
//!
//! Inputs have no derivative, so most registers have none either. Which registers can depend on
//! which free parameter is worked out once per evaluator ([`Planes::new`]); only those carry a
//! plane of derivatives, one f64 per lane and parameter.
//!
//! A tangent that is exactly zero contributes zero even where the partial derivative is infinite
//! (√ at 0, a power at 0). Where a function jumps or bends (`floor`, `step`, `min`, a branch) the
//! derivative is that of the side that the value is on. A bitcast has derivative zero.

use std::collections::BTreeSet;

use naga::{BinaryOperator as Operator, MathFunction as Math};
use pulp::Arch;

use super::LANES;
use super::machine::{Files, Tangents};
use super::real::{DEGREES_PER_RADIAN, RADIANS_PER_DEGREE, Real, each1, each2, sign};
use crate::form::operation::Op;
use crate::form::program::{Instr, Kind, Program, Reg, Slot, each_instr};

/// Derivative planes of every float register.
#[derive(Debug, Clone)]
pub(crate) struct Planes {
    arch: Arch,
    /// Per float register, the free parameters it may depend on, ascending.
    depends: Vec<Vec<u32>>,
    /// Per float register, one run of [`LANES`] derivatives per entry of `depends`.
    planes: Vec<Vec<f64>>,
    scratch: [Vec<f64>; 2],
}

/// Partial derivative of an instruction by one of its arguments.
#[derive(Clone, Copy)]
enum Partial<'p> {
    Constant(f64),
    Lanes(&'p [f64]),
}

impl Planes {
    /// Planes for `program`, whose parameters `free` (indices) are the ones to derive by.
    pub(crate) fn new(program: &Program, free: &[usize]) -> Self {
        let mut depends = vec![BTreeSet::new(); program.registers[Kind::F as usize] as usize];
        for (k, &parameter) in (0..).zip(free) {
            depends[program.parameters[parameter] as usize].insert(k);
        }
        let mut instrs: Vec<&Instr> = program.prologue.iter().collect();
        each_instr(&program.body, &mut |instr| instrs.push(instr));
        instrs.retain(|instr| carries(instr));
        // Variables feed back through loops: repeat until nothing changes.
        let mut changed = true;
        while changed {
            changed = false;
            for instr in &instrs {
                let (mut union, mut written) = (BTreeSet::new(), Vec::new());
                let reads = |reg: Reg| {
                    if reg.kind == Kind::F {
                        union.extend(&depends[reg.slot as usize]);
                    }
                };
                instr.visit(reads, |reg| written.push(reg));
                for reg in written.iter().filter(|reg| reg.kind == Kind::F) {
                    let set: &mut BTreeSet<u32> = &mut depends[reg.slot as usize];
                    let before = set.len();
                    set.extend(&union);
                    changed |= set.len() > before;
                }
            }
        }
        let depends: Vec<Vec<u32>> =
            depends.into_iter().map(|set| set.into_iter().collect()).collect();
        let mut planes: Vec<Vec<f64>> =
            depends.iter().map(|depends| vec![0.0; depends.len() * LANES]).collect();
        for &parameter in free {
            planes[program.parameters[parameter] as usize].fill(1.0);
        }
        let scratch = [vec![0.0; LANES], vec![0.0; LANES]];
        Self { arch: Arch::new(), depends, planes, scratch }
    }

    /// Derivatives of register `slot` by free parameter `k`; none if it cannot depend on it.
    pub(crate) fn plane(&self, slot: Slot, k: usize) -> Option<&[f64]> {
        let at = self.depends[slot as usize].iter().position(|&d| d as usize == k)?;
        self.planes[slot as usize].get(at * LANES..(at + 1) * LANES)
    }

    /// Chain rule: the planes of `to` are the sums of the arguments' planes times `Partial`s.
    fn combine(&mut self, to: Slot, count: usize, arguments: &[(Slot, Partial)]) {
        let arch = self.arch;
        let mut planes = std::mem::take(&mut self.planes[to as usize]);
        for (out, &k) in planes.chunks_exact_mut(LANES).zip(&self.depends[to as usize]) {
            let out = &mut out[..count];
            let mut first = true;
            for &(slot, partial) in arguments {
                let Some(tangent) = self.plane(slot, k as usize) else { continue };
                accumulate(arch, out, &tangent[..count], partial, first);
                first = false;
            }
            if first {
                out.fill(0.0);
            }
        }
        self.planes[to as usize] = planes;
    }

    /// Copies, lane by lane, the planes of the register that `from(lane)` names.
    fn pick(&mut self, to: Slot, count: usize, from: impl Fn(usize) -> Option<Slot>) {
        let mut planes = std::mem::take(&mut self.planes[to as usize]);
        for (out, &k) in planes.chunks_exact_mut(LANES).zip(&self.depends[to as usize]) {
            for (lane, out) in out.iter_mut().enumerate().take(count) {
                if let Some(slot) = from(lane) {
                    *out = self.plane(slot, k as usize).map_or(0.0, |tangent| tangent[lane]);
                }
            }
        }
        self.planes[to as usize] = planes;
    }

    fn carried(&self, to: Slot) -> bool {
        !self.depends[to as usize].is_empty()
    }

    /// Chain rule for one argument, by whose lanes `write` gives the partial derivative.
    fn by_lanes(&mut self, (to, a): (Slot, Slot), n: usize, write: impl FnOnce(Arch, &mut [f64])) {
        let mut scratch = std::mem::take(&mut self.scratch);
        let partial = &mut scratch[0][..n];
        write(self.arch, partial);
        self.combine(to, n, &[(a, Partial::Lanes(partial))]);
        self.scratch = scratch;
    }

    /// A function of one argument: `r = function(x)`.
    fn follow_function(&mut self, function: Math, registers: (Slot, Slot), x: &[f64], r: &[f64]) {
        self.by_lanes(registers, x.len(), |arch, p| match function {
            Math::Abs => each1(arch, p, x, sign),
            Math::Frexp => each2(arch, p, x, r, |x, r| if x == 0.0 { 0.5 } else { r / x }),
            Math::Sqrt => each1(arch, p, r, |r| 0.5 / r),
            Math::InverseSqrt => each1(arch, p, r, |r| -0.5 * r * r * r),
            Math::Sin => f64::elementary(arch, Math::Cos, p, x),
            Math::Cos => {
                f64::elementary(arch, Math::Sin, p, x);
                p.iter_mut().for_each(|p| *p = -*p);
            }
            Math::Tan => each1(arch, p, r, |r| 1.0 + r * r),
            Math::Asin => each1(arch, p, x, |x| 1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
            Math::Acos => each1(arch, p, x, |x| -1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
            Math::Atan => each1(arch, p, x, |x| 1.0 / (1.0 + x * x)),
            Math::Sinh => f64::elementary(arch, Math::Cosh, p, x),
            Math::Cosh => f64::elementary(arch, Math::Sinh, p, x),
            Math::Tanh => each1(arch, p, r, |r| (1.0 - r) * (1.0 + r)),
            Math::Asinh => each1(arch, p, x, |x| 1.0 / (x * x + 1.0).sqrt()),
            Math::Acosh => each1(arch, p, x, |x| 1.0 / ((x - 1.0) * (x + 1.0)).sqrt()),
            Math::Atanh => each1(arch, p, x, |x| 1.0 / ((1.0 - x) * (1.0 + x))),
            Math::Exp => p.copy_from_slice(r),
            Math::Exp2 => each1(arch, p, r, |r| r * std::f64::consts::LN_2),
            Math::Log => each1(arch, p, x, |x| 1.0 / x),
            Math::Log2 => each1(arch, p, x, |x| std::f64::consts::LOG2_E / x),
            // `carries` keeps the others from having planes.
            _ => p.fill(0.0),
        });
    }

    /// An operation on floats.
    fn follow_op(
        &mut self,
        op: Op,
        to: Slot,
        [a, b, c, _]: [Slot; 4],
        files: &Files<f64>,
        n: usize,
    ) {
        let lanes = |slot: Slot| &files.floats[slot as usize][..n];
        let (x, r) = (lanes(a), lanes(to));
        let one = Partial::Constant(1.0);
        match op {
            Op::Unary(..) => self.combine(to, n, &[(a, Partial::Constant(-1.0))]),
            Op::Math(Math::Degrees, _) => {
                self.combine(to, n, &[(a, Partial::Constant(DEGREES_PER_RADIAN))]);
            }
            Op::Math(Math::Radians, _) => {
                self.combine(to, n, &[(a, Partial::Constant(RADIANS_PER_DEGREE))]);
            }
            Op::Math(Math::Ldexp, _) => self.by_lanes((to, a), n, |arch, p| {
                let exponents = &files.integers[b as usize][..n];
                each1(arch, p, exponents, |e| 1.0.scale(e as i32));
            }),
            Op::Math(Math::Fma, _) => {
                let [by_a, by_b] = [b, a].map(|slot| Partial::Lanes(lanes(slot)));
                self.combine(to, n, &[(a, by_a), (b, by_b), (c, one)]);
            }
            Op::Binary(Operator::Add, _) => self.combine(to, n, &[(a, one), (b, one)]),
            Op::Binary(Operator::Subtract, _) => {
                self.combine(to, n, &[(a, one), (b, Partial::Constant(-1.0))]);
            }
            Op::Binary(Operator::Multiply, _) => {
                let [by_a, by_b] = [b, a].map(|slot| Partial::Lanes(lanes(slot)));
                self.combine(to, n, &[(a, by_a), (b, by_b)]);
            }
            Op::Binary(..) | Op::Math(Math::Min | Math::Max | Math::Pow | Math::Atan2, _) => {
                self.follow_pair(op, (to, a, b), [x, lanes(b), r]);
            }
            Op::Math(function, _) => self.follow_function(function, (to, a), x, r),
            // What reads no float has no tangent.
            _ => {}
        }
    }

    /// A quotient, a remainder or a function of two arguments: `r = op(x, y)`.
    fn follow_pair(&mut self, op: Op, (to, a, b): (Slot, Slot, Slot), [x, y, r]: [&[f64]; 3]) {
        let (arch, n) = (self.arch, x.len());
        let (first, second) = (self.carried(a), self.carried(b));
        let mut scratch = std::mem::take(&mut self.scratch);
        let [p, q] = &mut scratch;
        let (p, q) = (&mut p[..n], &mut q[..n]);
        match op {
            Op::Binary(Operator::Divide, _) => {
                each1(arch, p, y, |y| 1.0 / y);
                if second {
                    each2(arch, q, r, y, |r, y| -r / y);
                }
            }
            Op::Binary(..) => {
                p.fill(1.0);
                each2(arch, q, x, y, |x, y| -(x / y).trunc());
            }
            Op::Math(function @ (Math::Min | Math::Max), _) => {
                let (low, high) = if function == Math::Min { (x, y) } else { (y, x) };
                each2(arch, p, low, high, |low, high| if low < high { 1.0 } else { 0.0 });
                each1(arch, q, p, |p| 1.0 - p);
            }
            Op::Math(Math::Pow, _) => {
                if first {
                    each2(arch, p, r, x, |r, x| r / x);
                    for ((p, &x), &y) in p.iter_mut().zip(x).zip(y) {
                        *p = y * if x == 0.0 { x.power(y - 1.0) } else { *p };
                    }
                }
                if second {
                    let by_exponent = |x: f64, r: f64| if r == 0.0 { 0.0 } else { r * x.ln() };
                    each2(arch, q, x, r, by_exponent);
                }
            }
            _ => {
                each2(arch, p, x, y, |y, x| x / (x * x + y * y));
                each2(arch, q, x, y, |y, x| -y / (x * x + y * y));
            }
        }
        self.combine(to, n, &[(a, Partial::Lanes(p)), (b, Partial::Lanes(q))]);
        self.scratch = scratch;
    }
}

impl Tangents<f64> for Planes {
    fn follow(&mut self, instr: &Instr, files: &Files<f64>, active: &[bool]) {
        let n = active.len();
        let indices = |slot: Slot| &files.integers[slot as usize][..n];
        let copied = |from: Slot| [(from, Partial::Constant(1.0))];
        match *instr {
            Instr::Scatter { ref to, index, from } if from.kind == Kind::F => {
                let index = indices(index);
                for (at, &to) in to.iter().enumerate() {
                    let written = |lane: usize| active[lane] && index[lane] as usize == at;
                    self.pick(to, n, |lane| written(lane).then_some(from.slot));
                }
            }
            Instr::Compute { op, to: Reg { kind: Kind::F, slot: to }, from }
                if self.carried(to) =>
            {
                self.follow_op(op, to, from.map(|reg| reg.slot), files, n);
            }
            Instr::Select { to: Reg { kind: Kind::F, slot: to }, when, yes, no }
                if self.carried(to) =>
            {
                let when = &files.booleans[when as usize];
                self.pick(to, n, |lane| Some(if when[lane] { yes } else { no }));
            }
            Instr::Gather { to: Reg { kind: Kind::F, slot: to }, ref from, index }
                if self.carried(to) =>
            {
                let index = indices(index);
                self.pick(to, n, |lane| from.get(index[lane] as usize).copied());
            }
            Instr::Move { to: Reg { kind: Kind::F, slot: to }, from } if self.carried(to) => {
                self.combine(to, n, &copied(from));
            }
            Instr::Store { to: Reg { kind: Kind::F, slot: to }, from } if self.carried(to) => {
                if active.iter().all(|active| *active) {
                    self.combine(to, n, &copied(from));
                } else {
                    self.pick(to, n, |lane| active[lane].then_some(from));
                }
            }
            _ => {}
        }
    }
}

/// False for instructions whose result has derivative zero whatever they read.
fn carries(instr: &Instr) -> bool {
    use Math::*;
    let Instr::Compute { op: Op::Math(function, _), .. } = instr else { return true };
    !matches!(function, Sign | Floor | Ceil | Round | Trunc | QuantizeToF16 | Step)
}

/// `out = partial · tangent`, or `out += partial · tangent` if not `first`.
fn accumulate(arch: Arch, out: &mut [f64], tangent: &[f64], partial: Partial, first: bool) {
    let product = |p: f64, t: f64| if t == 0.0 { 0.0 } else { p * t };
    match (partial, first) {
        (Partial::Constant(p), true) => each1(arch, out, tangent, |t| p * t),
        (Partial::Lanes(p), true) => each2(arch, out, p, tangent, product),
        (Partial::Constant(p), false) => {
            for (out, &t) in out.iter_mut().zip(tangent) {
                *out += p * t;
            }
        }
        (Partial::Lanes(p), false) => arch.dispatch(
            #[inline(always)]
            || {
                for ((out, &p), &t) in out.iter_mut().zip(p).zip(tangent) {
                    *out += product(p, t);
                }
            },
        ),
    }
}
