//! Cost of forms and references: counted in machine code, and ratios taken in one run, on the CPU lanes and
//! on the device.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::time::Instant;

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::counted::{CountedCost, Counter, GpuTarget};
use crate::effect::{Candidate, Reference};
use crate::form::{Form, Input, OpCount, ScalarType};
use crate::gpu::{self, AdapterDescription, Device, TimedForm, TimingFigures, TimingOptions};
use crate::numeric::measured::Measured;
use crate::numeric::statistics::percentile;
use crate::validate::ValidateError;
use crate::validate::accuracy::GroundTruth;

/// Cost of one form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// The fit.
    pub name: String,
    /// The fit that its ratio refers to.
    pub baseline: String,
    /// Operations in the text.
    pub operations: OpCount,
    /// Nanoseconds per evaluation on f64 lanes, one core.
    pub lanes_f64_ns: f64,
    /// Nanoseconds per evaluation on f32 lanes, one core.
    pub lanes_f32_ns: f64,
    /// Cost counted in machine code, by target.
    pub counted: BTreeMap<GpuTarget, Measured<CountedCost>>,
    /// Cost on the device, net of an empty kernel.
    pub device: Measured<TimingFigures>,
}

/// The target by which forms are ranked, and on which goals are judged.
pub const RANKED_ON: GpuTarget = GpuTarget::Rdna2;

/// By which cost the forms of a group are ranked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Counted on [`RANKED_ON`]: cycles of a wave.
    Counted,
    /// Timed on the device, which may be software: ns.
    Device,
    /// Timed on f32 lanes: ns.
    Lanes,
}

impl Basis {
    /// `cost on rdna2`.
    pub fn words(self) -> String {
        match self {
            Self::Counted => format!("cost on {RANKED_ON}, counted"),
            Self::Device => "cost on the device".to_owned(),
            Self::Lanes => "cost on f32 lanes".to_owned(),
        }
    }

    /// Unit of the cost.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Counted => "cycles of a wave",
            Self::Device | Self::Lanes => "ns",
        }
    }
}

impl Cost {
    /// The cost by `basis`; NaN if it was not measured.
    fn by(&self, basis: Basis) -> f64 {
        match basis {
            Basis::Counted => self.on(RANKED_ON).map_or(f64::NAN, |counted| counted.cost),
            Basis::Device => self.device.value().map_or(f64::NAN, |timing| timing.net_ns.median),
            Basis::Lanes => self.lanes_f32_ns,
        }
    }

    /// What was counted on `target`.
    pub fn on(&self, target: GpuTarget) -> Option<&CountedCost> {
        self.counted.get(&target)?.value()
    }
}

/// Cost of a reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceCost {
    /// Name.
    pub name: String,
    /// Nanoseconds per evaluation, one core.
    pub ns: f64,
}

/// Costs of one effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// Effect.
    pub effect: String,
    /// The device, or why there is none.
    pub adapter: Measured<AdapterDescription>,
    /// Forms, in the order given.
    pub forms: Vec<Cost>,
    /// References.
    pub references: Vec<ReferenceCost>,
}

impl Costs {
    /// The cost of the fit called `name`.
    pub fn of(&self, name: &str) -> Option<&Cost> {
        self.forms.iter().find(|cost| cost.name == name)
    }

    /// By which cost the forms that refer to `baseline` are ranked: the counted one where the baseline has
    /// been counted, else the time on the device, else that on lanes.
    pub fn basis(&self, baseline: &str) -> Basis {
        let of_baseline = self.of(baseline);
        if of_baseline.is_some_and(|cost| cost.on(RANKED_ON).is_some()) {
            Basis::Counted
        } else if of_baseline.is_some_and(|cost| cost.device.value().is_some()) {
            Basis::Device
        } else {
            Basis::Lanes
        }
    }

    /// The number by which `cost` is ranked in its group; NaN if it was not measured.
    pub fn ranked(&self, cost: &Cost) -> f64 {
        cost.by(self.basis(&cost.baseline))
    }

