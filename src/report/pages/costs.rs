//! Error against cost, with the frontier drawn.

use super::{Evidence, bare, count, device_notice, no_device};
use crate::report::document::{Cell, Column, Figure, Highlight, Section, Table};
use crate::report::plot::{Axis, Plot, Series};
use crate::validate::cost::{Cost, Costs};
use crate::validate::measured::Measured;

pub(super) fn section(evidence: &Evidence<'_>) -> Section {
    let costs = evidence.costs;
    let mut section = Section::new("Error against cost");
    section = match &costs.adapter {
        Measured::Value(adapter) => section.paragraph(format!(
            "Device: {adapter}. Medians of interleaved rounds in one run, net of an empty kernel; \
             ratios refer to `{}`.",
            bare(&costs.baseline)
        )),
        Measured::NotMeasured(_) => device_notice(section, &costs.adapter)
            .paragraph("Costs below are those of the f32 lanes on one core."),
    };
    let points = errors(evidence);
    if points.len() > 1 {
        let (axis, where_measured) = match &costs.adapter {
            Measured::Value(_) => (Axis::log("cost on the device", "ns per evaluation"), "device"),
            Measured::NotMeasured(_) => {
                (Axis::log("cost on f32 lanes", "ns per evaluation"), "f32 lanes")
            }
        };
        let mut plot = Plot::new(
            format!("{}: error against cost", evidence.effect.title),
            axis,
            Axis::log("max |error|, f32", "1"),
        )
        .series(Series::markers("forms", points.iter().map(|(_, cost, error)| (*cost, *error))))
        .with_frontier();
        for (name, cost, error) in &points {
            plot = plot.annotate(*cost, *error, bare(name));
        }
        section = section.block(Figure::new(
            format!("{}-cost", evidence.effect.name.replace('_', "-")),
            format!(
                "Largest error against cost ({where_measured}); the staircase joins the forms that no \
                 other beats in both."
            ),
            plot,
        ));
    }
    section.block(table(costs)).block(references(costs))
}

/// Name, cost and largest error of every timed fit: over the effect's first region for fits to a
/// reference, over all members for fits to a family.
fn errors<'a>(evidence: &Evidence<'a>) -> Vec<(&'a str, f64, f64)> {
    let study = evidence.study;
    evidence
        .costs
        .forms
        .iter()
        .filter_map(|cost| {
            let single = study.fits.iter().find(|fit| fit.outcome.name == cost.name);
            let error = match single {
                Some(fit) if study.families.is_empty() => fit.regions.first()?.1.f32.max_abs,
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
        .collect()
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
        table.push(row(cost, &costs.baseline, costs.adapter.value().is_some()));
    }
    table
}

fn row(cost: &Cost, baseline: &str, has_device: bool) -> Vec<Cell> {
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
    if cost.name == baseline {
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
