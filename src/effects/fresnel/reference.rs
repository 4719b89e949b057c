//! Power reflectance of a smooth interface, in f64.
//!
//! # Equations
//!
//! Light in a medium of index 1 meets a medium of index m = n + ik (relative to the first) at the
//! angle θ, cos θ = μ, sin²θ = s² = (1 − μ)(1 + μ). With the complex number w = m cos θₜ,
//! w² = m² − s², Re w ≥ 0, Im w ≥ 0, the amplitude ratios of Born & Wolf, *Principles of Optics*,
//! §1.5.2 eq. 21 (dielectric) and §14.2 (absorbing), are
//!
//! r_s = (μ − w)/(μ + w),  r_p = (m²μ − w)/(m²μ + w),  R = |r|², unpolarised R = (R_s + R_p)/2.
//!
//! Both numerators cancel near index 1, and that of r_p near Brewster's angle. Two identities
//! take the cancellation out:
//!
//! * μ² − w² = 1 − m², so r_s = (1 − m²)/(w + μ)²;
//! * r_p/r_s = −cos(θ + θₜ)/cos(θ − θₜ) = −(μw − s²)/(μw + s²) (the two parts of Born & Wolf
//!   §1.5.2 eq. 21a divided), and μ²w² − s⁴ = μ²(m² + 1) − 1, so
//!   r_p/r_s = (1 − μ²(m² + 1))/(μw + s²)².
//!
//! Hence
//!
//! R_s = |m − 1|²|m + 1|² / |w + μ|⁴,  R_p = R_s |μ²(m² + 1) − 1|² / |μw + s²|⁴,
//!
//! where |m ∓ 1|² = (n ∓ 1)² + k² and both denominators are sums of terms of one sign. What is left
//! of cancellation is Re w² = (n − 1)(n + 1) + μ² − k² (the critical angle of total reflection) and
//! Re(μ²(m² + 1) − 1) = μ²(n² − k² + 1) − 1 (Brewster's angle): these two are formed in twice the
//! working precision.

use crate::effect::DomainError;

/// Largest index for which the fourth powers above stay far from overflow.
const LARGEST_INDEX: f64 = 1e30;

/// Power reflectance for the two linear polarisations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reflectance {
    /// Electric field perpendicular to the plane of incidence (s, TE), 1, in [0, 1].
    pub s: f64,
    /// Electric field in the plane of incidence (p, TM), 1, in [0, 1].
    pub p: f64,
}

impl Reflectance {
    /// Both polarisations alike.
    const fn both(value: f64) -> Self {
        Self { s: value, p: value }
    }

    /// Reflectance of unpolarised light: the mean of the two.
    pub fn mean(self) -> f64 {
        0.5 * (self.s + self.p)
    }
}

/// Power reflectance of a smooth conductor, by polarisation.
///
/// `mu`: cosine of incidence, 1, in [0, 1]. `n`, `k`: real and imaginary part of the index of the
/// conductor relative to the outside medium, 1, n in (0, 1e30], k in [0, 1e30].
///
/// Relative error of s, p and their mean ≤ 1e-13, and ≤ 1.8e-15 on the points of
/// `tests/oracles/fresnel.csv` (n from 1e-3 to 100, k from 0 to 100, mu down to 1e-8; Brewster's and
/// the critical angle among them), wherever the value is above 1e-290. Exactly 1 at mu = 0, except
/// that an index of exactly 1 is no interface: exactly 0 at every mu.
///
/// Source: Born & Wolf §1.5.2 and §14.2, rearranged as in the module's text.
///
/// # Errors
/// [`DomainError`] for an argument outside its domain or not finite.
pub fn conductor(mu: f64, n: f64, k: f64) -> Result<Reflectance, DomainError> {
    DomainError::unless((0.0..=1.0).contains(&mu), "mu", mu, "[0, 1]")?;
    DomainError::unless(n > 0.0 && n <= LARGEST_INDEX, "n", n, "(0, 1e30]")?;
    DomainError::unless((0.0..=LARGEST_INDEX).contains(&k), "k", k, "[0, 1e30]")?;
    Ok(reflectance(mu, n, k))
}

/// Power reflectance of a smooth interface between two dielectrics, by polarisation.
///
/// `mu`: cosine of incidence, 1, in [0, 1]. `eta`: index of the far side over that of the near
/// side, 1, in (0, 1e30]; below 1 there is a critical angle, beyond which both parts are exactly 1.
///
/// Accuracy as for [`conductor`]; at Brewster's angle the p part vanishes and its relative error
/// stays ≤ 1e-13 nevertheless.
///
/// Source: Born & Wolf §1.5.2 to §1.5.4, rearranged as in the module's text.
///
/// # Errors
/// [`DomainError`] for an argument outside its domain or not finite.
pub fn dielectric(mu: f64, eta: f64) -> Result<Reflectance, DomainError> {
    DomainError::unless((0.0..=1.0).contains(&mu), "mu", mu, "[0, 1]")?;
    DomainError::unless(eta > 0.0 && eta <= LARGEST_INDEX, "eta", eta, "(0, 1e30]")?;
    Ok(reflectance(mu, eta, 0.0))
}

/// Weight of the edge colour in Schlick's approximation, (1 − mu)⁵.
///
/// `mu`: cosine of incidence, 1, in [0, 1]. Returns 1, in [0, 1], relative error ≤ 1e-15.
/// Source: C. Schlick, *An Inexpensive BRDF Model for Physically-based Rendering*, Computer
/// Graphics Forum 13(3), 1994, eq. 15.
///
/// # Errors
/// [`DomainError`] if `mu` is outside [0, 1] or not finite.
pub fn schlick_weight(mu: f64) -> Result<f64, DomainError> {
    DomainError::unless((0.0..=1.0).contains(&mu), "mu", mu, "[0, 1]")?;
    let grazing = 1.0 - mu;
    let square = grazing * grazing;
    Ok(square * square * grazing)
}

