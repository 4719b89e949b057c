//! The sine integral Si(x) = ∫₀ˣ sin t / t dt in f64, and the auxiliary functions behind it.
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | f(x), g(x) | [`auxiliary`] | Si = π/2 − f cos x − g sin x for x > 0, A&S 5.2.8 |
//! | E₁(z) | `scaled_exponential_integral` | f and g are its parts: eⁱˣ E₁(ix) = g − i f |
//! | γ | `EULER_GAMMA` | Euler's constant |
//!
//! Three formulas, none of which a form uses: the power series up to 4 (its terms cancel by a
//! factor Shi(4)/Si(4) = 5.6 at most), the continued fraction of E₁ on the imaginary axis up to 40,
//! and the asymptotic series beyond, whose smallest term is below e⁻⁴⁰. Elementary functions are
//! core-math's, correctly rounded with full argument reduction, so the value is the same on every
//! machine and right for arguments up to the largest f64.

use std::f64::consts::{EULER_GAMMA, FRAC_PI_2};

use nalgebra::Complex;

/// End of the power series.
const SERIES_END: f64 = 4.0;
/// Start of the asymptotic series.
const ASYMPTOTIC_START: f64 = 40.0;

/// Sine integral Si(x) = ∫₀ˣ sin t / t dt.
///
/// `x`: any f64. Returns Si(x), 1, in [−Si(π), Si(π)]; ±π/2 for ±∞, NaN for NaN, odd to the bit
/// (Si(−0) = −0). Relative error ≤ 1e-14 for every finite x (`tests/references.rs`; 5.0e-16 is the
/// largest measured).
/// Source: A&S 5.2.14 (series), 5.1.22 (continued fraction of E₁), 5.2.34–35 (asymptotic series).
pub fn sine_integral(x: f64) -> f64 {
    let magnitude = x.abs();
    let value = if magnitude <= SERIES_END {
        series(magnitude)
    } else if magnitude.is_finite() {
        let (f, g) = auxiliary(magnitude);
        let (sin, cos) = core_math::sincos(magnitude);
        FRAC_PI_2 - f * cos - g * sin
    } else {
        // ∞ + π/2 would be ∞; NaN must stay NaN.
        if magnitude.is_nan() { magnitude } else { FRAC_PI_2 }
    };
    value.copysign(x)
}

/// Auxiliary functions f(x) and g(x) of the sine and cosine integrals, A&S 5.2.6–7:
/// f = Ci sin x + (π/2 − Si) cos x, g = −Ci cos x + (π/2 − Si) sin x.
///
/// `x` > 0. Returns (f, g), both positive and decreasing, from (π/2, ∞) at 0 to (1/x, 1/x²); NaN for
/// negative x and NaN. Error of either ≤ 1e-14 f(x) (`tests/references.rs`).
pub fn auxiliary(x: f64) -> (f64, f64) {
    if x.is_nan() || x < 0.0 {
        (f64::NAN, f64::NAN)
    } else if x == 0.0 {
        (FRAC_PI_2, f64::INFINITY)
    } else if x <= SERIES_END {
        let (sin, cos) = core_math::sincos(x);
        let (ci, rest) = (cosine_integral_series(x), FRAC_PI_2 - series(x));
        (ci * sin + rest * cos, rest * sin - ci * cos)
    } else if x < ASYMPTOTIC_START {
        let value = scaled_exponential_integral(x);
        (-value.im, value.re)
    } else {
        asymptotic(x)
    }
}

/// Si by A&S 5.2.14, x·(1 + Σ (−1)ᵏ x²ᵏ / ((2k + 1)(2k + 1)!)), for 0 ≤ x ≤ 4.
fn series(x: f64) -> f64 {
    x + x * alternating(x, 1.0)
}

/// Ci by A&S 5.2.16, γ + ln x + Σ (−1)ᵏ x²ᵏ / (2k (2k)!), for 0 < x ≤ 4.
fn cosine_integral_series(x: f64) -> f64 {
    EULER_GAMMA + core_math::log(x) + alternating(x, 0.0)
}

/// Σ (−1)ᵏ x²ᵏ first! / (m m!), m = 2k + `first`, over k ≥ 1; `first` is 0 or 1.
fn alternating(x: f64, first: f64) -> f64 {
    let square = x * x;
    let (mut power, mut sum, mut m) = (1.0, 0.0, first);
    loop {
        // power = (−1)ᵏ x²ᵏ / m!
        power *= -square / ((m + 1.0) * (m + 2.0));
        m += 2.0;
        let next = sum + power / m;
        if next == sum {
            return sum;
        }
        sum = next;
    }
}

/// eⁱˣ E₁(ix) by the continued fraction A&S 5.1.22 in its even part,
/// 1/(z + 1 − 1²/(z + 3 − 2²/(z + 5 − …))), evaluated by Steed's algorithm, for x ≥ 4.
fn scaled_exponential_integral(x: f64) -> Complex<f64> {
    let mut b = Complex::new(1.0, x);
    let mut d = b.inv();
    let (mut step, mut value) = (d, d);
    let mut k = 0.0;
    // At x = 4, where it is slowest, it takes 54 terms; the bound is never met.
    while k < 500.0 {
        k += 1.0;
        let a = -k * k;
        b += 2.0;
        // Steed writes b d − 1, which cancels; it equals −a d₋₁ d.
        let previous = d;
        d = (previous * a + b).inv();
        step *= previous * d * -a;
        value += step;
        if step.norm_sqr() < 1e-34 * value.norm_sqr() {
            break;
        }
    }
    value
}

/// f and g by A&S 5.2.34–35, f ~ (1/x) Σ (−1)ⁿ (2n)!/x²ⁿ, g ~ (1/x²) Σ (−1)ⁿ (2n + 1)!/x²ⁿ, for
/// x ≥ 40: terms fall until n = 20, and the sums end long before.
fn asymptotic(x: f64) -> (f64, f64) {
    // Not x², which overflows beyond 1e154.
    let inverse = 1.0 / x;
    let ratio = -inverse * inverse;
    let (mut f, mut g) = (0.0, 0.0);
    let (mut term, mut n) = (1.0, 0.0);
    loop {
        let (next_f, odd) = (f + term, term * (n + 1.0));
        let next_g = g + odd;
        if (next_f == f && next_g == g) || n > ASYMPTOTIC_START {
            return (f * inverse, g * inverse * inverse);
        }
        (f, g) = (next_f, next_g);
        term = odd * (n + 2.0) * ratio;
        n += 2.0;
    }
}
