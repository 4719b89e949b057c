//! Fits to families of measured tables, and what finer fitting is worth.

use super::{EffectEvidence, bare};
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedColumn, PrintedTable, Section, number, place};
use crate::effect::{Family, Member};
use crate::project::Approximated;
use crate::validate::ValidateError;
use crate::validate::cost::Basis;
use crate::validate::curves::over_member;
use crate::validate::family::{Choice, FormOverFamily, choices, group_rms};
use crate::validate::study::FamilyStudy;

/// Errors below this magnitude are drawn linearly, larger ones by ratio: the forms span decades.
const LINEAR_BELOW: f64 = 1e-4;
/// Groups drawn as error curves: the ones on which the forms differ most.
const DRAWN: usize = 6;

pub(super) fn section(
    evidence: &EffectEvidence<'_>,
    family: &FamilyStudy,
) -> Result<Section, ValidateError> {
    let description =
        position(evidence, &family.family).map_or("", |(_, family)| family.description);
    let cost = family.forms.iter().map(|form| evidence.cost(&form.fit).unwrap_or(f64::INFINITY));
    let cost: Vec<f64> = cost.collect();
    let first = family.forms.first().and_then(|form| evidence.costs.of(&form.fit));
    let basis = evidence.costs.basis(first.map_or("", |cost| &cost.baseline));
    let choices = choices(&family.forms, &family.spreads, &cost);
    let mut section = Section::new(format!("Family: {}", family.family.replace('_', " ")))
        .paragraph(description)
        .block(forms_table(family, &cost, basis))
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
    let summary = "Every member, every form: RMS in f32 on held-out points";
    Ok(section.details(summary, member_table(family)))
}

fn position<'a>(evidence: &EffectEvidence<'a>, name: &str) -> Option<(usize, &'a Family)> {
    evidence.effect.families.iter().enumerate().find(|(_, family)| family.name == name)
}

fn forms_table(family: &FamilyStudy, cost: &[f64], basis: Basis) -> PrintedTable {
    let mut forms: Vec<_> = family.forms.iter().zip(cost).collect();
    forms.sort_by(|(a, _), (b, _)| b.rms.total_cmp(&a.rms));
    let spread = |form: &FormOverFamily| {
        let spread = form.constant_spread.iter();
        let spread = spread.map(|(name, half)| format!("{name} ± {}", number(*half, 2)));
        let spread = spread.collect::<Vec<_>>().join(", ");
        Cell::text(if spread.is_empty() { "–".to_owned() } else { spread })
    };
    PrintedTable::over(
        "Every form over all members, in f32, on held-out points with grazing and the dips among them. \
         Spread: half the difference of a constant between sources of one material, RMS over \
         materials and bands: what a constant is known to.",
        forms,
    )
    .code("fit", |(form, _)| bare(&form.fit))
    .number("free constants", "1", |(form, _)| form.free)
    .number("RMS", "1", |(form, _)| form.rms)
    .number("max", "1", |(form, _)| form.max_abs)
    .text("worst member", |(form, _)| form.max_member.as_str())
    .text("where", |(form, _)| place(&form.max_at, 4))
    .number(basis.words(), basis.unit(), |(_, cost)| **cost)
    .text("spread of the constants between sources", |(form, _)| spread(form))
    .table()
}

fn choice_table(choices: &[Choice]) -> PrintedTable {
    PrintedTable::over(
        "For each material, the cheapest form whose error stays within the spread of its sources.",
        choices,
    )
    .text("material", |of| of.group.as_str())
    .number("spread of the sources, RMS", "1", |of| Cell::number_or(of.spread_rms, 3, "one source"))
    .code("cheapest within it", |of| {
        let none = if of.spread_rms.is_some() { "none" } else { "–" };
        Cell::text(of.cheapest.as_deref().map_or(none, bare))
    })
    .number("its RMS error", "1", |of| {
        of.rms.map_or_else(|| Cell::text("–"), |rms| Cell::number(rms, 3))
    })
    .text("because", |of| of.reason.as_str())
    .table()
}

fn spread_table(family: &FamilyStudy) -> PrintedTable {
    PrintedTable::over("How far the sources of a material are apart.", &family.spreads)
        .text("material", |of| of.group.as_str())
        .text("sources", |of| of.sources.join(", "))
        .number("RMS difference", "1", |of| of.rms)
        .number("max difference", "1", |of| of.max_abs)
        .text("band of the max", |of| of.max_band.as_str())
        .table()
}

fn groups(family: &FamilyStudy) -> Vec<&str> {
    let mut groups: Vec<&str> = family.forms.first().map_or_else(Vec::new, |form| {
        form.members.iter().map(|member| member.group.as_str()).collect()
    });
    groups.dedup();
    groups
}

fn group_table(family: &FamilyStudy) -> PrintedTable {
    PrintedTable::over(
        "RMS error per material, all bands and sources together, f32.",
        groups(family),
    )
    .text("material", |group| *group)
    .columns(&family.forms, named, |group, form| Cell::number(group_rms(form, group), 3))
    .table()
}

fn member_table(family: &FamilyStudy) -> PrintedTable {
    let members = family.forms.first().map_or(&[][..], |form| &form.members);
    PrintedTable::over("RMS error per member, f32.", members.iter().enumerate())
        .text("member", |(_, member)| member.label.as_str())
        .columns(&family.forms, named, |(at, _), form| {
            let rms = form.members.get(*at).map(|member| member.residuals.rms);
            Cell::number_or(rms, 3, "no such member")
        })
        .table()
}

fn named(form: &&FormOverFamily) -> PrintedColumn {
    PrintedColumn::number(bare(&form.fit), "1")
}

/// Error curves for one member of the groups on which the forms differ most.
fn figure(
    evidence: &EffectEvidence<'_>,
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
            PlotAxis::linear("cosine of incidence", "1"),
            PlotAxis::symlog("error", "1", LINEAR_BELOW),
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
