//! What a form costs on the device.
//!
//! Each form runs in a loop of its own: every invocation reads a point, evaluates the form there
//! many times and stores the sum. An offset that the compiler cannot know to be 0 is added to the
//! point and grows from turn to turn, so that no evaluation can be hoisted, shared or left out.
//! The same loop with the sum of the inputs in place of the form, the empty loop, is subtracted.
//! Forms are interleaved, A B C … empty, B C … empty A, over many rounds, and compared within a
//! round, so that a machine that is busy with something else slows all of them alike.
//!
//! Points are shuffled: neighbouring invocations hold unrelated points, so a branch diverges as
//! it does at the least coherent place of an image. Give points spread evenly over the domain.
//! Since an invocation stays at its point, the branch predictor of a software device learns every
//! branch: what counts is which sides run, as on a GPU, not how well they are guessed.
//! Parameters are pipeline constants and may be folded, as they are in the emitted code. What is
//! measured is throughput, not latency: the evaluations of a loop do not depend on each other.
//! The tables of a form lie in storage buffers, as an engine would hold them, so reading one costs a load from the device's memory, cached as the device pleases.

mod clock;
mod item;
mod spread;
mod trial;

pub use clock::Clock;
pub use spread::Spread;

use super::device::Device;
use super::error::GpuError;
use super::program::{Program, Purpose};
use crate::form::{Form, Input, ScalarType};
use crate::numeric::measured::Measured;
use clock::Stopwatch;
use item::Item;
use serde::{Deserialize, Serialize};
use trial::Candidate;

/// A form to time, with the points to time it at.
#[derive(Debug, Clone, Copy)]
pub struct TimedForm<'a> {
    /// Name in the result.
    pub name: &'a str,
    /// The form.
    pub form: &'a Form,
    /// One value per entry of [`Form::parameters`].
    pub parameters: &'a [f32],
    /// One column per entry of [`Form::input_columns`], all of one length, spread evenly over the
    /// domain in any order.
    pub inputs: &'a [Input<'a>],
}

/// How to time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimingOptions {
    /// Number of rounds, after one that is thrown away.
    pub rounds: usize,
    /// Time after which no further round begins once there are [`TimingOptions::LEAST_ROUNDS`], s.
    pub budget_s: f64,
    /// Points in the buffer of each form, rounded up to a power of two; the inputs are repeated,
    /// or a random part of them taken, to fill it.
    pub points: usize,
    /// Usual number of evaluations per invocation; less for forms so slow that a dispatch would
    /// take too long, more on devices so fast that it would not take long enough.
    pub repeats: u32,
    /// Duration of one dispatch that the work is chosen for, ms. Short against the time slices of
    /// a busy machine, long against the cost of a launch.
    pub dispatch_ms: f64,
    /// Longest time in which a form must compile and run once, s; it is not measured otherwise.
    pub compile_limit_s: f64,
    /// Seed of the shuffle.
    pub seed: u64,
    /// Name of the form that ratios refer to.
    pub baseline: Option<String>,
}

impl TimingOptions {
    /// Rounds that are run however long they take.
    pub const LEAST_ROUNDS: usize = 5;

    /// A quarter of the rounds and less of the time: for costs beside something else that is shown.
    pub fn brief() -> Self {
        Self { rounds: 15, budget_s: 0.4, ..Self::default() }
    }
}

impl Default for TimingOptions {
    /// 63 rounds of dispatches of 2 ms: about 2 s for twelve forms, besides compiling them.
    fn default() -> Self {
        Self {
            rounds: 63,
            budget_s: 3.0,
            points: 1 << 12,
            repeats: 64,
            dispatch_ms: 2.0,
            compile_limit_s: 10.0,
            seed: 0,
            baseline: None,
        }
    }
}

/// The cost of one form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Name, from [`TimedForm::name`].
    pub name: String,
    /// The cost, or why it is not known.
    pub cost: Measured<TimingFigures>,
}

