//! `bench`: what forms and references cost, beside their error.

use std::collections::BTreeSet;

use anyhow::bail;
use clap::Args;
use serde::Serialize;

use super::Ending;
use super::context::Context;
use super::output::{significant, table};
use crate::effect::Yardstick;
use crate::numeric::measured::Measured;
use crate::numeric::statistics::largest;
use crate::run::{Studied, write_costs};
use crate::validate::cheapest::{Cheapest, cheapest};
use crate::validate::cost::{Cost, Costs};
use crate::validate::goals::{GoalVerdict, goals};

const MORE: &str = "\
Forms are timed in one run, interleaved, on f64 and f32 lanes (one core) and, where there is an
adapter, on the device net of an empty kernel. Quote the ratios: the nanoseconds are this machine's.
A form on the frontier is beaten by no other in both error and cost.

Example:
  striae bench sine_integral";

/// Cost of forms and references, against their error
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Effects [default: all]
    #[arg(value_name = "NAME")]
    effects: Vec<String>,
    /// Record the costs on this device in reports/costs/, in a file named after the adapter
    #[arg(long)]
    record: bool,
}

/// One form: its error and its cost.
#[derive(Debug, Serialize)]
struct Line {
    fit: String,
    /// Error in f32 by which forms are compared, by region (or over all members of a family).
    error: Vec<(String, f64)>,
    frontier: bool,
    #[serde(flatten)]
    cost: Cost,
}

#[derive(Debug, Serialize)]
struct Bench {
    effect: String,
    costs: Costs,
    forms: Vec<Line>,
    cheapest: Vec<Cheapest>,
    goals: Vec<GoalVerdict>,
}

/// Times, and prints the frontier.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let effects = context.effects(&arguments.effects)?;
    let run = context.run()?;
    let studied = run.studies(&effects, &|_| ())?;
    if arguments.record {
        if !arguments.effects.is_empty() {
            bail!("--record is for every effect together: name none");
        }
        let Some(device) = run.device.value() else {
            bail!("--record needs a device, and there is none");
        };
        let folder = run.project.reports().join("costs");
        let path = write_costs(&folder, device.description(), &studied)?;
        context.output.note(&format!("costs: {}", run.project.shown(&path)));
    }
    let benches: Vec<Bench> = studied.iter().map(bench).collect();
    context.output.result(&benches, || benches.iter().map(text).collect::<Vec<_>>().join("\n"))?;
    Ok(Ending::Done)
}

fn bench(studied: &Studied) -> Bench {
    let mut forms: Vec<Line> = studied
        .costs
        .forms
        .iter()
        .map(|cost| Line {
            fit: cost.name.clone(),
            error: errors(studied, &cost.name),
            frontier: false,
            cost: cost.clone(),
        })
        .collect();
    forms.sort_by(|a, b| a.cost.nanoseconds().total_cmp(&b.cost.nanoseconds()));
    // Fits to different references answer different questions: a frontier each.
    let baselines: BTreeSet<String> = forms.iter().map(|line| line.cost.baseline.clone()).collect();
    for baseline in &baselines {
        let mut best = f64::INFINITY;
        for line in forms.iter_mut().filter(|line| line.cost.baseline == *baseline) {
            let worst = worst(line);
            line.frontier = worst < best;
            // A NaN is no error to beat.
            best = best.min(worst);
        }
    }
    Bench {
        effect: studied.effect.name.to_owned(),
        costs: studied.costs.clone(),
        forms,
        cheapest: cheapest(&studied.study, &studied.costs),
        goals: goals(studied.effect, &studied.study, &studied.costs),
    }
}

fn errors(studied: &Studied, fit: &str) -> Vec<(String, f64)> {
    if let Some(study) = studied.study.candidates.iter().find(|study| study.name == fit) {
        let region = |(name, accuracy): &(String, crate::validate::accuracy::Accuracy)| {
            let kind = match accuracy.yardstick {
                Yardstick::MaxAbs => name.clone(),
                other => format!("{name}, {}", other.words()),
            };
            (kind, accuracy.headline())
        };
        return study.regions.iter().map(region).collect();
    }
    let forms = studied.study.families.iter().flat_map(|family| &family.forms);
    forms
        .filter(|form| form.fit == fit)
        .flat_map(|form| [("all members".to_owned(), form.max_abs), ("RMS".to_owned(), form.rms)])
        .collect()
}

