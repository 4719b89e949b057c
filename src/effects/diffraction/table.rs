//! Diffraction tables: S_d over the projected, not normalised half vector.
//!
//! A texel holds the power of the cells of the transform that lie in it, over its area, so that Σ S_d ΔA is
//! the share of the reflected power that the table covers. It is the mean of S_d over the texel as far as
//! cells, each taken as uniform, are small beside one: `simulate` says what twice the padding changes. With an odd number of texels the mirror direction h = 0
//! lies in the middle of one, with an even number at the corner of four; either way the centroid of an
//! order is where the order is, to the texel's own resolution.

use rayon::prelude::*;

use super::DiffractionError;
use super::far_field::{FarField, FarFieldTransform};
use super::growth::OrderGrowth;
use super::illuminant::IlluminantChoice;
use super::preparation::PreparedHeights;
use super::resample::{Cells, gathered};
use crate::measured::pattern::Pattern;
use crate::measured::spectra::Spectra;
use crate::table::{Axis, Grid, GridChannel, MAX_PIXEL_BYTES};

/// Wavelengths that are held in memory at once.
const BATCH: usize = 8;
/// What w is at normal incidence and exitance.
pub const NORMAL: f64 = 2.0;

/// What the channels of a table are.
#[derive(Debug, Clone, PartialEq)]
pub enum Channels {
    /// `R`, `G`, `B`: linear sRGB under a light that the environment gives its colour.
    Rgb(IlluminantChoice),
    /// One per wavelength, `S_550` at 550 nm.
    Spectral,
}

/// The extent and the channels of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableShape {
    /// Texels along h_x and h_y.
    pub size: [usize; 2],
    /// The table spans [−extent, extent] in h_x and h_y.
    pub extent: f64,
    /// Wavelengths, nm, increasing.
    pub wavelengths_nm: Vec<f64>,
    /// The channels.
    pub channels: Channels,
}

/// A table with the shares of power that show what it leaves out.
#[derive(Debug, Clone, PartialEq)]
pub struct DiffractionTable {
    /// The table, in sr⁻¹.
    pub grid: Grid,
    /// Shares at each wavelength.
    pub shares: Vec<PowerShares>,
    /// What its orders are at another w.
    pub growth: OrderGrowth,
}

/// Shares of the reflected power at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerShares {
    /// Wavelength, nm.
    pub wavelength_nm: f64,
    /// All of it; 1 by Parseval for a height map.
    pub total: f64,
    /// Inside the table.
    pub inside: f64,
    /// Beyond |h| = 1; 0 for a pattern.
    pub evanescent: f64,
}

/// Where a pattern lies in terms of h, and how it is taken to other wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternPlacing {
    /// Wavelength at which it was recorded, nm.
    pub wavelength_nm: f64,
    /// |h| at the middle of its left and right edges.
    pub half_extent: f64,
    /// Pixel position of the mirror direction, (0, 0) at the outer corner of the first pixel.
    pub centre: [f64; 2],
    /// p: S at λ is (λ₀/λ)^p times S at λ₀, at λ₀/λ times the place. 2 conserves power.
    pub exponent: f64,
}

impl TableShape {
    /// A table of one wavelength, as it is.
    pub(super) fn at(wavelength_nm: f64, size: [usize; 2], extent: f64) -> Self {
        Self { size, extent, wavelengths_nm: vec![wavelength_nm], channels: Channels::Spectral }
    }

    /// The axes, in increasing h.
    pub fn axes(&self) -> [Axis; 2] {
        let axis = |name, count| Axis::new(name, "1", [-self.extent, self.extent], count);
        [axis("h_x", self.size[0]), axis("h_y", self.size[1])]
    }

