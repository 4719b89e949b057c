//! Images as PNG: sRGB, 8 or 16 bits.

use ::image::{ExtendedColorType, ImageEncoder};

use super::image::{Channel, Clipped, Image, ImageError};
use crate::measured::{decoded_png, srgb};

/// How a pixel that is not finite is shown.
const NON_FINITE: [u8; 3] = [255, 0, 255];

/// Reads an image; `origin` names it in messages.
pub(super) fn decode(origin: &str, bytes: &[u8]) -> Result<Image, ImageError> {
    let picture = decoded_png(bytes).map_err(|e| fault(origin, &e.to_string()))?;
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

fn fault(origin: &str, reason: &str) -> ImageError {
    ImageError::Unusable(format!("{origin}: malformed PNG: {reason}"))
}

/// The bytes of an 8-bit file of sRGB-encoded pixels; `origin` names it in messages.
pub(super) fn encode(
    origin: &str,
    width: usize,
    height: usize,
    pixels: &[[u8; 3]],
) -> Result<Vec<u8>, ImageError> {
    let fault = |reason: String| fault(origin, &reason);
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
pub(super) fn shown(colours: &[[f32; 3]], exposure: f64) -> (Vec<[u8; 3]>, Clipped) {
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
