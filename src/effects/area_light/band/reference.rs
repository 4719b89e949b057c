//! The band integral B(x₀, x₁) = ∫ sinc²(t/2) dt in f64, sinc u = sin u/u, to rounding for every band.
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | P(x) | `from_zero` | B(0, x); P(∞) = π |
//! | H(x) | `complement` | (π − P)/2 = 1/x − E(x), x > 0 |
//! | E(x) | `oscillation` | (1/x − f) cos x − g sin x, with f and g of A&S 5.2.6–7 |
//!
//! By parts, P(x) = 2 Si(x) − 2(1 − cos x)/x, and Si = π/2 − f cos x − g sin x makes that
//! π − 2H(x). A band on one side of 0, 0 ≤ a < b, is taken in one of two ways:
//!
//! * up to `WIDE` it is integrated by Gauss–Legendre panels of one period. The integrand is entire and
//!   not negative, so nothing cancels; at t = a + δ its sine is sin(a/2) cos(δ/2) + cos(a/2) sin(δ/2),
//!   with δ from b − a and never from t, so that a narrow band about a zero 2πn keeps its digits
//!   although t has rounded them away;
//! * beyond, B = 2[(b − a)/(ab) + E(b) − E(a)], where E = O(1/x²) is small beside the first term.
//!
//! A band across 0 is P(b) + P(−a). Elementary functions are core-math's, correctly rounded with full
//! argument reduction.

use std::f64::consts::{PI, TAU};

use crate::effects::sine_integral::auxiliary;
use crate::numeric::quadrature::GaussLegendre;

/// Widest band that is integrated in panels: eight periods.
const WIDE: f64 = 8.0 * TAU;
/// Start of the asymptotic series, whose smallest term is below e⁻⁴⁰ there.
const ASYMPTOTIC_START: f64 = 40.0;
/// Below it g is next to its logarithmic singularity; P is integrated instead.
const AUXILIARY_START: f64 = 4.0;
/// Nodes per panel: 24 integrate a period of sinc² to rounding.
const ORDER: usize = 24;

/// Band integral ∫ sinc²(t/2) dt from `x0` to `x1`, with sinc u = sin u/u.
///
/// `x0`, `x1`: any f64, in either order. Returns the integral, 1, in [−2π, 2π]: positive for x0 < x1,
/// to the bit the negative of that with the bounds swapped, 0 for equal bounds, NaN for NaN. Relative
/// error ≤ 1e-13 wherever the value is a normal f64 (`tests/band.rs`).
/// Source: by parts from velinov2018 eq. 25; A&S 5.2.6–8 and 5.2.34–35.
pub fn sinc_squared_band(x0: f64, x1: f64) -> f64 {
    if x0.is_nan() || x1.is_nan() {
        f64::NAN
    } else if x0 == x1 {
        0.0
    } else if x0 > x1 {
        -ascending(x1, x0)
    } else {
        ascending(x0, x1)
    }
}

/// The band for `x0` < `x1`.
fn ascending(x0: f64, x1: f64) -> f64 {
    if x0 >= 0.0 {
        one_sided(x0, x1)
    } else if x1 <= 0.0 {
        one_sided(-x1, -x0)
    } else {
        from_zero(-x0) + from_zero(x1)
    }
}

/// The band for 0 ≤ `near` < `far`.
fn one_sided(near: f64, far: f64) -> f64 {
    let width = far - near;
    if width <= WIDE {
        in_panels(near, width)
    } else if near < AUXILIARY_START {
        from_zero(far) - from_zero(near)
    } else {
        let reciprocals = if far.is_finite() { width / far / near } else { 1.0 / near };
        2.0 * (reciprocals + oscillation(far) - oscillation(near))
    }
}

/// P(x), for x ≥ 0.
fn from_zero(x: f64) -> f64 {
    if x <= WIDE { in_panels(0.0, x) } else { PI - 2.0 * complement(x) }
}

/// H(x), for x > 0.
fn complement(x: f64) -> f64 {
    1.0 / x - oscillation(x)
}

