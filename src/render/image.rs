//! Images: named channels of f32 over one grid of pixels, read from and written to EXR and PNG.

use std::path::Path;

use ::image::{ExtendedColorType, ImageEncoder};

use crate::measured::{decoded_png, srgb};
use crate::table::{TableError, decode_exr, encode_exr, singles, store};

/// What the name of a channel of standard errors begins with: `stderr.R` belongs to `R`.
pub const STANDARD_ERROR_PREFIX: &str = "stderr.";

/// How a pixel that is not finite is shown.
const NON_FINITE: [u8; 3] = [255, 0, 255];

/// An image. Rows from top to bottom, pixels from left to right; a pixel's centre is half a pixel
/// from its edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// The channels, each of `width · height` values.
    pub channels: Vec<Channel>,
}

/// A channel of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// `R`, `G`, `B`, or `stderr.R` and so on for the standard error of a channel.
    pub name: String,
    /// The values, row by row; linear, not clamped.
    pub values: Vec<f32>,
}

/// Why an image could not be read, used or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The file could not be read or written, or it is no EXR that this crate reads.
    #[error(transparent)]
    File(#[from] TableError),
    /// The name of the file ends in none of the known formats, the PNG decoder or encoder refused, the
    /// image is empty, or two channels have one name.
    #[error("{0}")]
    Unusable(String),
    /// A channel that is needed is not there.
    #[error("no channel {name:?}; the image has: {known}")]
    MissingChannel {
        /// The channel.
        name: String,
        /// The names that are there.
        known: String,
    },
    /// A channel does not fill the image.
    #[error("channel {name:?} has {got} values, {width} × {height} pixels need {expected}")]
    Length {
        /// The channel.
        name: String,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// Number of values that is needed.
        expected: usize,
        /// Number of values that is there.
        got: usize,
    },
}

/// What a picture with a limited range could not show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Clipped {
    /// Pixels with a channel below 0, shown as 0.
    pub below: usize,
    /// Pixels with a channel above 1 after exposure, shown as 1.
    pub above: usize,
    /// Pixels with a channel that is not finite, shown in magenta.
    pub non_finite: usize,
}

impl Image {
    /// An image of linear sRGB colours, row by row.
    pub fn rgb(width: usize, height: usize, colours: &[[f32; 3]]) -> Self {
        let channel = |(name, at): (&str, usize)| Channel {
            name: name.to_owned(),
            values: colours.iter().map(|colour| colour[at]).collect(),
        };
        Self { width, height, channels: [("R", 0), ("G", 1), ("B", 2)].map(channel).into() }
    }

