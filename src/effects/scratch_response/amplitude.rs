//! Factors of the scattered amplitude of velinov2018 eq. 2–5, in f64.

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::LazyLock;

use errorfunctions::w_with_relerror;
use nalgebra::Complex;

use crate::numeric::quadrature::GaussLegendre;

/// Longest scratch, over σ, whose Fourier integral is taken by quadrature.
const SHORT: f64 = 0.5;
/// Largest phase from end to end, rad, of a scratch taken by quadrature.
const SHORT_PHASE: f64 = 64.0;
/// Phase that one panel of 24 nodes integrates to rounding, rad.
const PANEL_PHASE: f64 = 8.0;

/// sinc(πx) = sin πx / πx, without loss next to its zeros.
pub fn sinc_pi(x: f64) -> f64 {
    let turns = x.abs();
    if turns < 1e-9 {
        return 1.0;
    }
    let nearest = turns.round();
    let sine = core_math::sin(PI * (turns - nearest));
    // sin π(n + r) = (−1)ⁿ sin πr
    let sign = if nearest % 2.0 == 0.0 { 1.0 } else { -1.0 };
    sign * sine / (PI * turns)
}

/// Depth factor 𝒟 = 1 − exp(i2π(γ + γᵢ)D/λ): the light that misses the surface less the light that
/// went down to the floor of the scratch and back.
///
/// `mu_sum`: γ + γᵢ, sum of the cosines of incidence and exitance; 2 is the small-angle limit, eq. 4.
/// Returns 2 sin πt · (sin πt − i cos πt) with t = (γ + γᵢ)D/λ: no cancellation next to whole t.
pub fn depth_factor(depth_um: f64, wavelength_um: f64, mu_sum: f64) -> Complex<f64> {
    let turns = mu_sum * depth_um / wavelength_um;
    let (sin, cos) = core_math::sincos(PI * (turns - turns.round()));
    Complex::new(2.0 * sin * sin, -2.0 * sin * cos)
}

/// Gaussian-windowed Fourier integral along a scratch, over its value for the infinite scratch at
/// ξ₁ = 0: (1/√(2π)σ) ∫ exp(−t²/2σ² − ikξ₁t) dt over [begin, end]; eq. 5 without its dependence on s_b.
///
/// `wavenumber_sigma`: σkξ₁. `begin`, `end`: ends of the scratch along itself from the shaded point,
/// over σ, begin ≤ end; infinities give eq. 8.
pub fn along_factor(wavenumber_sigma: f64, begin: f64, end: f64) -> Complex<f64> {
    let length = end - begin;
    let phase = (wavenumber_sigma * length).abs();
    if length <= SHORT && phase <= SHORT_PHASE {
        by_quadrature(wavenumber_sigma, begin, end)
    } else if begin >= 0.0 {
        // Both ends on one side: the whole cancels, the tails do not.
        0.5 * (tail(wavenumber_sigma, begin) - tail(wavenumber_sigma, end))
    } else if end <= 0.0 {
        0.5 * (tail(wavenumber_sigma, end) - tail(wavenumber_sigma, begin))
    } else {
        let whole = core_math::exp(-0.5 * wavenumber_sigma * wavenumber_sigma);
        whole - 0.5 * (tail(wavenumber_sigma, begin) + tail(wavenumber_sigma, end))
    }
}

/// exp(−b²) erfc(±(a + ib)) with a = t/√2 and b = q/√2, + for t ≥ 0, for any q and t: what an end at t
/// takes from the infinite scratch, twice.
///
/// erf itself overflows beyond b = 26. With erfc z = exp(−z²) w(iz), where w is Faddeeva's function,
/// exp(−b²) exp(−z²) = exp(−a² − 2iab), and |w| ≤ 1 as Im(iz) = |a| ≥ 0: nothing overflows.
fn tail(q: f64, t: f64) -> Complex<f64> {
    let side = if t < 0.0 { -1.0 } else { 1.0 };
    let (a, b) = (t.abs() * FRAC_1_SQRT_2, q * FRAC_1_SQRT_2);
    let window = core_math::exp(-a * a);
    if window == 0.0 {
        return Complex::new(0.0, 0.0);
    }
    let (sin, cos) = core_math::sincos(t * q);
    Complex::new(cos, -sin) * w_with_relerror(Complex::new(-side * b, a), 0.0) * window
}

/// The integral itself: for short scratches the difference of two values of erf would cancel.
fn by_quadrature(q: f64, begin: f64, end: f64) -> Complex<f64> {
    static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(24));
    let panels = 1 + ((q * (end - begin)).abs() / PANEL_PHASE) as usize;
    let part = |f: fn(f64) -> f64| {
        let integrand = |t: f64| core_math::exp(-0.5 * t * t) * f(q * t);
        RULE.integral_in_panels(integrand, begin, end, panels) / (2.0 * PI).sqrt()
    };
    Complex::new(part(core_math::cos), -part(core_math::sin))
}
