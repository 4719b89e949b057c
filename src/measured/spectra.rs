//! The CIE 1931 2° observer and illuminants D65 and A, and linear sRGB from reflectance spectra.
//!
//! Tristimulus values are sums over the observer's wavelengths (1 nm) as far as the illuminant is
//! tabulated, the illuminant interpolated linearly between its own (CIE 15:2018, §7.1).

use std::path::Path;

use nalgebra::{Matrix3, Vector3};

use super::MeasuredError;
use super::error::require;
use super::tabulation::linear;
use crate::table::Table;

/// Chromaticities (x, y) of the sRGB primaries, IEC 61966-2-1:1999.
const SRGB_PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// Largest share of X, Y or Z that may lie outside the nodes of [`Spectra::linear_srgb_weights`].
pub const MOST_OUTSIDE: f64 = 0.05;

/// The observer and the illuminants in `data/measured/spectra/`.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectra {
    wavelength_nm: Vec<f64>,
    observer: [Vec<f64>; 3],
    d65: Illuminant,
    a: Illuminant,
}

/// The relative spectral power distribution of an illuminant.
#[derive(Debug, Clone, PartialEq)]
pub struct Illuminant {
    wavelength_nm: Vec<f64>,
    power: Vec<f64>,
}

impl Illuminant {
    /// The illuminant of a table: columns `wavelength`, a length, and `power` \[1\].
    ///
    /// # Errors
    /// [`MeasuredError`] naming the table's origin: no such column, another unit, wavelengths that
    /// do not increase.
    pub fn of(table: &Table) -> Result<Self, MeasuredError> {
        let wavelength_nm = increasing(&table.origin, table)?;
        Ok(Self { wavelength_nm, power: table.values_in("power", "1")? })
    }

    /// The tabulated powers, in the order of increasing wavelength.
    pub fn powers(&self) -> &[f64] {
        &self.power
    }

    /// Relative power at a wavelength in nm; `None` where it is not tabulated.
    pub fn power(&self, wavelength_nm: f64) -> Option<f64> {
        linear(&self.wavelength_nm, &self.power, wavelength_nm)
    }
}

/// Weights that turn a reflectance at given wavelengths into linear sRGB.
#[derive(Debug, Clone, PartialEq)]
pub struct SrgbWeights {
    /// The wavelengths, nm.
    pub wavelength_nm: Vec<f64>,
    /// Weights of R, G, B at each wavelength; they may be negative, and sum to 1 each.
    pub weights: Vec<[f64; 3]>,
    /// Largest share of X, Y or Z of the white that lies outside the wavelengths, where the
    /// reflectance is taken as constant.
    pub outside: f64,
}

impl SrgbWeights {
    /// Linear sRGB (R, G, B) of a reflectance given at the wavelengths, in order. May leave
    /// [0, 1] for a saturated colour.
    pub fn linear_srgb(&self, reflectance: &[f64]) -> [f64; 3] {
        let mut rgb = [0.0; 3];
        for (weight, value) in self.weights.iter().zip(reflectance) {
            for (sum, w) in rgb.iter_mut().zip(weight) {
                *sum += w * value;
            }
        }
        rgb
    }
}

impl Spectra {
    /// Reads `cie1931_xyz.csv`, `illuminant_d65.csv` and `illuminant_a.csv` from a folder.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file.
    pub fn load(folder: &Path) -> Result<Self, MeasuredError> {
        let read = |name| Table::read_csv(folder.join(name));
        Self::of(
            &read("cie1931_xyz.csv")?,
            &read("illuminant_d65.csv")?,
            &read("illuminant_a.csv")?,
        )
    }

    /// The spectra of the repository as they were when the crate was built.
    ///
    /// # Errors
    /// None that a build with readable files has.
    pub fn built_in() -> Result<Self, MeasuredError> {
        let read = Table::read_csv_str;
        let observer = include_str!("../../data/measured/spectra/cie1931_xyz.csv");
        let d65 = include_str!("../../data/measured/spectra/illuminant_d65.csv");
        let a = include_str!("../../data/measured/spectra/illuminant_a.csv");
        Self::of(
            &read("built-in cie1931_xyz.csv", observer)?,
            &read("built-in illuminant_d65.csv", d65)?,
            &read("built-in illuminant_a.csv", a)?,
        )
    }

    fn of(observer: &Table, d65: &Table, a: &Table) -> Result<Self, MeasuredError> {
        Ok(Self {
            wavelength_nm: increasing(&observer.origin, observer)?,
            observer: [
                observer.values_in("x_bar", "1")?,
                observer.values_in("y_bar", "1")?,
                observer.values_in("z_bar", "1")?,
            ],
            d65: Illuminant::of(d65)?,
            a: Illuminant::of(a)?,
        })
    }

