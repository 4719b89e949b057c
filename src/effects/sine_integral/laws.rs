//! Properties that a form of Si should have whatever its error.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::hard_cases::{hard_cases, table};
use super::reference::sine_integral;
use crate::effect::{FormValues, Violation};
use crate::numeric::statistics::{largest, mean};

/// Laws of the effect, by name.
pub(super) const LAWS: &[(&str, Violation)] = &[
    ("odd", oddness),
    ("tail bound", tail_excess),
    ("unbiased tail", tail_bias),
    ("bounded", excess_over_maximum),
    ("monotone to pi", largest_fall),
];

fn oddness(form: FormValues) -> f64 {
    let mut points = hard_cases();
    let values = form(&points);
    points.columns.iter_mut().flat_map(|column| &mut column.values).for_each(|x| *x = -*x);
    let mirrored = form(&points);
    largest(values.iter().zip(&mirrored).map(|(a, b)| (f64::from(*a) + f64::from(*b)).abs()))
}

/// x, rounded to f32, and the values there.
fn values(form: FormValues, x: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let points = table(x.collect(), "laws");
    let x = points.columns.iter().flat_map(|column| &column.values);
    x.zip(form(&points)).map(|(x, value)| (*x, f64::from(value))).collect()
}

fn tail_excess(form: FormValues) -> f64 {
    let found = values(form, (0..4000).map(|i| 1e3 * 10_f64.powf(f64::from(i) / 4000.0)));
    largest(found.into_iter().map(|(x, v)| (v - FRAC_PI_2).abs() - 1.0 / x))
}

fn tail_bias(form: FormValues) -> f64 {
    const POINTS_PER_PERIOD: usize = 256;
    let periods = [16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0];
    let x = periods.iter().flat_map(|n| {
        (0..POINTS_PER_PERIOD).map(move |i| TAU * (n + i as f64 / POINTS_PER_PERIOD as f64))
    });
    let scaled: Vec<f64> = values(form, x).into_iter().map(|(x, v)| x * (v - FRAC_PI_2)).collect();
    largest(scaled.chunks(POINTS_PER_PERIOD).map(|period| mean(period).abs()))
}

fn excess_over_maximum(form: FormValues) -> f64 {
    let grid = (0..=8192).map(|i| 4.0 * PI * f64::from(i) / 8192.0);
    let hard = hard_cases().columns.into_iter().flat_map(|c| c.values);
    let maximum = sine_integral(PI);
    largest(values(form, grid.chain(hard)).into_iter().map(|(_, v)| v.abs() - maximum))
}

fn largest_fall(form: FormValues) -> f64 {
    let found = values(form, (0..=4096).map(|i| PI * f64::from(i) / 4096.0));
    largest(found.windows(2).map(|pair| pair[0].1 - pair[1].1))
}
