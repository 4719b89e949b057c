//! Diffraction patterns as a camera records them at one wavelength: PNG, EXR and portable float maps.

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageFormat, ImageReader, Limits};

use super::error::require;
use super::import::{extension, unknown_format};
use super::samples::{Samples, size_fault};
use super::{MeasuredError, portable_float_map, srgb};
use crate::table::{MAX_PIXEL_BYTES, decode_exr, store};

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
    /// than [`MAX_PIXEL_BYTES`], no such channel or several that differ (listing them), and as
    /// [`Pattern::check`].
    pub fn read(
        path: impl AsRef<Path>,
        channel: Option<&str>,
        encoding: Encoding,
    ) -> Result<Self, MeasuredError> {
        let path = path.as_ref();
        let origin = path.display().to_string();
        let decode: fn(&str, &[u8], Encoding) -> Result<Picture, MeasuredError> =
            match extension(path).as_str() {
                "png" => png,
                "exr" => |origin, bytes, _| exr(origin, bytes),
                "pfm" => |origin, bytes, _| portable_float_map::decode(origin, bytes),
                _ => {
                    let known = "PNG (.png); OpenEXR (.exr); portable float map (.pfm)";
                    return Err(unknown_format(path, known));
                }
            };
        let bytes = store::read(path)?;
        let picture = decode(&origin, &bytes, encoding)?;
        let (width, height) = (picture.width, picture.height);
        let intensity = chosen(&origin, picture.channels, channel)?;
        let mut pattern = Self { width, height, intensity, origin };
        pattern.check()?;
        pattern.origin = store::origin(path, &bytes);
        Ok(pattern)
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
        if self.width.min(self.height) < 2 {
            return Err(size_fault(origin, size, "pixels", "at least 2 across and down"));
        }
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
        require(largest != 0.0, origin, || {
            format!("all {total} pixels are black, expected a pattern with light in it")
        })?;
        require(count != total, origin, || {
            format!("all {total} pixels are {largest}, expected a pattern that varies")
        })?;
        if count > FEW && count as f64 > MOST_AT_LARGEST * total as f64 {
            let what = "pixels have the largest value: saturated";
            return samples.refuse(what, "at most 1 % of them", |value| {
                (*value == largest).then_some(*value)
            });
        }
        Ok(())
    }
}

/// The channels of a picture, row by row from the top.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) channels: Vec<(String, Vec<f64>)>,
}

impl Picture {
    /// Of pixels with one value after the other for each of `names`.
    pub(super) fn interleaved(
        [width, height]: [usize; 2],
        names: &[&str],
        values: impl Iterator<Item = f64> + Clone,
    ) -> Self {
        let channel = |(at, name): (usize, &&str)| {
            ((*name).to_owned(), values.clone().skip(at).step_by(names.len()).collect())
        };
        Self { width, height, channels: names.iter().enumerate().map(channel).collect() }
    }
}

/// The channel called `wanted`; without a name the only one there is, or one of several equal ones,
/// coverage (`A`) left out.
fn chosen(
    origin: &str,
    mut channels: Vec<(String, Vec<f64>)>,
    wanted: Option<&str>,
) -> Result<Vec<f64>, MeasuredError> {
    let known = channels.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
    let fault =
        |reason: String| MeasuredError::unusable(origin, format!("{reason}; it has: {known}"));
    if let Some(wanted) = wanted {
        return match channels.iter().position(|(name, _)| name == wanted) {
            Some(index) => Ok(channels.swap_remove(index).1),
            None => Err(fault(format!("no channel {wanted:?}"))),
        };
    }
    if channels.len() > 1 {
        channels.retain(|(name, _)| name != "A");
    }
    let mut channels = channels.into_iter();
    let Some((_, first)) = channels.next() else { return Err(fault("no channel".into())) };
    // By their bits, so that a NaN in all of them is reported as such.
    let same =
        |other: &[f64]| first.iter().map(|v| v.to_bits()).eq(other.iter().map(|v| v.to_bits()));
    match channels.find(|(_, other)| !same(other)) {
        Some((name, _)) => Err(fault(format!(
            "the channels differ (the first and {name:?}), expected one wavelength: name a channel"
        ))),
        None => Ok(first),
    }
}

fn exr(origin: &str, bytes: &[u8]) -> Result<Picture, MeasuredError> {
    let decoded = decode_exr(origin, bytes)?;
    let wide = |values: Vec<f32>| values.into_iter().map(f64::from).collect();
    Ok(Picture {
        width: decoded.width,
        height: decoded.height,
        channels: decoded.channels.into_iter().map(|(name, v)| (name, wide(v))).collect(),
    })
}

/// The picture in a PNG file of at most [`MAX_PIXEL_BYTES`]. Sixteen bits hold its eight exactly:
/// 257 · v / 65535 = v / 255.
pub(crate) fn decoded_png(bytes: &[u8]) -> image::ImageResult<DynamicImage> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_PIXEL_BYTES);
    reader.limits(limits);
    reader.decode()
}

fn png(origin: &str, bytes: &[u8], encoding: Encoding) -> Result<Picture, MeasuredError> {
    let picture = decoded_png(bytes)
        .map_err(|e| MeasuredError::unusable(origin, format!("malformed PNG: {e}")))?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let (names, codes): (&[&str], Vec<u16>) = if picture.color().has_color() {
        (&["R", "G", "B"], picture.into_rgb16().into_raw())
    } else {
        (&["Y"], picture.into_luma16().into_raw())
    };
    let linear = |code: &u16| {
        let code = f64::from(*code) / 65535.0;
        match encoding {
            Encoding::Srgb => srgb::decoded(code),
            Encoding::Linear => code,
        }
    };
    Ok(Picture::interleaved([width, height], names, codes.iter().map(linear)))
}
