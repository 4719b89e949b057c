//! Which of the statistics of an optimum mean something.

use nalgebra::{DMatrix, DVector};

use super::loss::Loss;
use super::solve::Solution;
use super::statistics::{Covariance, covariance, residual_deviation};
use super::target::{Noise, Points};

/// Residuals below this part of the target are its rounding to f64 and that of the form.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What the constants are worth, from the Jacobian of those that are not on a bound.
pub(super) struct Worth {
    /// Indices of the constants that are not on a bound.
    pub(super) varying: Vec<usize>,
    /// Spread of those.
    pub(super) covariance: Covariance,
    /// Residual standard deviation, or why it means nothing.
    deviation: Result<f64, &'static str>,
}

impl Worth {
    /// `jacobian` and `residuals` carry their factors; `scale` is the largest target with its own.
    pub(super) fn new(
        loss: Loss,
        points: &Points,
        solution: &Solution,
        jacobian: &DMatrix<f64>,
        residuals: &DVector<f64>,
        scale: f64,
    ) -> Self {
        let varying: Vec<usize> =
            (0..jacobian.ncols()).filter(|i| !solution.at_bound.contains(i)).collect();
        let covariance = if varying.is_empty() {
            // Nothing varies, so nothing is undetermined.
            Covariance {
                condition: Some(1.0),
                unit_errors: Some(vec![]),
                correlation: Some(vec![]),
            }
        } else {
            covariance(&jacobian.select_columns(&varying))
        };
        let deviation = match (loss, points.noise) {
            (_, Noise::Exact) => Err("the target is exact: residuals are model error, not noise"),
            (Loss::Minimax, _) => Err("the minimax loss has no model of the noise"),
            (Loss::Huber { .. }, _) => Err("the Huber loss has no residual variance"),
            _ => match residual_deviation(residuals, varying.len()) {
                None => Err("as many parameters as points: no degrees of freedom"),
                Some(deviation) if deviation <= ROUNDING * scale => {
                    Err("the residuals are rounding: the target has no noise")
                }
                Some(deviation) => Ok(deviation),
            },
        };
        Self { varying, covariance, deviation }
    }

    /// Standard error of a free constant, or why there is none.
    pub(super) fn stderr(&self, free: usize) -> Result<f64, &'static str> {
        let Some(position) = self.varying.iter().position(|i| *i == free) else {
            return Err("on its bound");
        };
        let deviation = self.deviation?;
        let errors = self.covariance.unit_errors.as_ref().ok_or("the Jacobian is singular")?;
        errors
            .get(position)
            .map(|unit| unit * deviation)
            .filter(|error| error.is_finite())
            .ok_or("not finite")
    }
}
