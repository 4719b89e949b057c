//! What is shown of the lights on the hard cases: f32 against the same form in f64, with the worst cases.
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | v, e | 1 | value in f32, and of the same text with the same arguments in f64 |
//! | L | 1 | √π/ks · 2π/(kw + π): the most that the lobe can hold |
//! | c | 1 | Σ over the arguments a of max |e(a(1 ± 2⁻²⁴)) − e|: what rounding the arguments may change |
//!
//! Where c/e is as large as |v − e|/e the case is as uncertain as its arguments, and no form in f32 does better;
//! where it is smaller the form loses digits itself. So the worst relative error is shown with c/e of its
//! case, and |v − e|/L beside it.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::errors::{row, single};
use super::hard_cases::HARD_CASES;
use crate::document::{Cell, Section};
use crate::effect::{Candidate, Candidates, ClaimError, Exhibit};
use crate::effects::area_light::TEXTS;
use crate::numeric::statistics::percentile;
use crate::table;

/// Candidates shown on each set of [`HARD_CASES`].
const SHOWN: [&[&str]; 2] = [
    &[
        "sphere_line_printed",
        "sphere_line_lean",
        "sphere_line_medium",
        "sphere_covered_three_medium",
        "sphere_covered_five_medium",
    ],
    &[
        "triangle_line_printed",
        "triangle_line_lean",
        "triangle_line_medium",
        "triangle_covered_three_medium",
        "triangle_covered_five_medium",
        "triangle_covered_split_medium",
    ],
];
/// Part of L below which a value has no relative error: f32 resolves 6e-8 of it.
const JUDGED: f64 = 1e-6;
/// Half an ulp of f32, relative.
const HALF_ULP: f64 = 5.960_464_477_539_063e-8;

pub(super) fn hard_cases(candidates: &Candidates) -> Result<Section, ClaimError> {
    let sets = HARD_CASES.iter().map(|(_, points)| points()).collect::<Vec<_>>();
    let named: Vec<_> = sets
        .iter()
        .zip(SHOWN)
        .flat_map(|(points, names)| names.iter().map(move |name| (points, *name)))
        .collect();
    let rows = named
        .par_iter()
        .map(|(points, name)| {
            hard_row(name, candidates.get(&format!("area_light/{name}"))?, points)
        })
        .collect::<Result<Vec<_>, ClaimError>>()?;
    Ok(Exhibit::of(TEXTS, "hard_cases", &[]).table(rows).section())
}

/// Whether the shaded point lies on the surface of the sphere, to 1e-6.
fn on_surface(row: &[f64]) -> bool {
    match row {
        [_, _, _, _, x, y, z, radius] => (x.hypot(*y).hypot(*z) / radius - 1.0).abs() < 1e-6,
        _ => false,
    }
}

/// The most that the lobe can hold at one point: it is bounded by its crest and by its integral.
fn most(arguments: &[f64]) -> f64 {
    match arguments {
        [kw, ks, ..] => PI.sqrt() / ks * TAU / (kw + PI),
        _ => f64::NAN,
    }
}

fn hard_row(
    name: &str,
    candidate: &Candidate,
    points: &table::Table,
) -> Result<Vec<Cell>, ClaimError> {
    let (single, double) = (single(candidate, points)?, candidate.values_at(points)?);
    let mut relative: Vec<f64> = Vec::new();
    let (mut worst, mut worst_relative) = ((0.0, 0), (0.0, 0));
    for (at, (value, exact)) in single.iter().zip(&double).enumerate() {
        let arguments = row(points, at);
        if on_surface(&arguments) {
            continue;
        }
        let (error, lobe) = ((value - exact).abs(), most(&arguments));
        if error / lobe > worst.0 || error.is_nan() {
            worst = (error / lobe, at);
        }
        if *exact > JUDGED * lobe || exact.is_nan() {
            relative.push(error / exact);
            if error / exact > worst_relative.0 || error.is_nan() {
                worst_relative = (error / exact, at);
            }
        }
    }
    let odd = single.iter().chain(&double).filter(|value| !value.is_finite()).count();
    let negative = single.iter().filter(|value| **value < 0.0).count();
    let case = |at: usize| {
        let arguments = points.columns.iter().map(|c| format!("{} {:.9e}", c.name, c.values[at]));
        Cell::text(format!("row {at}: `{}`", arguments.collect::<Vec<_>>().join(", ")))
    };
    Ok(vec![
        format!("`{name}`").into(),
        (single.len() as f64).into(),
        (odd as f64).into(),
        (negative as f64).into(),
        percentile(&relative, 50.0).into(),
        percentile(&relative, 99.0).into(),
        worst_relative.0.into(),
        by_rounding(candidate, points, worst_relative.1)?.into(),
        case(worst_relative.1),
        worst.0.into(),
        case(worst.1),
    ])
}

/// c/e of a case.
fn by_rounding(candidate: &Candidate, points: &table::Table, at: usize) -> Result<f64, ClaimError> {
    // The case itself, then every argument up and down.
    let mut moved = points.clone();
    let count = moved.columns.len();
    for (argument, column) in moved.columns.iter_mut().enumerate() {
        column.values = vec![column.values[at]; 1 + 2 * count];
        column.values[1 + 2 * argument] *= 1.0 + HALF_ULP;
        column.values[2 + 2 * argument] *= 1.0 - HALF_ULP;
    }
    let values = candidate.values_at(&moved)?;
    let Some((exact, moved)) = values.split_first() else { return Ok(f64::NAN) };
    let change = |pair: &[f64]| {
        let [up, down] = [0, 1].map(|side| pair.get(side).map_or(f64::NAN, |v| (v - exact).abs()));
        if up > down { up } else { down }
    };
    Ok(moved.chunks(2).map(change).sum::<f64>() / exact)
}
