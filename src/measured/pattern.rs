//! Diffraction patterns as a camera records them at one wavelength.

use std::path::Path;

use super::samples::{Samples, require_two};
use super::{MeasuredError, pattern_file};

/// Largest share of pixels that may have the largest value.
const MOST_AT_LARGEST: f64 = 0.01;

/// As many pixels may have the largest value however few there are: a symmetric pattern has its
/// peak, or four of them, without being saturated.
const FEW: usize = 4;

/// Intensity over a regular grid, one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Linear intensity in any unit, row by row from the top; finite and not negative.
    pub intensity: Vec<f64>,
    /// One line on the origin: file and SHA-256.
    pub origin: String,
}

/// What the codes of a PNG file stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Encoded as sRGB: cameras that make pictures.
    Srgb,
    /// In proportion to intensity: cameras that measure.
    Linear,
}

impl Pattern {
    /// Reads a pattern, of the format that the name ends in.
    ///
    /// - `.png`: 8 or 16 bits, grey (channel `Y`) or `R`, `G`, `B`, of which `encoding` says what
    ///   the codes stand for; full scale is 1. Transparency is not looked at.
    /// - `.exr`: half or f32; the channel `A` counts only where it is asked for.
    /// - `.pfm`: portable float map, grey (`Y`) or `R`, `G`, `B`, either byte order. Its rows run
    ///   from the bottom and are turned over; the size of its scale factor is not looked at.
    ///
    /// `channel` names the channel; without it there must be only one, or all must be equal.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file: not there, another format, malformed, truncated, larger
    /// than [`crate::table::MAX_PIXEL_BYTES`], no such channel or several that differ (listing
    /// them), and as [`Pattern::check`].
    pub fn read(
        path: impl AsRef<Path>,
        channel: Option<&str>,
        encoding: Encoding,
    ) -> Result<Self, MeasuredError> {
        pattern_file::read(path.as_ref(), channel, encoding)
    }

    /// Intensity of pixel (`x`, `y`), from the left and the top; `None` outside.
    pub fn at(&self, x: usize, y: usize) -> Option<f64> {
        if x >= self.width {
            return None;
        }
        self.intensity.get(y.checked_mul(self.width)?.checked_add(x)?).copied()
    }

    /// Checks what reading guarantees, for a pattern made in memory: two pixels across and down,
    /// one finite value per pixel that is not negative, not all black or equal, and not saturated:
    /// at most one in a hundred pixels, or four if that is more, has the largest value.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), MeasuredError> {
        let (origin, size) = (self.origin.as_str(), [self.width, self.height]);
        require_two(origin, size, "pixels", "at least 2 across and down")?;
        let samples = Samples::filling(origin, size, &self.intensity)?;
        samples.refuse("pixels are not finite", "finite intensities", |value| {
            (!value.is_finite()).then_some(*value)
        })?;
        samples.refuse("pixels are negative", "intensities of at least 0", |value| {
            (*value < 0.0).then_some(*value)
        })?;
        let largest = self.intensity.iter().copied().fold(0.0, f64::max);
        let (total, count) =
            (self.intensity.len(), self.intensity.iter().filter(|v| **v == largest).count());
        let implausible = |reason: String| MeasuredError::implausible(origin, reason);
        if largest == 0.0 {
            return Err(implausible(format!(
                "all {total} pixels are black, expected a pattern with light in it"
            )));
        }
        if count == total {
            return Err(implausible(format!(
                "all {total} pixels are {largest}, expected a pattern that varies"
            )));
        }
        if count > FEW && count as f64 > MOST_AT_LARGEST * total as f64 {
            let what = "pixels have the largest value: saturated";
            return samples.refuse(what, "at most 1 % of them", |value| {
                (*value == largest).then_some(*value)
            });
        }
        Ok(())
    }
}
