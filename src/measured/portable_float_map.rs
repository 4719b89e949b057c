//! Portable float maps (PFM): `Pf` (grey) or `PF` (colour), width, height and a scale factor, each
//! ended by one white space, then f32 numbers from the bottom row up.
//!
//! Source: P. Debevec, "PFM Portable FloatMap Image Format" (1997). The scale factor's sign gives
//! the byte order, negative for little-endian; its size is a unit and is not looked at.
//!
//! Read here and not with `zune-ppm` 0.5, which takes first bytes of the pixels that look like
//! white space or `#` for the header, and turns over rows rightly only where their number is even.

use super::MeasuredError;
use super::pattern::Picture;

/// Reads a map; `origin` names it in messages.
pub(super) fn decode(origin: &str, bytes: &[u8]) -> Result<Picture, MeasuredError> {
    let fault =
        |reason: String| MeasuredError::unusable(origin, format!("malformed PFM: {reason}"));
    let mut rest = bytes;
    let mut word = |what: &str| -> Result<String, MeasuredError> {
        // No word of a header is longer than this.
        let end = rest.iter().take(64).position(u8::is_ascii_whitespace);
        let Some((word, after)) = end.and_then(|end| rest.split_at_checked(end)) else {
            return Err(fault(format!("the header ends before its {what}")));
        };
        rest = after.get(1..).unwrap_or_default();
        Ok(String::from_utf8_lossy(word).into_owned())
    };
    let names: &[&str] = match word("signature")?.as_str() {
        "Pf" => &["Y"],
        "PF" => &["R", "G", "B"],
        other => return Err(fault(format!("expected the signature Pf or PF, got {other:?}"))),
    };
    let mut side = |what: &str| {
        let text = word(what)?;
        let side = text.parse::<u32>().ok().filter(|side| *side > 0);
        side.ok_or_else(|| fault(format!("{what}: expected a number of pixels, got {text:?}")))
    };
    let (width, height) = (side("width")? as usize, side("height")? as usize);
    let text = word("scale factor")?;
    let scale = text.parse::<f64>().ok().filter(|scale| scale.is_finite() && *scale != 0.0);
    let Some(scale) = scale else {
        return Err(fault(format!("scale factor: expected a number that is not 0, got {text:?}")));
    };

    let pixels = (width as u64).saturating_mul(height as u64);
    let expected = pixels.saturating_mul(4 * names.len() as u64);
    if rest.len() as u64 != expected {
        let (got, numbers) = (rest.len(), names.len());
        let of = format!("{width} × {height} pixels of {numbers} f32");
        let reason = format!("{got} bytes of pixels, expected {expected} for {of}");
        return Err(MeasuredError::unusable(origin, reason));
    }
    let number = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let (numbers, _) = rest.as_chunks();
    let values: Vec<f64> = numbers.iter().map(|bytes| f64::from(number(*bytes))).collect();
    let from_top = values.chunks(width * names.len()).rev().flatten().copied();
    Ok(Picture::interleaved([width, height], names, from_top))
}
