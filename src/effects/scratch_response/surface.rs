//! The SVBRDF of a scratched mirror, velinov2018 eq. 1 and 2, and each of its simplifications as a
//! function of its own.
//!
//! Amplitudes are over √π σλ, so that a squared magnitude is a reflectance: the mirror alone has
//! 2√π (σ/λ) exp(−σ²k²|ξ|²/2), a scratch √2 (W/λ) sinc(πWξ₂/λ) 𝒟 η/(√(2π)σ).
//! The other two simplifications need no function: an infinite scratch has infinite ends
//! ([`StraightScratch::unbounded`]), and small angles have [`Directions::mu_sum`] = 2.

use std::f64::consts::{PI, SQRT_2};

use nalgebra::Complex;

use super::amplitude::{along_factor, depth_factor, sinc_pi};

/// A straight scratch with a rectangular cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightScratch {
    /// A point on its centre line, from the shaded point, µm.
    pub position_um: [f64; 2],
    /// Direction of its tangent, counterclockwise from the first axis of the surface, rad.
    pub direction_rad: f64,
    /// Where it begins along the tangent, from `position_um`, µm; −∞ for no end.
    pub begin_um: f64,
    /// Where it ends, µm; ∞ for no end.
    pub end_um: f64,
    /// Width W, µm.
    pub width_um: f64,
    /// Depth D, µm.
    pub depth_um: f64,
}

/// The light and the area over which it is coherent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coherence {
    /// Wavelength λ, µm.
    pub wavelength_um: f64,
    /// Radius σ of the coherence area, µm.
    pub sigma_um: f64,
}

/// A scratch in one direction, without its depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile {
    /// √2 (W/λ) sinc(πWξ₂/λ) exp(−s_b²/2σ² − iks_bξ₂).
    pub(super) amplitude: Complex<f64>,
    /// σkξ₁.
    pub(super) wavenumber_sigma: f64,
    /// Ends along the scratch from the shaded point, over σ.
    pub(super) ends: [f64; 2],
}

/// What the response takes of the directions of incidence and exitance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directions {
    /// ξ = tangential part of ω_i + ω_o, in the axes of the surface.
    pub xi: [f64; 2],
    /// γ + γᵢ, sum of the cosines with the normal.
    pub mu_sum: f64,
}

impl Directions {
    /// Of unit vectors to the light and to the viewer; the third component is along the normal.
    pub fn between(incidence: [f64; 3], exitance: [f64; 3]) -> Self {
        let [x, y, mu_sum] = std::array::from_fn(|i| incidence[i] + exitance[i]);
        Self { xi: [x, y], mu_sum }
    }
}

impl StraightScratch {
    /// A scratch along the first axis of the surface, at `offset_um` from the shaded point.
    pub(super) fn along_first_axis(
        width_um: f64,
        depth_um: f64,
        offset_um: f64,
        [begin_um, end_um]: [f64; 2],
    ) -> Self {
        let position_um = [0.0, offset_um];
        Self { position_um, direction_rad: 0.0, begin_um, end_um, width_um, depth_um }
    }

    /// This scratch without ends.
    pub(super) fn infinite(offset_um: f64, width_um: f64, depth_um: f64) -> Self {
        Self::along_first_axis(width_um, depth_um, offset_um, [0.0; 2]).unbounded()
    }

    /// The scratch without ends, eq. 8.
    pub fn unbounded(self) -> Self {
        Self { begin_um: f64::NEG_INFINITY, end_um: f64::INFINITY, ..self }
    }

    /// A vector along (t) and across (b) the scratch.
    fn in_own_frame(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let (sin, cos) = core_math::sincos(self.direction_rad);
        (x * cos + y * sin, y * cos - x * sin)
    }

    /// Offset s_b of the scratch from the shaded point, µm.
    pub fn offset_um(&self) -> f64 {
        self.in_own_frame(self.position_um).1
    }