fn text(bench: &Bench) -> String {
    let mut text = match &bench.costs.adapter {
        Measured::Value(adapter) => format!("{}: device {adapter}\n", bench.effect),
        Measured::NotMeasured(reason) => {
            format!("{}: device not measured: {reason}\n", bench.effect)
        }
    };
    text.push_str(&table(
        &[
            "fit",
            "frontier",
            "error, f32",
            "device ns",
            "ratio",
            "quartiles of the ratio",
            "f32 lanes ns",
            "f64 lanes ns",
        ],
        bench.forms.iter().map(row).collect(),
    ));
    let references = &bench.costs.references;
    text.push_str(&table(
        &["reference", "f64 ns"],
        references.iter().map(|r| vec![r.name.clone(), significant(r.ns, 3)]).collect(),
    ));
    let mut baselines: Vec<&str> =
        bench.costs.forms.iter().map(|cost| cost.baseline.as_str()).collect();
    baselines.dedup();
    baselines.iter().for_each(|baseline| text.push_str(&asked(bench, baseline)));
    if !bench.cheapest.is_empty() {
        let best = |best: &Option<(String, f64)>| match best {
            Some((fit, ratio)) => format!("{fit} ({}×)", significant(*ratio, 2)),
            None => "none".to_owned(),
        };
        let rows = bench.cheapest.iter().map(|one| {
            let named = [one.region.clone(), one.baseline.clone()].into_iter();
            named.chain(one.fits.iter().map(best)).collect()
        });
        text.push_str(&table(
            &["cheapest in region", "baseline", "≤ 10 %", "≤ 1 %", "≤ 0.1 %"],
            rows.collect(),
        ));
    }
    bench.goals.iter().for_each(|goal| text.push_str(&goal_line(goal)));
    text
}

fn row(line: &Line) -> Vec<String> {
    let errors: Vec<String> = line
        .error
        .iter()
        .map(|(region, error)| format!("{} ({region})", significant(*error, 3)))
        .collect();
    let (nanoseconds, ratio, quartiles) = match &line.cost.device {
        Measured::Value(timing) => (
            significant(timing.net_ns.median, 3),
            timing.ratio.map_or_else(|| "–".into(), |ratio| significant(ratio.median, 3)),
            timing.ratio.map_or_else(String::new, |ratio| {
                format!("{} – {}", significant(ratio.p25, 3), significant(ratio.p75, 3))
            }),
        ),
        Measured::NotMeasured(_) => ("not measured".into(), "not measured".into(), String::new()),
    };
    vec![
        line.fit.clone(),
        if line.frontier { "●".into() } else { String::new() },
        errors.join(", "),
        nanoseconds,
        ratio,
        quartiles,
        significant(line.cost.lanes_f32_ns, 3),
        significant(line.cost.lanes_f64_ns, 3),
    ]
}

/// A goal beside what was reached.
fn goal_line(goal: &GoalVerdict) -> String {
    let cost = match &goal.cost {
        Measured::Value(ratio) => format!("{}×", significant(*ratio, 3)),
        Measured::NotMeasured(_) => "a cost not measured".to_owned(),
    };
    let met = match goal.met {
        Measured::Value(true) => "met",
        Measured::Value(false) => "NOT MET",
        Measured::NotMeasured(_) => "not measured",
    };
    format!(
        "goal {}: {} ≤ {} over {} at ≤ {}× {}: {} at {cost}: {met}\n",
        goal.fit,
        goal.yardstick,
        significant(goal.error_asked, 3),
        goal.region,
        significant(goal.cost_asked, 3),
        goal.baseline,
        significant(goal.error, 3),
    )
}

/// The largest error of a form over all regions; NaN if one has no value.
fn worst(line: &Line) -> f64 {
    largest(line.error.iter().map(|(_, error)| *error))
}

/// The two questions a renderer asks of the baseline: what is as cheap and better, what is as good
/// and cheaper.
fn asked(bench: &Bench, baseline: &str) -> String {
    let Some(baseline) = bench.forms.iter().find(|line| line.fit == baseline) else {
        return String::new();
    };
    let comparable = |line: &&Line| {
        line.cost.baseline == baseline.fit && line.error.len() == baseline.error.len()
    };
    let ratio = |line: &Line| line.cost.nanoseconds() / baseline.cost.nanoseconds();
    let mut text =
        format!("baseline {}: error {}\n", baseline.fit, significant(worst(baseline), 3));
    let best = bench
        .forms
        .iter()
        .filter(comparable)
        .filter(|line| ratio(line) <= 1.0)
        .min_by(|a, b| worst(a).total_cmp(&worst(b)));
    if let Some(line) = best {
        text.push_str(&format!(
            "most accurate at no more than its cost: {} ({} at {}×)\n",
            line.fit,
            significant(worst(line), 3),
            significant(ratio(line), 3)
        ));
    }
    let cheapest = bench
        .forms
        .iter()
        .filter(comparable)
        .filter(|line| worst(line) < worst(baseline))
        .min_by(|a, b| a.cost.nanoseconds().total_cmp(&b.cost.nanoseconds()));
    if let Some(line) = cheapest {
        text.push_str(&format!(
            "cheapest that is more accurate: {} ({} at {}×)\n",
            line.fit,
            significant(worst(line), 3),
            significant(ratio(line), 3)
        ));
    }
    text
}
