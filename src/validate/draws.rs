//! Draws against the distribution that they should have: mean, variance and χ² with a p-value.

use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

use crate::effect::Distribution;

/// Expected draws from which a cell is tested by itself; smaller ones are pooled, as the χ² distribution
/// of the statistic asks.
const LEAST_EXPECTED: f64 = 5.0;

/// How the draws at one point compare with its distribution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointDraws {
    /// Draws.
    pub draws: usize,
    /// Their mean less that of the distribution, in its standard errors, 1.
    pub mean_z: f64,
    /// Their variance over that of the distribution, 1.
    pub variance_ratio: f64,
    /// Pearson's statistic over cells with enough expected draws.
    pub chi_squared: f64,
    /// Cells less one; 0 if all draws fall into one.
    pub degrees: usize,
    /// Probability of a statistic at least as large, 1.
    pub p: f64,
}

/// How the draws at all points compare, corrected for their number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Draws {
    /// Point by point.
    pub points: Vec<PointDraws>,
    /// Largest magnitude of a mean's z, 1.
    pub worst_mean_z: f64,
    /// Probability that fair draws have a mean as far off at any point (Šidák), 1.
    pub mean_p: f64,
    /// Largest ratio of variances or its inverse, 1.
    pub worst_variance_ratio: f64,
    /// Smallest p of χ² over the points, corrected for their number (Šidák), 1.
    pub chi_squared_p: f64,
}

/// Compares `draws` at a point with `distribution`. A draw that is no count, or is a count of probability
/// 0, makes χ² infinite and p = 0.
pub fn at_point(draws: &[f64], distribution: &Distribution) -> PointDraws {
    let count = draws.len() as f64;
    let mean = draws.iter().sum::<f64>() / count;
    let square = |draw: &f64| (draw - mean) * (draw - mean);
    let variance = draws.iter().map(square).sum::<f64>() / (count - 1.0);
    let (chi_squared, degrees) = chi_squared(draws, &distribution.probabilities);
    let of_mean = (distribution.variance / count).sqrt();
    let ratio = |a: f64, b: f64| if a == b { 1.0 } else { a / b };
    PointDraws {
        draws: draws.len(),
        mean_z: if mean == distribution.mean { 0.0 } else { (mean - distribution.mean) / of_mean },
        variance_ratio: ratio(variance, distribution.variance),
        chi_squared,
        degrees,
        p: upper_tail(chi_squared, degrees),
    }
}

/// Compares the draws at every point.
pub fn at_points<'a>(all: impl IntoIterator<Item = (&'a [f64], &'a Distribution)>) -> Draws {
    let points: Vec<PointDraws> =
        all.into_iter().map(|(draws, distribution)| at_point(draws, distribution)).collect();
    let worst = |of: &dyn Fn(&PointDraws) -> f64| {
        points.iter().map(of).fold(0.0, |worst: f64, other| {
            if worst.is_nan() || other.is_nan() { f64::NAN } else { worst.max(other) }
        })
    };
    let worst_mean_z = worst(&|point| point.mean_z.abs());
    let of_z = Normal::standard();
    let least = points.iter().map(|point| point.p).fold(1.0, f64::min);
    Draws {
        worst_mean_z,
        mean_p: sidak(2.0 * of_z.sf(worst_mean_z), points.len()),
        worst_variance_ratio: worst(&|point| point.variance_ratio.max(1.0 / point.variance_ratio)),
        chi_squared_p: sidak(least, points.len()),
        points,
    }
}

/// Probability of a p at least as small among `count` independent tests.
fn sidak(p: f64, count: usize) -> f64 {
    -(count as f64 * (-p).ln_1p()).exp_m1()
}

fn upper_tail(statistic: f64, degrees: usize) -> f64 {
    match ChiSquared::new(degrees as f64) {
        _ if statistic.is_infinite() => 0.0,
        Ok(distribution) => distribution.sf(statistic),
        // One cell holds everything: nothing can be off.
        Err(_) => 1.0,
    }
}

