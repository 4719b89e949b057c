//! Error against cost, with the frontier drawn.

use super::{Evidence, bare, device_notice, on_device};
use crate::document::plot::{Axis, Plot, Series};
use crate::document::{Block, Cell, Column, Figure, Highlight, Section, Table, Verdict, number};
use crate::effect::{Effect, Yardstick};
use crate::gpu::Measurement;
use crate::numeric::measured::Measured;
use crate::validate::cheapest::{Cheapest, cheapest};
use crate::validate::cost::{Cost, Costs};
use crate::validate::goals::{GoalVerdict, goals};
use crate::validate::standing::{Answers, Standing, standings};
use crate::validate::study::Study;

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    let Evidence { effect, study, costs, .. } = *evidence;
    let mut section = cost_section("Error against cost", effect, study, costs);
    // The figures stand between what is concluded and the tables.
    let place = section.blocks.iter().position(|block| matches!(block, Block::Table(_)));
    let place = place.unwrap_or(section.blocks.len());
    section.blocks.splice(place..place, figures(evidence).into_iter().map(Block::from));
    section.block(operations(costs))
}

/// What the forms of an effect cost and how they stand: what follows for a renderer, then tables.
pub fn cost_section(title: &str, effect: &Effect, study: &Study, costs: &Costs) -> Section {
    let standings = standings(study, costs);
    let section = Section::new(title);
    let section = match &costs.adapter {
        Measured::Value(adapter) => section.paragraph(format!(
            "Device: {adapter}. Medians of interleaved rounds in one run, net of an empty kernel; \
             ratios refer to {}.",
            baselines(costs)
        )),
        Measured::NotMeasured(_) => device_notice(section, &costs.adapter)
            .paragraph("Costs below are those of the f32 lanes on one core."),
    };
    let answers = groups(costs).into_iter().filter_map(|name| Answers::of(&standings, name));
    let mut section = section
        .block(Block::List(answers.map(|answers| answer(&answers).into()).collect()))
        .block(table(&standings, costs));
    let least = cheapest(study, costs);
    if !least.is_empty() {
        section = section.block(cheapest_table(&least));
    }
    let verdicts = goals(effect, study, costs);
    if !verdicts.is_empty() {
        section = section.block(goal_table(&verdicts));
    }
    section.block(references(costs))
}

/// What is as cheap as the baseline and better, and what is better and cheapest.
fn answer(answers: &Answers<'_>) -> String {
    let Answers { baseline, as_cheap, better } = answers;
    let shown = |one: &Standing<'_>| {
        let ratio = one.cost.nanoseconds() / baseline.cost.nanoseconds();
        format!("`{}` ({} at {}×)", bare(one.fit), number(one.worst(), 3), number(ratio, 3))
    };
    let mut text =
        format!("Baseline `{}`: error {}.", bare(baseline.fit), number(baseline.worst(), 3));
    if let Some(one) = as_cheap {
        text += &format!(" Most accurate at no more than its cost: {}.", shown(one));
    }
    if let Some(one) = better {
        text += &format!(" Cheapest that is more accurate: {}.", shown(one));
    }
    text
}

fn figures(evidence: &Evidence<'_>) -> Vec<Figure> {
    let (effect, costs) = (evidence.effect, evidence.costs);
    let groups = groups(costs);
    let (axis, place) = match &costs.adapter {
        Measured::Value(_) => ("cost on the device", "device"),
        Measured::NotMeasured(_) => ("cost on f32 lanes", "f32 lanes"),
    };
    let figure = |(number, (group, (points, yardstick))): (usize, (&&str, Points<'_>))| {
        let title = match groups.len() {
            1 => format!("{}: error against cost", effect.title),
            _ => format!("Error against cost, beside {}", bare(group)),
        };
        let x = Axis::log(axis, "ns per evaluation");
        let y = Axis::log(format!("{}, f32", yardstick.words()), "1");
        let marked = points.iter().map(|(_, cost, error)| (*cost, *error));
        let plot = Plot::new(title, x, y).series(Series::markers("forms", marked)).with_frontier();
        let plot = points
            .iter()
            .fold(plot, |plot, (name, cost, error)| plot.annotate(*cost, *error, bare(name)));
        let slug = effect.name.replace('_', "-");
        let stem = match number {
            0 => format!("{slug}-cost"),
            _ => format!("{slug}-cost-{number}"),
        };
        let caption = format!(
            "Error against cost ({place}); the staircase joins the forms that no other beats in both."
        );
        Figure::new(stem, caption, plot)
    };
    let drawn = groups.iter().map(|group| (group, errors(evidence, group)));
    drawn.filter(|(_, (points, _))| points.len() > 1).enumerate().map(figure).collect()
}

/// Name, cost and error of fits, and what error that is.
type Points<'a> = (Vec<(&'a str, f64, f64)>, Yardstick);

