//! Errors of a candidate on lobes and half lobes, in f32 at bounds rounded to f32: what the claims and
//! the exhibit are made of.

use std::f64::consts::{PI, TAU};

use super::sinc_squared_band;
use crate::effect::Candidate;
use crate::form::FormError;

/// Which part of the lobe [2πn, 2π(n + 1)].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// All of it.
    Whole,
    /// Up to its crest.
    FirstHalf,
    /// From its crest on.
    SecondHalf,
}

impl Part {
    /// Its bounds for the lobe `n`, rounded to f32.
    fn bounds(self, n: u32) -> (f32, f32) {
        let start = TAU * f64::from(n);
        let (from, to) = match self {
            Self::Whole => (start, start + TAU),
            Self::FirstHalf => (start, start + PI),
            Self::SecondHalf => (start + PI, start + TAU),
        };
        (from as f32, to as f32)
    }
}

/// Relative errors on a part of the lobes `orders`.
pub(super) fn relative_errors(
    candidate: &Candidate,
    part: Part,
    orders: &[u32],
) -> Result<Vec<f64>, FormError> {
    let (starts, ends): (Vec<f32>, Vec<f32>) = orders.iter().map(|&n| part.bounds(n)).unzip();
    let values = candidate.values_f32(&[&starts, &ends])?;
    let bands = starts.iter().zip(&ends);
    let exact = bands.map(|(&a, &b)| sinc_squared_band(f64::from(a), f64::from(b)));
    Ok(values.iter().zip(exact).map(|(v, exact)| f64::from(*v) / exact - 1.0).collect())
}

/// Largest |relative error| over lobes and half lobes n = 0 … `last`, with its part and order.
pub(super) fn worst(candidate: &Candidate, last: u32) -> Result<(f64, Part, u32), FormError> {
    let orders: Vec<u32> = (0..=last).collect();
    let mut worst = (0.0, Part::Whole, 0);
    for part in [Part::Whole, Part::FirstHalf, Part::SecondHalf] {
        for (error, &n) in relative_errors(candidate, part, &orders)?.iter().zip(&orders) {
            if error.abs() > worst.0 || error.is_nan() {
                worst = (error.abs(), part, n);
            }
        }
    }
    Ok(worst)
}
