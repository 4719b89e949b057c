//! Images as OpenEXR: f32 channels, one part, scan lines, lossless.

use super::image::{Channel, Image, ImageError};
use crate::table::{decode_exr, encode_exr};

/// What pictures call their channels, in the order in which they are kept.
const COLOURS: [&str; 4] = ["R", "G", "B", "A"];

/// Reads an image; `origin` names it in messages.
pub(super) fn decode(origin: &str, bytes: &[u8]) -> Result<Image, ImageError> {
    let decoded = decode_exr(origin, bytes)?;
    let mut channels: Vec<Channel> =
        decoded.channels.into_iter().map(|(name, values)| Channel { name, values }).collect();
    let rank = |channel: &Channel| {
        COLOURS.iter().position(|name| *name == channel.name).unwrap_or(COLOURS.len())
    };
    channels.sort_by_key(rank);
    let image = Image { width: decoded.width, height: decoded.height, channels };
    image.check()?;
    Ok(image)
}

/// The bytes of a file.
pub(super) fn encode(image: &Image, origin: &str) -> Result<Vec<u8>, ImageError> {
    image.check()?;
    let channels: Vec<(&str, &[f32])> =
        image.channels.iter().map(|c| (c.name.as_str(), c.values.as_slice())).collect();
    Ok(encode_exr(origin, image.width, image.height, &channels)?)
}