/// Every timed fit of the group that refers to `baseline`: over its first region for fits to a
/// reference, over all members for fits to a family.
fn errors<'a>(evidence: &Evidence<'a>, baseline: &str) -> Points<'a> {
    let study = evidence.study;
    let mut yardstick = Yardstick::MaxAbs;
    let timed = evidence.costs.forms.iter().filter(|cost| cost.baseline == baseline);
    let points = timed.filter_map(|cost| {
        let single = study.fits.iter().find(|fit| fit.outcome.name == cost.name);
        let error = match single {
            Some(fit) if study.families.is_empty() => {
                let accuracy = &fit.regions.first()?.1;
                yardstick = accuracy.yardstick;
                accuracy.headline()
            }
            _ => {
                let mut forms = study.families.iter().flat_map(|family| &family.forms);
                forms.find(|form| form.fit == cost.name)?.max_abs
            }
        };
        Some((cost.name.as_str(), cost.nanoseconds(), error))
    });
    (points.collect(), yardstick)
}

/// The baselines of the groups of forms that are compared, in order.
fn groups(costs: &Costs) -> Vec<&str> {
    let mut groups: Vec<&str> = costs.forms.iter().map(|cost| cost.baseline.as_str()).collect();
    groups.dedup();
    groups
}

fn baselines(costs: &Costs) -> String {
    let names: Vec<String> =
        groups(costs).into_iter().map(|name| format!("`{}`", bare(name))).collect();
    match names.as_slice() {
        [one] => one.clone(),
        _ => format!("the one of {} that is fitted to the same reference", names.join(", ")),
    }
}

fn table(standings: &[Standing<'_>], costs: &Costs) -> Table {
    let columns = vec![
        Column::code("fit"),
        Column::text("frontier"),
        Column::text("error, f32"),
        Column::number("device", "ns"),
        Column::text("quartiles [ns]"),
        Column::number("ratio to baseline", "1"),
        Column::text("quartiles of the ratio"),
        Column::number("f32 lanes", "ns"),
        Column::number("f64 lanes", "ns"),
    ];
    let has_device = costs.adapter.value().is_some();
    let row = |one: &Standing<'_>| {
        let errors = one.error.iter();
        let errors: Vec<String> =
            errors.map(|(region, error)| format!("{} ({region})", number(*error, 3))).collect();
        let mut row = vec![
            Cell::text(bare(one.fit)),
            Cell::text(if one.frontier { "●" } else { "" }),
            Cell::text(errors.join(", ")),
        ];
        row.extend(timing(&one.cost.device, has_device));
        row.push(Cell::number(one.cost.lanes_f32_ns, 3));
        row.push(Cell::number(one.cost.lanes_f64_ns, 3));
        if one.fit == one.cost.baseline {
            row = row.into_iter().map(|cell| cell.highlighted(Highlight::Subject)).collect();
        }
        row
    };
    Table::new(
        "Cost per evaluation, the cheapest first. Lanes: one core, interpreted from naga's IR. On \
         the frontier: no fit to the same reference errs less at no more cost.",
        columns,
    )
    .with_rows(standings.iter().map(row))
}