    /// Reads an image, of the format that the name ends in.
    ///
    /// - `.exr`: every channel under its own name, half or f32, also NaN and infinities, which
    ///   [`Image::non_finite`] counts. `R`, `G`, `B`, `A` come first, the others as in the file.
    /// - `.png`: 8 or 16 bits, decoded from sRGB to linear `R`, `G`, `B` (three equal channels for
    ///   grey), and `A` as it is. Colour profiles and gamma chunks are not looked at.
    ///
    /// # Errors
    /// [`ImageError`], naming the file: not there, another format, malformed, truncated, or larger
    /// than [`crate::table::MAX_PIXEL_BYTES`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ImageError> {
        let path = path.as_ref();
        let decode = match Format::of(path)? {
            Format::Exr => decode_exr_image,
            Format::Png => decode_png_image,
        };
        let image = decode(&path.display().to_string(), &store::read(path)?)?;
        image.check()?;
        Ok(image)
    }

    /// Writes all channels as f32 EXR with lossless packing, whole or not at all. The same image
    /// always gives the same bytes, and reading gives the same values, NaN among them.
    ///
    /// # Errors
    /// As [`Image::check`]; [`ImageError::File`] if the file cannot be written.
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), ImageError> {
        self.check()?;
        let path = path.as_ref();
        let channels: Vec<(&str, &[f32])> =
            self.channels.iter().map(|c| (c.name.as_str(), c.values.as_slice())).collect();
        let bytes =
            encode_exr(&path.display().to_string(), (self.width, self.height), &channels, singles)?;
        Ok(store::atomic_write(path, &bytes)?)
    }

    /// Writes the colours ([`Image::colours`]) times 2^`exposure` as an 8-bit sRGB PNG, whole or not
    /// at all. Values are clamped to [0, 1], pixels that are not finite are magenta; the result
    /// counts both.
    ///
    /// # Errors
    /// As [`Image::colours`]; [`ImageError::File`] if the file cannot be written.
    pub fn write_png(&self, path: impl AsRef<Path>, exposure: f64) -> Result<Clipped, ImageError> {
        let (pixels, clipped) = shown(&self.colours()?, exposure);
        write_pixels(path.as_ref(), self.width, self.height, &pixels)?;
        Ok(clipped)
    }

    /// The bytes of the PNG file that [`Image::write_png`] writes.
    ///
    /// # Errors
    /// As [`Image::colours`].
    pub fn png(&self, exposure: f64) -> Result<Vec<u8>, ImageError> {
        let (pixels, _) = shown(&self.colours()?, exposure);
        encode_png("picture", self.width, self.height, &pixels)
    }

    /// The channel called `name`.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }

    /// The channel called `name`, which must be there.
    ///
    /// # Errors
    /// [`ImageError::MissingChannel`], listing the channels that are there.
    pub fn require(&self, name: &str) -> Result<&Channel, ImageError> {
        self.channel(name).ok_or_else(|| ImageError::MissingChannel {
            name: name.into(),
            known: self.names().join(", "),
        })
    }

    /// The standard errors of the channel called `name`: `stderr.name`.
    pub fn standard_error(&self, name: &str) -> Option<&Channel> {
        let of =
            |channel: &&Channel| channel.name.strip_prefix(STANDARD_ERROR_PREFIX) == Some(name);
        self.channels.iter().find(of)
    }

    /// The names of the channels, in order.
    pub fn names(&self) -> Vec<&str> {
        self.channels.iter().map(|channel| channel.name.as_str()).collect()
    }

    /// The channels that are no standard errors.
    pub fn quantities(&self) -> impl Iterator<Item = &Channel> {
        self.channels.iter().filter(|c| !c.name.starts_with(STANDARD_ERROR_PREFIX))
    }

    /// Linear colours, row by row: `R`, `G`, `B`, or one quantity alone as grey.
    ///
    /// # Errors
    /// As [`Image::check`]; [`ImageError::MissingChannel`] if it has neither.
    pub fn colours(&self) -> Result<Vec<[f32; 3]>, ImageError> {
        self.check()?;
        let mut quantities = self.quantities();
        let channels = match (quantities.next(), quantities.next()) {
            (Some(grey), None) => [grey, grey, grey],
            _ => [self.require("R")?, self.require("G")?, self.require("B")?],
        };
        let [r, g, b] = channels.map(|channel| channel.values.iter().copied());
        Ok(r.zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect())
    }

    /// Number of values that are NaN or infinite, over all channels.
    pub fn non_finite(&self) -> usize {
        let values = self.channels.iter().flat_map(|channel| &channel.values);
        values.filter(|value| !value.is_finite()).count()
    }

    /// Checks what reading guarantees, for an image made in memory: pixels, channels, distinct
    /// names, one value per pixel and channel.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), ImageError> {
        let (width, height) = (self.width, self.height);
        let expected = width.saturating_mul(height);
        if expected == 0 || self.channels.is_empty() {
            return Err(ImageError::Unusable(format!(
                "an image of {width} × {height} pixels with {} channels is empty",
                self.channels.len()
            )));
        }
        for (i, channel) in self.channels.iter().enumerate() {
            let (name, got) = (&channel.name, channel.values.len());
            if self.channels.iter().take(i).any(|other| other.name == *name) {
                return Err(ImageError::Unusable(format!("channel {name:?} appears twice")));
            }
            if got != expected {
                let name = name.clone();
                return Err(ImageError::Length { name, width, height, expected, got });
            }
        }
        Ok(())
    }
}

/// Writes sRGB-encoded pixels as an 8-bit PNG, whole or not at all.
///
/// # Errors
/// [`ImageError::Unusable`] if their number is not `width · height`; [`ImageError::File`] if the file
/// cannot be written.
pub fn write_pixels(
    path: &Path,
    width: usize,
    height: usize,
    pixels: &[[u8; 3]],
) -> Result<(), ImageError> {
    let bytes = encode_png(&path.display().to_string(), width, height, pixels)?;
    Ok(store::atomic_write(path, &bytes)?)
}

