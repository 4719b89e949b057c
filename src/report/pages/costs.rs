//! Error against cost, with the frontier drawn.

use super::{EffectEvidence, bare, device_notice};
use crate::counted::{CountedCost, GpuTarget};
use crate::document::plot::{Plot, PlotAxis};
use crate::document::{
    Block, Cell, Figure, NoticeLevel, PrintedColumn, PrintedTable, Section, Verdict, number,
};
use crate::effect::{Effect, Yardstick};
use crate::gpu::{Spread, TimingFigures};
use crate::numeric::measured::Measured;
use crate::validate::cost::{Cost, Costs, RANKED_ON};
use crate::validate::standing::{
    Answers, Cheapest, GoalVerdict, LIMITS, Standing, cheapest, goals, standings,
};
use crate::validate::study::Study;

pub(super) fn section(evidence: &EffectEvidence<'_>) -> Section {
    let EffectEvidence { effect, study, costs, .. } = *evidence;
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
    let section = Section::new(title).paragraph(format!(
        "Counted costs: issue cycles of a wave per evaluation in the machine code of a GPU, net of a kernel \
         without the form. They rank the forms, on {RANKED_ON}, and goals are judged on them; ratios \
         refer to {}.",
        baselines(costs)
    ));
    let section = uncounted(costs)
        .into_iter()
        .fold(section, |section, text| section.notice(NoticeLevel::NotMeasured, text));
    let section = match &costs.adapter {
        Measured::Value(adapter) => section.paragraph(format!(
            "Times: medians of interleaved rounds in one run on {adapter}, net of an empty kernel."
        )),
        Measured::NotMeasured(_) => device_notice(section, &costs.adapter),
    };
    let answers = groups(costs).into_iter().filter_map(|name| Answers::of(&standings, name));
    let (least, verdicts) = (cheapest(study, costs), goals(effect, study, costs));
    section
        .list(answers.map(|answers| answer(&answers)))
        .block(counted_table(&standings, costs))
        .block(timed_table(&standings, costs))
        .blocks((!least.is_empty()).then(|| cheapest_table(&least)))
        .blocks((!verdicts.is_empty()).then(|| goal_table(&verdicts)))
        .block(references(costs))
}

/// Why forms have no counted cost, once per reason.
fn uncounted(costs: &Costs) -> Vec<String> {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for cost in &costs.forms {
        for (target, counted) in &cost.counted {
            let Measured::NotMeasured(reason) = counted else { continue };
            let at = reasons.iter().position(|(known, _)| known == reason);
            let at = at.unwrap_or_else(|| {
                reasons.push((reason, Vec::new()));
                reasons.len() - 1
            });
            let target = target.to_string();
            if !reasons[at].1.contains(&target) {
                reasons[at].1.push(target);
            }
        }
    }
    let line = |(reason, targets): &(&str, Vec<String>)| {
        format!("Not counted on {}: {reason}", targets.join(", "))
    };
    reasons.iter().map(line).collect()
}

