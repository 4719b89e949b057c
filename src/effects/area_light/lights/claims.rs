//! Claims of velinov2018 on area lights, recomputed.

use std::f64::consts::TAU;

use super::draws::Draw;
use super::errors::{exact, light_of, named, relative_l2, single};
use super::regions::REGIONS;
use crate::effect::claim::ClaimCheck;
use crate::effect::{Candidates, ClaimError, Found};

/// Checks of the claims, by name.
pub(in super::super) const CLAIMS: &[(&str, ClaimCheck<Candidates>)] = &[
    ("disc", disc),
    ("second_root", second_root),
    ("sign_of_zero", sign_of_zero),
    ("coherence", coherence),
    ("single_line", single_line),
    ("normalization", normalization),
];

fn disc(_: &Candidates) -> Result<Found, ClaimError> {
    let ratios = [0.1_f64, 0.5, 0.9];
    let error = |ratio: f64| ratio.atan() / ratio.asin() - 1.0;
    let words = ratios.map(|ratio| format!("{:+.1} % at r/p = {ratio}", 100.0 * error(ratio)));
    let verdict = match ratios.map(|ratio| error(ratio).abs() <= 0.01) {
        [_, _, true] => "holds to 1 %",
        [true, ..] => "holds for small lights only; not defined for r >= p, where all is lit",
        _ => "does not hold to 1 %",
    };
    let words = words.join(", ");
    Ok(Found::new(
        format!("half-angle atan(r/p) against asin(r/p) of the silhouette: {words}"),
        verdict,
    ))
}

/// Residual of c + t cos γ + b sin γ at v = tan(γ/2), over the size of its terms.
fn residual([c, t, b]: [f64; 3], v: f64) -> f64 {
    let scale = c.abs() + t.abs() + b.abs();
    if v.is_infinite() {
        return (c - t).abs() / scale;
    }
    let square = v * v;
    ((c + (t * (1.0 - square) + 2.0 * b * v) / (1.0 + square)) / scale).abs()
}

/// Residual up to which a root counts as one.
const ROOT: f64 = 1e-6;

fn second_root(_: &Candidates) -> Result<Found, ClaimError> {
    let mut draw = Draw::new(40);
    let (mut solvable, mut printed, mut right) = (0, 0, 0);
    for _ in 0..10_000 {
        let case = [0; 3].map(|_| draw.between(-1.0, 1.0));
        let [c, t, b] = case;
        let square = b * b + t * t - c * c;
        if square < 0.0 {
            continue;
        }
        solvable += 1;
        let q = -(b + 1.0_f64.copysign(b) * square.sqrt());
        printed += usize::from(residual(case, (c - t) / q) > ROOT);
        right += usize::from(residual(case, (c + t) / q) > ROOT);
    }
    let found = format!(
        "of {solvable} random solvable cases of c + t cos + b sin = 0 the reciprocal fails in {printed}, \
         (c + t)/q, q = -(b + sgn(b) sqrt(D)), in {right}"
    );
    let verdict = match (printed, right) {
        (0, _) => "holds",
        (_, 0) => "does not hold: the second root is C/q, not A/q, unless t = 0",
        _ => "does not hold",
    };
    Ok(Found::new(found, verdict))
}

fn sign_of_zero(_: &Candidates) -> Result<Found, ClaimError> {
    let mut draw = Draw::new(41);
    let (mut cases, mut zero, mut one) = (0, 0, 0);
    for _ in 0..1000 {
        let case = [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), 0.0];
        let [c, t, _] = case;
        if t.abs() <= c.abs() {
            continue;
        }
        cases += 1;
        let root = (t * t - c * c).sqrt();
        // With sgn(0) = 0 the numerator of the first root is 0.
        zero += usize::from(residual(case, 0.0) > ROOT);
        one += usize::from(residual(case, -root / (c - t)) > ROOT);
    }
    let found = format!(
        "with b = 0, of {cases} solvable cases sgn(0) = 0 fails in {zero}, sgn(0) = 1 in {one}"
    );
    let verdict = match (zero, one) {
        (0, _) => "holds",
        (_, 0) => {
            "holds if sgn(0) counts as 1, and sgn is that of the coefficient in use, not of b_xi1"
        }
        _ => "does not hold",
    };
    Ok(Found::new(found, verdict))
}

fn coherence(_: &Candidates) -> Result<Found, ClaimError> {
    let ks = TAU / 550.0 * 10.0;
    let least = (-ks * ks * 4.0).exp();
    let found = format!(
        "k sigma = {ks:.3} at 550 nm: over all of the hemisphere exp(-(k sigma xi_1)^2) stays above {least:.3}"
    );
    let verdict = if least > 0.5 {
        "cannot be: nothing would be specular along the scratch; micrometres are likely"
    } else {
        "may be: the lobe is narrower than the hemisphere"
    };
    Ok(Found::new(found, verdict))
}

fn single_line(candidates: &Candidates) -> Result<Found, ClaimError> {
    let (errors, words) = on_regions(candidates, |of, exact| {
        let [line, nodes] = [of("line_medium")?, of("covered_three_medium")?];
        let errors = [line, nodes].map(|values| relative_l2(&values, exact));
        Ok((errors[0], format!("{:.1} % ({:.1} %)", 100.0 * errors[0], 100.0 * errors[1])))
    })?;
    let found = format!(
        "relative L2 error of the line with exact bands, in brackets of three slices where the light covers \
         the lobe: {words}"
    );
    Ok(Found::new(found, extent_of(&errors, 0.1)))
}

fn normalization(candidates: &Candidates) -> Result<Found, ClaimError> {
    let (biases, words) = on_regions(candidates, |of, exact| {
        let bias = of("line_printed")?.iter().sum::<f64>() / exact.iter().sum::<f64>() - 1.0;
        Ok((bias, format!("{:+.1} %", 100.0 * bias)))
    })?;
    let found = format!("light in all of the published form against the reference: {words}");
    Ok(Found::new(found, extent_of(&biases, 0.05)))
}

/// Values of the candidate that does so across the slices.
type Values<'a> = &'a dyn Fn(&str) -> Result<Vec<f64>, ClaimError>;

/// A number and words of every region, from the values of candidates and of the reference.
fn on_regions(
    candidates: &Candidates,
    found: impl Fn(Values<'_>, &[f64]) -> Result<(f64, String), ClaimError>,
) -> Result<(Vec<f64>, String), ClaimError> {
    let mut numbers = Vec::new();
    let mut words = Vec::new();
    for (region, _, fitted) in REGIONS {
        let Some(fitted) = fitted else { continue };
        let points = fitted();
        let (light, reference) = light_of(&points);
        let values = |across: &str| single(named(candidates, light, across)?, &points);
        let (number, shown) = found(&values, &exact(reference, &points)?)?;
        numbers.push(number);
        words.push(format!("{region} {shown}"));
    }
    Ok((numbers, words.join(", ")))
}

/// On how many regions a claim holds, to a relative error.
fn extent_of(errors: &[f64], limit: f64) -> String {
    let held = errors.iter().filter(|error| error.abs() <= limit).count();
    let percent = 100.0 * limit;
    match held {
        0 => format!("does not hold: to {percent} % on none of {} regions", errors.len()),
        _ if held == errors.len() => format!("holds: to {percent} % on all {held} regions"),
        _ => format!("in part: to {percent} % on {held} of {} regions", errors.len()),
    }
}
