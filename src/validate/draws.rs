//! Draws against the distribution that they should have: mean, variance and χ² with a p-value.
//!
//! A form draws where its reference is a distribution and it takes, beside what the points have, one `u32`
//! that numbers its draws. Every draw that it is judged by has another number, so that all are independent
//! if the form is fair, and the same on every run.

use std::collections::BTreeMap;

use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

use crate::effect::{Candidate, Distribution};
use crate::form::{Form, ScalarType};
use crate::gpu::DeviceKernel;
use crate::numeric::measured::Measured;
use crate::numeric::statistics::largest;
use crate::validate::ValidateError;
use crate::validate::accuracy::{GroundTruth, Judged, column, kernel_values, values_f32, widened};

/// Draws over all points of a region; each point has as many, but no fewer than [`LEAST_DRAWS`].
const DRAWS: usize = 1 << 17;
/// Draws at a point however many points there are.
const LEAST_DRAWS: usize = 1 << 8;
/// Probability below which draws are not taken for fair.
pub const SIGNIFICANCE: f64 = 1e-3;

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

impl PointDraws {
    /// The ratio of the variances or its inverse, whichever is larger.
    pub fn variance_off(&self) -> f64 {
        self.variance_ratio.max(1.0 / self.variance_ratio)
    }
}

/// How the draws at all points compare, corrected for their number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Draws {
    /// Point by point.
    #[serde(skip)]
    pub points: Vec<PointDraws>,
    /// Largest magnitude of a mean's z, 1.
    pub worst_mean_z: f64,
    /// Probability that fair draws have a mean as far off at any point (Šidák), 1.
    pub mean_p: f64,
    /// Largest ratio of variances or its inverse, 1.
    pub worst_variance_ratio: f64,
    /// Smallest p of χ² at a point, 1.
    pub least_p: f64,
    /// What the smallest p of fair draws stays below with probability [`SIGNIFICANCE`] (Šidák), 1.
    pub sidak_limit: f64,
    /// Smallest p of χ² over the points, corrected for their number (Šidák), 1.
    pub chi_squared_p: f64,
}

impl Draws {
    /// Whether neither mean nor χ² speaks against fair draws.
    pub fn fair(&self) -> bool {
        self.mean_p >= SIGNIFICANCE && self.chi_squared_p >= SIGNIFICANCE
    }

    /// The point at which `badness` is largest.
    pub fn worst_point(&self, badness: impl Fn(&PointDraws) -> f64) -> usize {
        let all = self.points.iter().map(badness).enumerate();
        all.max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(point, _)| point)
    }
}

/// Draws in each precision, with the same numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawsStudy {
    /// Shipped constants, f32 arithmetic with correctly rounded elementary functions.
    pub f32: Draws,
    /// Shipped constants on the device.
    pub device: Measured<Draws>,
}

impl DrawsStudy {
    /// The draws of `candidate` that `target` asks for, in f32 and, where there is one, on the device with
    /// the form's `kernel`.
    ///
    /// # Errors
    /// If the form cannot be evaluated, or the device fails.
    pub fn of(
        candidate: &Candidate,
        target: &GroundTruth,
        kernel: &Measured<DeviceKernel<'_>>,
    ) -> Result<Self, ValidateError> {
        let drawn = |values: Vec<f32>| target.draws(&widened(&values));
        let f32 = drawn(values_f32(candidate, target)?);
        let device = match kernel {
            Measured::Value(kernel) => Measured::Value(drawn(kernel_values(kernel, target)?)),
            Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
        };
        Ok(Self { f32, device })
    }
}

impl Judged {
    /// The input of `form` that numbers its draws.
    pub(super) fn counter(&self, form: &Form) -> Option<usize> {
        let inputs = form.input_columns().into_iter().enumerate();
        let missing: Vec<usize> = inputs
            .filter(|(_, input)| self.points.column(input).is_none())
            .map(|(at, _)| at)
            .collect();
        match missing[..] {
            [at] if form.input_types()[at] == ScalarType::U32 => {
                (!self.truth.distributions.is_empty()).then_some(at)
            }
            _ => None,
        }
    }

    /// Points and numbers of the draws of `form`, one point after the other.
    pub(super) fn drawn(&self, form: &Form, counter: usize) -> Result<GroundTruth, ValidateError> {
        let count = (DRAWS / self.points.rows().max(1)).max(LEAST_DRAWS);
        let repeated = |values: &[f64]| -> Vec<f64> {
            values.iter().flat_map(|value| std::iter::repeat_n(*value, count)).collect()
        };
        let arguments = form.input_columns();
        let inputs = arguments.iter().enumerate().map(|(at, argument)| match at == counter {
            true => Ok((0..self.points.rows() * count).map(|number| number as f64).collect()),
            false => Ok(repeated(column(&self.points, argument)?)),
        });
        let means: Vec<f64> = self.truth.distributions.iter().map(|of| of.mean).collect();
        Ok(GroundTruth {
            inputs: inputs.collect::<Result<_, ValidateError>>()?,
            arguments,
            values: repeated(&means),
            distributions: self.truth.distributions.clone(),
            ..GroundTruth::none()
        })
    }
}

impl GroundTruth {
    /// The draws `values`, all that were made point after point, against the distributions.
    pub fn draws(&self, values: &[f64]) -> Draws {
        let count = values.len() / self.distributions.len().max(1);
        at_points(values.chunks(count.max(1)).zip(&self.distributions))
    }

    /// The arguments of the first draw at a point.
    pub fn place(&self, point: usize) -> BTreeMap<String, f64> {
        let row = point * (self.values.len() / self.distributions.len().max(1));
        let inputs = self.arguments.iter().zip(&self.inputs);
        inputs.filter_map(|(name, column)| Some((name.clone(), *column.get(row)?))).collect()
    }
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
    let worst_mean_z = largest(points.iter().map(|point| point.mean_z.abs()));
    let of_z = Normal::standard();
    let least_p = points.iter().map(|point| point.p).fold(1.0, f64::min);
    Draws {
        worst_mean_z,
        mean_p: sidak(2.0 * of_z.sf(worst_mean_z), points.len()),
        worst_variance_ratio: largest(points.iter().map(PointDraws::variance_off)),
        least_p,
        sidak_limit: -((-SIGNIFICANCE).ln_1p() / points.len() as f64).exp_m1(),
        chi_squared_p: sidak(least_p, points.len()),
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
        if !expected.is_finite() || (expected == 0.0 && *seen > 0.0) {
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