/// The channels of an EXR file, the colours first, in the order in which they are kept.
fn decode_exr_image(origin: &str, bytes: &[u8]) -> Result<Image, ImageError> {
    let decoded = decode_exr(origin, bytes)?;
    let channels = decoded.channels.into_iter();
    let mut channels: Vec<Channel> =
        channels.map(|(name, values)| Channel { name, values }).collect();
    let rank = |channel: &Channel| ["R", "G", "B", "A"].iter().position(|c| *c == channel.name);
    channels.sort_by_key(|channel| rank(channel).unwrap_or(usize::MAX));
    Ok(Image { width: decoded.width, height: decoded.height, channels })
}

/// The colours of a PNG file as linear ones, and its coverage as it is.
fn decode_png_image(origin: &str, bytes: &[u8]) -> Result<Image, ImageError> {
    let picture = decoded_png(bytes).map_err(|e| png_fault(origin, &e.to_string()))?;
    let has_alpha = picture.color().has_alpha();
    let picture = picture.into_rgba16();
    let (width, height) = picture.dimensions();
    let values = |at: usize, decoded: fn(f64) -> f64| -> Vec<f32> {
        let codes = picture.as_raw().chunks_exact(4).filter_map(|pixel| pixel.get(at));
        codes.map(|code| decoded(f64::from(*code) / 65535.0) as f32).collect()
    };
    let colours = [("R", 0), ("G", 1), ("B", 2)].into_iter();
    let colour =
        |(name, at): (&str, _)| Channel { name: name.into(), values: values(at, srgb::decoded) };
    let mut channels: Vec<Channel> = colours.map(colour).collect();
    if has_alpha {
        channels.push(Channel { name: "A".into(), values: values(3, |alpha| alpha) });
    }
    Ok(Image { width: width as usize, height: height as usize, channels })
}

fn png_fault(origin: &str, reason: &str) -> ImageError {
    ImageError::Unusable(format!("{origin}: malformed PNG: {reason}"))
}

/// The bytes of an 8-bit file of sRGB-encoded pixels; `origin` names it in messages.
fn encode_png(
    origin: &str,
    width: usize,
    height: usize,
    pixels: &[[u8; 3]],
) -> Result<Vec<u8>, ImageError> {
    let fault = |reason: String| png_fault(origin, &reason);
    if pixels.len() != width.saturating_mul(height) {
        return Err(fault(format!("{} pixels for {width} × {height}", pixels.len())));
    }
    let side = |n: usize| u32::try_from(n).map_err(|_| fault(format!("{n} pixels to a side")));
    let mut bytes = Vec::new();
    ::image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(pixels.as_flattened(), side(width)?, side(height)?, ExtendedColorType::Rgb8)
        .map_err(|e| fault(e.to_string()))?;
    Ok(bytes)
}

/// Linear colours times 2^`exposure` as sRGB bytes, and what had to be clipped.
fn shown(colours: &[[f32; 3]], exposure: f64) -> (Vec<[u8; 3]>, Clipped) {
    let gain = exposure.exp2();
    let mut clipped = Clipped::default();
    let pixel = |colour: &[f32; 3]| {
        let exposed = colour.map(|value| f64::from(value) * gain);
        if exposed.iter().any(|value| !value.is_finite()) {
            clipped.non_finite += 1;
            return NON_FINITE;
        }
        clipped.below += usize::from(exposed.iter().any(|value| *value < 0.0));
        clipped.above += usize::from(exposed.iter().any(|value| *value > 1.0));
        exposed.map(|value| (255.0 * srgb::encoded(value.clamp(0.0, 1.0))).round() as u8)
    };
    (colours.iter().map(pixel).collect(), clipped)
}

/// Formats of image files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// OpenEXR: linear, any range.
    Exr,
    /// PNG: sRGB in [0, 1].
    Png,
}

impl Format {
    /// The format that the name of `path` ends in, in either case.
    ///
    /// # Errors
    /// [`ImageError::Unusable`] if it is none of them.
    pub fn of(path: &Path) -> Result<Self, ImageError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("png") => Ok(Self::Png),
            _ => Err(ImageError::Unusable(format!(
                "{}: unknown format of image; expected a name that ends in .exr or .png",
                path.display()
            ))),
        }
    }
}
