//! What is counted in machine code.

use std::collections::{BTreeMap, HashSet};

use serde::{Deserialize, Serialize};

/// What a compiler says of one kernel.
#[derive(Debug)]
pub(super) struct Compiled {
    /// The driver's own statistics, by name.
    pub(super) statistics: BTreeMap<String, f64>,
    /// The machine code.
    pub(super) assembly: String,
}

/// Counts in one kernel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Statistics {
    pub(super) instructions: f64,
    pub(super) quarter_rate: f64,
    pub(super) inverse_throughput: f64,
    pub(super) latency: Option<f64>,
    pub(super) registers: f64,
}

/// What one evaluation of a form costs on a target: counts in machine code, net of the empty kernel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CountedCost {
    /// Inverse throughput, issue cycles of one wave: issue slots weighted by the rate of their unit. The
    /// number that is called the cost.
    pub cost: f64,
    /// Latency of one wave alone, cycles, where the compiler estimates it.
    pub latency: Option<f64>,
    /// Instructions.
    pub instructions: f64,
    /// Instructions that issue at a quarter of the rate of an addition: sin, cos, exp2, log2, reciprocals,
    /// roots and 32-bit integer products.
    pub quarter_rate: f64,
    /// Vector registers of the whole kernel.
    pub registers: f64,
}

/// What two additions of a wave cost: below it a form costs no more than the sum that the empty kernel makes
/// in its place, and nothing can be told relative to it.
const LEAST_CYCLES: f64 = 4.0;

impl CountedCost {
    /// The cost over that of `baseline`, unless the latter is as good as none.
    pub fn over(&self, baseline: &Self) -> Option<f64> {
        (baseline.cost >= LEAST_CYCLES).then(|| self.cost / baseline.cost)
    }

    /// The cost of one of `evaluations` in `full` that are not in `empty`.
    pub(super) fn net(full: &Statistics, empty: &Statistics, evaluations: u32) -> Self {
        let per = |of: fn(&Statistics) -> f64| (of(full) - of(empty)) / f64::from(evaluations);
        let latency = full.latency.zip(empty.latency);
        Self {
            cost: per(|of| of.inverse_throughput),
            latency: latency.map(|(full, empty)| (full - empty) / f64::from(evaluations)),
            instructions: per(|of| of.instructions),
            quarter_rate: per(|of| of.quarter_rate),
            registers: full.registers,
        }
    }
}

/// Operations of AMD's vector unit at a quarter of the rate, by the beginning of their names.
const QUARTER_RATE: [&str; 11] = [
    "v_sin_f32",
    "v_cos_f32",
    "v_exp_f32",
    "v_log_f32",
    "v_rcp_",
    "v_rsq_",
    "v_sqrt_f32",
    "v_mul_lo_u32",
    "v_mul_hi_",
    "v_mad_u64_u32",
    "v_mad_i64_i32",
];

/// Why a kernel with a loop has no cost.
const LOOP: &str = "its machine code has a loop, whose turns a compiler only guesses";

impl Compiled {
    /// Machine code alone.
    pub(super) fn new(assembly: String) -> Self {
        Self { statistics: BTreeMap::new(), assembly }
    }

    /// Whether a branch goes back to a label that stands before it.
    fn has_loop(&self) -> bool {
        let mut labels = HashSet::new();
        self.assembly.lines().any(|line| {
            let mut words = line.split_whitespace();
            match (words.next(), words.next()) {
                (Some(first), _) if first.ends_with(':') => {
                    labels.insert(first.trim_end_matches(':'));
                    false
                }
                (Some(operation), Some(to)) => {
                    let branch =
                        operation.starts_with("s_branch") || operation.starts_with("s_cbranch");
                    branch && labels.contains(to)
                }
                _ => false,
            }
        })
    }

    /// The counts in a disassembly of nvdisasm.
    pub(super) fn of_nvdisasm(&self) -> Result<Statistics, String> {
        let (mut instructions, mut slow, mut registers) = (0_u32, 0_u32, 0_u32);
        let mut labels = HashSet::new();
        let mut last_label = "";
        for line in self.assembly.lines() {
            let line = line.trim();
            if let Some(label) = line.strip_suffix(':') {
                labels.insert(label);
                last_label = label;
                continue;
            }
            let Some((_, code)) = line.strip_prefix("/*").and_then(|rest| rest.split_once("*/"))
            else {
                continue;
            };
            let mut words = code.split_whitespace().skip_while(|word| word.starts_with('@'));
            let Some(operation) = words.next() else { continue };
            let operands = words.collect::<Vec<_>>().join(" ");
            if operation == "NOP" {
                continue;
            }
            if operation.starts_with("BRA") {
                let to = operands.split("`(").nth(1).and_then(|rest| rest.split(')').next());
                match to {
                    // The end of every kernel: a trap that branches to itself.
                    Some(to) if to == last_label && operands.starts_with('`') => continue,
                    Some(to) if labels.contains(to) => return Err(LOOP.to_owned()),
                    _ => {}
                }
            }
            instructions += 1;
            slow += u32::from(operation.starts_with("MUFU"));
            let numbers = operands.split(|c: char| !c.is_ascii_alphanumeric());
            let register = |word: &str| word.strip_prefix('R')?.parse::<u32>().ok();
            registers =
                registers.max(numbers.filter_map(register).max().map_or(0, |last| last + 1));
        }
        if instructions == 0 {
            return Err("nvdisasm shows no instruction".to_owned());
        }
        Ok(Statistics {
            instructions: f64::from(instructions),
            quarter_rate: f64::from(slow),
            inverse_throughput: f64::from(instructions + 3 * slow),
            latency: None,
            registers: f64::from(registers),
        })
    }

    /// The counts of RADV.
    pub(super) fn of_radv(&self) -> Result<Statistics, String> {
        let figure = |name: &str| {
            let value = self.statistics.get(name).copied();
            value.ok_or_else(|| format!("the driver does not tell the statistic `{name}`"))
        };
        if self.has_loop() {
            return Err(LOOP.to_owned());
        }
        let operations = self.assembly.lines().filter_map(|line| line.split_whitespace().next());
        let slow = |operation: &&str| QUARTER_RATE.iter().any(|slow| operation.starts_with(slow));
        Ok(Statistics {
            instructions: figure("Instructions")?,
            quarter_rate: operations.filter(slow).count() as f64,
            inverse_throughput: figure("Inverse Throughput")?,
            latency: Some(figure("Latency")?),
            registers: figure("VGPRs")?,
        })
    }
}
