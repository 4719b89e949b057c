//! Environment maps: radiance from every direction, in latitude–longitude format.

use std::f64::consts::PI;

use super::MeasuredError;
use super::error::require;
use super::samples::{Samples, size_fault};
use crate::table::{MAX_PIXEL_BYTES, TableError};

/// Fewest rows of a map.
pub const LEAST_HEIGHT: usize = 4;

/// Luminance of linear R, G, B with the primaries of Rec. 709 (ITU-R BT.709-6, item 3.2).
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Radiance from every direction of the sphere, laid out as [`LatLong`] with `width` = 2 · `height`.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Texels around.
    pub width: usize,
    /// Texels from zenith to nadir.
    pub height: usize,
    /// Linear R, G, B, one per texel, row by row; finite and not negative.
    pub radiance: Vec<[f32; 3]>,
    /// One line on the origin: file and SHA-256.
    pub origin: String,
}

/// Texels over the sphere in latitude–longitude format.
///
/// Rows run from the zenith (+z) to the nadir, columns with increasing azimuth from +x through +y.
/// The centre of texel (i, j) of `width` × `height` stands for the direction of azimuth
/// φ = 2π (i + ½)/width and polar angle θ = π (j + ½)/height, that is
/// (sin θ cos φ, sin θ sin φ, cos θ).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LatLong {
    /// Texels around.
    pub width: usize,
    /// Texels from zenith to nadir.
    pub height: usize,
}

impl LatLong {
    /// Direction at continuous texel coordinates: `x` in [0, width], `y` in [0, height], ½ past the
    /// index at a texel's centre. A unit vector.
    pub fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let (phi, theta) = (2.0 * PI * x / self.width as f64, PI * y / self.height as f64);
        [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
    }

    /// Continuous texel coordinates (x, y) of a direction of any length but 0: the inverse of
    /// [`LatLong::direction`], x in [0, width).
    pub fn coordinates(&self, direction: [f64; 3]) -> (f64, f64) {
        let (x, y) = self.unwrapped(direction);
        let width = self.width as f64;
        let turned = if x < 0.0 { x + width } else { x };
        // A small negative number rounds up to the width.
        (if turned < width { turned } else { 0.0 }, y)
    }

    /// As [`LatLong::coordinates`] but for a turn, x in [−width/2, width/2], without its rounding.
    pub(crate) fn unwrapped(&self, [x, y, z]: [f64; 3]) -> (f64, f64) {
        // Not the platform's atan2: the same everywhere, and glibc's sets the rounding mode at each call.
        let column = libm::atan2(y, x) * self.width as f64 / (2.0 * PI);
        let square = x * x + y * y;
        // The slow function where a square leaves the normal numbers.
        let across = if (1e-290..1e290).contains(&square) { square.sqrt() } else { x.hypot(y) };
        (column, libm::atan2(across, z) * self.height as f64 / PI)
    }

    /// The four texels around a direction of any length but 0, by their number row by row, with
    /// their bilinear shares; around in azimuth and on over the poles.
    pub fn around(&self, direction: [f64; 3]) -> [(usize, f64); 4] {
        let (x, y) = self.unwrapped(direction);
        self.between(x - 0.5, y - 0.5)
    }

    /// R, G, B in a direction of any length but 0 between the four of `texels`, row by row, around it,
    /// by their shares ([`LatLong::around`]); those that are not there are black.
    pub fn bilinear(&self, direction: [f64; 3], texels: &[[f32; 3]]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (texel, share) in self.around(direction) {
            let texel = texels.get(texel).copied().unwrap_or_default();
            for (sum, value) in sum.iter_mut().zip(texel) {
                *sum += share * f64::from(value);
            }
        }
        sum
    }

    /// The four texels around a place between the centres of texels, which have whole coordinates.
    pub fn between(&self, x: f64, y: f64) -> [(usize, f64); 4] {
        let (left, top) = (x.floor(), y.floor());
        let (u, v) = (x - left, y - top);
        let (left, top) = (left as i64, top as i64);
        [
            (self.texel(left, top), (1.0 - u) * (1.0 - v)),
            (self.texel(left + 1, top), u * (1.0 - v)),
            (self.texel(left, top + 1), (1.0 - u) * v),
            (self.texel(left + 1, top + 1), u * v),
        ]
    }

    /// Number of the texel at any column, and any row up to a turn beyond a pole: column i is column
    /// i ± width, and row −1 at column i is row 0 at the column opposite.
    fn texel(&self, column: i64, row: i64) -> usize {
        let (width, height) = (self.width as i64, self.height as i64);
        let (column, row) = match row {
            row if row < 0 => (column + width / 2, -1 - row),
            row if row >= height => (column + width / 2, 2 * height - 1 - row),
            row => (column, row),
        };
        // A division takes longer than all else.
        let within = (0..width).contains(&column);
        let column = if within { column } else { column.checked_rem_euclid(width).unwrap_or(0) };
        (row * width + column).max(0) as usize
    }
}

/// What becomes of negative values in a file, which lossy packing leaves beside bright texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Negative {
    /// They are an error.
    Refused,
    /// They become 0, and the origin says how many did and which was lowest.
    Black,
}

impl Environment {
    /// The name under which scenes ask for [`Environment::white`].
    pub const WHITE: &str = "white";

    /// Radiance 1 in R, G and B from everywhere: what a surface that only redistributes light gives back
    /// whole.
    pub fn white() -> Self {
        let (width, height) = (64, 32);
        let radiance = vec![[1.0; 3]; width * height];
        Self { width, height, radiance, origin: "radiance 1 from everywhere".to_owned() }
    }

