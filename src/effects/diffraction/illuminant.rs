//! Weights of wavelengths in the R, G and B of a table, under any light.
//!
//! A pixel of an environment already carries the colour of its light: the table says what the surface
//! adds. So the weights of each channel sum to 1, whatever the illuminant, and a mirror stays white
//! under each: von Kries' adaptation in the sRGB primaries. With P(λ) the illuminant and D(λ) D65,
//!
//! w_c(λ) ∝ w_c^D65(λ) P(λ)/D(λ), Σ_λ w_c(λ) = 1.

use std::path::Path;

use super::DiffractionError;
use crate::measured::spectra::{self, Spectra, SrgbWeights, hat_shares};
use crate::table::Table;

/// The light that a table is made for.
#[derive(Debug, Clone, PartialEq)]
pub enum Illuminant {
    /// CIE D65: daylight.
    D65,
    /// CIE A: an incandescent lamp.
    A,
    /// CIE E: equal power at every wavelength.
    E,
    /// A tabulated spectrum; dark where it is not tabulated.
    Tabulated {
        /// The spectrum.
        spectrum: spectra::Illuminant,
        /// The file.
        origin: String,
    },
}

impl Illuminant {
    /// `d65`, `a`, `e`, or the name of a CSV file with columns `wavelength [nm]` and `power [1]`.
    ///
    /// # Errors
    /// [`DiffractionError`] naming the file, for one that cannot be read, wavelengths that do not
    /// increase and powers that are negative or not finite.
    pub fn named(name: &str) -> Result<Self, DiffractionError> {
        match name {
            "d65" | "D65" => Ok(Self::D65),
            "a" | "A" => Ok(Self::A),
            "e" | "E" => Ok(Self::E),
            file => Self::read(Path::new(file)),
        }
    }

    fn read(path: &Path) -> Result<Self, DiffractionError> {
        let table = Table::read_csv(path)?;
        let spectrum = spectra::Illuminant::of(&table)?;
        if let Some(bad) = spectrum.powers().iter().find(|p| !(p.is_finite() && **p >= 0.0)) {
            let reason = format!("column \"power\": expected 0 or more, got {bad}");
            return Err(DiffractionError::unusable(&table.origin, reason));
        }
        Ok(Self::Tabulated { spectrum, origin: table.origin })
    }

    /// Relative power over that of D65; `None` where D65 is not tabulated.
    fn over_d65(&self, wavelength: f64, spectra: &Spectra) -> Option<f64> {
        let daylight = spectra.d65().power(wavelength)?;
        let power = match self {
            Self::D65 => return Some(1.0),
            Self::A => spectra.a().power(wavelength).unwrap_or(0.0),
            Self::E => 1.0,
            Self::Tabulated { spectrum, .. } => spectrum.power(wavelength).unwrap_or(0.0),
        };
        Some(power / daylight)
    }

    /// Weights of R, G and B at `nodes_nm` under this light, each channel summing to 1: exact for what
    /// is linear in wavelength between the nodes and constant beyond them.
    ///
    /// # Errors
    /// [`DiffractionError::Measured`] as [`Spectra::linear_srgb_weights`], for nodes that do not
    /// increase or leave too much of the light out; [`DiffractionError::Unusable`] for a light that
    /// leaves a channel without a positive weight.
    pub fn srgb_weights(
        &self,
        nodes_nm: &[f64],
        spectra: &Spectra,
    ) -> Result<SrgbWeights, DiffractionError> {
        let daylight = spectra.linear_srgb_weights(nodes_nm)?;
        if *self == Self::D65 {
            return Ok(daylight);
        }
        // At every nanometre, since neither D65 nor a lamp is linear between the nodes.
        let tabulated = |w: &f64| spectra.d65().power(*w).is_some();
        let fine: Vec<f64> = spectra.wavelengths_nm().iter().copied().filter(tabulated).collect();
        let every = spectra.linear_srgb_weights(&fine)?;
        let mut weights = vec![[0.0; 3]; nodes_nm.len()];
        let (mut sums, mut outside) = ([0.0; 3], 0.0_f64);
        let ends = nodes_nm.first().zip(nodes_nm.last()).map_or(0.0..=0.0, |(a, b)| *a..=*b);
        for (wavelength, rgb) in fine.iter().zip(&every.weights) {
            let ratio = self.over_d65(*wavelength, spectra).unwrap_or(0.0);
            let value = rgb.map(|weight| weight * ratio);
            sums.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
            for (node, share) in hat_shares(nodes_nm, *wavelength) {
                let weight = weights.get_mut(node).into_iter().flatten();
                weight.zip(value).for_each(|(weight, value)| *weight += share * value);
            }
            if !ends.contains(wavelength) {
                outside += rgb[1] * ratio;
            }
        }
        if sums.iter().any(|sum| !(*sum > 0.0 && sum.is_finite())) {
            let origin = match self {
                Self::Tabulated { origin, .. } => origin.as_str(),
                _ => "illuminant",
            };
            let reason = format!("R, G, B of the light over D65 are {sums:?}, expected positive");
            return Err(DiffractionError::unusable(origin, reason));
        }
        for (channel, sum) in sums.iter().enumerate() {
            weights.iter_mut().for_each(|weight| weight[channel] /= sum);
        }
        let wavelength_nm = nodes_nm.to_vec();
        Ok(SrgbWeights { wavelength_nm, weights, outside: outside.abs() / sums[1] })
    }
}
