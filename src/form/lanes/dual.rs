//! Derivatives by the free parameters, carried beside the values of f64 lanes.
//!
//! Inputs have no derivative, so most registers have none either. Which registers can depend on
//! which free parameter is worked out once per evaluator ([`Planes::new`]); only those carry a
//! plane of derivatives, one f64 per lane and parameter.
//!
//! A tangent that is exactly zero contributes zero even where the partial derivative is infinite
//! (√ at 0, a power at 0). Where a function jumps or bends (`floor`, `step`, `min`, a branch) the
//! derivative is that of the side that the value is on. A bitcast has derivative zero.

use pulp::Arch;

use super::machine::{Files, Tangents};
use super::real::{Real, each1, each2};
use super::{LANES, real};
use crate::form::operation::{F1, F2};
use crate::form::program::{Instr, Program, Reg, Slot, each_instr};

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
        let words = free.len().div_ceil(64).max(1);
        let mut sets = vec![vec![0_u64; words]; program.floats as usize];
        for (k, &parameter) in free.iter().enumerate() {
            sets[program.parameters[parameter] as usize][k / 64] |= 1 << (k % 64);
        }
        let mut instrs: Vec<&Instr> = program.prologue.iter().collect();
        each_instr(&program.body, &mut |instr| instrs.push(instr));
        // Variables feed back through loops: repeat until nothing changes.
        let mut union = vec![0_u64; words];
        let mut changed = true;
        while changed {
            changed = false;
            for instr in instrs.iter().filter(|instr| carries(instr)) {
                union.fill(0);
                let reads = |reg| {
                    if let Reg::F(slot) = reg {
                        union.iter_mut().zip(&sets[slot as usize]).for_each(|(u, s)| *u |= s);
                    }
                };
                let mut written = Vec::new();
                instr.visit(reads, |reg| written.push(reg));
                for reg in written {
                    if let Reg::F(slot) = reg {
                        for (set, &u) in sets[slot as usize].iter_mut().zip(&union) {
                            changed |= *set | u != *set;
                            *set |= u;
                        }
                    }
                }
            }
        }
        let members = |set: &Vec<u64>| -> Vec<u32> {
            (0..free.len() as u32).filter(|&k| set[k as usize / 64] >> (k % 64) & 1 == 1).collect()
        };
        let depends: Vec<Vec<u32>> = sets.iter().map(members).collect();
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

    fn follow1(&mut self, op: F1, (to, a): (Slot, Slot), x: &[f64], r: &[f64]) {
        let arch = self.arch;
        let constant = match op {
            F1::Neg => Some(-1.0),
            F1::Degrees => Some(f64::DEGREES_PER_RADIAN),
            F1::Radians => Some(f64::RADIANS_PER_DEGREE),
            _ => None,
        };
        if let Some(factor) = constant {
            return self.combine(to, x.len(), &[(a, Partial::Constant(factor))]);
        }
        let mut scratch = std::mem::take(&mut self.scratch);
        let p = &mut scratch[0][..x.len()];
        match op {
            F1::Abs => real::float1(arch, F1::Sign, p, x),
            F1::FrexpFract => each2(arch, p, x, r, |x, r| if x == 0.0 { 0.5 } else { r / x }),
            F1::Sqrt => each1(arch, p, r, |r| 0.5 / r),
            F1::InverseSqrt => each1(arch, p, r, |r| -0.5 * r * r * r),
            F1::Sin => real::float1(arch, F1::Cos, p, x),
            F1::Cos => {
                real::float1(arch, F1::Sin, p, x);
                p.iter_mut().for_each(|p| *p = -*p);
            }
            F1::Tan => each1(arch, p, r, |r| 1.0 + r * r),
            F1::Asin => each1(arch, p, x, |x| 1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
            F1::Acos => each1(arch, p, x, |x| -1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
            F1::Atan => each1(arch, p, x, |x| 1.0 / (1.0 + x * x)),
            F1::Sinh => real::float1(arch, F1::Cosh, p, x),
            F1::Cosh => real::float1(arch, F1::Sinh, p, x),
            F1::Tanh => each1(arch, p, r, |r| (1.0 - r) * (1.0 + r)),
            F1::Asinh => each1(arch, p, x, |x| 1.0 / (x * x + 1.0).sqrt()),
            F1::Acosh => each1(arch, p, x, |x| 1.0 / ((x - 1.0) * (x + 1.0)).sqrt()),
            F1::Atanh => each1(arch, p, x, |x| 1.0 / ((1.0 - x) * (1.0 + x))),
            F1::Exp => p.copy_from_slice(r),
            F1::Exp2 => each1(arch, p, r, |r| r * std::f64::consts::LN_2),
            F1::Log => each1(arch, p, x, |x| 1.0 / x),
            F1::Log2 => each1(arch, p, x, |x| std::f64::consts::LOG2_E / x),
            // `carries` keeps these from having planes.
            _ => p.fill(0.0),
        }
        self.combine(to, x.len(), &[(a, Partial::Lanes(p))]);
        self.scratch = scratch;
    }

    fn follow2(&mut self, op: F2, (to, a, b): (Slot, Slot, Slot), files: &Files<f64>, n: usize) {
        let arch = self.arch;
        let lanes = |slot: Slot| &files.floats[slot as usize][..n];
        let (x, y, r) = (lanes(a), lanes(b), lanes(to));
        match op {
            F2::Add | F2::Sub => {
                let second = if op == F2::Add { 1.0 } else { -1.0 };
                let arguments = [(a, Partial::Constant(1.0)), (b, Partial::Constant(second))];
                return self.combine(to, n, &arguments);
            }
            F2::Mul => {
                return self.combine(to, n, &[(a, Partial::Lanes(y)), (b, Partial::Lanes(x))]);
            }
            _ => {}
        }
        let (first, second) = (self.carried(a), self.carried(b));
        let mut scratch = std::mem::take(&mut self.scratch);
        let [p, q] = &mut scratch;
        let (p, q) = (&mut p[..n], &mut q[..n]);
        match op {
            F2::Div => {
                each1(arch, p, y, |y| 1.0 / y);
                if second {
                    each2(arch, q, r, y, |r, y| -r / y);
                }
            }
            F2::Rem => {
                p.fill(1.0);
                each2(arch, q, x, y, |x, y| -(x / y).trunc());
            }
            F2::Min => {
                each2(arch, p, x, y, |x, y| if x < y { 1.0 } else { 0.0 });
                each1(arch, q, p, |p| 1.0 - p);
            }
            F2::Max => {
                each2(arch, p, x, y, |x, y| if x > y { 1.0 } else { 0.0 });
                each1(arch, q, p, |p| 1.0 - p);
            }
            F2::Pow => {
                if first {
                    each2(arch, p, r, x, |r, x| r / x);
                    for ((p, &x), &y) in p.iter_mut().zip(x).zip(y) {
                        *p = y * if x == 0.0 { x.pow(y - 1.0) } else { *p };
                    }
                }
                if second {
                    let by_exponent = |x: f64, r: f64| if r == 0.0 { 0.0 } else { r * x.ln() };
                    each2(arch, q, x, r, by_exponent);
                }
            }
            F2::Atan2 => {
                each2(arch, p, x, y, |y, x| x / (x * x + y * y));
                each2(arch, q, x, y, |y, x| -y / (x * x + y * y));
            }
            F2::Add | F2::Sub | F2::Mul | F2::Step => {}
        }
        self.combine(to, n, &[(a, Partial::Lanes(p)), (b, Partial::Lanes(q))]);
        self.scratch = scratch;
    }
}

impl Tangents<f64> for Planes {
    fn follow(&mut self, instr: &Instr, files: &Files<f64>, active: &[bool]) {
        let n = active.len();
        let lanes = |slot: Slot| &files.floats[slot as usize][..n];
        match *instr {
            Instr::F1 { op, to, a } if self.carried(to) => {
                self.follow1(op, (to, a), lanes(a), lanes(to));
            }
            Instr::F2 { op, to, a, b } if self.carried(to) => {
                self.follow2(op, (to, a, b), files, n);
            }
            Instr::Fma { to, a, b, c } if self.carried(to) => {
                let by_factor = [(a, Partial::Lanes(lanes(b))), (b, Partial::Lanes(lanes(a)))];
                self.combine(to, n, &[by_factor[0], by_factor[1], (c, Partial::Constant(1.0))]);
            }
            Instr::Ldexp { to, a, exponent } if self.carried(to) => {
                let mut scratch = std::mem::take(&mut self.scratch);
                let exponents = &files.integers[exponent as usize][..n];
                each1(self.arch, &mut scratch[0][..n], exponents, |e| 1.0.scale(e as i32));
                self.combine(to, n, &[(a, Partial::Lanes(&scratch[0][..n]))]);
                self.scratch = scratch;
            }
            Instr::Move { to: Reg::F(to), from: Reg::F(from) } if self.carried(to) => {
                self.combine(to, n, &[(from, Partial::Constant(1.0))]);
            }
            Instr::Store { to: Reg::F(to), from: Reg::F(from) } if self.carried(to) => {
                if active[..n].iter().all(|active| *active) {
                    self.combine(to, n, &[(from, Partial::Constant(1.0))]);
                } else {
                    self.pick(to, n, |lane| active[lane].then_some(from));
                }
            }
            Instr::Select { to: Reg::F(to), when, yes: Reg::F(yes), no: Reg::F(no) }
                if self.carried(to) =>
            {
                let when = &files.booleans[when as usize];
                self.pick(to, n, |lane| Some(if when[lane] { yes } else { no }));
            }
            Instr::Gather { to: Reg::F(to), ref from, index } if self.carried(to) => {
                let index = &files.integers[index as usize];
                self.pick(to, n, |lane| match from.get(index[lane] as usize) {
                    Some(&Reg::F(from)) => Some(from),
                    _ => None,
                });
            }
            Instr::Scatter { ref to, index, from: Reg::F(from) } => {
                let index = &files.integers[index as usize];
                for (at, &to) in to.iter().enumerate() {
                    if let Reg::F(to) = to {
                        let written = |lane: usize| active[lane] && index[lane] as usize == at;
                        self.pick(to, n, |lane| written(lane).then_some(from));
                    }
                }
            }
            _ => {}
        }
    }
}

/// False for instructions whose result has derivative zero whatever they read.
fn carries(instr: &Instr) -> bool {
    !matches!(
        instr,
        Instr::F1 {
            op: F1::Sign | F1::Floor | F1::Ceil | F1::Round | F1::Trunc | F1::QuantizeF16,
            ..
        } | Instr::F2 { op: F2::Step, .. }
    )
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
