//! Error against cost, with the frontier drawn.

use super::{Evidence, bare, count, device_notice, no_device};
use crate::document::plot::{Axis, Plot, Series};
use crate::document::{Cell, Column, Figure, Highlight, Section, Table, Verdict};
use crate::effect::Yardstick;
use crate::numeric::measured::Measured;
use crate::validate::cheapest::{Cheapest, cheapest};
use crate::validate::cost::{Cost, Costs};
use crate::validate::goals::{GoalVerdict, goals};

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    let costs = evidence.costs;
    let mut section = Section::new("Error against cost");
    section = match &costs.adapter {
        Measured::Value(adapter) => section.paragraph(format!(
            "Device: {adapter}. Medians of interleaved rounds in one run, net of an empty kernel; \
             ratios refer to {}.",
            baselines(costs)
        )),
        Measured::NotMeasured(_) => device_notice(section, &costs.adapter)
            .paragraph("Costs below are those of the f32 lanes on one core."),
    };
    let groups: Vec<&str> = groups(costs);
    let drawn = groups
        .iter()
        .map(|group| (group, errors(evidence, group)))
        .filter(|(_, (points, _))| points.len() > 1);
    for (number, (group, (points, yardstick))) in drawn.enumerate() {
        let (axis, where_measured) = match &costs.adapter {
            Measured::Value(_) => (Axis::log("cost on the device", "ns per evaluation"), "device"),
            Measured::NotMeasured(_) => {
                (Axis::log("cost on f32 lanes", "ns per evaluation"), "f32 lanes")
            }
        };
        let mut plot = Plot::new(
            match groups.len() {
                1 => format!("{}: error against cost", evidence.effect.title),
                _ => format!("Error against cost, beside {}", bare(group)),
            },
            axis,
            Axis::log(format!("{}, f32", yardstick.words()), "1"),
        )
        .series(Series::markers("forms", points.iter().map(|(_, cost, error)| (*cost, *error))))
        .with_frontier();
        for (name, cost, error) in &points {
            plot = plot.annotate(*cost, *error, bare(name));
        }
        section = section.block(Figure::new(
            match number {
                0 => format!("{}-cost", evidence.effect.name.replace('_', "-")),
                _ => format!("{}-cost-{number}", evidence.effect.name.replace('_', "-")),
            },
            format!(
                "Error against cost ({where_measured}); the staircase joins the forms that no other \
                 beats in both."
            ),
            plot,
        ));
    }
    section = section.block(table(costs)).block(references(costs));
    let least = cheapest(evidence.study, costs);
    if !least.is_empty() {
        section = section.block(cheapest_table(&least));
    }
    let verdicts = goals(evidence.effect, evidence.study, costs);
    if verdicts.is_empty() { section } else { section.block(goal_table(&verdicts)) }
}

fn cheapest_table(least: &[Cheapest]) -> Table {
    let mut table = Table::new(
        "The cheapest fit for an error, region by region, with its cost relative to the baseline in \
         brackets. Errors in f32 by the yardstick of the region.",
        vec![
            Column::text("region"),
            Column::code("baseline"),
            Column::text("≤ 10 %"),
            Column::text("≤ 1 %"),
            Column::text("≤ 0.1 %"),
        ],
    );
    for one in least {
        let mut row = vec![Cell::text(one.region.clone()), Cell::text(bare(&one.baseline))];
        row.extend(one.fits.iter().map(|best| match best {
            Some((fit, ratio)) => {
                let ratio = crate::document::cell::number(*ratio, 2);
                Cell::text(format!("`{}` ({ratio}×)", bare(fit)))
            }
            None => Cell::text("none"),
        }));
        table.push(row);
    }
    table
}