/// Gauss–Legendre panels of a period at most, for `near` ≥ 0 and 0 ≤ `width` ≤ [`WIDE`].
fn in_panels(near: f64, width: f64) -> f64 {
    thread_local! {
        static RULE: GaussLegendre = GaussLegendre::new(ORDER);
    }
    let (sin, cos) = core_math::sincos(0.5 * near);
    let sinc_squared = |part: f64| {
        let offset = part * width;
        let t = near + offset;
        // There 1 − t²/12 is 1, and half of a subnormal may be none.
        if t < 1e-8 {
            return 1.0;
        }
        let (sin_offset, cos_offset) = core_math::sincos(0.5 * offset);
        let sinc = 2.0 * (sin * cos_offset + cos * sin_offset) / t;
        sinc * sinc
    };
    let panels = (width / TAU).ceil() as usize;
    // The mean first: half a subnormal width may be none.
    width * RULE.with(|rule| rule.integral_in_panels(sinc_squared, 0.0, 1.0, panels))
}

/// E(x) = (1/x − f) cos x − g sin x, for x ≥ 4; it decays as 1/x².
fn oscillation(x: f64) -> f64 {
    if x.is_infinite() {
        return 0.0;
    }
    let (rest, g) = if x < ASYMPTOTIC_START {
        let (f, g) = auxiliary(x);
        (1.0 / x - f, g)
    } else {
        asymptotic(x)
    };
    let (sin, cos) = core_math::sincos(x);
    rest * cos - g * sin
}

/// 1/x − f and g by A&S 5.2.34–35 without the term that the first loses to cancellation:
/// (1/x) Σ₁ (−1)ⁿ⁺¹ (2n)!/x²ⁿ and (1/x²) Σ₀ (−1)ⁿ (2n + 1)!/x²ⁿ, for x ≥ 40.
fn asymptotic(x: f64) -> (f64, f64) {
    // Not x², which overflows beyond 1e154.
    let inverse = 1.0 / x;
    let ratio = -inverse * inverse;
    let (mut rest, mut g) = (0.0, 0.0);
    // (−1)ⁿ (2n)!/x²ⁿ
    let (mut term, mut n) = (1.0, 0.0);
    loop {
        let odd = term * (n + 1.0);
        let next_g = g + odd;
        term = odd * (n + 2.0) * ratio;
        let next_rest = rest - term;
        n += 2.0;
        if (next_rest == rest && next_g == g) || n > ASYMPTOTIC_START {
            return (rest * inverse, g * inverse * inverse);
        }
        (rest, g) = (next_rest, next_g);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_orders() {
        assert_eq!(sinc_squared_band(3.0, 3.0), 0.0);
        assert_eq!(sinc_squared_band(0.0, 5e-324), 5e-324);
        assert_eq!(sinc_squared_band(-0.0, 0.0), 0.0);
        assert_eq!(sinc_squared_band(f64::NEG_INFINITY, f64::INFINITY), TAU);
        assert_eq!(sinc_squared_band(f64::INFINITY, 0.0), -PI);
        assert_eq!(sinc_squared_band(f64::INFINITY, f64::INFINITY), 0.0);
        assert!(sinc_squared_band(f64::NAN, 1.0).is_nan());
        assert!(sinc_squared_band(1.0, f64::NAN).is_nan());
        assert!((sinc_squared_band(f64::MIN, f64::MAX) - TAU).abs() < 1e-15);
    }

    #[test]
    fn the_two_ways_meet_where_they_change() {
        for near in [0.0, 1.0, 3.99, 4.0, 10.0, 39.0, 41.0, 1e3, 1e5] {
            let by_panels = in_panels(near, WIDE);
            let wider = sinc_squared_band(near, near + WIDE * (1.0 + 1e-9));
            // The crest of the integrand times the step is 2e-9 of a far band.
            assert!((wider - by_panels).abs() <= 3e-9 * by_panels, "{near}");
        }
    }
}
