//! A form over a family of measured tables, and what finer fitting is worth.
//!
//! Two laboratories that measure "gold" do not agree. Their disagreement, carried through to the
//! quantity that is shaded, bounds what a fit can be worth: a form that is closer to either table
//! than the tables are to each other pays for digits that nobody knows.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::effect::Member;
use crate::fit::outcome::{Outcome, Residuals};
use crate::table::Table;

/// A form fitted to every member, judged on held-out points in f32.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FormOverFamily {
    /// The fit.
    pub fit: String,
    /// Constants fitted per member.
    pub free: usize,
    /// Root mean square over all points of all members.
    pub rms: f64,
    /// Largest error.
    pub max_abs: f64,
    /// Member where it is.
    pub max_member: String,
    /// Arguments where it is.
    pub max_at: BTreeMap<String, f64>,
    /// Residuals per member, in the family's order.
    pub members: Vec<MemberResiduals>,
    /// Difference of each constant between the sources of a group: the root mean square of half
    /// the range over sources, for the groups and bands that have several. Empty without any.
    pub constant_spread: BTreeMap<String, f64>,
}

/// Residuals of one member.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MemberResiduals {
    /// `group.source@band`.
    pub label: String,
    /// Group.
    pub group: String,
    /// Held-out residuals in f32.
    pub residuals: Residuals,
}

/// How far the sources of a group are apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupSpread {
    /// Group.
    pub group: String,
    /// Sources compared.
    pub sources: Vec<String>,
    /// Root mean square difference over shared points and bands.
    pub rms: f64,
    /// Largest difference.
    pub max_abs: f64,
    /// Band of the largest difference.
    pub max_band: String,
}

/// Which form a group needs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Group.
    pub group: String,
    /// Root mean square difference of its sources; absent with one source.
    pub spread_rms: Option<f64>,
    /// Cheapest fit whose error over the group stays within the spread.
    pub cheapest: Option<String>,
    /// Its root mean square error over the group's members.
    pub rms: Option<f64>,
    /// Why this one, or why none.
    pub reason: String,
}

/// Summarises the held-out residuals of one form. `outcomes` and `residuals` follow `members`.
pub fn over_family(
    fit: &str,
    members: &[Member],
    outcomes: &[Outcome],
    residuals: Vec<Residuals>,
) -> FormOverFamily {
    let worst =
        residuals.iter().zip(members).max_by(|(a, _), (b, _)| a.max_abs.total_cmp(&b.max_abs));
    FormOverFamily {
        fit: fit.to_owned(),
        free: outcomes.first().map_or(0, Outcome::free_count),
        rms: pooled_rms(&residuals),
        max_abs: worst.map_or(f64::NAN, |(residuals, _)| residuals.max_abs),
        max_member: worst.map(|(_, member)| member.label.clone()).unwrap_or_default(),
        max_at: worst.map(|(residuals, _)| residuals.max_abs_at.clone()).unwrap_or_default(),
        constant_spread: constant_spread(members, outcomes),
        members: members
            .iter()
            .zip(residuals)
            .map(|(member, residuals)| MemberResiduals {
                label: member.label.clone(),
                group: member.group.clone(),
                residuals,
            })
            .collect(),
    }
}

fn constant_spread(members: &[Member], outcomes: &[Outcome]) -> BTreeMap<String, f64> {
    let mut cells: BTreeMap<(&str, &str), Vec<&Outcome>> = BTreeMap::new();
    let of = |member: &Member| outcomes.iter().find(|outcome| outcome.label() == member.label);
    for (member, outcome) in members.iter().filter_map(|member| Some((member, of(member)?))) {
        cells.entry((&member.group, &member.band)).or_default().push(outcome);
    }
    let mut halves: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for outcomes in cells.values().filter(|outcomes| outcomes.len() > 1) {
        for (name, parameter) in &outcomes[0].parameters {
            if parameter.role != "free" {
                continue;
            }
            let values = || outcomes.iter().filter_map(|o| o.parameters.get(name)).map(|p| p.value);
            let (low, high) = (
                values().fold(f64::INFINITY, f64::min),
                values().fold(f64::NEG_INFINITY, f64::max),
            );
            halves.entry(name.clone()).or_default().push(0.5 * (high - low));
        }
    }
    let rms = |halves: Vec<f64>| {
        (halves.iter().map(|half| half * half).sum::<f64>() / halves.len() as f64).sqrt()
    };
    halves.into_iter().map(|(name, halves)| (name, rms(halves))).collect()
}

