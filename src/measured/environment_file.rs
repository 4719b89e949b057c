//! Environment maps as Radiance and EXR files.

use std::io::Cursor;
use std::path::Path;

use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder};

use super::environment::require_size;
use super::import::{extension, unknown_format};
use super::{Environment, MeasuredError, Negative};
use crate::table::{decode_exr, encode_exr, halves, singles, store};

/// The channels of a map.
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Largest half.
const LARGEST_HALF: f32 = 65504.0;

/// Smallest half above 0.
const SMALLEST_HALF: f32 = 1.0 / 16_777_216.0;

/// What Radiance files of another tool begin with; the decoder knows `#?RADIANCE` alone.
const OTHER_SIGNATURE: &[u8] = b"#?RGBE";

impl Environment {
    /// Reads a map: Radiance (`.hdr`, RGBE; exposure and colour correction divided out) or EXR
    /// (`.exr`, channels `R`, `G`, `B`, others not looked at).
    ///
    /// Columns are taken in the order of the file. A panorama, in which azimuth falls to the right
    /// as it does for a viewer inside, so becomes its mirror image.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file: not there, another format, malformed or truncated,
    /// missing channels (listing those there), and as [`Environment::check`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeasuredError> {
        Self::read_with(path, Negative::Refused)
    }

    /// As [`Environment::read`], with a say in what becomes of negative values.
    ///
    /// # Errors
    /// As [`Environment::read`].
    pub fn read_with(path: impl AsRef<Path>, negative: Negative) -> Result<Self, MeasuredError> {
        let path = path.as_ref();
        let decode = match extension(path).as_str() {
            "hdr" => radiance,
            "exr" => exr,
            _ => return Err(unknown_format(path, "Radiance (.hdr); OpenEXR (.exr)")),
        };
        let bytes = store::read(path)?;
        let mut map = decode(&path.display().to_string(), &bytes)?;
        let black = match negative {
            Negative::Refused => None,
            Negative::Black => raise_to_black(&mut map.radiance),
        };
        map.check()?;
        map.origin = store::origin(path, &bytes);
        if let Some((count, lowest)) = black {
            map.origin
                .push_str(&format!(", {count} negative values, down to {lowest}, taken as 0"));
        }
        Ok(map)
    }

    /// Writes the map as EXR with channels `R`, `G`, `B`, whole or not at all; the same map always
    /// gives the same bytes. Values are halves, within 2⁻¹¹ of the map's (2⁻²⁵ below 2⁻¹⁴), or f32
    /// where one exceeds the largest half, 65504, or where halves would leave it all black.
    ///
    /// # Errors
    /// As [`Environment::check`]; [`MeasuredError::Table`] if the file cannot be written.
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), MeasuredError> {
        self.check()?;
        let plane = |at: usize| self.radiance.iter().map(|texel| texel[at]).collect::<Vec<f32>>();
        let planes = [0, 1, 2].map(plane);
        let channels: Vec<(&str, &[f32])> =
            CHANNELS.into_iter().zip(planes.iter().map(Vec::as_slice)).collect();
        let samples = match planes.iter().flatten().copied().fold(0.0, f32::max) {
            SMALLEST_HALF..=LARGEST_HALF => halves,
            _ => singles,
        };
        let path = path.as_ref();
        let bytes =
            encode_exr(&path.display().to_string(), (self.width, self.height), &channels, samples)?;
        Ok(store::atomic_write(path, &bytes)?)
    }
}

/// Makes finite negative values 0; says how many there were, if any, and the lowest.
fn raise_to_black(radiance: &mut [[f32; 3]]) -> Option<(usize, f32)> {
    let mut found = None;
    for value in radiance.iter_mut().flatten().filter(|v| **v < 0.0 && v.is_finite()) {
        let (count, lowest) = found.unwrap_or((0, 0.0f32));
        found = Some((count + 1, lowest.min(*value)));
        *value = 0.0;
    }
    found
}

/// The texels of a file, not yet checked.
fn exr(origin: &str, bytes: &[u8]) -> Result<Environment, MeasuredError> {
    let decoded = decode_exr(origin, bytes)?;
    let plane = |name: &str| decoded.channels.iter().find(|(n, _)| n == name).map(|(_, v)| v);
    let [Some(r), Some(g), Some(b)] = CHANNELS.map(plane) else {
        let missing: Vec<&str> =
            CHANNELS.into_iter().filter(|name| plane(name).is_none()).collect();
        let names: Vec<&str> = decoded.channels.iter().map(|(n, _)| n.as_str()).collect();
        let (missing, known) = (missing.join(", "), names.join(", "));
        let reason = format!("no channel {missing}, expected R, G and B; it has: {known}");
        return Err(MeasuredError::unusable(origin, reason));
    };
    let radiance = r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b]).collect();
    let (width, height) = (decoded.width, decoded.height);
    Ok(Environment { width, height, radiance, origin: origin.into() })
}

/// As [`exr`].
fn radiance(origin: &str, bytes: &[u8]) -> Result<Environment, MeasuredError> {
    let fault = |reason: String| {
        MeasuredError::unusable(origin, format!("malformed Radiance file: {reason}"))
    };
    let attempt = || {
        let decoder = if bytes.starts_with(OTHER_SIGNATURE) {
            HdrDecoder::new_nonstrict(Cursor::new(bytes))
        } else {
            HdrDecoder::new(Cursor::new(bytes))
        };
        let decoder = decoder.map_err(|e| fault(e.to_string()))?;
        let (width, height) = decoder.dimensions();
        require_size(origin, width as usize, height as usize)?;
        let header = decoder.metadata();
        let pixels = DynamicImage::from_decoder(decoder).map_err(|e| fault(e.to_string()))?;
        Ok((header, pixels.into_rgb32f()))
    };
    // The decoder is not ours, and its panics on a malformed file must not become ours: run lengths
    // that overflow are one.
    let (header, pixels) = std::panic::catch_unwind(attempt)
        .unwrap_or_else(|_| Err(fault("the decoder gave up on it".into())))?;

    let exposure = header.exposure.unwrap_or(1.0);
    let (r, g, b) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let divisors = [r, g, b].map(|correction| exposure * correction);
    if divisors.iter().any(|divisor| !(divisor.is_finite() && *divisor > 0.0)) {
        return Err(fault(format!(
            "expected a positive EXPOSURE and COLORCORR, got {exposure} and {r} {g} {b}"
        )));
    }
    let [r, g, b] = divisors;
    let (width, height) = (pixels.width() as usize, pixels.height() as usize);
    let texels = pixels.pixels().map(|pixel| pixel.0).map(|[x, y, z]| [x / r, y / g, z / b]);
    Ok(Environment { width, height, radiance: texels.collect(), origin: origin.into() })
}
