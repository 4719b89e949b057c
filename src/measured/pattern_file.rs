//! Patterns as PNG, EXR and portable float maps, and the choice of one channel.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits};

use super::import::extension;
use super::{Encoding, MeasuredError, Pattern, portable_float_map};
use crate::table::{MAX_PIXEL_BYTES, decode_exr, store};

/// The channels of a picture, row by row from the top.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) channels: Vec<(String, Vec<f64>)>,
}

/// Reads the channel of a file.
pub(super) fn read(
    path: &Path,
    channel: Option<&str>,
    encoding: Encoding,
) -> Result<Pattern, MeasuredError> {
    let origin = path.display().to_string();
    let decode: fn(&str, &[u8], Encoding) -> Result<Picture, MeasuredError> =
        match extension(path).as_str() {
            "png" => png,
            "exr" => |origin, bytes, _| exr(origin, bytes),
            "pfm" => |origin, bytes, _| portable_float_map::decode(origin, bytes),
            _ => {
                let known = "PNG (.png); OpenEXR (.exr); portable float map (.pfm)";
                return Err(MeasuredError::unknown_format(path, known));
            }
        };
    let bytes = store::read(path)?;
    let picture = decode(&origin, &bytes, encoding)?;
    let (width, height) = (picture.width, picture.height);
    let intensity = chosen(&origin, picture.channels, channel)?;
    let mut pattern = Pattern { width, height, intensity, origin };
    pattern.check()?;
    pattern.origin = store::origin(path, &bytes);
    Ok(pattern)
}

/// The channel called `wanted`; without a name the only one there is, or one of several equal ones,
/// coverage (`A`) left out.
fn chosen(
    origin: &str,
    mut channels: Vec<(String, Vec<f64>)>,
    wanted: Option<&str>,
) -> Result<Vec<f64>, MeasuredError> {
    let known = channels.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
    let fault = |reason: String| MeasuredError::Channel { origin: origin.into(), reason, known };
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

fn png(origin: &str, bytes: &[u8], encoding: Encoding) -> Result<Picture, MeasuredError> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_PIXEL_BYTES);
    reader.limits(limits);
    let picture = reader.decode().map_err(|e| MeasuredError::Decoder {
        origin: origin.into(),
        format: "PNG",
        reason: e.to_string(),
    })?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    // Sixteen bits hold eight exactly: 257 · v / 65535 = v / 255.
    let (names, codes): (&[&str], Vec<u16>) = if picture.color().has_color() {
        (&["R", "G", "B"], picture.into_rgb16().into_raw())
    } else {
        (&["Y"], picture.into_luma16().into_raw())
    };
    let linear = |code: &u16| {
        let code = f64::from(*code) / 65535.0;
        match encoding {
            Encoding::Srgb => srgb_decoded(code),
            Encoding::Linear => code,
        }
    };
    let channel = |(at, name): (usize, &&str)| {
        let values = codes.iter().skip(at).step_by(names.len()).map(linear).collect();
        ((*name).to_owned(), values)
    };
    Ok(Picture { width, height, channels: names.iter().enumerate().map(channel).collect() })
}

/// Linear value of an sRGB-encoded one (IEC 61966-2-1). Both 1, in [0, 1].
fn srgb_decoded(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        core_math::pow((encoded + 0.055) / 1.055, 2.4)
    }
}
