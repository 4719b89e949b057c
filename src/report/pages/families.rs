//! Fits to families of measured tables, and what finer fitting is worth.

use super::{Evidence, bare, count, place};
use crate::document::plot::{Axis, Plot, Series};
use crate::document::{Block, Cell, Column, Figure, Section, Table};
use crate::effect::{Family, Member};
use crate::project::Approximated;
use crate::validate::ValidateError;
use crate::validate::curves::over_member;
use crate::validate::family::{Choice, choices, group_rms};
use crate::validate::study::FamilyStudy;

/// Errors below this magnitude are drawn linearly, larger ones by ratio: the forms span decades.
const LINEAR_BELOW: f64 = 1e-4;
/// Groups drawn as error curves: the ones on which the forms differ most.
const DRAWN: usize = 6;

pub(super) fn section(
    evidence: &Evidence<'_>,
    family: &FamilyStudy,
) -> Result<Section, ValidateError> {
    let description =
        position(evidence, &family.family).map_or("", |(_, family)| family.description);
    let cost: Vec<f64> = family.forms.iter().map(|form| cost(evidence, &form.fit)).collect();
    let choices = choices(&family.forms, &family.spreads, &cost);
    let mut section = Section::new(format!("Family: {}", family.family.replace('_', " ")))
        .paragraph(description)
        .block(forms_table(family, &cost))
        .block(choice_table(&choices))
        .paragraph(
            "Where sources disagree by more than a form errs, a finer form fits one laboratory's noise: \
             it is not worth its cost.",
        )
        .block(spread_table(family))
        .block(group_table(family));
    if let Some((position, registered)) = position(evidence, &family.family)
        && let Some(members) = evidence.members.get(position)
    {
        section = section.block(figure(evidence, family, registered, members)?);
    }
    Ok(section.block(Block::Details {
        summary: "Every member, every form: RMS in f32 on held-out points".into(),
        blocks: vec![Block::Table(member_table(family))],
    }))
}

fn position<'a>(evidence: &Evidence<'a>, name: &str) -> Option<(usize, &'a Family)> {
    evidence.effect.families.iter().enumerate().find(|(_, family)| family.name == name)
}

fn cost(evidence: &Evidence<'_>, fit: &str) -> f64 {
    evidence
        .costs
        .forms
        .iter()
        .find(|cost| cost.name == fit)
        .map_or(f64::INFINITY, |cost| cost.nanoseconds())
}

fn forms_table(family: &FamilyStudy, cost: &[f64]) -> Table {
    let mut table = Table::new(
        "Every form over all members, in f32, on held-out points with grazing and the dips among them. \
         Spread: half the difference of a constant between sources of one material, RMS over \
         materials and bands: what a constant is known to.",
        vec![
            Column::code("fit"),
            Column::number("free constants", "1"),
            Column::number("RMS", "1"),
            Column::number("max", "1"),
            Column::text("worst member"),
            Column::text("where"),
            Column::number("cost", "ns"),
            Column::text("spread of the constants between sources"),
        ],
    );
    let mut order: Vec<usize> = (0..family.forms.len()).collect();
    order.sort_by(|a, b| family.forms[*b].rms.total_cmp(&family.forms[*a].rms));
    for at in order {
        let form = &family.forms[at];
        let spread = form
            .constant_spread
            .iter()
            .map(|(name, half)| format!("{name} ± {}", crate::document::cell::number(*half, 2)))
            .collect::<Vec<_>>()
            .join(", ");
        table.push(vec![
            Cell::text(bare(&form.fit)),
            count(form.free),
            Cell::number(form.rms, 3),
            Cell::number(form.max_abs, 3),
            Cell::text(form.max_member.clone()),
            Cell::text(place(&form.max_at)),
            Cell::number(cost[at], 3),
            Cell::text(if spread.is_empty() { "–".into() } else { spread }),
        ]);
    }
    table
}