fn goal_table(verdicts: &[GoalVerdict]) -> Table {
    let mut table = Table::new(
        "What was set out to be reached, beside what is reached: error on the device (in f32 where \
         there is none) and cost relative to the baseline.",
        vec![
            Column::code("fit"),
            Column::text("error, region"),
            Column::number("asked", "1"),
            Column::number("reached", "1"),
            Column::code("baseline"),
            Column::number("cost asked", "1"),
            Column::number("cost", "1"),
            Column::verdict("verdict"),
            Column::text("why"),
        ],
    );
    for goal in verdicts {
        table.push(vec![
            Cell::text(bare(&goal.fit)),
            Cell::text(format!("{}, {}", goal.yardstick, goal.region)),
            Cell::number(goal.error_asked, 3),
            Cell::number(goal.error, 3),
            Cell::text(bare(&goal.baseline)),
            Cell::number(goal.cost_asked, 3),
            match &goal.cost {
                Measured::Value(ratio) => Cell::number(*ratio, 3),
                Measured::NotMeasured(_) => no_device(),
            },
            match &goal.met {
                Measured::Value(true) => Cell::verdict_as(Verdict::Pass, "met"),
                Measured::Value(false) => Cell::verdict_as(Verdict::Fail, "not met"),
                Measured::NotMeasured(reason) => Cell::missing(reason.clone()),
            },
            Cell::text(goal.why.clone()),
        ]);
    }
    table
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

/// Name, cost and error of every timed fit of the group that refers to `baseline`: over its first
/// region for fits to a reference, over all members for fits to a family; and what error that is.
fn errors<'a>(evidence: &Evidence<'a>, baseline: &str) -> (Vec<(&'a str, f64, f64)>, Yardstick) {
    let study = evidence.study;
    let mut yardstick = Yardstick::MaxAbs;
    let points = evidence
        .costs
        .forms
        .iter()
        .filter(|cost| cost.baseline == baseline)
        .filter_map(|cost| {
            let single = study.candidates.iter().find(|fit| fit.name == cost.name);
            let error = match single {
                Some(fit) if study.families.is_empty() => {
                    let accuracy = &fit.regions.first()?.1;
                    yardstick = accuracy.yardstick;
                    accuracy.headline()
                }
                _ => {
                    study
                        .families
                        .iter()
                        .flat_map(|family| &family.forms)
                        .find(|form| form.fit == cost.name)?
                        .max_abs
                }
            };
            Some((cost.name.as_str(), cost.nanoseconds(), error))
        })
        .collect();
    (points, yardstick)
}

fn table(costs: &Costs) -> Table {
    let mut table = Table::new(
        "Cost per evaluation. Lanes: one core, interpreted from naga's IR.",
        vec![
            Column::code("fit"),
            Column::number("add, multiply", "1"),
            Column::number("divide, root", "1"),
            Column::number("elementary", "1"),
            Column::number("branches", "1"),
            Column::number("table reads", "1"),
            Column::number("f64 lanes", "ns"),
            Column::number("f32 lanes", "ns"),
            Column::number("device", "ns"),
            Column::number("device, quartiles", "ns"),
            Column::number("ratio to baseline", "1"),
        ],
    );
    for cost in &costs.forms {
        table.push(row(cost, costs.adapter.value().is_some()));
    }
    table
}

fn row(cost: &Cost, has_device: bool) -> Vec<Cell> {
    let operations = &cost.operations;
    let mut row = vec![
        Cell::text(bare(&cost.name)),
        count(operations.arithmetic as usize),
        count(operations.divide_sqrt as usize),
        count(operations.elementary as usize),
        count(operations.branches as usize),
        count(operations.table_reads as usize),
        Cell::number(cost.lanes_f64_ns, 3),
        Cell::number(cost.lanes_f32_ns, 3),
    ];
    match &cost.device {
        Measured::Value(timing) => row.extend([
            Cell::number(timing.net_ns.median, 3),
            Cell::text(format!("{:.3} – {:.3}", timing.net_ns.p25, timing.net_ns.p75)),
            Cell::number_or(timing.ratio.map(|ratio| ratio.median), 3, "no baseline to refer to"),
        ]),
        // A form that a device there was did not measure says why.
        Measured::NotMeasured(reason) if has_device => {
            row.extend((0..3).map(|_| Cell::missing(reason.clone())));
        }
        Measured::NotMeasured(_) => row.extend((0..3).map(|_| no_device())),
    }
    if cost.name == cost.baseline {
        row = row.into_iter().map(|cell| cell.highlighted(Highlight::Subject)).collect();
    }
    row
}

fn references(costs: &Costs) -> Table {
    let mut table = Table::new(
        "Cost of the references, one core, for scale.",
        vec![Column::code("reference"), Column::number("f64", "ns")],
    );
    for reference in &costs.references {
        table.push(vec![Cell::text(reference.name.clone()), Cell::number(reference.ns, 3)]);
    }
    table
}
