//! Costs of forms on GPUs that need not be there: their machine code, made by the compilers that ship and
//! counted.
//!
//! | target | compiler | where it comes from |
//! |---|---|---|
//! | `rdna2`, `rdna3`, `gcn4` | Mesa's RADV on its null device | `mesa-vulkan-drivers` of Debian and Ubuntu |
//! | `sm_75`, `sm_90` | NVIDIA's NVRTC with fast math, and nvdisasm | the wheels `nvidia-cuda-nvrtc-cu12` and `nvidia-cuda-nvdisasm` |
//!
//! `STRIAE_NVRTC` names the library of NVRTC and `STRIAE_NVDISASM` the program nvdisasm where they are not
//! among the packages of `python3`.
//!
//! A kernel makes its inputs in registers and evaluates the form eight times, so that memory does not rule;
//! costs are net of the same kernel without the form, and the same on every run. The cost is the inverse
//! throughput: a shader of a full screen has waves enough to hide latency, and then what it costs is the
//! issue slots that it takes, a sine four of them. Latency stands beside it for those that have not. Both
//! are static: each branch counts. Loops are asked to be unrolled; one that the compiler keeps has no cost. For NVIDIA, of which no
//! compiler tells the throughput, it is instructions, those of the unit for transcendentals counted four
//! times (conversions as any other), and there is no latency.
//!
//! Compilers run in a child process, one per target for all kernels: the program of striae started again,
//! since what picks the driver must be in the environment before it loads, and since it may crash.

mod child;
mod cuda;
#[allow(unsafe_code)] // Vulkan and NVRTC are C: the crate's only unsafe module, and a small one.
mod foreign;
mod kernel;
mod statistics;
mod target;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::{Mutex, OnceLock, PoisonError};

pub use child::{COUNT_VERB, count_kernels};
pub use statistics::CountedCost;
pub use target::GpuTarget;

use rayon::prelude::*;

use crate::form::Form;
use crate::numeric::measured::Measured;
use kernel::{EVALUATIONS, KernelCode, KernelPair};
use statistics::Statistics;
use target::Compiler;

/// Counts kernels and remembers them: each once, whoever asks.
#[derive(Debug)]
pub struct Counter {
    program: Measured<PathBuf>,
    known: Mutex<HashMap<GpuTarget, Known>>,
}

/// What is known of a target.
#[derive(Debug, Default)]
struct Known {
    driver: Option<Measured<String>>,
    kernels: HashMap<KernelCode, Measured<Statistics>>,
}

impl Default for Counter {
    /// Counts by the running program, if that is striae's.
    fn default() -> Self {
        let own = std::env::current_exe().ok();
        let is_striae = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "striae");
        Self::by(match own.filter(is_striae) {
            Some(path) => Measured::Value(path),
            None => Measured::NotMeasured(
                "costs are counted by the program `striae`, which this is not".to_owned(),
            ),
        })
    }
}

impl Counter {
    /// Counts by the program of striae at `path`.
    pub fn with_program(path: impl Into<PathBuf>) -> Self {
        Self::by(Measured::Value(path.into()))
    }

    fn by(program: Measured<PathBuf>) -> Self {
        Self { program, known: Mutex::default() }
    }

    /// What one evaluation of each form costs, its constants as they ship, or why it was not counted: a
    /// list per target, in the order of `targets`.
    pub fn costs(
        &self,
        targets: &[GpuTarget],
        forms: &[(&Form, &[f32])],
    ) -> Vec<Vec<Measured<CountedCost>>> {
        let pairs = |compiler: Compiler| -> Vec<Result<KernelPair, String>> {
            let pair =
                |(form, constants): &(&Form, &[f32])| KernelPair::new(form, constants, compiler);
            forms.par_iter().map(pair).collect()
        };
        let (radv, nvrtc) = (OnceLock::new(), OnceLock::new());
        std::thread::scope(|scope| {
            let count = |target: GpuTarget| {
                let made = match target.compiler() {
                    Compiler::Radv(_) => &radv,
                    Compiler::Nvrtc => &nvrtc,
                };
                let pairs = made.get_or_init(|| pairs(target.compiler()));
                scope.spawn(move || self.costs_on(target, pairs))
            };
            let counting: Vec<_> = targets.iter().map(|target| count(*target)).collect();
            let nothing =
                |_| vec![Measured::NotMeasured("counting failed".to_owned()); forms.len()];
            counting.into_iter().map(|thread| thread.join().unwrap_or_else(nothing)).collect()
        })
    }

    fn costs_on(
        &self,
        target: GpuTarget,
        pairs: &[Result<KernelPair, String>],
    ) -> Vec<Measured<CountedCost>> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let mut missing: Vec<&KernelCode> = Vec::new();
        {
            let mut all = known();
            let known = all.entry(target).or_default();
            let mut seen = HashSet::new();
            for code in pairs.iter().flatten().flat_map(|pair| [&pair.full, &pair.empty]) {
                if !known.kernels.contains_key(code) && seen.insert(code) {
                    missing.push(code);
                }
            }
        }
        if !missing.is_empty() {
            let counted = match &self.program {
                Measured::Value(program) => child::counted(program, target, &missing),
                Measured::NotMeasured(reason) => child::Counted::nothing(reason, missing.len()),
            };
            let mut all = known();
            let known = all.entry(target).or_default();
            known.driver = Some(counted.driver);
            known.kernels.extend(missing.into_iter().cloned().zip(counted.kernels));
        }
        let all = known();
        let figure = |code: &KernelCode| {
            let figure = all.get(&target).and_then(|known| known.kernels.get(code));
            figure.cloned().unwrap_or_else(|| Measured::NotMeasured("was not counted".to_owned()))
        };
        let cost = |pair: &Result<KernelPair, String>| match pair {
            Err(reason) => Measured::NotMeasured(reason.clone()),
            Ok(pair) => match (figure(&pair.full), figure(&pair.empty)) {
                (Measured::Value(full), Measured::Value(empty)) => {
                    Measured::Value(CountedCost::net(&full, &empty, EVALUATIONS))
                }
                (Measured::NotMeasured(reason), _) | (_, Measured::NotMeasured(reason)) => {
                    Measured::NotMeasured(reason)
                }
            },
        };
        pairs.iter().map(cost).collect()
    }

    /// Device and version of the compiler behind the counts of `target` so far.
    pub fn driver(&self, target: GpuTarget) -> Measured<String> {
        let all = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let driver = all.get(&target).and_then(|known| known.driver.clone());
        driver.unwrap_or_else(|| Measured::NotMeasured("nothing was counted".to_owned()))
    }
}