/// Time on the device, its quartiles, the ratio to the baseline, its quartiles.
fn timing(device: &Measured<Measurement>, has_device: bool) -> [Cell; 4] {
    let span = |from: f64, to: f64| Cell::text(format!("{} – {}", number(from, 3), number(to, 3)));
    match device {
        Measured::Value(Measurement { net_ns, ratio, .. }) => [
            Cell::number(net_ns.median, 3),
            span(net_ns.p25, net_ns.p75),
            Cell::number_or(ratio.map(|ratio| ratio.median), 3, "no baseline to refer to"),
            ratio.map_or_else(|| Cell::text(""), |ratio| span(ratio.p25, ratio.p75)),
        ],
        // A form that a device there was did not measure says why.
        Measured::NotMeasured(reason) => {
            let why = if has_device { reason.as_str() } else { "no device" };
            [Cell::missing(why), Cell::text(""), Cell::missing(why), Cell::text("")]
        }
    }
}

fn operations(costs: &Costs) -> Table {
    let columns = vec![
        Column::code("fit"),
        Column::number("add, multiply", "1"),
        Column::number("divide, root", "1"),
        Column::number("elementary", "1"),
        Column::number("branches", "1"),
        Column::number("table reads", "1"),
    ];
    let row = |Cost { name, operations: of, .. }: &Cost| {
        let counts = [of.arithmetic, of.divide_sqrt, of.elementary, of.branches, of.table_reads];
        let counts = counts.map(|count| Cell::count(count as usize));
        [Cell::text(bare(name))].into_iter().chain(counts).collect()
    };
    Table::new("Operations in the text.", columns).with_rows(costs.forms.iter().map(row))
}

fn cheapest_table(least: &[Cheapest]) -> Table {
    let columns = vec![
        Column::text("region"),
        Column::code("baseline"),
        Column::text("≤ 10 %"),
        Column::text("≤ 1 %"),
        Column::text("≤ 0.1 %"),
    ];
    let best = |best: &Option<(String, f64)>| match best {
        Some((fit, ratio)) => Cell::text(format!("`{}` ({}×)", bare(fit), number(*ratio, 2))),
        None => Cell::text("none"),
    };
    Table::new(
        "The cheapest fit for an error, region by region, with its cost relative to the baseline in \
         brackets. Errors in f32 by the yardstick of the region.",
        columns,
    )
    .with_rows(least.iter().map(|one| {
        let named = [Cell::text(one.region.as_str()), Cell::text(bare(&one.baseline))];
        named.into_iter().chain(one.fits.iter().map(best)).collect()
    }))
}

fn goal_table(verdicts: &[GoalVerdict]) -> Table {
    let columns = vec![
        Column::code("fit"),
        Column::text("error, region"),
        Column::number("asked", "1"),
        Column::number("reached", "1"),
        Column::code("baseline"),
        Column::number("cost asked", "1"),
        Column::number("cost", "1"),
        Column::verdict("verdict"),
        Column::text("why"),
    ];
    Table::new(
        "What was set out to be reached, beside what is reached: error on the device (in f32 where \
         there is none) and cost relative to the baseline.",
        columns,
    )
    .with_rows(verdicts.iter().map(|goal| {
        vec![
            Cell::text(bare(&goal.fit)),
            Cell::text(format!("{}, {}", goal.yardstick, goal.region)),
            Cell::number(goal.error_asked, 3),
            Cell::number(goal.error, 3),
            Cell::text(bare(&goal.baseline)),
            Cell::number(goal.cost_asked, 3),
            on_device(&goal.cost, 3),
            match &goal.met {
                Measured::Value(true) => Cell::verdict_as(Verdict::Pass, "met"),
                Measured::Value(false) => Cell::verdict_as(Verdict::Fail, "not met"),
                Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
            },
            Cell::text(goal.why.as_str()),
        ]
    }))
}

fn references(costs: &Costs) -> Table {
    let columns = vec![Column::code("reference"), Column::number("f64", "ns")];
    Table::new("Cost of the references, one core, for scale.", columns).with_rows(
        costs
            .references
            .iter()
            .map(|one| vec![Cell::text(one.name.as_str()), Cell::number(one.ns, 3)]),
    )
}