fn choice_table(choices: &[Choice]) -> Table {
    let mut table = Table::new(
        "For each material, the cheapest form whose error stays within the spread of its sources.",
        vec![
            Column::text("material"),
            Column::number("spread of the sources, RMS", "1"),
            Column::code("cheapest within it"),
            Column::number("its RMS error", "1"),
            Column::text("because"),
        ],
    );
    for choice in choices {
        table.push(vec![
            Cell::text(choice.group.clone()),
            Cell::number_or(choice.spread_rms, 3, "one source"),
            choice.cheapest.as_deref().map_or_else(
                || Cell::text(if choice.spread_rms.is_some() { "none" } else { "–" }),
                |fit| Cell::text(bare(fit)),
            ),
            choice.rms.map_or_else(|| Cell::text("–"), |rms| Cell::number(rms, 3)),
            Cell::text(choice.reason.clone()),
        ]);
    }
    table
}

fn spread_table(family: &FamilyStudy) -> Table {
    let mut table = Table::new(
        "How far the sources of a material are apart.",
        vec![
            Column::text("material"),
            Column::text("sources"),
            Column::number("RMS difference", "1"),
            Column::number("max difference", "1"),
            Column::text("band of the max"),
        ],
    );
    for spread in &family.spreads {
        table.push(vec![
            Cell::text(spread.group.clone()),
            Cell::text(spread.sources.join(", ")),
            Cell::number(spread.rms, 3),
            Cell::number(spread.max_abs, 3),
            Cell::text(spread.max_band.clone()),
        ]);
    }
    table
}

fn groups(family: &FamilyStudy) -> Vec<&str> {
    let mut groups: Vec<&str> = family.forms.first().map_or_else(Vec::new, |form| {
        form.members.iter().map(|member| member.group.as_str()).collect()
    });
    groups.dedup();
    groups
}

fn group_table(family: &FamilyStudy) -> Table {
    let mut columns = vec![Column::text("material")];
    columns.extend(family.forms.iter().map(|form| Column::number(bare(&form.fit), "1")));
    let mut table =
        Table::new("RMS error per material, all bands and sources together, f32.", columns);
    for group in groups(family) {
        let mut row = vec![Cell::text(group)];
        row.extend(family.forms.iter().map(|form| Cell::number(group_rms(form, group), 3)));
        table.push(row);
    }
    table
}

fn member_table(family: &FamilyStudy) -> Table {
    let mut columns = vec![Column::text("member")];
    columns.extend(family.forms.iter().map(|form| Column::number(bare(&form.fit), "1")));
    let mut table = Table::new("RMS error per member, f32.", columns);
    let members = family.forms.first().map_or(0, |form| form.members.len());
    for at in 0..members {
        let mut row = vec![Cell::text(family.forms[0].members[at].label.clone())];
        row.extend(family.forms.iter().map(|form| {
            form.members.get(at).map_or_else(
                || Cell::missing("no such member"),
                |m| Cell::number(m.residuals.rms, 3),
            )
        }));
        table.push(row);
    }
    table
}

/// Error curves for one member of the groups on which the forms differ most.
fn figure(
    evidence: &Evidence<'_>,
    family: &FamilyStudy,
    registered: &Family,
    members: &[Member],
) -> Result<Figure, ValidateError> {
    let mut ranked: Vec<(&str, f64)> = groups(family)
        .into_iter()
        .map(|group| {
            let worst = family.forms.iter().map(|form| group_rms(form, group)).fold(0.0, f64::max);
            (group, worst)
        })
        .collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut plots = Vec::new();
    for (group, _) in ranked.iter().take(DRAWN) {
        let Some(member) = members.iter().find(|m| m.group == *group && m.band == "G") else {
            continue;
        };
        let mut plot = Plot::new(
            member.label.clone(),
            Axis::linear("cosine of incidence", "1"),
            Axis::symlog("error", "1", LINEAR_BELOW),
        );
        let over = Approximated::Family(registered.name.to_owned());
        for subject in evidence.subjects.iter().filter(|subject| subject.approximates == over) {
            if let Some(candidate) = subject.of_member(&member.label) {
                let curve = over_member(candidate, member)?;
                plot = plot.series(Series::line(bare(&subject.name), curve.points));
            }
        }
        plots.push(plot);
    }
    Ok(Figure::grid(
        format!("{}-members", family.family.replace('_', "-")),
        "Error over the cosine of incidence for the six materials on which the forms differ most, \
         green channel, f32, held-out points; the axis is linear below 1e-4 in magnitude, logarithmic above.",
        plots,
        2,
    ))
}
