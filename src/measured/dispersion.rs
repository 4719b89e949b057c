//! The dispersion formulas of refractiveindex.info, numbered as there.
//!
//! Source: refractiveindex.info database, "Dispersion formulas" (M. N. Polyanskiy, Sci. Data 11,
//! 94 (2024)). Wavelengths λ in µm; C₁, C₂ … are the coefficients in the order of the record;
//! those that a record leaves out are zero.

/// A dispersion formula with its coefficients.
///
/// | number | name | formula |
/// |---|---|---|
/// | 1 | Sellmeier | n² − 1 = C₁ + Σ C₂ᵢ λ²/(λ² − C₂ᵢ₊₁²) |
/// | 2 | Sellmeier-2 | n² − 1 = C₁ + Σ C₂ᵢ λ²/(λ² − C₂ᵢ₊₁) |
/// | 3 | polynomial | n² = C₁ + Σ C₂ᵢ λ^C₂ᵢ₊₁ |
/// | 4 | RefractiveIndex.INFO | n² = C₁ + C₂ λ^C₃/(λ² − C₄^C₅) + C₆ λ^C₇/(λ² − C₈^C₉) + C₁₀ λ^C₁₁ + … |
/// | 5 | Cauchy | n = C₁ + Σ C₂ᵢ λ^C₂ᵢ₊₁ |
/// | 6 | gases | n − 1 = C₁ + Σ C₂ᵢ/(C₂ᵢ₊₁ − λ⁻²) |
/// | 7 | Herzberger | n = C₁ + C₂ L + C₃ L² + C₄ λ² + C₅ λ⁴ + C₆ λ⁶, with L = 1/(λ² − 0.028) |
/// | 8 | retro | (n² − 1)/(n² + 2) = C₁ + C₂ λ²/(λ² − C₃) + C₄ λ² |
/// | 9 | exotic | n² = C₁ + C₂/(λ² − C₃) + C₄ (λ − C₅)/((λ − C₅)² + C₆) |
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersion {
    number: u32,
    coefficients: Vec<f64>,
}

impl Dispersion {
    /// The formula of that number with its coefficients, in the order of the record.
    ///
    /// # Errors
    /// In words, if there is no such formula, there are no coefficients, more than the formula has
    /// places for, or one is not finite.
    pub fn new(number: u32, coefficients: Vec<f64>) -> Result<Self, String> {
        let (given, most) = match number {
            1..=6 => (coefficients.len(), usize::MAX),
            7 | 9 => (coefficients.len(), 6),
            8 => (coefficients.len(), 4),
            _ => return Err(format!("expected a formula from 1 to 9, got {number}")),
        };
        if given == 0 {
            return Err("no coefficients".into());
        }
        if given > most {
            return Err(format!("{given} coefficients, the formula has {most}"));
        }
        match coefficients.iter().position(|c| !c.is_finite()) {
            Some(i) => Err(format!("coefficient {} is not finite", i + 1)),
            None => Ok(Self { number, coefficients }),
        }
    }

    /// Refractive index at `lambda_um`, µm; NaN or infinite where the formula has no real value.
    pub fn index(&self, lambda_um: f64) -> f64 {
        let l = lambda_um;
        let l2 = l * l;
        let c = |i: usize| self.coefficients.get(i - 1).copied().unwrap_or(0.0);
        match self.number {
            1 => (1.0 + c(1) + self.sum(2, |b, c| b * l2 / (l2 - c * c))).sqrt(),
            2 => (1.0 + c(1) + self.sum(2, |b, c| b * l2 / (l2 - c))).sqrt(),
            3 => (c(1) + self.sum(2, |a, e| a * l.powf(e))).sqrt(),
            4 => {
                let resonance = |i: usize| {
                    let strength = c(i) * l.powf(c(i + 1));
                    if c(i) == 0.0 { 0.0 } else { strength / (l2 - c(i + 2).powf(c(i + 3))) }
                };
                let powers = self.sum(10, |a, e| a * l.powf(e));
                (c(1) + resonance(2) + resonance(6) + powers).sqrt()
            }
            5 => c(1) + self.sum(2, |a, e| a * l.powf(e)),
            6 => 1.0 + c(1) + self.sum(2, |b, c| b / (c - 1.0 / l2)),
            7 => {
                let pole = 1.0 / (l2 - 0.028);
                c(1) + c(2) * pole + c(3) * pole * pole + (c(4) + (c(5) + c(6) * l2) * l2) * l2
            }
            8 => {
                let s = c(1) + c(2) * l2 / (l2 - c(3)) + c(4) * l2;
                ((1.0 + 2.0 * s) / (1.0 - s)).sqrt()
            }
            // 9: there is no other.
            _ => {
                let d = l - c(5);
                (c(1) + c(2) / (l2 - c(3)) + c(4) * d / (d * d + c(6))).sqrt()
            }
        }
    }

    /// Σ term(Cᵢ, Cᵢ₊₁) over the pairs from coefficient `first` on. Pairs whose first member is
    /// zero are left out: they are place-holders, and their 0/0 must not reach the sum.
    fn sum(&self, first: usize, term: impl Fn(f64, f64) -> f64) -> f64 {
        let pairs = self.coefficients.get(first - 1..).unwrap_or_default().chunks(2);
        pairs
            .map(|pair| match *pair {
                [a, b] if a != 0.0 => term(a, b),
                [a] if a != 0.0 => term(a, 0.0),
                _ => 0.0,
            })
            .sum()
    }
}