    /// Amplitude 𝒮 of the scratch, eq. 2–5, over √π σλ.
    pub fn amplitude(&self, light: Coherence, directions: Directions) -> Complex<f64> {
        let Profile { amplitude, wavenumber_sigma, ends: [begin, end] } =
            self.profile(light, directions.xi);
        depth_factor(self.depth_um, light.wavelength_um, directions.mu_sum)
            * amplitude
            * along_factor(wavenumber_sigma, begin, end)
    }

    /// The amplitude without its depth factor and the factor along the scratch, and what the latter
    /// takes.
    pub(super) fn profile(&self, light: Coherence, xi: [f64; 2]) -> Profile {
        let Coherence { wavelength_um, sigma_um } = light;
        let (along, across) = self.in_own_frame(xi);
        let (position, offset) = self.in_own_frame(self.position_um);
        let wavenumber = 2.0 * PI / wavelength_um;
        let spectral =
            self.width_um / wavelength_um * sinc_pi(self.width_um * across / wavelength_um);
        let window = core_math::exp(-0.5 * (offset / sigma_um).powi(2));
        let (sin, cos) = core_math::sincos(wavenumber * offset * across);
        Profile {
            amplitude: SQRT_2 * spectral * window * Complex::new(cos, -sin),
            wavenumber_sigma: sigma_um * wavenumber * along,
            ends: [self.begin_um, self.end_um].map(|end| (position + end) / sigma_um),
        }
    }

    /// Share of the scratch area in the coherence area, eq. 17 with its exact integral: W/(πσ²) times
    /// the length of the scratch under the window exp(−|s|²/2σ²).
    pub fn density(&self, sigma_um: f64) -> f64 {
        let (position, offset) = self.in_own_frame(self.position_um);
        let ends = [self.begin_um, self.end_um].map(|end| (position + end) / sigma_um);
        let window = core_math::exp(-0.5 * (offset / sigma_um).powi(2));
        let inside = along_factor(0.0, ends[0], ends[1]).re;
        (2.0 / PI).sqrt() * self.width_um / sigma_um * window * inside
    }

    /// Share a of the incident light that falls into the scratch: W/(πσ²) times its length under the
    /// *intensity* window exp(−|s|²/σ²). Integrated over all offsets it is W; eq. 17 gives 2W.
    pub fn light_share(&self, sigma_um: f64) -> f64 {
        // The squared window is the window of σ/√2, and its whole area is πσ².
        0.5 * self.density(sigma_um / SQRT_2)
    }

    /// Energy that the scratch alone reflects over the whole plane of direction cosines at a fixed
    /// depth phase: |𝒟|² a. The cross term with the mirror removes as much.
    pub fn reflected_share(&self, light: Coherence, mu_sum: f64) -> f64 {
        depth_factor(self.depth_um, light.wavelength_um, mu_sum).norm_sqr()
            * self.light_share(light.sigma_um)
    }
}

/// Amplitude ℬ of the smooth mirror, over √π σλ.
pub fn mirror_amplitude(light: Coherence, directions: Directions) -> f64 {
    let Coherence { wavelength_um, sigma_um } = light;
    let [x, y] = directions.xi;
    let q = 2.0 * PI * sigma_um / wavelength_um * x.hypot(y);
    2.0 * PI.sqrt() * sigma_um / wavelength_um * core_math::exp(-0.5 * q * q)
}

/// Coherent sum 𝒮 over scratches, over √π σλ.
pub fn coherent_amplitude(
    scratches: &[StraightScratch],
    light: Coherence,
    directions: Directions,
) -> Complex<f64> {
    scratches.iter().map(|scratch| scratch.amplitude(light, directions)).sum()
}

/// SVBRDF f_r = |ℬ − 𝒮|²/(πσ²λ²) of a scratched mirror, eq. 1, 1/sr.
pub fn svbrdf(scratches: &[StraightScratch], light: Coherence, directions: Directions) -> f64 {
    let scratched = coherent_amplitude(scratches, light, directions);
    (mirror_amplitude(light, directions) - scratched).norm_sqr()
}