    fn check(&self) -> Result<(), DiffractionError> {
        let out = |quantity, got, unit, expected| {
            Err(DiffractionError::OutOfRange { quantity, got, unit, expected })
        };
        if !(self.extent > 0.0 && self.extent <= 2.0) {
            return out("extent", self.extent, "1", "in (0, 2]");
        }
        let texels = self.size[0].saturating_mul(self.size[1]);
        let channels = match self.channels {
            Channels::Rgb(_) => 3 * BATCH,
            Channels::Spectral => self.wavelengths_nm.len(),
        };
        let bytes = texels.saturating_mul(channels).saturating_mul(4);
        if texels == 0 || bytes as u64 > MAX_PIXEL_BYTES {
            return out("texels", texels as f64, "1", "1 or more, and 1 GiB of channels at most");
        }
        if let Some(bad) = self.wavelengths_nm.iter().find(|w| !(**w >= 1.0 && w.is_finite())) {
            return out("wavelength", *bad, "nm", "1 or more");
        }
        if self.wavelengths_nm.is_empty() || !self.wavelengths_nm.is_sorted_by(|a, b| a < b) {
            let count = self.wavelengths_nm.len() as f64;
            return out("wavelengths", count, "of them", "one or more, increasing");
        }
        Ok(())
    }
}

/// The table of a surface, at w = `w` throughout ([`NORMAL`] for renderers).
///
/// `padding`: samples of the transform over those of the surface, per side; 1 is enough where
/// λ/L, the cell of h, is no larger than a texel.
///
/// # Errors
/// [`DiffractionError`] for a shape or a padding outside its domain, and as
/// [`IlluminantChoice::srgb_weights`].
pub fn of_surface(
    surface: &PreparedHeights,
    shape: &TableShape,
    padding: usize,
    w: f64,
    spectra: &Spectra,
) -> Result<DiffractionTable, DiffractionError> {
    let transform = FarFieldTransform::new(surface, padding)?;
    let [x, y] = shape.axes();
    let share = |wavelength: f64| {
        let field = transform.far_field(surface, wavelength, w);
        let [cells_x, cells_y] = field.cells();
        (gathered(&field.power, cells_x, cells_y, &x, &y), field.total(), field.evanescent())
    };
    let growth =
        |weights: &[[f64; 3]]| OrderGrowth::of_surface(surface, &shape.wavelengths_nm, weights, w);
    assembled(shape, spectra, &surface.origin, share, growth)
}

/// The table of a pattern recorded at one wavelength: its total is taken as all of the power.
///
/// Rows of the table run as those of the picture.
///
/// # Errors
/// [`DiffractionError`] for a pattern that is empty, dark or not finite, a placing or a shape outside
/// its domain, and as [`IlluminantChoice::srgb_weights`].
pub fn of_pattern(
    pattern: &Pattern,
    placing: PatternPlacing,
    shape: &TableShape,
    spectra: &Spectra,
) -> Result<DiffractionTable, DiffractionError> {
    let expected = pattern.width.saturating_mul(pattern.height);
    if expected == 0 || pattern.intensity.len() != expected {
        let got = pattern.intensity.len();
        let (width, height) = (pattern.width, pattern.height);
        let reason = format!("{width} × {height} pixels, got {got} intensities");
        return Err(DiffractionError::unusable(&pattern.origin, reason));
    }
    let total = crate::numeric::statistics::sum(pattern.intensity.iter().copied());
    if !(total > 0.0 && total.is_finite()) || pattern.intensity.iter().any(|i| *i < 0.0) {
        let reason = "intensities must be 0 or more, finite, and not all 0";
        return Err(DiffractionError::unusable(&pattern.origin, reason));
    }
    let domains = [
        ("pattern wavelength", placing.wavelength_nm, "nm"),
        ("pattern half-extent", placing.half_extent, "1"),
    ];
    for (quantity, got, unit) in domains {
        if !(got > 0.0 && got.is_finite()) {
            let expected = "positive";
            return Err(DiffractionError::OutOfRange { quantity, got, unit, expected });
        }
    }
    let power: Vec<f64> = pattern.intensity.iter().map(|i| i / total).collect();
    let pitch = 2.0 * placing.half_extent / pattern.width as f64;
    let cells = |count: usize, centre: f64| Cells { count, first: -centre, pitch };
    let (cells_x, cells_y) =
        (cells(pattern.width, placing.centre[0]), cells(pattern.height, placing.centre[1]));
    let [x, y] = shape.axes();
    let share = |wavelength: f64| {
        let ratio = wavelength / placing.wavelength_nm;
        // S ∝ ratio^−p per area, and areas grow as ratio².
        let gain = ratio.powf(2.0 - placing.exponent);
        let mut texels = gathered(&power, cells_x.scaled(ratio), cells_y.scaled(ratio), &x, &y);
        texels.iter_mut().for_each(|p| *p *= gain);
        (texels, gain, 0.0)
    };
    assembled(shape, spectra, &pattern.origin, share, |_| OrderGrowth::unknown())
}