/// The difference between sources, per group with more than one.
pub fn spreads(members: &[Member]) -> Vec<GroupSpread> {
    let mut groups: BTreeMap<&str, Vec<&Member>> = BTreeMap::new();
    for member in members {
        groups.entry(&member.group).or_default().push(member);
    }
    groups.into_iter().filter_map(|(group, members)| spread(group, &members)).collect()
}

fn spread(group: &str, members: &[&Member]) -> Option<GroupSpread> {
    let mut found = GroupSpread {
        group: group.to_owned(),
        sources: Vec::new(),
        rms: 0.0,
        max_abs: 0.0,
        max_band: String::new(),
    };
    let (mut count, mut sum) = (0_usize, 0.0);
    for (at, first) in members.iter().enumerate() {
        if !found.sources.contains(&first.source) {
            found.sources.push(first.source.clone());
        }
        for second in &members[at + 1..] {
            if first.band != second.band || first.source == second.source {
                continue;
            }
            for difference in differences(&first.table, &second.table) {
                count += 1;
                sum += difference * difference;
                if difference > found.max_abs {
                    found.max_abs = difference;
                    found.max_band.clone_from(&first.band);
                }
            }
        }
    }
    found.rms = (sum / count.max(1) as f64).sqrt();
    (count > 0).then_some(found)
}

/// Magnitudes of the differences of `value` at the first arguments that both tables have.
fn differences(first: &Table, second: &Table) -> Vec<f64> {
    let pairs = |table: &Table| -> BTreeMap<u64, f64> {
        let columns = table.columns.first().zip(table.column("value"));
        let pairs = columns.map(|(argument, value)| argument.values.iter().zip(&value.values));
        pairs.into_iter().flatten().map(|(argument, value)| (argument.to_bits(), *value)).collect()
    };
    let second = pairs(second);
    pairs(first)
        .into_iter()
        .filter_map(|(argument, value)| second.get(&argument).map(|other| (value - other).abs()))
        .collect()
}

/// For each group, the cheapest form whose error stays within the measurement spread.
///
/// `cost` is the cost per evaluation of each fit, in the order of `forms`.
pub fn choices(forms: &[FormOverFamily], spreads: &[GroupSpread], cost: &[f64]) -> Vec<Choice> {
    let mut groups: Vec<&str> =
        forms.iter().flat_map(|form| &form.members).map(|member| member.group.as_str()).collect();
    groups.sort_unstable();
    groups.dedup();
    groups.into_iter().map(|group| choice(group, forms, spreads, cost)).collect()
}

fn choice(group: &str, forms: &[FormOverFamily], spreads: &[GroupSpread], cost: &[f64]) -> Choice {
    let spread = spreads.iter().find(|spread| spread.group == group);
    let none = |reason: String| Choice {
        group: group.to_owned(),
        spread_rms: spread.map(|spread| spread.rms),
        cheapest: None,
        rms: None,
        reason,
    };
    let Some(GroupSpread { rms: spread, sources, .. }) = spread else {
        return none("one source: its uncertainty is not known from this data".into());
    };
    let mut candidates: Vec<(&FormOverFamily, f64, f64)> = forms
        .iter()
        .zip(cost)
        .map(|(form, cost)| (form, group_rms(form, group), *cost))
        .filter(|(_, rms, _)| rms.is_finite())
        .collect();
    candidates.sort_by(|a, b| a.2.total_cmp(&b.2));
    let sources = sources.join(" and ");
    let Some((form, rms, _)) = candidates.iter().find(|(_, rms, _)| rms <= spread) else {
        return none(format!("{sources} agree more closely than any form follows them"));
    };
    let finer = candidates.iter().filter(|(_, other, _)| other < rms).count();
    let reason = format!(
        "within the spread of {sources}; {finer} finer fit(s) cost more than the data supports"
    );
    Choice { cheapest: Some(form.fit.clone()), rms: Some(*rms), ..none(reason) }
}

/// Root mean square error of a form over the members of a group.
pub fn group_rms(form: &FormOverFamily, group: &str) -> f64 {
    let own = form.members.iter().filter(|member| member.group == group);
    pooled_rms(own.map(|member| &member.residuals))
}

/// Root mean square over the points of all; not a number without any.
fn pooled_rms<'a>(all: impl IntoIterator<Item = &'a Residuals>) -> f64 {
    let (mut count, mut sum) = (0_usize, 0.0);
    for residuals in all {
        count += residuals.count;
        sum += residuals.rms * residuals.rms * residuals.count as f64;
    }
    (sum / count as f64).sqrt()
}