/// The equations of the module's text, for arguments inside their domains.
fn reflectance(mu: f64, n: f64, k: f64) -> Reflectance {
    if n == 1.0 && k == 0.0 {
        return Reflectance::both(0.0);
    }
    if mu == 0.0 {
        return Reflectance::both(1.0);
    }
    let mu_squared = Pair::product(mu, mu);
    let k_squared = Pair::product(k, k);
    let n_squared_less_one = Pair::sum(n, -1.0).times(Pair::sum(n, 1.0));
    let w_squared = n_squared_less_one.plus(mu_squared).plus(k_squared.negated()).value();
    let w_squared_im = 2.0 * n * k;
    if k == 0.0 && w_squared <= 0.0 {
        return Reflectance::both(1.0);
    }
    let (w, w_im) = square_root(w_squared, w_squared_im);

    let s_squared = (1.0 - mu) * (1.0 + mu);
    let from_one = ((n - 1.0).powi(2) + k * k) * ((n + 1.0).powi(2) + k * k);
    let s = from_one / ((w + mu).powi(2) + w_im * w_im).powi(2);

    let brewster = mu_squared
        .times(n_squared_less_one.plus(k_squared.negated()).plus(Pair::of(2.0)))
        .plus(Pair::of(-1.0))
        .value();
    let brewster_im = mu * mu * w_squared_im;
    let ratio = (brewster * brewster + brewster_im * brewster_im)
        / ((mu * w + s_squared).powi(2) + (mu * w_im).powi(2)).powi(2);
    // Rounding may lift a value next to 1 above it by a few units in the last place.
    Reflectance { s: s.min(1.0), p: (s * ratio).min(1.0) }
}

/// Square root of re + i·im, im ≥ 0, in the first quadrant, without cancellation.
fn square_root(re: f64, im: f64) -> (f64, f64) {
    let larger = ((re.hypot(im) + re.abs()) / 2.0).sqrt();
    let smaller = if larger > 0.0 { im / (2.0 * larger) } else { 0.0 };
    if re >= 0.0 { (larger, smaller) } else { (smaller, larger) }
}

/// An unevaluated sum of two f64, high part first: about 104 bits.
#[derive(Debug, Clone, Copy)]
struct Pair {
    high: f64,
    low: f64,
}

impl Pair {
    const fn of(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// a + b exactly (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self { high, low: (a - (high - of_b)) + (b - of_b) }
    }

    /// a · b exactly, barring underflow.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    fn plus(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let first = Self::sum(high.high, high.low + low.high);
        Self::sum(first.high, first.low + low.low)
    }

    fn times(self, other: Self) -> Self {
        let high = Self::product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        Self::sum(high.high, high.low + cross)
    }

    fn negated(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }

    fn value(self) -> f64 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grazing_light_is_reflected_whole() {
        for (n, k) in [(1e-3, 0.0), (0.05, 3.3), (1.5, 0.0), (2.9, 3.0), (100.0, 100.0)] {
            assert_eq!(conductor(0.0, n, k), Ok(Reflectance::both(1.0)));
        }
        assert_eq!(dielectric(0.0, 1.5), Ok(Reflectance::both(1.0)));
    }

    #[test]
    fn index_one_is_no_interface() {
        for mu in [0.0, 1e-8, 0.3, 1.0] {
            assert_eq!(conductor(mu, 1.0, 0.0), Ok(Reflectance::both(0.0)));
            assert_eq!(dielectric(mu, 1.0), Ok(Reflectance::both(0.0)));
        }
    }

    #[test]
    fn normal_incidence_has_the_textbook_value() {
        let glass = dielectric(1.0, 1.5).map(Reflectance::mean);
        assert!(glass.is_ok_and(|r| (r - 0.04).abs() < 1e-17));
        let both = conductor(1.0, 0.5, 2.0);
        assert!(both.is_ok_and(|r| r.s == r.p && (r.s - 4.25 / 6.25).abs() < 1e-15));
    }

    #[test]
    fn beyond_the_critical_angle_everything_is_reflected() {
        // eta = 0.6: the critical angle has mu = 0.8.
        assert_eq!(dielectric(0.79, 0.6), Ok(Reflectance::both(1.0)));
        assert!(dielectric(0.81, 0.6).is_ok_and(|r| r.s < 1.0 && r.p < r.s));
    }

    #[test]
    fn the_two_references_agree_without_absorption() {
        for mu in [1e-8, 0.1, 0.77, 1.0] {
            assert_eq!(conductor(mu, 1.33, 0.0), dielectric(mu, 1.33));
        }
    }

    #[test]
    fn arguments_outside_their_domain_are_named() {
        let at_fault = |r: Result<Reflectance, DomainError>| r.err().map(|e| e.quantity);
        assert_eq!(at_fault(conductor(-1e-300, 1.0, 1.0)), Some("mu"));
        assert_eq!(at_fault(conductor(f64::NAN, 1.0, 1.0)), Some("mu"));
        assert_eq!(at_fault(conductor(0.5, 0.0, 1.0)), Some("n"));
        assert_eq!(at_fault(conductor(0.5, f64::INFINITY, 1.0)), Some("n"));
        assert_eq!(at_fault(conductor(0.5, 1.0, -1.0)), Some("k"));
        assert_eq!(at_fault(dielectric(1.5, 1.0)), Some("mu"));
        assert_eq!(at_fault(dielectric(0.5, -1.5)), Some("eta"));
        assert!(schlick_weight(1.0 + f64::EPSILON).is_err());
    }
}
