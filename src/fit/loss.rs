//! Losses: what a residual costs.

/// What is minimised over the residuals r = f − y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Loss {
    /// ½ Σ w r².
    LeastSquares,
    /// ½ Σ w (r/y)²; the target may not be 0 anywhere.
    Relative,
    /// Σ w ρ(r) with ρ = ½ r² up to |r| = `scale` and growing linearly beyond (Huber 1964).
    Huber {
        /// Where the loss turns linear, in the target's unit.
        scale: f64,
    },
    /// max √w |r|.
    Minimax,
}

impl Loss {
    /// Name as in a spec.
    pub fn name(&self) -> &'static str {
        match self {
            Loss::LeastSquares => "least_squares",
            Loss::Relative => "relative",
            Loss::Huber { .. } => "huber",
            Loss::Minimax => "minimax",
        }
    }

    /// The cost of `residuals`, which carry their factors (√w, 1/|y|) already; NaN if one is NaN.
    pub fn cost(&self, residuals: &[f64]) -> f64 {
        match self {
            Loss::LeastSquares | Loss::Relative => {
                0.5 * residuals.iter().map(|r| r * r).sum::<f64>()
            }
            Loss::Huber { .. } => {
                0.5 * residuals.iter().map(|r| self.pseudo(*r).0).map(|q| q * q).sum::<f64>()
            }
            Loss::Minimax => residuals.iter().fold(0.0, |worst: f64, r| {
                if worst.is_nan() || r.is_nan() { f64::NAN } else { worst.max(r.abs()) }
            }),
        }
    }

    /// Pseudo-residual q(r) with ½ q² = ρ(r), and dq/dr: with it a least-squares solver minimises
    /// this loss. For Huber q = sign(r) √(2 s |r| − s²) beyond s, continuous with its derivative.
    pub fn pseudo(&self, residual: f64) -> (f64, f64) {
        match *self {
            Loss::Huber { scale } if residual.abs() > scale => {
                let q = (2.0 * scale * residual.abs() - scale * scale).sqrt();
                (q.copysign(residual), scale / q)
            }
            _ => (residual, 1.0),
        }
    }
}

/// The factor of each residual: √w, and 1/|y| for [`Loss::Relative`].
pub fn factors(loss: Loss, target: &[f64], weights: Option<&[f64]>) -> Vec<f64> {
    (0..target.len())
        .map(|i| {
            let weight = weights.and_then(|w| w.get(i)).map_or(1.0, |w| w.sqrt());
            match loss {
                Loss::Relative => weight / target[i].abs(),
                _ => weight,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn huber_is_quadratic_then_linear() {
        let loss = Loss::Huber { scale: 2.0 };
        assert_eq!(loss.cost(&[1.0]), 0.5);
        assert!((loss.cost(&[5.0]) - (2.0 * 5.0 - 2.0)).abs() < 1e-14);
    }

    #[test]
    fn a_nan_is_not_swallowed() {
        assert!(Loss::Minimax.cost(&[1.0, f64::NAN, 2.0]).is_nan());
        assert!(Loss::Minimax.cost(&[f64::NAN]).is_nan());
    }
}