    /// A map of given radiance, row by row from the zenith; `origin` says where it is from.
    ///
    /// # Errors
    /// As [`Environment::check`].
    pub fn new(
        width: usize,
        height: usize,
        radiance: Vec<[f32; 3]>,
        origin: impl Into<String>,
    ) -> Result<Self, MeasuredError> {
        let map = Self { width, height, radiance, origin: origin.into() };
        map.check()?;
        Ok(map)
    }

    /// How its texels lie over the sphere.
    pub fn layout(&self) -> LatLong {
        LatLong { width: self.width, height: self.height }
    }

    /// Linear R, G, B from a direction of any length but 0: bilinear ([`LatLong::bilinear`]). Black
    /// for a map without texels.
    pub fn radiance(&self, direction: [f64; 3]) -> [f64; 3] {
        self.layout().bilinear(direction, &self.radiance)
    }

    /// Solid angle of a texel of `row` (below `height`), sr: 2π/width (cos θ_top − cos θ_bottom).
    pub fn solid_angle(&self, row: usize) -> f64 {
        // The difference of cosines as a product, which loses nothing near the poles.
        let half = 0.5 * PI / self.height as f64;
        let centre = half * (2.0 * row as f64 + 1.0);
        4.0 * PI / self.width as f64 * centre.sin() * half.sin()
    }

    /// Mean linear R, G, B over the sphere.
    pub fn mean(&self) -> [f64; 3] {
        let mut mean = [0.0; 3];
        for (row, texels) in self.radiance.chunks(self.width.max(1)).enumerate() {
            let weight = self.solid_angle(row) / (4.0 * PI);
            for (channel, mean) in mean.iter_mut().enumerate() {
                let sum: f64 =
                    texels.iter().filter_map(|t| t.get(channel)).map(|v| f64::from(*v)).sum();
                *mean += weight * sum;
            }
        }
        mean
    }

    /// Largest luminance of a texel over the mean luminance, 1, with the weights of Rec. 709; 1 for
    /// a uniform map. The smaller the texels, the larger it is where lamps are small.
    pub fn contrast(&self) -> f64 {
        let texels = self.radiance.iter().map(|texel| luminance(texel.map(f64::from)));
        texels.fold(0.0, f64::max) / luminance(self.mean())
    }

    /// The map turned by the rotation R whose rows are `rows`: what came from direction v comes
    /// from R v, and the new radiance from d is the old one from Rᵀ d, bilinear between texels. So
    /// the mean is kept to within interpolation only. `rows` must be orthonormal.
    pub fn rotated(&self, rows: [[f64; 3]; 3]) -> Self {
        let ([a, b, c], layout) = (rows, self.layout());
        let texel = |column: usize, row: usize| {
            let [x, y, z] = layout.direction(column as f64 + 0.5, row as f64 + 0.5);
            let back: [f64; 3] = std::array::from_fn(|i| a[i] * x + b[i] * y + c[i] * z);
            self.radiance(back).map(|value| value as f32)
        };
        let radiance = (0..self.height)
            .flat_map(|row| (0..self.width).map(move |column| (column, row)))
            .map(|(column, row)| texel(column, row))
            .collect();
        Self { radiance, origin: format!("{}, rotated", self.origin), ..*self }
    }

    /// Checks what reading guarantees, for a map made in memory: twice as wide as high, at least
    /// [`LEAST_HEIGHT`] rows, at most [`MAX_PIXEL_BYTES`], one radiance per texel, every value
    /// finite and not negative, not all black.
    ///
    /// # Errors
    /// The first rule that is broken, with the number of texels that break it and the first.
    pub fn check(&self) -> Result<(), MeasuredError> {
        let (origin, width, height) = (self.origin.as_str(), self.width, self.height);
        require_size(origin, width, height)?;
        let samples = Samples::filling(origin, [width, height], &self.radiance)?;
        samples.refuse("texels are not finite", "finite radiance", |texel| {
            texel.iter().find(|value| !value.is_finite()).map(|value| f64::from(*value))
        })?;
        samples.refuse("texels are negative", "radiance of at least 0", |texel| {
            texel.iter().find(|value| **value < 0.0).map(|value| f64::from(*value))
        })?;
        let total = self.radiance.len();
        require(self.radiance.iter().flatten().any(|value| *value != 0.0), origin, || {
            format!("all {total} texels are black, expected light from somewhere")
        })
    }
}

/// Luminance of linear R, G, B with the primaries of Rec. 709.
pub(crate) fn luminance(rgb: [f64; 3]) -> f64 {
    rgb.iter().zip(LUMINANCE).map(|(value, weight)| value * weight).sum()
}

/// Checks the size alone, before there is memory for it.
pub(super) fn require_size(origin: &str, width: usize, height: usize) -> Result<(), MeasuredError> {
    let fault = |expected| size_fault(origin, [width, height], "texels", expected);
    if height.checked_mul(2) != Some(width) {
        return Err(fault("twice as wide as high (latitude–longitude)"));
    }
    if height < LEAST_HEIGHT {
        return Err(fault("at least 8 × 4"));
    }
    let declared = (width as u128 * height as u128).saturating_mul(size_of::<[f32; 3]>() as u128);
    let limit = u128::from(MAX_PIXEL_BYTES);
    if declared > limit {
        let why = "the largest map that is read";
        return Err(TableError::too_large(origin, declared, limit, why).into());
    }
    Ok(())
}