    /// A counted cost over that of the baseline, or why it is not known.
    pub fn ratio_on(&self, target: GpuTarget, cost: &Cost) -> Measured<f64> {
        let counted = |cost: &Cost| {
            let counted = cost.counted.get(&target).cloned();
            counted.unwrap_or_else(|| Measured::NotMeasured("was not counted".to_owned()))
        };
        let baseline = self.of(&cost.baseline);
        match (counted(cost), baseline.map(counted)) {
            (Measured::Value(own), Some(Measured::Value(base))) => match own.over(&base) {
                Some(ratio) => Measured::Value(ratio),
                None => Measured::NotMeasured("the baseline costs as good as nothing".to_owned()),
            },
            (Measured::NotMeasured(reason), _) | (_, Some(Measured::NotMeasured(reason))) => {
                Measured::NotMeasured(reason)
            }
            (_, None) => Measured::NotMeasured("there is no baseline".to_owned()),
        }
    }
}

/// A form with constants, and the points over which it is timed.
#[derive(Debug, Clone)]
pub struct Timed {
    /// The form.
    pub candidate: Candidate,
    /// Where it is evaluated.
    pub target: GroundTruth,
}

/// A reference and the points over which it is timed.
#[derive(Debug, Clone)]
pub struct TimedReference {
    /// The reference.
    pub reference: &'static Reference,
    /// One column per argument.
    pub inputs: Vec<Vec<f64>>,
}

/// Rounds of interleaved timing; the median over rounds is reported.
const ROUNDS: usize = 9;
/// Rounds that every form takes part in.
const LEAST_ROUNDS: usize = 3;
/// Time on the CPU after which a form takes part in no further round, ns: a slow form's passes are
/// long against the timer and the scheduler already.
const ENOUGH_NS: f64 = 4e7;
/// Time in which a reference is evaluated at further points, s.
const REFERENCE_S: f64 = 0.1;
/// Points per timed pass on the CPU.
const POINTS: usize = 1 << 12;

/// Counts every candidate by `counter`; times it, on the device by `timing`, and every reference. The first candidate of each
/// group is the baseline of the ratios in it.
///
/// Points are shuffled, so that a branch on the argument diverges as it would on a screen.
///
/// # Errors
/// If a form cannot be evaluated or the device fails.
pub fn costs(
    effect: &str,
    groups: &[Vec<Timed>],
    references: &[TimedReference],
    device: &Measured<Device>,
    timing: &TimingOptions,
    counter: &Counter,
) -> Result<Costs, ValidateError> {
    let mut forms = Vec::new();
    for group in groups {
        forms.extend(group_costs(group, device, timing)?);
    }
    let candidates: Vec<&Candidate> =
        groups.iter().flatten().map(|timed| &timed.candidate).collect();
    for (cost, counted) in forms.iter_mut().zip(counted(counter, &candidates)) {
        cost.counted = counted;
    }
    Ok(Costs {
        effect: effect.to_owned(),
        adapter: device.map(|device| device.description().clone()),
        forms,
        references: references
            .iter()
            .map(|timed| reference_cost(timed.reference, &shuffled(&timed.inputs)))
            .collect(),
    })
}

/// What `candidates` cost on every target, each with the constants that ship.
pub fn counted(
    counter: &Counter,
    candidates: &[&Candidate],
) -> Vec<BTreeMap<GpuTarget, Measured<CountedCost>>> {
    let forms: Vec<(&Form, &[f32])> =
        candidates.iter().map(|of| (&of.form, of.constants_f32.as_slice())).collect();
    let costs = counter.costs(&GpuTarget::ALL, &forms);
    let of = |at: usize| {
        let targets = GpuTarget::ALL.into_iter().zip(&costs);
        targets.filter_map(|(target, costs)| Some((target, costs.get(at)?.clone()))).collect()
    };
    (0..candidates.len()).map(of).collect()
}

