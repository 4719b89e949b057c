//! The dispersion formulas of refractiveindex.info, numbered as there.
//!
//! Source: refractiveindex.info database, "Dispersion formulas" (M. N. Polyanskiy, Sci. Data 11,
//! 94 (2024)). Wavelengths λ in µm; C₁, C₂ … are the coefficients in the order of the record;
//! those that a record leaves out are zero.

/// A dispersion formula with its coefficients.
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersion {
    formula: Formula,
    coefficients: Vec<f64>,
}

/// The shape of a dispersion formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formula {
    /// 1: n² − 1 = C₁ + Σ C₂ᵢ λ²/(λ² − C₂ᵢ₊₁²).
    Sellmeier,
    /// 2: n² − 1 = C₁ + Σ C₂ᵢ λ²/(λ² − C₂ᵢ₊₁).
    Sellmeier2,
    /// 3: n² = C₁ + Σ C₂ᵢ λ^C₂ᵢ₊₁.
    Polynomial,
    /// 4: n² = C₁ + C₂ λ^C₃/(λ² − C₄^C₅) + C₆ λ^C₇/(λ² − C₈^C₉) + C₁₀ λ^C₁₁ + ….
    RefractiveIndexInfo,
    /// 5: n = C₁ + Σ C₂ᵢ λ^C₂ᵢ₊₁.
    Cauchy,
    /// 6: n − 1 = C₁ + Σ C₂ᵢ/(C₂ᵢ₊₁ − λ⁻²).
    Gases,
    /// 7: n = C₁ + C₂ L + C₃ L² + C₄ λ² + C₅ λ⁴ + C₆ λ⁶, with L = 1/(λ² − 0.028).
    Herzberger,
    /// 8: (n² − 1)/(n² + 2) = C₁ + C₂ λ²/(λ² − C₃) + C₄ λ².
    Retro,
    /// 9: n² = C₁ + C₂/(λ² − C₃) + C₄ (λ − C₅)/((λ − C₅)² + C₆).
    Exotic,
}

impl Formula {
    /// The formula of that number, 1 to 9.
    pub fn numbered(number: u32) -> Option<Self> {
        Some(match number {
            1 => Self::Sellmeier,
            2 => Self::Sellmeier2,
            3 => Self::Polynomial,
            4 => Self::RefractiveIndexInfo,
            5 => Self::Cauchy,
            6 => Self::Gases,
            7 => Self::Herzberger,
            8 => Self::Retro,
            9 => Self::Exotic,
            _ => return None,
        })
    }

    /// Most coefficients that the formula has a place for; none for an open sum.
    fn most_coefficients(self) -> Option<usize> {
        match self {
            Self::Herzberger | Self::Exotic => Some(6),
            Self::Retro => Some(4),
            _ => None,
        }
    }
}

impl Dispersion {
    /// A formula with its coefficients, in the order of the record.
    ///
    /// # Errors
    /// In words, if there are no coefficients, more than the formula has, or one is not finite.
    pub fn new(formula: Formula, coefficients: Vec<f64>) -> Result<Self, String> {
        let given = coefficients.len();
        if given == 0 {
            return Err("no coefficients".into());
        }
        if let Some(most) = formula.most_coefficients().filter(|most| given > *most) {
            return Err(format!("{given} coefficients, the formula has {most}"));
        }
        match coefficients.iter().position(|c| !c.is_finite()) {
            Some(i) => Err(format!("coefficient {} is not finite", i + 1)),
            None => Ok(Self { formula, coefficients }),
        }
    }

    /// The shape of the formula.
    pub fn formula(&self) -> Formula {
        self.formula
    }

    /// Refractive index at `lambda_um`, µm; NaN or infinite where the formula has no real value.
    pub fn index(&self, lambda_um: f64) -> f64 {
        let l = lambda_um;
        let l2 = l * l;
        let c = |i: usize| self.coefficients.get(i - 1).copied().unwrap_or(0.0);
        match self.formula {
            Formula::Sellmeier => (1.0 + c(1) + self.sum(2, |b, c| b * l2 / (l2 - c * c))).sqrt(),
            Formula::Sellmeier2 => (1.0 + c(1) + self.sum(2, |b, c| b * l2 / (l2 - c))).sqrt(),
            Formula::Polynomial => (c(1) + self.sum(2, |a, e| a * l.powf(e))).sqrt(),
            Formula::RefractiveIndexInfo => {
                let resonance = |i: usize| {
                    let strength = c(i) * l.powf(c(i + 1));
                    if c(i) == 0.0 { 0.0 } else { strength / (l2 - c(i + 2).powf(c(i + 3))) }
                };
                let powers = self.sum(10, |a, e| a * l.powf(e));
                (c(1) + resonance(2) + resonance(6) + powers).sqrt()
            }
            Formula::Cauchy => c(1) + self.sum(2, |a, e| a * l.powf(e)),
            Formula::Gases => 1.0 + c(1) + self.sum(2, |b, c| b / (c - 1.0 / l2)),
            Formula::Herzberger => {
                let pole = 1.0 / (l2 - 0.028);
                c(1) + c(2) * pole + c(3) * pole * pole + (c(4) + (c(5) + c(6) * l2) * l2) * l2
            }
            Formula::Retro => {
                let s = c(1) + c(2) * l2 / (l2 - c(3)) + c(4) * l2;
                ((1.0 + 2.0 * s) / (1.0 - s)).sqrt()
            }
            Formula::Exotic => {
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
