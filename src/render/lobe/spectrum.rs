//! Radiance of a scratch under area lights, wavelength by wavelength, and the colour it makes.
//!
//! # Derivation
//!
//! | symbol | code | unit | |
//! |---|---|---|---|
//! | W, D | `width_um`, `depth_um` | µm | of the rectangular profile |
//! | σ | `coherence_radius_um` | µm | coherence area A_C = πσ² |
//! | λ, k | `wavelength_nm` | nm | k = 2π/λ |
//! | ξ | | 1 | (ω_i + ω_o) along and across the scratch |
//! | kW, kσ | `kw`, `ks` | 1 | what the forms take |
//!
//! Eq. 6 without a base is f_r = |𝒮|²/(A_C λ²). By eq. 2 and 3, |𝒮|² = W² sinc²(kWξ₂/2) |𝒟|² |η|²
//! with |𝒟|² = 2 − 2 cos(4πD/λ) (eq. 11) and |η|² = 2A_C exp(−s_b²/σ²) exp(−σ²k²ξ₁²) (eq. 9). The
//! view looks at the middle of the scratch, s_b = 0, so that |η_s|²/(2A_C) = 1 and A_C cancels:
//!
//! f_r = 2 (W/λ)² |𝒟|² · sinc²(kWξ₂/2) exp(−σ²k²ξ₁²).
//!
//! In direction cosines dξ₁dξ₂ = cos θ_i dω_i (eq. 24): reflected radiance is ∫ f_r L dξ over what
//! is above the horizon. For a light of uniform radiance L it is 2 (W/λ)² |𝒟|² L · I with
//!
//! I(kW, kσ, ω_o, light) = ∫∫ exp(−(kσ)²ξ₁²) sinc²(kWξ₂/2) dξ₁ dξ₂,
//!
//! which is what the forms of `area_light` approximate (eq. 27 along one line) and its references
//! compute. Eq. 27 as printed leaves the factor 1/(A_C λ²) of eq. 6 to the caller.
//!
//! # Colour
//!
//! With `rgb`, each channel is the radiance at one wavelength. With `spectral`, a light of radiance
//! 1 has the spectrum of D65 and the radiance factor of the scratch is weighted with the CIE 1931
//! functions ([`Spectra::linear_srgb_weights`]); what reflects 1 at every wavelength is white.

use std::f64::consts::PI;
use std::path::Path;

use crate::measured::spectra::Spectra;
use crate::render::RenderError;
use crate::render::scene::{Scratch, Spectrum};

/// One wavelength of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    /// kW: width of the scratch in units of λ/2π, as the forms are given it.
    pub(super) kw: f32,
    /// kσ, as the forms are given it.
    pub(super) ks: f32,
    /// What the integral I at this wavelength adds to R, G, B under a light of radiance 1.
    pub(super) weight: [f64; 3],
}

/// 2 (W/λ)² |𝒟|²: radiance per I and per radiance of the light, 1.
fn response(scratch: &Scratch, wavelength_nm: f64) -> f64 {
    let wavelength_um = wavelength_nm * 1e-3;
    let half_phase = 2.0 * PI * scratch.depth_um / wavelength_um;
    // 2 − 2 cos 2p = 4 sin² p, which keeps its digits for shallow scratches.
    let sine = core_math::sin(half_phase);
    let depth = 4.0 * sine * sine;
    let width = scratch.width_um / wavelength_um;
    2.0 * width * width * depth
}

/// The wavelengths of a picture; spectral ones take the spectra in the folder `spectra`.
///
/// # Errors
/// [`RenderError::Measured`] if the spectra cannot be had or leave out too much of the white.
pub(super) fn waves(
    scratch: &Scratch,
    spectrum: &Spectrum,
    spectra: &Path,
) -> Result<Vec<Wave>, RenderError> {
    let (wavelengths, weights) = match spectrum {
        Spectrum::Rgb(wavelengths) => {
            let channel = |at: usize| std::array::from_fn(|c| f64::from(u8::from(c == at)));
            (wavelengths.to_vec(), (0..3).map(channel).collect())
        }
        Spectrum::Spectral(wavelengths) => {
            (wavelengths.clone(), Spectra::load(spectra)?.linear_srgb_weights(wavelengths)?.weights)
        }
    };
    let wave = |(&wavelength_nm, weight): (&f64, [f64; 3])| {
        let wavenumber_per_um = 2.0 * PI / (wavelength_nm * 1e-3);
        let response = response(scratch, wavelength_nm);
        Wave {
            kw: (wavenumber_per_um * scratch.width_um) as f32,
            ks: (wavenumber_per_um * scratch.coherence_radius_um) as f32,
            weight: weight.map(|share| share * response),
        }
    };
    Ok(wavelengths.iter().zip(weights).map(wave).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRATCH: Scratch = Scratch { width_um: 2.0, depth_um: 0.15, coherence_radius_um: 60.0 };

    #[test]
    fn a_quarter_wave_deep_scratch_is_brightest() {
        // 4πD/λ = π: |𝒟|² = 4 and 2 (W/λ)² = 2 (2/0.6)².
        let expected = 8.0 * (2.0_f64 / 0.6).powi(2);
        assert!((response(&SCRATCH, 600.0) - expected).abs() < 1e-12 * expected);
        assert!(response(&SCRATCH, 300.0) < 1e-28 * expected);
    }

    #[test]
    fn each_channel_has_its_wavelength() -> Result<(), RenderError> {
        let waves = waves(&SCRATCH, &Spectrum::Rgb([650.0, 532.0, 450.0]), Path::new("none"))?;
        assert_eq!(waves.len(), 3);
        assert_eq!(waves[1].weight[0], 0.0);
        assert_eq!(waves[1].weight[1], response(&SCRATCH, 532.0));
        assert!((f64::from(waves[0].ks / waves[0].kw) - 30.0).abs() < 1e-5);
        Ok(())
    }
}