/// What is as cheap as the baseline and better, and what is better and cheapest.
fn answer(answers: &Answers<'_>) -> String {
    let Answers { baseline, as_cheap, better } = answers;
    let shown = |one: &Standing<'_>| {
        let ratio = one.ranked / baseline.ranked;
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

fn figures(evidence: &EffectEvidence<'_>) -> Vec<Figure> {
    let (effect, costs) = (evidence.effect, evidence.costs);
    let groups = groups(costs);
    let figure = |(number, (group, (points, yardstick))): (usize, (&&str, Points<'_>))| {
        let title = match groups.len() {
            1 => format!("{}: error against cost", effect.title),
            _ => format!("Error against cost, beside {}", bare(group)),
        };
        let basis = costs.basis(group);
        let x = PlotAxis::log(basis.words(), format!("{} per evaluation", basis.unit()));
        let y = PlotAxis::log(format!("{}, f32", yardstick.words()), "1");
        let plot = Plot::new(title, x, y).with_labelled("forms", &points);
        let slug = effect.name.replace('_', "-");
        let stem = match number {
            0 => format!("{slug}-cost"),
            _ => format!("{slug}-cost-{number}"),
        };
        let caption = format!(
            "Error against {}; the staircase joins the forms that no other beats in both.",
            basis.words()
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
fn errors<'a>(evidence: &EffectEvidence<'a>, baseline: &str) -> Points<'a> {
    let study = evidence.study;
    let mut yardstick = Yardstick::MaxAbs;
    let costs = evidence.costs;
    // What costs as good as nothing has no place on a scale of ratios.
    let placed = |cost: &&Cost| cost.baseline == baseline && costs.ranked(cost) > 0.0;
    let timed = costs.forms.iter().filter(placed);
    let points = timed.filter_map(|cost| {
        let single = study.candidates.iter().find(|fit| fit.name == cost.name);
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
        Some((bare(&cost.name), costs.ranked(cost), error))
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

fn counted_table(standings: &[Standing<'_>], costs: &Costs) -> PrintedTable {
    let counted = |of: fn(&CountedCost) -> Option<f64>| {
        move |one: &&Standing<'_>| {
            Cell::number_or(one.cost.on(RANKED_ON).and_then(of), 4, "not counted")
        }
    };
    PrintedTable::over(
        "Cost per evaluation, counted: relative to the baseline on each target, then the figures of the \
         first. The cheapest first. On the frontier: no fit to the same reference errs less at no more \
         cost.",
        standings,
    )
    .code("fit", |one| bare(one.fit))
    .text("frontier", |one| if one.frontier { "●" } else { "" })
    .text("error, f32", errors_of)
    .columns(
        GpuTarget::ALL,
        |target| PrintedColumn::number(format!("ratio, {target}"), "1"),
        |one, target| match costs.ratio_on(*target, one.cost) {
            Measured::Value(ratio) => Cell::number(ratio, 3),
            Measured::NotMeasured(_) if one.cost.on(*target).is_some() => Cell::missing("none"),
            Measured::NotMeasured(_) => Cell::missing("not counted"),
        },
    )
    .number("cost", "cycles of a wave", counted(|of| Some(of.cost)))
    .number("latency", "cycles", counted(|of| of.latency))
    .number("instructions", "1", counted(|of| Some(of.instructions)))
    .number("quarter rate", "1", counted(|of| Some(of.quarter_rate)))
    .number("registers", "1", counted(|of| Some(of.registers)))
    .subject(|one| one.fit == one.cost.baseline)
    .table()
}

fn errors_of(one: &&Standing<'_>) -> Cell {
    let errors = one.error.iter();
    let errors = errors.map(|(region, error)| format!("{} ({region})", number(*error, 3)));
    Cell::text(errors.collect::<Vec<_>>().join(", "))
}

fn timed_table(standings: &[Standing<'_>], costs: &Costs) -> PrintedTable {
    let has_device = costs.adapter.value().is_some();
    let timed = |of: fn(&TimingFigures) -> Cell| {
        move |one: &&Standing<'_>| match &one.cost.device {
            Measured::Value(timing) => of(timing),
            // A form that a device there was did not measure says why.
            Measured::NotMeasured(why) if has_device => Cell::missing(why.as_str()),
            Measured::NotMeasured(_) => Cell::missing("no device"),
        }
    };
    PrintedTable::over(
        "Time per evaluation in this run, which holds for this machine. Lanes: one core, interpreted \
         from naga's IR.",
        standings,
    )
    .code("fit", |one| bare(one.fit))
    .number("device", "ns", timed(|of| Cell::number(of.net_ns.median, 3)))
    .text("quartiles [ns]", timed(|of| quartiles(Some(of.net_ns))))
    .number(
        "ratio to baseline",
        "1",
        timed(|of| {
            Cell::number_or(of.ratio.map(|ratio| ratio.median), 3, "no baseline to refer to")
        }),
    )
    .text("quartiles of the ratio", timed(|of| quartiles(of.ratio)))
    .number("f32 lanes", "ns", |one| one.cost.lanes_f32_ns)
    .number("f64 lanes", "ns", |one| one.cost.lanes_f64_ns)
    .subject(|one| one.fit == one.cost.baseline)
    .table()
}

fn quartiles(of: Option<Spread>) -> Cell {
    let shown = |of: Spread| format!("{} – {}", number(of.p25, 3), number(of.p75, 3));
    Cell::text(of.map(shown).unwrap_or_default())
}

fn operations(costs: &Costs) -> PrintedTable {
    let kinds = ["add, multiply", "divide, root", "elementary", "branches", "table reads"];
    PrintedTable::over("Operations in the text.", &costs.forms)
        .code("fit", |cost| bare(&cost.name))
        .columns(
            kinds.into_iter().enumerate(),
            |(_, kind)| PrintedColumn::number(*kind, "1"),
            |cost, (at, _)| {
                let of = &cost.operations;
                let counts =
                    [of.arithmetic, of.divide_sqrt, of.elementary, of.branches, of.table_reads];
                Cell::count(counts[*at] as usize)
            },
        )
        .table()
}

fn cheapest_table(least: &[Cheapest]) -> PrintedTable {
    let best = |best: &Option<(String, f64)>| match best {
        Some((fit, ratio)) => Cell::text(format!("`{}` ({}×)", bare(fit), number(*ratio, 2))),
        None => Cell::text("none"),
    };
    PrintedTable::over(
        "The cheapest fit for an error, region by region, with its cost relative to the baseline in \
         brackets. Errors in f32 by the yardstick of the region.",
        least,
    )
    .text("region", |of| of.region.as_str())
    .code("baseline", |of| bare(&of.baseline))
    .columns(
        LIMITS.into_iter().enumerate(),
        |(_, limit)| PrintedColumn::text(format!("≤ {} %", 100.0 * limit)),
        |of, (at, _)| best(&of.fits[*at]),
    )
    .table()
}

fn goal_table(verdicts: &[GoalVerdict]) -> PrintedTable {
    PrintedTable::over(
        format!(
            "What was set out to be reached, beside what is reached: error on the device (in f32 where \
             there is none) and cost relative to the baseline, counted on {RANKED_ON}."
        ),
        verdicts,
    )
    .code("fit", |goal| bare(&goal.fit))
    .text("error, region", |goal| format!("{}, {}", goal.yardstick, goal.region))
    .number("asked", "1", |goal| goal.error_asked)
    .number("reached", "1", |goal| goal.error)
    .code("baseline", |goal| bare(&goal.baseline))
    .number("cost asked", "1", |goal| goal.cost_asked)
    .number("cost", "1", |goal| match &goal.cost {
        Measured::Value(ratio) => Cell::number(*ratio, 3),
        Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
    })
    .verdict("verdict", |goal| match &goal.met {
        Measured::Value(true) => Cell::verdict_as(Verdict::Pass, "met"),
        Measured::Value(false) => Cell::verdict_as(Verdict::Fail, "not met"),
        Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
    })
    .text("why", |goal| goal.why.as_str())
    .table()
}

fn references(costs: &Costs) -> PrintedTable {
    PrintedTable::over("Cost of the references, one core, for scale.", &costs.references)
        .code("reference", |of| of.name.as_str())
        .number("f64", "ns", |of| of.ns)
        .table()
}
