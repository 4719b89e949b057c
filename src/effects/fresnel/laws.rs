//! Properties of every Fresnel form.
//!
//! Monotonicity is not among them: a metal reflects less at its pseudo-Brewster angle than head-on.

use std::iter::repeat;

use crate::effect::{FormValues, Law, Violation, points};
use crate::table::Table;

/// Reflectances at normal incidence, from glass to the ideal mirror.
const F_NORMAL: [f32; 9] = [0.02, 0.04, 0.17, 0.33, 0.5, 0.75, 0.95, 0.99, 1.0];

/// Laws of the effect, by name.
pub(super) const LAWS: &[(&str, Violation)] = &[
    ("one at grazing", |form| worst(form, &[0.0], &F_NORMAL, |_, _, value| (value - 1.0).abs())),
    ("given at normal incidence", |form| {
        worst(form, &[1.0], &F_NORMAL, |_, f, value| (value - f).abs())
    }),
    ("between 0 and 1", |form| {
        let mu: Vec<f32> = (0..=512).map(|i| i as f32 / 512.0).collect();
        worst(form, &mu, &F_NORMAL[4..], |_, _, value| (-value).max(value - 1.0))
    }),
    ("flat at normal incidence", |form| {
        let step = 1.0 / 64.0;
        let head_on = answers(form, &[1.0], &F_NORMAL);
        let beside = answers(form, &[1.0 - step], &F_NORMAL);
        let slopes = head_on.iter().zip(&beside).map(|(a, b)| f64::from(a.2 - b.2).abs());
        Law::worst(slopes) / f64::from(step)
    }),
];

/// Largest of `excess(mu, f_normal, value)` over all pairs, and 0.
fn worst(
    form: FormValues<'_>,
    mu: &[f32],
    f_normal: &[f32],
    excess: fn(f64, f64, f64) -> f64,
) -> f64 {
    Law::worst(
        answers(form, mu, f_normal)
            .into_iter()
            .map(|(mu, f, value)| excess(f64::from(mu), f64::from(f), f64::from(value))),
    )
}

/// (mu, f_normal, value) over all pairs.
///
/// Forms of this effect take mu and f_normal; some also the reflectance at the edge, and a weight
/// takes mu alone, which is the same as f_normal = 0.
fn answers(form: FormValues<'_>, mu: &[f32], f_normal: &[f32]) -> Vec<(f32, f32, f32)> {
    let rows: Vec<[f64; 3]> = f_normal
        .iter()
        .flat_map(|f| mu.iter().map(move |mu| [*mu, *f, f + (1.0 - f) * 0.4].map(f64::from)))
        .collect();
    let columns = ["mu", "f_normal", "f_edge"].map(|name| (name, "1"));
    let points = points::of_rows(columns, &rows, "laws of fresnel".into());
    let cosines = Table { columns: points.columns[..1].to_vec(), ..Table::default() };
    let weights = Some(form(&cosines)).filter(|values| values.iter().any(|v| !v.is_nan()));
    let with_f = if weights.is_some() { 0.0 } else { 1.0 };
    // What is missing is not a number.
    let values = weights.unwrap_or_else(|| form(&points)).into_iter().chain(repeat(f32::NAN));
    let answer = |(&[mu, f, _], value): (&[f64; 3], f32)| (mu as f32, with_f * f as f32, value);
    rows.iter().zip(values).map(answer).collect()
}

#[cfg(test)]
mod tests {
    use super::super::EFFECT;
    use super::Table;

    fn schlick(points: &Table) -> Vec<f32> {
        match points.columns.as_slice() {
            [mu, f_normal, ..] => {
                let schlick = |(mu, f): (&f64, &f64)| (f + (1.0 - f) * (1.0 - mu).powi(5)) as f32;
                mu.values.iter().zip(&f_normal.values).map(schlick).collect()
            }
            _ => vec![f32::NAN],
        }
    }

    #[test]
    fn schlick_keeps_every_law_and_others_are_found() {
        let tilted = |points: &Table| match points.columns.as_slice() {
            [mu] => mu.values.iter().map(|mu| (1.1 - mu) as f32).collect(),
            _ => vec![f32::NAN],
        };
        crate::effects::assert_laws_bite(EFFECT.laws.iter(), &schlick, &tilted);
    }
}