    /// Wavelengths of the observer, nm, increasing.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelength_nm
    }

    /// Colour matching functions x̄, ȳ, z̄ at [`Spectra::wavelengths_nm`].
    pub fn observer(&self) -> &[Vec<f64>; 3] {
        &self.observer
    }

    /// CIE standard illuminant D65.
    pub fn d65(&self) -> &Illuminant {
        &self.d65
    }

    /// CIE standard illuminant A.
    pub fn a(&self) -> &Illuminant {
        &self.a
    }

    /// X, Y, Z of the perfect diffuser under an illuminant, Y = 1.
    pub fn white(&self, illuminant: &Illuminant) -> [f64; 3] {
        let sum: Vector3<f64> = self.stimuli(illuminant).map(|(_, xyz)| xyz).sum();
        let white = sum / sum.y;
        [white.x, white.y, white.z]
    }

    /// Wavelength and power × (x̄, ȳ, z̄), wherever both are tabulated.
    fn stimuli<'s>(
        &'s self,
        illuminant: &'s Illuminant,
    ) -> impl Iterator<Item = (f64, Vector3<f64>)> + 's {
        let [x, y, z] = &self.observer;
        let matching = x.iter().zip(y).zip(z).map(|((x, y), z)| Vector3::new(*x, *y, *z));
        let nodes = self.wavelength_nm.iter().copied().zip(matching);
        nodes.filter_map(|(w, xyz)| Some((w, xyz * illuminant.power(w)?)))
    }

    /// Weights such that Σ weight · R is the linear sRGB value, under D65 with the CIE 1931 2°
    /// observer, of the reflectance that is linear between the values R at `wavelengths_nm` and
    /// constant outside them. R ≡ 1 gives (1, 1, 1).
    ///
    /// `wavelengths_nm` increases. The matrix from XYZ is derived from the sRGB primaries and the
    /// white of these very tables (xy = 0.31273, 0.32902), rather than from the rounded white
    /// (0.3127, 0.3290) of IEC 61966-2-1, so that the perfect diffuser is exactly white.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] if the wavelengths do not increase or are not finite, or if
    /// more than [`MOST_OUTSIDE`] of X, Y or Z lies outside them.
    pub fn linear_srgb_weights(
        &self,
        wavelengths_nm: &[f64],
    ) -> Result<SrgbWeights, MeasuredError> {
        const OF: &str = "sRGB weights";
        let increasing = wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]);
        let (Some(first), Some(last)) = (wavelengths_nm.first(), wavelengths_nm.last()) else {
            return Err(MeasuredError::unusable(OF, "no wavelengths"));
        };
        require(increasing && first.is_finite() && last.is_finite(), OF, || {
            "wavelengths must be finite and increase".into()
        })?;
        let white = Vector3::from(self.white(&self.d65));
        let total: Vector3<f64> = self.stimuli(&self.d65).map(|(_, xyz)| xyz).sum();
        let to_srgb = xyz_to_linear_srgb(white).ok_or_else(|| {
            MeasuredError::unusable(OF, "the white of the tables has no sRGB matrix")
        })?;

        let mut sums = vec![Vector3::zeros(); wavelengths_nm.len()];
        let mut outside = Vector3::zeros();
        for (wavelength, xyz) in self.stimuli(&self.d65) {
            if !(*first..=*last).contains(&wavelength) {
                outside += xyz;
            }
            for (index, share) in hat_shares(wavelengths_nm, wavelength) {
                if let Some(sum) = sums.get_mut(index) {
                    *sum += xyz * share;
                }
            }
        }
        let outside = outside.component_div(&total).max();
        require(outside <= MOST_OUTSIDE, OF, || {
            format!(
                "{first} to {last} nm leaves out {:.1} % of the white, at most {:.0} % may be",
                100.0 * outside,
                100.0 * MOST_OUTSIDE
            )
        })?;
        let mut rgb: Vec<Vector3<f64>> =
            sums.into_iter().map(|xyz| to_srgb * (xyz / total.y)).collect();
        // Takes out what rounding in the matrix leaves of the white, some 1e-15.
        let sum: Vector3<f64> = rgb.iter().sum();
        rgb.iter_mut().for_each(|weight| weight.component_div_assign(&sum));
        let weights = rgb.into_iter().map(Into::into).collect();
        Ok(SrgbWeights { wavelength_nm: wavelengths_nm.to_vec(), weights, outside })
    }
}

/// Matrix from XYZ (white at Y = 1) to linear RGB with the sRGB primaries, in which `white` is
/// (1, 1, 1): columns are the primaries, scaled to add up to the white, and inverted.
fn xyz_to_linear_srgb(white: Vector3<f64>) -> Option<Matrix3<f64>> {
    let column = |[x, y]: [f64; 2]| Vector3::new(x / y, 1.0, (1.0 - x - y) / y);
    let primaries = Matrix3::from_columns(&SRGB_PRIMARIES.map(column));
    let scale = primaries.try_inverse()? * white;
    (primaries * Matrix3::from_diagonal(&scale)).try_inverse()
}

/// The nodes that the value at `x` is interpolated from, with their shares; a node past the end has
/// none.
pub(crate) fn hat_shares(nodes: &[f64], x: f64) -> [(usize, f64); 2] {
    let above = nodes.partition_point(|node| *node < x);
    let below = above.saturating_sub(1);
    match (nodes.get(below), nodes.get(above)) {
        (Some(a), Some(b)) if above > below => {
            let t = (x - a) / (b - a);
            [(below, 1.0 - t), (above, t)]
        }
        _ => [(below, 1.0), (above, 0.0)],
    }
}

/// The column `wavelength` of a table, nm, which must increase.
pub(super) fn increasing(origin: &str, table: &Table) -> Result<Vec<f64>, MeasuredError> {
    let wavelengths = table.values_in("wavelength", "nm")?;
    for pair in wavelengths.windows(2) {
        require(pair[0] < pair[1], origin, || format!("wavelengths do not increase: {pair:?} nm"))?;
    }
    Ok(wavelengths)
}
