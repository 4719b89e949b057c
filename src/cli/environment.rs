//! Environment maps named on the command line.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context as _, bail};
use image::{DynamicImage, ImageFormat, ImageReader, Limits};

use crate::measured::environment::Environment;
use crate::table::{MAX_PIXEL_BYTES, decode_exr, store};

/// Reads a latitude–longitude map of twice the width of its height: Radiance RGBE (.hdr) or EXR
/// (.exr) with channels R, G, B.
pub(super) fn load_environment(path: &Path) -> anyhow::Result<Environment> {
    let shown = path.display().to_string();
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let decode = match extension.as_deref() {
        Some("hdr") => decode_hdr,
        Some("exr") => decode_rgb_exr,
        _ => bail!("{shown}: unknown format of environment; expected .hdr or .exr"),
    };
    let bytes = store::read(path)?;
    let (width, height, radiance) = decode(&shown, &bytes)?;
    if width != 2 * height || height == 0 {
        bail!(
            "{shown}: {width} × {height} texels; a latitude–longitude map is twice as wide as high"
        );
    }
    let bad = |texel: &[f32; 3]| texel.iter().any(|v| !(v.is_finite() && *v >= 0.0));
    if let Some(at) = radiance.iter().position(bad) {
        let (column, row) = (at % width, at / width);
        bail!("{shown}: texel ({column}, {row}) is negative or not finite");
    }
    let origin = format!("{shown} (sha256 {})", store::sha256_hex(&bytes));
    Ok(Environment { width, height, radiance, origin })
}

type Texels = (usize, usize, Vec<[f32; 3]>);

fn decode_hdr(shown: &str, bytes: &[u8]) -> anyhow::Result<Texels> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Hdr);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_PIXEL_BYTES);
    reader.limits(limits);
    let DynamicImage::ImageRgb32F(picture) = reader.decode().with_context(|| shown.to_owned())?
    else {
        bail!("{shown}: not a Radiance file of RGB");
    };
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    Ok((width, height, picture.pixels().map(|pixel| pixel.0).collect()))
}

fn decode_rgb_exr(shown: &str, bytes: &[u8]) -> anyhow::Result<Texels> {
    let decoded = decode_exr(shown, bytes)?;
    let mut planes = Vec::with_capacity(3);
    for name in ["R", "G", "B"] {
        let Some((_, values)) = decoded.channels.iter().find(|(n, _)| n == name) else {
            bail!("{shown}: no channel {name:?}; an environment has R, G and B");
        };
        planes.push(values.iter().copied());
    }
    let mut texels = vec![[0.0f32; 3]; decoded.width * decoded.height];
    for (k, plane) in planes.into_iter().enumerate() {
        for (texel, value) in texels.iter_mut().zip(plane) {
            if let Some(slot) = texel.get_mut(k) {
                *slot = value;
            }
        }
    }
    Ok((decoded.width, decoded.height, texels))
}
