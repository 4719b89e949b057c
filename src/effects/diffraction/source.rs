//! Height maps and patterns from files.
//!
//! To be wired: the readers of `crate::measured` take the place of both functions.

use std::path::Path;

use serde::Deserialize;

use super::DiffractionError;
use crate::measured::height_map::HeightMap;
use crate::measured::pattern::Pattern;
use crate::table::{TableError, store};

/// What stands beside the samples, in `<stem>.json`.
#[derive(Debug, Deserialize)]
struct Header {
    nx: usize,
    ny: usize,
    dx_um: f64,
    dy_um: f64,
}

/// Reads `<stem>.f32`, little-endian heights in nm, with its `<stem>.json`.
pub(super) fn height_map(path: &Path) -> Result<HeightMap, DiffractionError> {
    let samples = store::read(path)?;
    let header_path = path.with_extension("json");
    let header_bytes = store::read(&header_path)?;
    let header: Header = serde_json::from_slice(&header_bytes).map_err(|e| {
        TableError::Malformed { origin: header_path.display().to_string(), reason: e.to_string() }
    })?;
    let origin = format!("{} (sha256 {})", path.display(), store::sha256_hex(&samples));
    let expected = header.nx.saturating_mul(header.ny).saturating_mul(4);
    if samples.len() != expected {
        let got = samples.len();
        let reason =
            format!("{} × {} samples need {expected} bytes, got {got}", header.nx, header.ny);
        return Err(DiffractionError::unusable(&origin, reason));
    }
    let (quads, _) = samples.as_chunks::<4>();
    Ok(HeightMap {
        nx: header.nx,
        ny: header.ny,
        dx_um: header.dx_um,
        dy_um: header.dy_um,
        height_nm: quads.iter().map(|quad| f64::from(f32::from_le_bytes(*quad))).collect(),
        origin,
    })
}

/// Reads a PNG as linear intensity: the mean of its sRGB-decoded channels.
pub(super) fn pattern(path: &Path) -> Result<Pattern, DiffractionError> {
    let bytes = store::read(path)?;
    let origin = format!("{} (sha256 {})", path.display(), store::sha256_hex(&bytes));
    let picture = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png)
        .map_err(|e| DiffractionError::unusable(&origin, e.to_string()))?
        .into_rgb16();
    let decoded = |code: u16| {
        let v = f64::from(code) / 65535.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    };
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let pixels = picture.as_raw().chunks_exact(3);
    let intensity =
        pixels.map(|p| p.iter().map(|code| decoded(*code)).sum::<f64>() / 3.0).collect();
    Ok(Pattern { width, height, intensity, origin })
}