/// A table from what `share` finds at a wavelength: the power per texel, all power, and what of it is
/// evanescent. `growth` is asked with the weights of the channels R, G, B.
fn assembled(
    shape: &TableShape,
    spectra: &Spectra,
    origin: &str,
    share: impl Fn(f64) -> (Vec<f64>, f64, f64) + Sync,
    growth: impl Fn(&[[f64; 3]]) -> OrderGrowth,
) -> Result<DiffractionTable, DiffractionError> {
    shape.check()?;
    let weights = match &shape.channels {
        Channels::Rgb(light) => Some(light.srgb_weights(&shape.wavelengths_nm, spectra)?.weights),
        Channels::Spectral => None,
    };
    let [x, y] = shape.axes();
    let count = x.count * y.count;
    let area = 4.0 * shape.extent * shape.extent / count as f64;
    let channel = |name: String, values: &[f64]| {
        GridChannel::new(name, "sr^-1", values.iter().map(|p| (p / area) as f32).collect())
    };
    let (mut shares, mut channels) = (Vec::new(), Vec::new());
    let mut rgb = vec![vec![0.0; count]; 3];
    for batch in shape.wavelengths_nm.chunks(BATCH) {
        let found: Vec<_> = batch.par_iter().map(|wavelength| share(*wavelength)).collect();
        for ((texels, total, evanescent), &wavelength_nm) in found.into_iter().zip(batch) {
            match weights.as_ref().and_then(|weights| weights.get(shares.len())) {
                None => channels.push(channel(format!("S_{wavelength_nm}"), &texels)),
                Some(weight) => {
                    for (sums, weight) in rgb.iter_mut().zip(weight) {
                        sums.iter_mut().zip(&texels).for_each(|(sum, p)| *sum += weight * p);
                    }
                }
            }
            let inside = crate::numeric::statistics::sum(texels);
            shares.push(PowerShares { wavelength_nm, total, inside, evanescent });
        }
    }
    if weights.is_some() {
        let names = ["R", "G", "B"].into_iter().zip(&rgb);
        channels = names.map(|(name, values)| channel(name.into(), values)).collect();
    }
    let grid = Grid { axes: vec![x, y], channels, origin: format!("diffraction of {origin}") };
    grid.check()?;
    let growth = weights.map_or_else(OrderGrowth::unknown, |weights| growth(&weights));
    Ok(DiffractionTable { grid, shares, growth })
}

/// Relative difference of two tables of one shape, in the L2 norm over all channels.
pub fn relative_l2(table: &Grid, reference: &Grid) -> f64 {
    let texels = |channels: &[GridChannel]| -> Vec<f64> {
        channels.iter().flat_map(|c| c.values.iter().map(|v| f64::from(*v))).collect()
    };
    let pairs = texels(&table.channels).into_iter().zip(texels(&reference.channels));
    crate::numeric::statistics::relative_l2(pairs)
}

/// Power per texel at one wavelength, with the far field that it comes from.
pub(super) fn at_wavelength(
    field: &FarField,
    size: [usize; 2],
    extent: f64,
) -> (Vec<f64>, [Axis; 2]) {
    let [x, y] = TableShape::at(field.wavelength_nm, size, extent).axes();
    let [cells_x, cells_y] = field.cells();
    (gathered(&field.power, cells_x, cells_y, &x, &y), [x, y])
}
