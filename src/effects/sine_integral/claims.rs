//! Claims of velinov2018 on eq. 29, recomputed from what ships and from the reference.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::reference::sine_integral;
use crate::effect::claim::ClaimCheck;
use crate::effect::{Candidate, Candidates, ClaimError, Found};
use crate::form::FormError;
use crate::numeric::statistics::{mean, rms};

/// Eq. 29, as printed.
const PUBLISHED: &str = "sine_integral/published";

/// Checks of the claims, by name.
pub(super) const CLAIMS: &[(&str, ClaimCheck<Candidates>)] = &[
    ("constants", constants),
    ("near_error", near_error),
    ("tail", tail),
    ("lobes", lobes),
    ("half_lobes", half_lobes),
];

/// Form minus reference.
fn errors(candidate: &Candidate, x: &[f64]) -> Result<Vec<f64>, FormError> {
    Ok(candidate.values(&[x])?.iter().zip(x).map(|(v, &x)| v - sine_integral(x)).collect())
}

/// ½ ∫₀ᵘ sinc²(t/2) dt = Si(u) − (1 − cos u)/u: what eq. 27 takes differences of.
fn primitive(u: f64) -> f64 {
    sine_integral(u) - (1.0 - core_math::cos(u)) / u
}

/// Relative errors of ∫ sinc²(u/2) du, as eq. 27 takes it from Si, over the width from the start of
/// the lobe n on, in words.
fn energy_errors<const N: usize>(
    candidate: &Candidate,
    orders: [f64; N],
    width: f64,
) -> Result<String, FormError> {
    let error = |n: f64| {
        let ends = [TAU * n, TAU * n + width];
        let errors = errors(candidate, &ends)?;
        let error = (errors[1] - errors[0]) / (primitive(ends[1]) - primitive(ends[0]));
        Ok(format!("{:+.1} % at n = {n}", 100.0 * error))
    };
    let parts: Result<Vec<String>, FormError> = orders.into_iter().map(error).collect();
    Ok(parts?.join(", "))
}

/// 20001 points in equal steps over [−10, 10], on which eq. 29 was fitted.
fn fitted_interval() -> Vec<f64> {
    (0..20_001_u32).map(|i| -10.0 + 20.0 * f64::from(i) / 20_000.0).collect()
}

/// The largest magnitude of `errors` and its place.
fn largest(x: &[f64], errors: &[f64]) -> (f64, f64) {
    let start = (0.0, f64::NAN);
    errors
        .iter()
        .zip(x)
        .fold(start, |worst, (e, &x)| if e.abs() > worst.0 { (e.abs(), x) } else { worst })
}

fn constants(candidates: &Candidates) -> Result<Found, ClaimError> {
    let x = fitted_interval();
    let at_print = rms(&errors(candidates.get(PUBLISHED)?, &x)?);
    let mut found = format!("RMS {at_print:.7} as printed on 20001 points");
    for (fit, points) in [("refit_coarse", 401), ("refit", 2001), ("refit_dense", 20_001)] {
        match candidates.get(&format!("sine_integral/{fit}")) {
            Ok(refit) => {
                let change = rms(&errors(refit, &x)?) - at_print;
                let named = refit.shipped().map(|(name, value)| format!("{name} {value:.8}"));
                let pair = named.collect::<Vec<_>>().join(", ");
                found += &format!("; {points} points give {pair} (RMS {change:+.1e})");
            }
            Err(error) => found += &format!("; {error}"),
        }
    }
    Ok(Found::new(
        found,
        "close: the minimum is so flat that the grid, which is not stated, decides the fourth digit; \
         no grid tried gives the printed pair",
    ))
}

fn near_error(candidates: &Candidates) -> Result<Found, ClaimError> {
    let x = fitted_interval();
    let errors = errors(candidates.get(PUBLISHED)?, &x)?;
    let (max, at) = largest(&x, &errors);
    Ok(Found::new(
        format!("maximal error {max:.5} at x = ±{:.2}, RMS {:.5}", at.abs(), rms(&errors)),
        "no figure to hold it to: this is the error",
    ))
}

fn tail(candidates: &Candidates) -> Result<Found, ClaimError> {
    let published = candidates.get(PUBLISHED)?;
    let far: Vec<f64> = (0..200_000).map(|i| 10.0 * 1e3_f64.powf(f64::from(i) / 2e5)).collect();
    let (max, at) = largest(&far, &errors(published, &far)?);
    // Mean over one period, from which Si itself has next to nothing.
    let period: Vec<f64> = (0..1024).map(|i| TAU * (1000.0 + f64::from(i) / 1024.0)).collect();
    let values = published.values(&[&period])?;
    let scaled: Vec<f64> = values.iter().zip(&period).map(|(v, x)| x * (v - FRAC_PI_2)).collect();
    Ok(Found::new(
        format!(
            "the tail is pi/2 + {:.3}/x on average, that of Si pi/2; maximal error on [10, 1e4] \
             {max:.4} at x = {at:.2}",
            mean(&scaled)
        ),
        "does not hold beyond the fitted interval",
    ))
}

fn lobes(candidates: &Candidates) -> Result<Found, ClaimError> {
    let orders = [1.0, 5.0, 100.0];
    let mut found = energy_errors(candidates.get(PUBLISHED)?, orders, TAU)?;
    if let Ok(unbiased) = candidates.get("sine_integral/unbiased_tail") {
        found += &format!("; with the tail unbiased {}", energy_errors(unbiased, orders, TAU)?);
    }
    Ok(Found::new(
        format!("energy of the lobe kWq in [2 pi n, 2 pi (n + 1)]: {found}"),
        "does not hold: the spurious tail takes light from every side lobe",
    ))
}

fn half_lobes(candidates: &Candidates) -> Result<Found, ClaimError> {
    let found = energy_errors(candidates.get(PUBLISHED)?, [1.0, 20.0], PI)?;
    Ok(Found::new(
        format!("energy of the first half of a lobe: {found}"),
        "does not hold: next to nothing is left of it",
    ))
}
