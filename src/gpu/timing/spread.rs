//! Order statistics of a repeated measurement.

use crate::numeric::statistics::percentile;
use serde::{Deserialize, Serialize};

/// Order statistics over the rounds of a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// Lower quartile.
    pub p25: f64,
    /// Median, the figure to quote.
    pub median: f64,
    /// Upper quartile.
    pub p75: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Statistics of the finite numbers of `sample`; `None` if fewer than half of it are finite.
    pub(super) fn of(sample: &[f64]) -> Option<Self> {
        let finite: Vec<f64> = sample.iter().copied().filter(|value| value.is_finite()).collect();
        if finite.is_empty() || 2 * finite.len() < sample.len() {
            return None;
        }
        let at = |percent| percentile(&finite, percent);
        Some(Self { min: at(0.0), p25: at(25.0), median: at(50.0), p75: at(75.0), max: at(100.0) })
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn order_statistics_of_a_known_sample() {
        let spread = Spread::of(&[5.0, 1.0, f64::NAN, 3.0, 2.0, 4.0]);
        let expected = Spread { min: 1.0, p25: 2.0, median: 3.0, p75: 4.0, max: 5.0 };
        assert_eq!(spread, Some(expected));
    }

    #[test]
    fn too_few_numbers_are_no_sample() {
        assert_eq!(Spread::of(&[f64::NAN, f64::NAN, 1.0]), None);
        assert_eq!(Spread::of(&[]), None);
    }
}
