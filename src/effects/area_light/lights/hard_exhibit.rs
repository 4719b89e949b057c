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

use super::columns::{SPHERE, TRIANGLE};
use super::hard_cases::HARD_CASES;
use super::measured::{Loaded, Points};
use crate::effect::exhibit::{Exhibit, ExhibitCell, ExhibitError, ExhibitTable};
use crate::effect::{FittedConstants, Quantity};
use crate::numeric::statistics::percentile;

/// Sets of hard cases, in the order of [`HARD_CASES`], with the forms shown.
const SHOWN: [(&[Quantity], &[&str]); 2] = [
    (
        &SPHERE,
        &[
            "sphere_line_printed",
            "sphere_line_lean",
            "sphere_line_medium",
            "sphere_covered_three_medium",
            "sphere_covered_five_medium",
        ],
    ),
    (
        &TRIANGLE,
        &[
            "triangle_line_printed",
            "triangle_line_lean",
            "triangle_line_medium",
            "triangle_covered_three_medium",
            "triangle_covered_five_medium",
            "triangle_covered_split_medium",
        ],
    ),
];
/// Part of L below which a value has no relative error: f32 resolves 6e-8 of it.
const JUDGED: f64 = 1e-6;
/// Half an ulp of f32, relative.
const HALF_ULP: f64 = 5.960_464_477_539_063e-8;

pub(super) fn hard_cases(fitted: &FittedConstants) -> Result<Exhibit, ExhibitError> {
    let named: Vec<(usize, &str)> = SHOWN
        .iter()
        .enumerate()
        .flat_map(|(set, (_, names))| names.iter().map(move |name| (set, *name)))
        .collect();
    let rows = named
        .par_iter()
        .map(|(set, name)| {
            let points = Points::new((HARD_CASES[*set].points)());
            hard_row(name, SHOWN[*set].0, &Loaded::new(name, fitted)?, &points)
        })
        .collect::<Result<Vec<_>, ExhibitError>>()?;
    let heading = |words: &str| (words.to_owned(), "");
    let number = |words: &str| (words.to_owned(), "1");
    Ok(Exhibit {
        title: "Hard cases of lights".into(),
        text: vec![
            "f32 against the same form in f64. Light that a limb, an edge or the horizon nearly cuts off is \
             as uncertain as the rounding of the arguments makes it. So the worst relative error, of values \
             above 1e-6 of the lobe, stands beside what rounding the arguments of its case may change, \
             relative too, the sum over arguments moved by half an ulp of f32; and errors are given relative \
             to sqrt(pi)/ks 2 pi/(kw + pi), the most that the lobe can hold. Left out of the errors: shaded \
             points on the surface of a sphere to 1e-6, where the light jumps from one half to all of the \
             hemisphere. On the device: cargo test --release --test lights -- --nocapture."
                .into(),
        ],
        plots: Vec::new(),
        tables: vec![ExhibitTable {
            caption: "Worst errors over the hard cases, with their rows and arguments".into(),
            columns: vec![
                heading("form"),
                number("cases"),
                number("not finite"),
                number("negative"),
                number("median relative error"),
                number("99 % below"),
                number("worst relative error"),
                number("by rounding of its arguments"),
                heading("its case"),
                number("worst relative to the lobe"),
                heading("its case"),
            ],
            rows,
        }],
    })
}

/// Whether the shaded point lies on the surface of the sphere, to 1e-6.
fn on_surface(row: &[f64]) -> bool {
    match row {
        [_, _, _, _, x, y, z, radius] => (x.hypot(*y).hypot(*z) / radius - 1.0).abs() < 1e-6,
        _ => false,
    }
}

/// The most that the lobe can hold: it is bounded by its crest and by its integral.
fn most(points: &Points, row: usize) -> f64 {
    let (kw, ks) = (points.columns[0][row], points.columns[1][row]);
    PI.sqrt() / ks * TAU / (kw + PI)
}

fn hard_row(
    name: &str,
    arguments: &[Quantity],
    form: &Loaded,
    points: &Points,
) -> Result<Vec<ExhibitCell>, ExhibitError> {
    let (single, double) = (form.single(points)?, form.double(points)?);
    let mut relative: Vec<f64> = Vec::new();
    let (mut worst, mut worst_relative) = ((0.0, 0), (0.0, 0));
    for (row, (value, exact)) in single.iter().zip(&double).enumerate() {
        if on_surface(&points.row(row)) {
            continue;
        }
        let (error, lobe) = ((value - exact).abs(), most(points, row));
        if error / lobe > worst.0 || error.is_nan() {
            worst = (error / lobe, row);
        }
        if *exact > JUDGED * lobe || exact.is_nan() {
            relative.push(error / exact);
            if error / exact > worst_relative.0 || error.is_nan() {
                worst_relative = (error / exact, row);
            }
        }
    }
    let odd = |values: &[f64]| values.iter().filter(|value| !value.is_finite()).count();
    let negative = single.iter().filter(|value| **value < 0.0).count();
    let rounding = by_rounding(form, &points.row(worst_relative.1))?;
    let case = |row: usize| {
        let parts: Vec<String> = arguments
            .iter()
            .zip(points.row(row))
            .map(|(argument, v)| format!("{} {v:.9e}", argument.name))
            .collect();
        ExhibitCell::Text(format!("row {row}: `{}`", parts.join(", ")))
    };
    Ok(vec![
        ExhibitCell::Text(format!("`{name}`")),
        ExhibitCell::Number(single.len() as f64),
        ExhibitCell::Number((odd(&single) + odd(&double)) as f64),
        ExhibitCell::Number(negative as f64),
        ExhibitCell::Number(percentile(&relative, 50.0)),
        ExhibitCell::Number(percentile(&relative, 99.0)),
        ExhibitCell::Number(worst_relative.0),
        ExhibitCell::Number(rounding),
        case(worst_relative.1),
        ExhibitCell::Number(worst.0),
        case(worst.1),
    ])
}

/// c/e of a case.
fn by_rounding(form: &Loaded, arguments: &[f64]) -> Result<f64, ExhibitError> {
    // The case itself, then every argument up and down.
    let columns = (0..arguments.len()).map(|moved| {
        let mut column = vec![arguments[moved]; 1 + 2 * arguments.len()];
        column[1 + 2 * moved] *= 1.0 + HALF_ULP;
        column[2 + 2 * moved] *= 1.0 - HALF_ULP;
        column
    });
    let values = form.double(&Points { columns: columns.collect() })?;
    let Some((exact, moved)) = values.split_first() else { return Ok(f64::NAN) };
    let change = |pair: &[f64]| {
        let [up, down] = [0, 1].map(|side| pair.get(side).map_or(f64::NAN, |v| (v - exact).abs()));
        if up > down { up } else { down }
    };
    Ok(moved.chunks(2).map(change).sum::<f64>() / exact)
}
