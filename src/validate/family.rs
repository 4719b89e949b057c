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
    let count: usize = residuals.iter().map(|r| r.count).sum();
    let sum: f64 = residuals.iter().map(|r| r.rms * r.rms * r.count as f64).sum();
    let worst =
        residuals.iter().zip(members).max_by(|(a, _), (b, _)| a.max_abs.total_cmp(&b.max_abs));
    FormOverFamily {
        fit: fit.to_owned(),
        free: outcomes.first().map_or(0, Outcome::free_count),
        rms: if count == 0 { f64::NAN } else { (sum / count as f64).sqrt() },
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
            let values = outcomes.iter().filter_map(|o| o.parameters.get(name)).map(|p| p.value);
            let (low, high) = values
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                    (low.min(value), high.max(value))
                });
            halves.entry(name.clone()).or_default().push(0.5 * (high - low));
        }
    }
    halves
        .into_iter()
        .map(|(name, halves)| {
            let square: f64 = halves.iter().map(|half| half * half).sum();
            (name, (square / halves.len() as f64).sqrt())
        })
        .collect()
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
        match (table.columns.first(), table.column("value")) {
            (Some(argument), Some(value)) => argument
                .values
                .iter()
                .map(|argument| argument.to_bits())
                .zip(value.values.iter().copied())
                .collect(),
            _ => BTreeMap::new(),
        }
    };
    let second = pairs(second);
    pairs(first)
        .into_iter()
        .filter_map(|(argument, value)| second.get(&argument).map(|other| (value - other).abs()))
        .collect()
}

/// For each group, the cheapest form whose error stays within the measurement spread.
///
/// `cost_ns` is the cost per evaluation of each fit, in the order of `forms`.
pub fn choices(forms: &[FormOverFamily], spreads: &[GroupSpread], cost_ns: &[f64]) -> Vec<Choice> {
    let mut groups: Vec<&str> =
        forms.iter().flat_map(|form| &form.members).map(|member| member.group.as_str()).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
        .into_iter()
        .map(|group| {
            let Some(spread) = spreads.iter().find(|spread| spread.group == group) else {
                return Choice {
                    group: group.to_owned(),
                    spread_rms: None,
                    cheapest: None,
                    rms: None,
                    reason: "one source: its uncertainty is not known from this data".into(),
                };
            };
            choice(group, forms, spread, cost_ns)
        })
        .collect()
}

fn choice(group: &str, forms: &[FormOverFamily], spread: &GroupSpread, cost_ns: &[f64]) -> Choice {
    let mut candidates: Vec<(&FormOverFamily, f64, f64)> = forms
        .iter()
        .zip(cost_ns)
        .map(|(form, cost)| (form, group_rms(form, group), *cost))
        .filter(|(_, rms, _)| rms.is_finite())
        .collect();
    candidates.sort_by(|a, b| a.2.total_cmp(&b.2));
    let within = candidates.iter().find(|(_, rms, _)| *rms <= spread.rms);
    match within {
        Some((form, rms, _)) => {
            let finer = candidates.iter().filter(|(_, other, _)| other < rms).count();
            Choice {
                group: group.to_owned(),
                spread_rms: Some(spread.rms),
                cheapest: Some(form.fit.clone()),
                rms: Some(*rms),
                reason: format!(
                    "within the spread of {}; {finer} finer fit(s) cost more than the data supports",
                    spread.sources.join(" and ")
                ),
            }
        }
        None => Choice {
            group: group.to_owned(),
            spread_rms: Some(spread.rms),
            cheapest: None,
            rms: None,
            reason: format!(
                "{} agree more closely than any form follows them",
                spread.sources.join(" and ")
            ),
        },
    }
}

/// Root mean square error of a form over the members of a group.
pub fn group_rms(form: &FormOverFamily, group: &str) -> f64 {
    let (mut count, mut sum) = (0_usize, 0.0);
    for member in form.members.iter().filter(|member| member.group == group) {
        count += member.residuals.count;
        sum += member.residuals.rms * member.residuals.rms * member.residuals.count as f64;
    }
    if count == 0 { f64::NAN } else { (sum / count as f64).sqrt() }
}
