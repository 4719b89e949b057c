//! Environment maps as Radiance and EXR files.

use std::io::Cursor;
use std::path::Path;

use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder};

use super::environment::{Negative, require_size};
use super::import::extension;
use super::{Environment, MeasuredError};
use crate::table::{decode_exr, encode_exr, encode_half_exr, store};

/// The channels of a map.
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Largest half.
const LARGEST_HALF: f32 = 65504.0;

/// Smallest half above 0.
const SMALLEST_HALF: f32 = 1.0 / 16_777_216.0;

/// What Radiance files of another tool begin with; the decoder knows `#?RADIANCE` alone.
const OTHER_SIGNATURE: &[u8] = b"#?RGBE";

/// Texels of a file, not yet looked at.
struct Texels {
    width: usize,
    height: usize,
    radiance: Vec<[f32; 3]>,
}

/// Reads a map, of the format that the name ends in.
pub(super) fn read(path: &Path, negative: Negative) -> Result<Environment, MeasuredError> {
    let decode = match extension(path).as_str() {
        "hdr" => radiance,
        "exr" => exr,
        _ => return Err(MeasuredError::unknown_format(path, "Radiance (.hdr); OpenEXR (.exr)")),
    };
    let bytes = store::read(path)?;
    let origin = path.display().to_string();
    let Texels { width, height, mut radiance } = decode(&origin, &bytes)?;
    let black = match negative {
        Negative::Refused => None,
        Negative::Black => raise_to_black(&mut radiance),
    };
    let mut map = Environment::new(width, height, radiance, origin)?;
    map.origin = store::origin(path, &bytes);
    if let Some((count, lowest)) = black {
        map.origin.push_str(&format!(", {count} negative values, down to {lowest}, taken as 0"));
    }
    Ok(map)
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

/// Writes a map as EXR.
pub(super) fn write(map: &Environment, path: &Path) -> Result<(), MeasuredError> {
    map.check()?;
    let plane = |at: usize| -> Vec<f32> {
        map.radiance.iter().filter_map(|texel| texel.get(at)).copied().collect()
    };
    let planes = [plane(0), plane(1), plane(2)];
    let channels: Vec<(&str, &[f32])> =
        CHANNELS.into_iter().zip(planes.iter().map(Vec::as_slice)).collect();
    let largest = planes.iter().flatten().copied().fold(0.0, f32::max);
    let encode = match largest {
        SMALLEST_HALF..=LARGEST_HALF => encode_half_exr,
        _ => encode_exr,
    };
    let bytes = encode(&path.display().to_string(), map.width, map.height, &channels)?;
    Ok(store::atomic_write(path, &bytes)?)
}

fn exr(origin: &str, bytes: &[u8]) -> Result<Texels, MeasuredError> {
    let decoded = decode_exr(origin, bytes)?;
    let plane = |name: &str| decoded.channels.iter().find(|(n, _)| n == name).map(|(_, v)| v);
    let [Some(r), Some(g), Some(b)] = CHANNELS.map(plane) else {
        let missing: Vec<&str> =
            CHANNELS.into_iter().filter(|name| plane(name).is_none()).collect();
        let names: Vec<&str> = decoded.channels.iter().map(|(n, _)| n.as_str()).collect();
        return Err(MeasuredError::Channel {
            origin: origin.into(),
            reason: format!("no channel {}, expected R, G and B", missing.join(", ")),
            known: names.join(", "),
        });
    };
    let radiance = r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b]).collect();
    Ok(Texels { width: decoded.width, height: decoded.height, radiance })
}

fn radiance(origin: &str, bytes: &[u8]) -> Result<Texels, MeasuredError> {
    let fault = |reason: String| MeasuredError::Decoder {
        origin: origin.into(),
        format: "Radiance file",
        reason,
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
    Ok(Texels { width, height, radiance: texels.collect() })
}
