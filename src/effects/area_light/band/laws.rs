//! Properties that a form of the band integral should have whatever its error.

use std::f64::consts::{PI, TAU};

use super::regions::{hard_cases, table};
use crate::effect::{FormValues, Violation};
use crate::numeric::statistics::largest;
use crate::table::Table;

/// Laws of bands, by name.
pub(crate) const LAWS: &[(&str, Violation)] = &[
    // Swapping the bounds changes the sign.
    ("antisymmetric", antisymmetry),
    // The integrand is a square.
    ("positive", not_positive),
    // The integrand is even.
    ("even", unevenness),
    // A light cut in two gives what it gave whole.
    ("additive", seam),
    // No light receives more than the whole lobe holds.
    ("total", excess_over_total),
];

/// The bands with their bounds swapped.
fn swapped(bands: &Table) -> Table {
    let mut swapped = bands.clone();
    for (column, other) in swapped.columns.iter_mut().zip(bands.columns.iter().rev()) {
        column.values.clone_from(&other.values);
    }
    swapped
}

fn antisymmetry(form: FormValues) -> f64 {
    let mut bands = hard_cases();
    let starts = bands.columns[0].values.clone();
    bands.columns.iter_mut().for_each(|bounds| bounds.values.extend(&starts));
    let (values, swapped) = (form(&bands), form(&swapped(&bands)));
    largest(values.iter().zip(&swapped).map(|(a, b)| (f64::from(*a) + f64::from(*b)).abs()))
}

fn unevenness(form: FormValues) -> f64 {
    let bands = hard_cases();
    let mut mirrored = swapped(&bands);
    mirrored.columns.iter_mut().flat_map(|bounds| &mut bounds.values).for_each(|x| *x = -*x);
    let (values, mirrored) = (form(&bands), form(&mirrored));
    largest(values.iter().zip(&mirrored).map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs()))
}

fn not_positive(form: FormValues) -> f64 {
    let bands = hard_cases();
    let bounds = bands.columns[0].values.iter().zip(&bands.columns[1].values);
    let judged: Vec<f32> = bounds
        .zip(form(&bands))
        .filter(|((a, b), _)| (*b - *a).abs() > 1e-30)
        .map(|((a, b), value)| if a < b { value } else { -value })
        .collect();
    let failed = judged.iter().filter(|v| v.is_nan() || **v <= 0.0).count();
    failed as f64 / judged.len() as f64
}

fn seam(form: FormValues) -> f64 {
    let at = |k: u32| PI * f64::from(k);
    let parts: Vec<[f64; 3]> = (1..=2000)
        .flat_map(|k| [[k - 1, k, k + 1], [k - 1, k, k + 2]])
        .map(|ends| ends.map(at))
        .collect();
    let between = |from: usize, to: usize| {
        form(&table(parts.iter().map(|ends| (ends[from], ends[to])).collect(), "seams"))
    };
    let (first, second, whole) = (between(0, 1), between(1, 2), between(0, 2));
    largest(first.iter().zip(&second).zip(&whole).map(|((p, q), w)| {
        let (parts, whole) = (f64::from(*p) + f64::from(*q), f64::from(*w));
        if parts == whole { 0.0 } else { ((parts - whole) / whole).abs() }
    }))
}

fn excess_over_total(form: FormValues) -> f64 {
    let reach = (0..2000).map(|i| 1e-3 * 1e8_f64.powf(f64::from(i) / 1999.0));
    let bands = table(reach.map(|x| (-x, x)).collect(), "across 0");
    largest(form(&bands).iter().map(|v| f64::from(*v).abs() - TAU))
}
