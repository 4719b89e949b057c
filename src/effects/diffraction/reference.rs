//! Powers of the orders of gratings, in closed form.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | m | `order` | 1 | order |
//! | a | `phase` | rad | amplitude of the phase of a sinusoid of amplitude b: k w b |
//! | φ | `phase` | rad | phase between top and bottom of a rectangular profile of depth D: k w D |
//! | q | `duty` | 1 | share of the period at the top |
//!
//! e^(−ia sin t) = Σ J_m(a) e^(−imt) (Jacobi–Anger), so a sinusoid sends J_m(a)² into order m. A
//! profile that is at phase φ over the share q of its period has the Fourier coefficients
//! 1 + q (e^(−iφ) − 1) for m = 0 and (e^(−iφ) − 1) sin(π m q)/(π m) otherwise, up to a phase, and
//! |e^(−iφ) − 1|² = 4 sin²(φ/2).

use std::f64::consts::PI;

use crate::effect::DomainError;

/// Largest order.
pub const MOST_ORDER: u32 = 10;
/// Largest amplitude of the phase, rad.
pub const MOST_PHASE: f64 = 20.0;

/// Share of the power that a sinusoidal phase grating sends into order `order`: J_m(a)².
///
/// `order`: at most 10. `phase`: a, rad, in [0, 20]. Returns a share, 1, in [0, 1]; summed over all
/// orders of both signs it is 1. Absolute error ≤ 1e-13 (tests/diffraction.rs; 1e-15 measured).
/// Source: Goodman, Introduction to Fourier Optics, §4.4.4.
///
/// # Errors
/// [`DomainError`] if an argument is outside its domain.
pub fn sinusoid_order_power(order: u32, phase: f64) -> Result<f64, DomainError> {
    within("order", f64::from(order), "[0, 10]", f64::from(MOST_ORDER))?;
    within("phase", phase, "[0, 20]", MOST_PHASE)?;
    let amplitude = libm::jn(order as i32, phase);
    Ok(amplitude * amplitude)
}

/// Share of the power that a rectangular phase grating sends into order `order`.
///
/// `order`: at most 10. `duty`: share of the period at the top, in [0, 1]. `phase`: φ, rad, in [0, 20].
/// Returns a share, 1, in [0, 1]; summed over all orders of both signs it is 1. Absolute error
/// ≤ 1e-13 (tests/diffraction.rs).
/// Source: Fourier series of the profile, as derived in this module.
///
/// # Errors
/// [`DomainError`] if an argument is outside its domain.
pub fn rectangular_order_power(order: u32, duty: f64, phase: f64) -> Result<f64, DomainError> {
    within("order", f64::from(order), "[0, 10]", f64::from(MOST_ORDER))?;
    within("duty", duty, "[0, 1]", 1.0)?;
    within("phase", phase, "[0, 20]", MOST_PHASE)?;
    let half = core_math::sin(0.5 * phase);
    let step = 4.0 * half * half;
    if order == 0 {
        return Ok(1.0 - duty * (1.0 - duty) * step);
    }
    let m = f64::from(order);
    // Whole turns come off before π is multiplied in.
    let turns = m * duty - (m * duty).round();
    let shape = core_math::sin(PI * turns) / (PI * m);
    Ok(step * shape * shape)
}

fn within(
    quantity: &'static str,
    got: f64,
    expected: &'static str,
    most: f64,
) -> Result<f64, DomainError> {
    DomainError::unless((0.0..=most).contains(&got), quantity, got, expected)
}

/// An order given as a number.
///
/// # Errors
/// [`DomainError`] if it is no whole number from 0 to 10.
pub(super) fn whole(order: f64) -> Result<u32, DomainError> {
    let inside = order.fract() == 0.0 && (0.0..=f64::from(MOST_ORDER)).contains(&order);
    DomainError::unless(inside, "order", order, "whole numbers from 0 to 10")?;
    Ok(order as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_sum_to_one() {
        for phase in [0.0, 0.3, 1.4, 2.0] {
            let power = |m| sinusoid_order_power(m, phase).expect("in the domain");
            let sum = power(0) + 2.0 * (1..=10).map(power).sum::<f64>();
            // J_11(2)² = 5e-16 is left out, twice.
            assert!((sum - 1.0).abs() < 1e-14, "{phase}: {sum}");
        }
    }

    #[test]
    fn small_phases_agree_with_the_first_order() {
        for phase in [1e-3, 1e-2] {
            let first = sinusoid_order_power(1, phase).expect("in the domain");
            assert!((first / (0.25 * phase * phase) - 1.0).abs() < phase * phase);
            let zero = sinusoid_order_power(0, phase).expect("in the domain");
            assert!((1.0 - zero - 0.5 * phase * phase).abs() < phase.powi(4));
        }
    }

    #[test]
    fn half_a_wave_at_half_duty_leaves_no_mirror() {
        let zero = rectangular_order_power(0, 0.5, PI).expect("in the domain");
        assert!(zero.abs() < 1e-15);
        let first = rectangular_order_power(1, 0.5, PI).expect("in the domain");
        assert!((first - 4.0 / (PI * PI)).abs() < 1e-15);
        assert!(rectangular_order_power(2, 0.5, PI).expect("in the domain") < 1e-30);
    }

    #[test]
    fn arguments_outside_are_refused() {
        assert!(sinusoid_order_power(11, 1.0).is_err());
        for phase in [-1e-9, 20.1, f64::NAN] {
            assert!(sinusoid_order_power(0, phase).is_err());
            assert!(rectangular_order_power(0, 0.5, phase).is_err());
        }
        assert!(rectangular_order_power(0, 1.1, 1.0).is_err());
        assert!(whole(1.5).is_err() && whole(-1.0).is_err() && whole(f64::NAN).is_err());
    }
}
