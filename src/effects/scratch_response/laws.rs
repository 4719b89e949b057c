//! Properties that a form should have whatever its error.

use std::f64::consts::PI;

use super::regions::{COLUMNS, Row, hard_rows};
use crate::effect::{FormValues, Violation, points};
use crate::numeric::statistics::{largest, sum};

/// Laws of the effect, by name.
pub(super) const LAWS: &[(&str, Violation)] = &[
    ("non-negative", negative),
    ("non-negative pair", negative),
    ("non-negative density", negative),
    ("even across", asymmetry),
    ("energy", energy_error),
];

fn values(form: FormValues, rows: &[Row]) -> Vec<f32> {
    form(&points::of_rows(COLUMNS, rows, "laws of scratch_response".to_owned()))
}

fn negative(form: FormValues) -> f64 {
    worst(values(form, &hard_rows()).iter().map(|v| -f64::from(*v)))
}

fn asymmetry(form: FormValues) -> f64 {
    let mut central = hard_rows();
    central.iter_mut().for_each(|row| row[6] = 0.0);
    let mut mirrored = central.clone();
    mirrored.iter_mut().for_each(|row| row[5] = -row[5]);
    let (there, back) = (values(form, &central), values(form, &mirrored));
    worst(there.iter().zip(&back).map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs()))
}

/// Largest |∫ f_r dξ − 1|: midpoints in both directions, fine across the mirror, by lobes beyond.
fn energy_error(form: FormValues) -> f64 {
    const SIGMA: f64 = 60.0;
    const WIDTH: f64 = 3.0;
    const WAVELENGTH: f64 = 0.55;
    let unit = WAVELENGTH / (2.0 * PI * SIGMA);
    // Across: (ξ₂, step). The mirror is over at 7 units; lobes are λ/W = 126 units wide.
    let mut across: Vec<(f64, f64)> = midpoints(0.0, 7.0 * unit, 56).collect();
    across.extend(midpoints(7.0 * unit, 60.0 * WAVELENGTH / WIDTH, 1440));
    let along: Vec<(f64, f64)> = midpoints(-4.0 * unit, 4.0 * unit, 16).collect();
    let cases = [0.0, WAVELENGTH / 4.0, WAVELENGTH / 3.0, WAVELENGTH / 2.0];
    let cases = cases.iter().flat_map(|&depth| [(depth, 0.0), (depth, 0.7 * SIGMA)]);
    worst(cases.map(|(depth, offset)| {
        let mut rows = Vec::new();
        let mut weights = Vec::new();
        for &(y, height) in &across {
            for &(x, width) in &along {
                for side in [1.0, -1.0] {
                    let mut row = [0.0; 15];
                    row[..4].copy_from_slice(&[WIDTH, depth, WAVELENGTH, SIGMA]);
                    row[4..10].copy_from_slice(&[x, side * y, offset, 2.0, -1e6, 1e6]);
                    rows.push(row);
                    weights.push(width * height);
                }
            }
        }
        let values = values(form, &rows);
        if values.len() != weights.len() {
            return f64::NAN;
        }
        let products = values.iter().zip(&weights).map(|(v, w)| f64::from(*v) * w);
        (sum(products) - 1.0).abs()
    }))
}

/// Midpoints of `count` equal steps over [from, to], each with the step.
fn midpoints(from: f64, to: f64, count: u32) -> impl Iterator<Item = (f64, f64)> {
    let step = (to - from) / f64::from(count);
    (0..count).map(move |i| (from + (f64::from(i) + 0.5) * step, step))
}

/// Largest violation, 0 if none is positive; NaN if a value is not finite, so that it cannot pass.
fn worst(violations: impl Iterator<Item = f64>) -> f64 {
    largest(violations.map(|v| if v.is_finite() { v } else { f64::NAN }))
}
