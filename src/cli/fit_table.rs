//! Results of fits as tables.

use std::collections::BTreeMap;

use super::output::{significant, table};
use crate::fit::FitResult;
use crate::fit::outcome::{FamilyOutcome, Outcome, ParameterOutcome};

/// One line per fit.
pub(super) fn summary(results: &[FitResult]) -> String {
    let row = |result: &FitResult| match result {
        FitResult::Single(outcome) => vec![
            outcome.name.clone(),
            outcome.status.words().to_owned(),
            free(outcome),
            significant(outcome.residuals_f32.rms, 4),
            significant(outcome.residuals_f32.max_abs, 4),
        ],
        FitResult::Family(family) => family_row(family),
    };
    let header = ["fit", "status", "free", "rms (f32)", "max (f32)"];
    table(&header, results.iter().map(row).collect())
}

fn family_row(family: &FamilyOutcome) -> Vec<String> {
    let members = &family.members;
    let mut endings: BTreeMap<&str, usize> = BTreeMap::new();
    for member in members {
        *endings.entry(member.status.words()).or_default() += 1;
    }
    let endings: Vec<String> = endings.iter().map(|(name, n)| format!("{n} {name}")).collect();
    let points: usize = members.iter().map(|m| m.residuals_f32.count).sum();
    let squares: f64 =
        members.iter().map(|m| m.residuals_f32.rms.powi(2) * m.residuals_f32.count as f64).sum();
    let max = members.iter().map(|m| m.residuals_f32.max_abs).fold(0.0, f64::max);
    vec![
        family.name.clone(),
        endings.join(", "),
        members.first().map_or_else(String::new, free),
        significant((squares / points as f64).sqrt(), 4),
        significant(max, 4),
    ]
}

fn free(outcome: &Outcome) -> String {
    outcome.free_count().to_string()
}

/// A table of constants per fit; one line per member for a family.
pub(super) fn constants(results: &[FitResult]) -> String {
    results.iter().map(one).collect::<Vec<_>>().join("\n")
}

fn one(result: &FitResult) -> String {
    match result {
        FitResult::Single(outcome) => single(outcome),
        FitResult::Family(family) => members(family),
    }
}

fn single(outcome: &Outcome) -> String {
    let name = if outcome.name.is_empty() { &outcome.form } else { &outcome.name };
    let residuals = &outcome.residuals;
    let heading = format!(
        "{name}: {} after {} iterations ({})\n{} points, rms {}, max {}{}; in f32 rms {}, max {}\n",
        outcome.status.words(),
        outcome.iterations,
        outcome.solver,
        residuals.count,
        significant(residuals.rms, 6),
        significant(residuals.max_abs, 6),
        place(outcome),
        significant(outcome.residuals_f32.rms, 6),
        significant(outcome.residuals_f32.max_abs, 6),
    );
    if outcome.parameters.is_empty() {
        return heading;
    }
    let row = |(name, p): (&String, &ParameterOutcome)| {
        let error = p.stderr.map_or_else(|| "none".to_owned(), |error| significant(error, 4));
        vec![name.clone(), p.role.clone(), p.value.to_string(), error, p.f32.to_string()]
    };
    let header = ["constant", "role", "value", "standard error", "f32"];
    heading + &table(&header, outcome.parameters.iter().map(row).collect()) + &reasons(outcome)
}

/// Why there are no standard errors, each reason once.
fn reasons(outcome: &Outcome) -> String {
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, parameter) in outcome.parameters.iter().filter(|(_, p)| p.role == "free") {
        if let Some(why) = &parameter.why_no_stderr {
            reasons.entry(why).or_default().push(name);
        }
    }
    let line = |(why, names): (&str, Vec<&str>)| {
        format!("no standard error of {}: {why}\n", names.join(", "))
    };
    reasons.into_iter().map(line).collect()
}

fn place(outcome: &Outcome) -> String {
    let at = outcome.residuals.max_abs_at.iter();
    let places: Vec<String> =
        at.map(|(name, value)| format!("{name} = {}", significant(*value, 6))).collect();
    if places.is_empty() { String::new() } else { format!(" at {}", places.join(", ")) }
}

fn members(family: &FamilyOutcome) -> String {
    let names: Vec<&String> =
        family.members.first().map(|m| m.parameters.keys().collect()).unwrap_or_default();
    let mut header = vec!["member", "status"];
    header.extend(names.iter().map(|name| name.as_str()));
    header.extend(["rms (f32)", "max (f32)"]);
    let row = |member: &Outcome| {
        let label = member.name.split_once('#').map_or(member.name.as_str(), |(_, label)| label);
        let mut row = vec![label.to_owned(), member.status.words().to_owned()];
        row.extend(names.iter().map(|name| {
            member.parameters.get(*name).map_or_else(String::new, |p| p.f32.to_string())
        }));
        row.push(significant(member.residuals_f32.rms, 4));
        row.push(significant(member.residuals_f32.max_abs, 4));
        row
    };
    let rows = family.members.iter().map(row).collect();
    format!("{}: {} members\n{}", family.name, family.members.len(), table(&header, rows))
}