/// Figures over the rounds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TimingFigures {
    /// Whose clock.
    pub clock: Clock,
    /// Number of rounds that were run.
    pub rounds: usize,
    /// Evaluations in one dispatch.
    pub evaluations: u64,
    /// Duration of one evaluation, net of the empty loop, ns. All invocations that run side by
    /// side count: this is the reciprocal of the throughput. Noise can make a cheap form negative.
    pub net_ns: Spread,
    /// The empty loop over as many inputs, ns per evaluation.
    pub empty_ns: Spread,
    /// `net_ns` divided by that of the baseline, round by round over the quieter half of the
    /// rounds; `None` without a baseline, or where the baseline costs nothing that can be told from
    /// the empty loop.
    pub ratio: Option<Spread>,
}

/// Times `forms`; one [`Timing`] per form, in their order.
///
/// A form that does not compile, needs longer than [`TimingOptions::compile_limit_s`] for it, or
/// whose inputs do not match, is not measured, with the reason; the others are. What a driver has
/// begun to compile cannot be called off and goes on in the background until the process ends.
/// Without timestamps on the device the host's clock is used, and [`TimingFigures::clock`] says so.
///
/// # Errors
/// [`GpuError`] if the device fails: lost, out of memory, not finished in time.
pub fn time(
    device: &Device,
    forms: &[TimedForm<'_>],
    options: &TimingOptions,
) -> Result<Vec<Timing>, GpuError> {
    let stopwatch = Stopwatch::new(device)?;
    let mut bench = Bench::new(device, &stopwatch, forms, options)?;
    for item in &mut bench.items {
        item.adapt(device, &stopwatch, options.dispatch_ms * 1e6)?;
    }
    let rounds = stopwatch.rounds(device, &bench.items, options)?;
    let baseline = options.baseline.as_deref().and_then(|name| {
        let index = forms.iter().position(|timed| timed.name == name)?;
        let place = bench.places.get(index)?.as_ref().ok()?;
        Some(place.net(&rounds))
    });
    let timings = forms.iter().zip(&bench.places).map(|(timed, place)| Timing {
        name: timed.name.to_owned(),
        cost: match place {
            Err(reason) => Measured::NotMeasured(reason.clone()),
            Ok(place) => bench.cost(*place, &rounds, baseline.as_deref(), stopwatch.clock()),
        },
    });
    Ok(timings.collect())
}

/// The loops of all forms and the empty loops that they need.
struct Bench {
    items: Vec<Item>,
    /// One per form: its loops, or why there are none.
    places: Vec<Result<Place, String>>,
}

/// Indices into [`Bench::items`].
#[derive(Debug, Clone, Copy)]
struct Place {
    own: usize,
    empty: usize,
}

impl Bench {
    fn new(
        device: &Device,
        stopwatch: &Stopwatch,
        forms: &[TimedForm<'_>],
        options: &TimingOptions,
    ) -> Result<Self, GpuError> {
        let mut bench = Self { items: Vec::new(), places: Vec::with_capacity(forms.len()) };
        // Types of the inputs and index of each empty loop.
        let mut empty_loops: Vec<(Vec<ScalarType>, usize)> = Vec::new();
        for candidate in candidates(device, forms, options) {
            let Candidate { program, inputs } = match candidate {
                Ok(candidate) => candidate,
                Err(reason) => {
                    bench.places.push(Err(reason));
                    continue;
                }
            };
            match Item::new(device, &stopwatch.sums, &program, &inputs, options) {
                Ok(item) => bench.items.push(item),
                Err(
                    error @ (GpuError::Lost(_) | GpuError::OutOfMemory(_) | GpuError::TimedOut(_)),
                ) => return Err(error),
                Err(error) => {
                    bench.places.push(Err(error.to_string()));
                    continue;
                }
            }
            let own = bench.items.len() - 1;
            let types = program.inputs();
            let known = empty_loops.iter().find(|(known, _)| *known == types);
            let empty = match known {
                Some((_, index)) => *index,
                None => {
                    let program = Program::empty_loop(&types)?;
                    let item = Item::new(device, &stopwatch.sums, &program, &inputs, options)?;
                    bench.items.push(item);
                    empty_loops.push((types, own + 1));
                    own + 1
                }
            };
            bench.places.push(Ok(Place { own, empty }));
        }
        Ok(bench)
    }

    fn cost(
        &self,
        place: Place,
        rounds: &[Vec<f64>],
        baseline: Option<&[f64]>,
        clock: Clock,
    ) -> Measured<TimingFigures> {
        let net = place.net(rounds);
        let empty: Vec<f64> =
            rounds.iter().filter_map(|round| round.get(place.empty).copied()).collect();
        let (Some(net_ns), Some(empty_ns)) = (Spread::of(&net), Spread::of(&empty)) else {
            let reason = "the device's timestamps do not advance";
            return Measured::NotMeasured(reason.to_owned());
        };
        Measured::Value(TimingFigures {
            clock,
            rounds: rounds.len(),
            evaluations: self.items.get(place.own).map_or(0, Item::evaluations),
            net_ns,
            empty_ns,
            ratio: baseline.and_then(|baseline| ratio(&net, baseline)),
        })
    }
}

/// The kernels of `forms` that can be timed, or the reasons why not. What the device has compiled
/// before needs no trial.
fn candidates(
    device: &Device,
    forms: &[TimedForm<'_>],
    options: &TimingOptions,
) -> Vec<Result<Candidate, String>> {
    let mut candidates: Vec<Result<Candidate, String>> = forms.iter().map(candidate).collect();
    let mut fresh: Vec<&mut Result<Candidate, String>> = candidates
        .iter_mut()
        .filter(|c| c.as_ref().is_ok_and(|c| !device.pipelines.has(&c.program.key())))
        .collect();
    let tried: Vec<Candidate> =
        fresh.iter().filter_map(|c| Some(c.as_ref().ok()?.with_one_row())).collect();
    for (candidate, verdict) in fresh.iter_mut().zip(trial::verdicts(&tried, options)) {
        if let Err(reason) = verdict {
            **candidate = Err(reason);
        }
    }
    candidates
}

fn candidate(timed: &TimedForm<'_>) -> Result<Candidate, String> {
    if timed.inputs.first().is_some_and(|column| column.is_empty()) {
        return Err("there are no points to time it at".to_owned());
    }
    let program = Program::new(timed.form, timed.parameters, Purpose::Repeat)
        .map_err(|error| error.to_string())?;
    let inputs = program.check(timed.inputs).and_then(|rows| {
        let column = |(at, column)| Ok(program.words(at, column, 0..rows)?.into_owned());
        timed.inputs.iter().copied().enumerate().map(column).collect::<Result<_, _>>()
    });
    Ok(Candidate { inputs: inputs.map_err(|error: GpuError| error.to_string())?, program })
}

impl Place {
    /// Own cost less that of the empty loop, round by round, ns per evaluation.
    fn net(self, rounds: &[Vec<f64>]) -> Vec<f64> {
        let difference = |round: &Vec<f64>| match (round.get(self.own), round.get(self.empty)) {
            (Some(own), Some(empty)) => own - empty,
            _ => f64::NAN,
        };
        rounds.iter().map(difference).collect()
    }
}

/// Ratios round by round over the quieter half of the rounds, where the baseline's cost is
/// positive in most of them. Whatever else the machine does only adds time, so the rounds in which
/// the two together were shortest were disturbed least.
fn ratio(net: &[f64], baseline: &[f64]) -> Option<Spread> {
    let mut rounds: Vec<(f64, f64)> = net.iter().copied().zip(baseline.iter().copied()).collect();
    rounds.sort_by(|a, b| (a.0 + a.1).total_cmp(&(b.0 + b.1)));
    rounds.truncate(rounds.len().div_ceil(2));
    let ratios: Vec<f64> =
        rounds.iter().map(|(net, base)| if *base > 0.0 { net / base } else { f64::NAN }).collect();
    Spread::of(&ratios)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_taken_round_by_round() {
        // All of the second round ran at half speed, and half of the last one.
        let spread = ratio(&[2.0, 4.0, 2.0, 2.0, 2.0], &[1.0, 2.0, 1.0, 1.0, 8.0]);
        assert_eq!(spread.map(|s| (s.min, s.max)), Some((2.0, 2.0)));
    }

    #[test]
    fn a_baseline_that_costs_nothing_gives_no_ratio() {
        assert_eq!(ratio(&[1.0, 1.0, 1.0, 1.0], &[0.0, -0.1, 0.1, 0.2]), None);
    }
}