/// Times the candidates of one group against each other.
fn group_costs(
    candidates: &[Timed],
    device: &Measured<Device>,
    timing: &TimingOptions,
) -> Result<Vec<Cost>, ValidateError> {
    let inputs: Vec<Vec<Vec<f64>>> =
        candidates.iter().map(|timed| shuffled(&timed.target.inputs)).collect();
    let narrow: Vec<Vec<Vec<f32>>> = inputs
        .iter()
        .map(|columns| columns.iter().map(|c| c.iter().map(|v| *v as f32).collect()).collect())
        .collect();
    let mut wide_ns = vec![Vec::with_capacity(ROUNDS); candidates.len()];
    let mut narrow_ns = vec![Vec::with_capacity(ROUNDS); candidates.len()];
    for round in 0..ROUNDS {
        for (at, timed) in candidates.iter().enumerate() {
            let spent: f64 = wide_ns[at].iter().chain(&narrow_ns[at]).sum();
            if round >= LEAST_ROUNDS && spent * POINTS as f64 > ENOUGH_NS {
                continue;
            }
            let columns: Vec<&[f64]> = inputs[at].iter().map(Vec::as_slice).collect();
            let candidate = &timed.candidate;
            wide_ns[at]
                .push(nanoseconds(|| candidate.form.eval_f64(&candidate.constants, &columns))?);
            let types = candidate.form.input_types();
            let columns: Vec<Input<'_>> = types
                .iter()
                .zip(inputs[at].iter().zip(&narrow[at]))
                .map(|(scalar, (wide, narrow))| match scalar {
                    ScalarType::F32 => narrow.into(),
                    ScalarType::I32 | ScalarType::U32 => wide.into(),
                })
                .collect();
            narrow_ns[at].push(nanoseconds(|| {
                candidate.form.eval_f32_inputs(&candidate.constants_f32, &columns)
            })?);
        }
    }
    let timings = device_timings(candidates, &inputs, device, timing)?;
    let baseline = candidates.first().map(|c| c.candidate.name.clone()).unwrap_or_default();
    Ok(candidates
        .iter()
        .enumerate()
        .map(|(at, timed)| Cost {
            name: timed.candidate.name.clone(),
            baseline: baseline.clone(),
            operations: timed.candidate.form.op_count(),
            lanes_f64_ns: percentile(&wide_ns[at], 50.0),
            lanes_f32_ns: percentile(&narrow_ns[at], 50.0),
            counted: BTreeMap::new(),
            device: timings[at].clone(),
        })
        .collect())
}

/// Nanoseconds per point of one pass over [`POINTS`] points.
fn nanoseconds<T, E: Into<ValidateError>>(
    pass: impl FnOnce() -> Result<T, E>,
) -> Result<f64, ValidateError> {
    let start = Instant::now();
    black_box(pass().map_err(Into::into)?);
    Ok(start.elapsed().as_secs_f64() * 1e9 / POINTS as f64)
}

/// [`POINTS`] rows drawn in a seeded random order, repeating the rows as often as needed.
fn shuffled(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, Vec::len);
    if rows == 0 {
        return columns.iter().map(|_| Vec::new()).collect();
    }
    let mut order: Vec<usize> = (0..rows).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(1));
    let order: Vec<usize> = order.into_iter().cycle().take(POINTS).collect();
    columns.iter().map(|column| order.iter().map(|row| column[*row]).collect()).collect()
}

fn device_timings(
    candidates: &[Timed],
    inputs: &[Vec<Vec<f64>>],
    device: &Measured<Device>,
    timing: &TimingOptions,
) -> Result<Vec<Measured<TimingFigures>>, ValidateError> {
    let device = match device {
        Measured::Value(device) => device,
        Measured::NotMeasured(reason) => {
            return Ok(vec![Measured::NotMeasured(reason.clone()); candidates.len()]);
        }
    };
    let inputs: Vec<Vec<Input<'_>>> =
        inputs.iter().map(|columns| columns.iter().map(Input::from).collect()).collect();
    let forms: Vec<TimedForm<'_>> = candidates
        .iter()
        .zip(&inputs)
        .map(|(timed, inputs)| TimedForm {
            name: &timed.candidate.name,
            form: &timed.candidate.form,
            parameters: &timed.candidate.constants_f32,
            inputs,
        })
        .collect();
    let baseline = candidates.first().map(|timed| timed.candidate.name.clone());
    let options = TimingOptions { baseline, ..timing.clone() };
    let timings = gpu::time(device, &forms, &options)?;
    Ok(timings.into_iter().map(|timing| timing.cost).collect())
}

/// The mean over as many of the points, in their random order, as [`REFERENCE_S`] allows: one at least.
fn reference_cost(reference: &Reference, columns: &[Vec<f64>]) -> ReferenceCost {
    let rows = columns.first().map_or(0, Vec::len);
    let start = Instant::now();
    let mut evaluated = 0;
    for row in 0..rows {
        let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        let _ = black_box(reference.value(black_box(&point)));
        evaluated += 1;
        if start.elapsed().as_secs_f64() > REFERENCE_S {
            break;
        }
    }
    let ns = start.elapsed().as_secs_f64() * 1e9 / f64::from(evaluated.max(1));
    ReferenceCost { name: reference.name.to_owned(), ns }
}
