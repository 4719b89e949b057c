//! Rounding of constants to f32 so that the error of the shipped expression is minimal.
//!
//! Rounding each constant to the nearest f32 moves an ill-conditioned form off its optimum, and says
//! nothing about the rounding inside the expression. So:
//! 1. two candidates: the nearest f32 of every constant; and Babai's nearest plane, which rounds one
//!    constant after the other and lets those still to be rounded make up for it (J = QR in units in
//!    the last place, back substitution with rounding);
//! 2. from the better one, a pattern search: ± steps of one constant, 1 ulp first and doubled as long
//!    as the loss, evaluated in f32 over every point, falls; rounds over all constants until none
//!    helps or the evaluations are used up.
//!
//! The search is sequential and compares exact numbers, so it always ends at the same constants.

use nalgebra::DMatrix;

use super::bounds::Bounds;
use super::loss::Loss;
use super::model::Origin;
use crate::form::{Form, FormError};

/// Point evaluations that a search may use, between [`FEWEST`] and [`MOST`] passes over the points.
const POINT_BUDGET: usize = 400_000;
const FEWEST: usize = 60;
const MOST: usize = 200;
/// Largest move away from the nearest f32 that is trusted, in ulps.
const FARTHEST: f64 = 1e6;

/// A form in f32 at the points of a fit.
pub struct Shipped<'a> {
    /// The form.
    pub form: &'a Form,
    /// Where each `override` comes from.
    pub origins: &'a [Origin],
    /// Input columns.
    pub inputs: Vec<Vec<f32>>,
    /// Which output columns.
    pub outputs: &'a [usize],
    /// The target.
    pub target: &'a [f64],
    /// The factors of the residuals.
    pub factors: &'a [f64],
    /// The loss.
    pub loss: Loss,
    /// Bounds of the free constants.
    pub bounds: &'a [Bounds],
}

impl Shipped<'_> {
    /// The values in f32.
    ///
    /// # Errors
    /// [`FormError`] from the form.
    pub fn values(&self, constants: &[f32]) -> Result<Vec<f32>, FormError> {
        let overrides = self.origins.iter().map(|origin| origin.value(constants, |v| v as f32));
        let overrides: Vec<f32> = overrides.collect();
        let inputs: Vec<&[f32]> = self.inputs.iter().map(Vec::as_slice).collect();
        let columns = self.form.eval_f32(&overrides, &inputs)?;
        let column = |output: &usize| columns.get(*output).into_iter().flatten().copied();
        Ok(self.outputs.iter().flat_map(column).collect())
    }

    /// The loss of the shipped expression; infinite where it is not finite.
    fn cost(&self, constants: &[f32]) -> Result<f64, FormError> {
        let residuals: Vec<f64> = self
            .values(constants)?
            .iter()
            .zip(self.target)
            .zip(self.factors)
            .map(|((v, t), f)| (f64::from(*v) - t) * f)
            .collect();
        let cost = self.loss.cost(&residuals);
        Ok(if cost.is_finite() { cost } else { f64::INFINITY })
    }

    fn allowed(&self, index: usize, value: f32) -> bool {
        let value = f64::from(value);
        value.is_finite()
            && self.bounds.get(index).is_none_or(|b| {
                b.lower.is_none_or(|low| value >= low) && b.upper.is_none_or(|high| value <= high)
            })
    }
}

/// f32 constants for the optimum `constants`; `jacobian` is that of the weighted residuals by the constants, at the optimum.
///
/// # Errors
/// [`FormError`] from the form.
pub fn round_to_f32(
    shipped: &Shipped,
    constants: &[f64],
    jacobian: &DMatrix<f64>,
) -> Result<Vec<f32>, FormError> {
    let nearest: Vec<f32> =
        constants.iter().enumerate().map(|(i, c)| nearest_allowed(shipped, i, *c)).collect();
    if constants.is_empty() {
        return Ok(nearest);
    }
    let budget = (POINT_BUDGET / shipped.target.len().max(1)).clamp(FEWEST, MOST);
    let mut used = 1;
    let mut cost = shipped.cost(&nearest)?;
    let mut best = nearest.clone();
    if let Some(plane) = nearest_plane(constants, &nearest, jacobian)
        && plane.iter().enumerate().all(|(i, c)| shipped.allowed(i, *c))
    {
        used += 1;
        let other = shipped.cost(&plane)?;
        if other < cost {
            (best, cost) = (plane, other);
        }
    }
    let mut improved = true;
    while improved && used < budget {
        improved = false;
        for index in 0..best.len() {
            for direction in [1, -1] {
                let mut step = 1;
                while used < budget {
                    let moved = ulps_away(best[index], direction * step);
                    if !shipped.allowed(index, moved) {
                        break;
                    }
                    let kept = std::mem::replace(&mut best[index], moved);
                    used += 1;
                    let next = shipped.cost(&best)?;
                    if next < cost {
                        cost = next;
                        improved = true;
                        step *= 2;
                    } else {
                        best[index] = kept;
                        break;
                    }
                }
            }
        }
    }
    Ok(best)
}

/// The nearest f32, or its neighbour where that one is outside the bounds.
fn nearest_allowed(shipped: &Shipped, index: usize, constant: f64) -> f32 {
    let nearest = constant as f32;
    [nearest, ulps_away(nearest, 1), ulps_away(nearest, -1)]
        .into_iter()
        .find(|value| shipped.allowed(index, *value))
        .unwrap_or(nearest)
}

/// The f32 that is `steps` representable numbers above `value`.
fn ulps_away(value: f32, steps: i32) -> f32 {
    // Ordered as integers: negative floats count downwards from −0.
    let bits = value.to_bits() as i32;
    let ordered = if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits };
    let moved = ordered.saturating_add(steps);
    let bits = if moved < 0 { i32::MIN.wrapping_sub(moved) } else { moved };
    f32::from_bits(bits as u32)
}

/// Babai's nearest plane about the optimum, in units in the last place of `nearest`.
fn nearest_plane(constants: &[f64], nearest: &[f32], jacobian: &DMatrix<f64>) -> Option<Vec<f32>> {
    let n = constants.len();
    if n == 0 || jacobian.ncols() != n || jacobian.nrows() < n {
        return None;
    }
    let units: Vec<f64> =
        nearest.iter().map(|c| (f64::from(ulps_away(*c, 1)) - f64::from(*c)).abs()).collect();
    let mut scaled = jacobian.clone();
    for (mut column, unit) in scaled.column_iter_mut().zip(&units) {
        column *= *unit;
    }
    let r = scaled.qr().r();
    let offset: Vec<f64> =
        (0..n).map(|i| (constants[i] - f64::from(nearest[i])) / units[i]).collect();
    let mut steps = vec![0.0; n];
    for i in (0..n).rev() {
        let rest: f64 = (i + 1..n).map(|k| r[(i, k)] * (offset[k] - steps[k])).sum();
        steps[i] = (offset[i] + rest / r[(i, i)]).round();
        if steps[i].is_nan() || steps[i].abs() > FARTHEST {
            return None;
        }
    }
    Some(nearest.iter().zip(&steps).map(|(c, s)| ulps_away(*c, *s as i32)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_in_order_across_zero() {
        assert_eq!(ulps_away(1.0, 1), 1.0 + f32::EPSILON);
        assert_eq!(ulps_away(0.0, -1), -f32::from_bits(1));
        assert_eq!(ulps_away(-f32::from_bits(1), 2), f32::from_bits(1));
        assert_eq!(ulps_away(-1.0, 1), -1.0 + f32::EPSILON / 2.0);
    }
}
