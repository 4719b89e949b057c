//! What the optimum is worth: standard errors, correlation, condition, equioscillation.

use nalgebra::{DMatrix, DVector};

use super::loss::Loss;
use super::solve::{Solution, divide_columns};
use super::target::{Noise, Points};

/// Smallest singular value of the column-scaled Jacobian, relative to the largest, under which some
/// combination of constants has no effect that f64 can see.
const SINGULAR: f64 = 1e-13;

/// Iterations after which the singular values of a small triangle are given up.
const SVD_ITERATIONS: usize = 1000;

/// Covariance of the constants up to the variance of the residuals.
#[derive(Debug, Clone)]
pub struct Covariance {
    /// Condition number of the column-scaled Jacobian.
    pub condition: f64,
    /// √ of the diagonal of (JᵀJ)⁻¹.
    pub unit_errors: Vec<f64>,
    /// Correlation of the constants.
    pub correlation: Vec<Vec<f64>>,
}

/// The covariance from the Jacobian by the constants, by the singular values of the Jacobian with its
/// columns scaled to length 1: JᵀJ is never formed. None if the Jacobian is singular.
pub fn covariance(jacobian: &DMatrix<f64>) -> Option<Covariance> {
    let n = jacobian.ncols();
    if n == 0 || jacobian.nrows() < n {
        return None;
    }
    let norms = jacobian.column_iter().map(|column| column.norm());
    let lengths = DVector::from_iterator(n, norms);
    if !lengths.iter().all(|length| length.is_finite() && *length > 0.0) {
        return None;
    }
    let mut unit = jacobian.clone();
    divide_columns(&mut unit, &lengths);
    let svd = unit.qr().r().try_svd(false, true, f64::EPSILON, SVD_ITERATIONS)?;
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    if smallest <= SINGULAR * largest {
        return None;
    }
    let mut rows = svd.v_t?;
    for (mut row, s) in rows.row_iter_mut().zip(svd.singular_values.iter()) {
        row /= *s;
    }
    let covariance = rows.tr_mul(&rows);
    let roots: Vec<f64> = covariance.diagonal().iter().map(|v| v.sqrt()).collect();
    let correlation = (0..n)
        .map(|i| {
            let entry = |j: usize| {
                if i == j {
                    1.0
                } else {
                    (covariance[(i, j)] / (roots[i] * roots[j])).clamp(-1.0, 1.0)
                }
            };
            (0..n).map(entry).collect()
        })
        .collect();
    let unit_errors =
        roots.iter().zip(lengths.iter()).map(|(root, length)| root / length).collect();
    Some(Covariance { condition: largest / smallest, unit_errors, correlation })
}

/// Residual standard deviation √(Σ r² / (m − n)), residuals with their factors: the scale of the
/// noise is taken from the fit, and weights are relative, as NIST certifies. Absent without degrees
/// of freedom.
pub fn residual_deviation(residuals: &DVector<f64>, free: usize) -> Option<f64> {
    let freedom = residuals.len().checked_sub(free).filter(|freedom| *freedom > 0)?;
    Some(residuals.norm() / (freedom as f64).sqrt())
}

/// Residuals below this part of the target are its rounding to f64 and that of the form.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What the constants are worth, from the Jacobian of those that are not on a bound.
pub(super) struct Worth {
    /// Indices of the constants that are not on a bound.
    pub(super) varying: Vec<usize>,
    /// Spread of those; none if their Jacobian is singular.
    pub(super) covariance: Option<Covariance>,
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
            Some(Covariance { condition: 1.0, unit_errors: vec![], correlation: vec![] })
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
        let covariance = self.covariance.as_ref().ok_or("the Jacobian is singular")?;
        let errors = covariance.unit_errors.get(position);
        errors.map(|unit| unit * deviation).filter(|error| error.is_finite()).ok_or("not finite")
    }
}

/// How close to the largest an error must be to count as reaching it.
const REACHED: f64 = 1e-4;

/// How many times `errors`, along increasing `x`, reach their largest magnitude with alternating
/// sign.
pub fn equioscillations(x: &[f64], errors: &[f64]) -> usize {
    let worst = errors.iter().fold(0.0, |worst: f64, e| worst.max(e.abs()));
    let mut order: Vec<usize> = (0..x.len().min(errors.len())).collect();
    order.sort_by(|i, j| x[*i].total_cmp(&x[*j]));
    let mut count = 0;
    let mut last = 0.0;
    for error in order.iter().map(|i| errors[*i]) {
        if error.abs() >= (1.0 - REACHED) * worst && error.signum() != last {
            count += 1;
            last = error.signum();
        }
    }
    if worst > 0.0 { count } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_has_the_textbook_errors() {
        let x = [1.0, 2.0, 3.0, 4.0];
        let jacobian = DMatrix::from_fn(4, 2, |i, j| if j == 0 { 1.0 } else { x[i] });
        let covariance = covariance(&jacobian).unwrap();
        let errors = covariance.unit_errors;
        assert!((errors[1] - (1.0f64 / 5.0).sqrt()).abs() < 1e-14);
        assert!((errors[0] - (30.0f64 / 20.0).sqrt()).abs() < 1e-14);
        let correlation = covariance.correlation[0][1];
        assert!((correlation + 10.0 / (4.0f64 * 30.0).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn equal_columns_are_singular() {
        assert!(covariance(&DMatrix::from_element(4, 2, 1.5)).is_none());
    }

    #[test]
    fn alternations_are_counted_in_the_order_of_x() {
        assert_eq!(equioscillations(&[0.0, 2.0, 1.0, 3.0], &[1.0, 1.0, -1.0, 0.2]), 3);
    }
}
