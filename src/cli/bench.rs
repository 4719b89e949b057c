//! `bench`: what forms and references cost, beside their error.

use anyhow::bail;
use clap::Args;
use serde::Serialize;

use super::Ending;
use super::context::Context;
use crate::gpu::TimingOptions;
use crate::report::pages::{cost_section, draws_section};
use crate::run::{Studied, write_costs};
use crate::validate::cost::Costs;
use crate::validate::draws::DrawsStudy;
use crate::validate::standing::{Cheapest, GoalVerdict, Standing, cheapest, goals, standings};
use crate::validate::study::CandidateStudy;

const MORE: &str = "\
With --target the machine code of a GPU is counted, which need not be there: rdna2, rdna3 and gcn4
(AMD, by Mesa's RADV), the same on every run. `device` times on the adapter that is there; `all` is a
table of every target, relative to the published baseline. The cost is the inverse throughput: issue
cycles of a wave per evaluation, net of a kernel without the form, an instruction like sin or a root
at a quarter of the rate counted four times. It is what a full screen pays, whose waves hide latency;
latency is given beside it. With --json a list of {name, error, cost, …}.

Without --target forms are timed in one run, interleaved, on f64 and f32 lanes (one core) and, where there is an
adapter, on the device net of an empty kernel. Quote the ratios: the nanoseconds are this machine's.
A form on the frontier is beaten by no other in both error and cost.

Examples:
  striae bench sine_integral
  striae bench sine_integral/auxiliary_lean --target rdna2 --json
  striae bench 'area_light/band_*' --target all";

/// Cost of forms and references, against their error
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Effects [default: all]; with --target also candidates, result files and patterns with `*`
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// What the costs are of: rdna2, rdna3, gcn4, device or all
    #[arg(long, value_name = "TARGET")]
    target: Option<String>,
    /// Record the costs in reports/costs/, in a file named after the target or the adapter
    #[arg(long)]
    record: bool,
}

#[derive(Debug, Serialize)]
struct Bench<'a> {
    effect: &'a str,
    costs: &'a Costs,
    forms: Vec<Standing<'a>>,
    cheapest: Vec<Cheapest>,
    goals: Vec<GoalVerdict>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    draws: Vec<DrawsIn<'a>>,
}

/// Draws of a form in a region.
#[derive(Debug, Serialize)]
struct DrawsIn<'a> {
    fit: &'a str,
    region: &'a str,
    #[serde(flatten)]
    draws: &'a DrawsStudy,
}

impl<'a> Bench<'a> {
    fn of(studied: &'a Studied) -> Self {
        let Studied { effect, study, costs, .. } = studied;
        Self {
            effect: effect.name,
            costs,
            forms: standings(study, costs),
            cheapest: cheapest(study, costs),
            goals: goals(effect, study, costs),
            draws: study.candidates.iter().flat_map(draws_of).collect(),
        }
    }
}

fn draws_of(of: &CandidateStudy) -> impl Iterator<Item = DrawsIn<'_>> {
    of.draws.iter().map(|(region, draws)| DrawsIn { fit: &of.name, region, draws })
}

/// Times, and prints the frontier; counts, and prints the costs.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    if arguments.record && !arguments.names.is_empty() {
        bail!("--record is for every effect together: name none");
    }
    if let Some(target) = &arguments.target {
        return super::bench_targets::run(target, &arguments.names, arguments.record, context);
    }
    let effects = context.effects(&arguments.names)?;
    let mut run = context.run()?;
    run.timing = TimingOptions::default();
    let studied = run.studies(&effects, &|_| ())?;
    if arguments.record {
        let Some(device) = run.device.value() else {
            bail!("--record needs a device, and there is none; or --target");
        };
        let path = write_costs(&run.project.costs(), device.description(), &studied)?;
        context.output.note(&format!("costs: {}", run.project.shown(&path)));
    }
    let benches: Vec<Bench<'_>> = studied.iter().map(Bench::of).collect();
    context.output.sections(&benches, || {
        let section = |of: &Studied| cost_section(of.effect.name, of.effect, &of.study, &of.costs);
        let sections = studied.iter().map(|of| [Some(section(of)), draws_section(&of.study)]);
        sections.flatten().flatten().collect()
    })
}