/// Pearson's statistic and its degrees of freedom over counts 0, 1 … and what lies beyond them,
/// neighbouring cells pooled until each expects [`LEAST_EXPECTED`] draws.
fn chi_squared(draws: &[f64], probabilities: &[f64]) -> (f64, usize) {
    let mut observed = vec![0.0; probabilities.len() + 1];
    for draw in draws {
        if !(draw.is_finite() && *draw >= 0.0 && draw.fract() == 0.0) {
            return (f64::INFINITY, 1);
        }
        observed[(*draw as usize).min(probabilities.len())] += 1.0;
    }
    let beyond = (1.0 - probabilities.iter().sum::<f64>()).max(0.0);
    let expected = probabilities.iter().chain([&beyond]).map(|p| p * draws.len() as f64);
    let mut cells: Vec<(f64, f64)> = Vec::new();
    let mut open = (0.0, 0.0);
    for (seen, expected) in observed.iter().zip(expected) {
        if expected == 0.0 && *seen > 0.0 {
            return (f64::INFINITY, 1);
        }
        open = (open.0 + seen, open.1 + expected);
        if open.1 >= LEAST_EXPECTED {
            cells.push(open);
            open = (0.0, 0.0);
        }
    }
    match cells.last_mut() {
        Some(last) => *last = (last.0 + open.0, last.1 + open.1),
        None => cells.push(open),
    }
    let term = |(seen, expected): &(f64, f64)| (seen - expected).powi(2) / expected;
    let statistic = if cells.len() < 2 { 0.0 } else { cells.iter().map(term).sum() };
    (statistic, cells.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Binomial, n = 4.
    fn binomial(p: f64) -> Distribution {
        let q = 1.0 - p;
        let probabilities = [1.0, 4.0, 6.0, 4.0, 1.0]
            .iter()
            .enumerate()
            .map(|(k, ways)| ways * p.powi(k as i32) * q.powi(4 - k as i32))
            .collect();
        Distribution { mean: 4.0 * p, variance: 4.0 * p * q, probabilities }
    }

    /// Draws in exactly these numbers.
    fn counted(counts: &[usize]) -> Vec<f64> {
        counts.iter().enumerate().flat_map(|(k, count)| vec![k as f64; *count]).collect()
    }

    #[test]
    fn draws_in_the_expected_numbers_are_fair() {
        let found = at_point(&counted(&[100, 400, 600, 400, 100]), &binomial(0.5));
        assert_eq!((found.mean_z, found.chi_squared, found.degrees, found.p), (0.0, 0.0, 4, 1.0));
        assert!((found.variance_ratio - 1.0).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn the_statistic_is_that_of_pearson() {
        // Σ (O − E)²/E = 400/100 + 400/400 + 0 + 0 + 0; P(χ²₄ > 5) = e^(−5/2)(1 + 5/2).
        let found = at_point(&counted(&[120, 380, 600, 400, 100]), &binomial(0.5));
        assert!((found.chi_squared - 5.0).abs() < 1e-12, "{found:?}");
        assert!((found.p - (-2.5_f64).exp() * 3.5).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn another_distribution_is_refused() {
        let draws = counted(&[100, 400, 600, 400, 100]);
        let found = at_points([(draws.as_slice(), &binomial(0.45))]);
        assert!(found.chi_squared_p < 1e-6 && found.mean_p < 1e-6, "{found:?}");
        for draw in [-1.0, 0.5, f64::NAN, 7.0] {
            assert_eq!(at_point(&[draw], &binomial(0.5)).p, 0.0, "{draw}");
        }
    }

    #[test]
    fn many_points_are_corrected_for() {
        assert!((sidak(0.01, 5) - (1.0 - 0.99_f64.powi(5))).abs() < 1e-15);
    }
}
