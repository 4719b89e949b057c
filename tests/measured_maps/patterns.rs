//! Patterns as PNG, EXR and portable float maps.

use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageBuffer};
use striae::measured::{Encoding, Pattern};
use striae::render::image::{Channel, Image};
use zune_core::bytestream::ZCursor;
use zune_core::result::DecodingResult;
use zune_ppm::PPMDecoder;

use crate::{Outcome, assert_refused};

const SIDE: usize = 24;

/// A peak on a slope, different in every pixel, between 0 and 1.
fn value(at: usize) -> f64 {
    let (x, y) = ((at % SIDE) as f64, (at / SIDE) as f64);
    0.9 / (1.0 + 0.1 * (x - 7.3).powi(2) + 0.05 * (y - 11.6).powi(2)) + 0.001 * x + 0.002 * y
}

fn values() -> Vec<f32> {
    (0..SIDE * SIDE).map(|at| value(at) as f32).collect()
}

fn exr(
    folder: &Path,
    channels: &[(&str, Vec<f32>)],
) -> Result<PathBuf, striae::render::image::ImageError> {
    let path = folder.join("p.exr");
    let channels = channels
        .iter()
        .map(|(name, values)| Channel { name: (*name).into(), values: values.clone() })
        .collect();
    Image { width: SIDE, height: SIDE, channels }.write_exr(&path)?;
    Ok(path)
}

/// A portable float map of rows from the top.
pub(crate) fn pfm(width: usize, values: &[f32], components: usize, little: bool) -> Vec<u8> {
    let height = values.len() / components / width;
    let signature = if components == 1 { "Pf" } else { "PF" };
    let scale = if little { "-1.0" } else { "1.0" };
    let mut bytes = format!("{signature}\n{width} {height}\n{scale}\n").into_bytes();
    for row in values.chunks(width * components).rev() {
        for value in row {
            bytes.extend(if little { value.to_le_bytes() } else { value.to_be_bytes() });
        }
    }
    bytes
}

fn read(path: impl AsRef<Path>) -> Result<Pattern, striae::measured::MeasuredError> {
    Pattern::read(path, None, Encoding::Linear)
}

#[test]
fn png_codes_are_linear_or_decoded() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("p.png");
    let side = SIDE as u32;
    let codes: Vec<u16> = (0..SIDE * SIDE).map(|at| (value(at) * 60000.0) as u16).collect();
    let grey: ImageBuffer<image::Luma<u16>, _> =
        ImageBuffer::from_raw(side, side, codes.clone()).ok_or("size")?;
    DynamicImage::ImageLuma16(grey).save(&path)?;
    let linear = read(&path)?;
    assert_eq!((linear.width, linear.height), (SIDE, SIDE));
    assert_eq!(linear.at(3, 5), Some(f64::from(codes[5 * SIDE + 3]) / 65535.0));
    assert_eq!((linear.at(SIDE, 0), linear.at(0, SIDE)), (None, None));
    let decoded = Pattern::read(&path, Some("Y"), Encoding::Srgb)?;
    // The reader of pictures has its own decoder of sRGB, to f32.
    let image = Image::read(&path)?;
    for (got, want) in decoded.intensity.iter().zip(&image.require("G")?.values) {
        assert!((got - f64::from(*want)).abs() < 1e-7, "{got}, expected {want}");
    }

    let bytes: Vec<u8> = codes.iter().flat_map(|c| [(c >> 8) as u8, 9, 0, 77]).collect();
    let colour = ImageBuffer::from_raw(side, side, bytes).ok_or("size")?;
    DynamicImage::ImageRgba8(colour).save(&path)?;
    let red = Pattern::read(&path, Some("R"), Encoding::Linear)?;
    assert_eq!(red.at(3, 5), Some(f64::from(codes[5 * SIDE + 3] >> 8) / 255.0));
    assert_refused(read(&path), &["p.png", "channels differ", "\"G\"", "R, G, B"]);
    assert_refused(
        Pattern::read(&path, Some("Z"), Encoding::Srgb),
        &["p.png", "no channel \"Z\"", "it has: R, G, B"],
    );
    assert_refused(
        Pattern::read(&path, Some("G"), Encoding::Srgb),
        &["p.png", "all 576 pixels are 0.0027", "varies"],
    );
    Ok(())
}

#[test]
fn exr_needs_one_channel_or_equal_ones() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (good, half) = (values(), vec![0.5; SIDE * SIDE]);
    for channels in [
        vec![("Y", good.clone())],
        vec![("intensity", good.clone()), ("A", half.clone())],
        vec![("R", good.clone()), ("G", good.clone()), ("B", good.clone())],
    ] {
        let pattern = read(exr(folder.path(), &channels)?)?;
        assert!(pattern.intensity.iter().zip(&good).all(|(a, b)| *a == f64::from(*b)));
    }
    let path =
        exr(folder.path(), &[("R", good.clone()), ("G", half.clone()), ("B", good.clone())])?;
    assert_refused(read(&path), &["p.exr", "channels differ", "B, G, R"]);
    let named = Pattern::read(&path, Some("B"), Encoding::Srgb)?;
    assert_eq!(named.at(1, 1), Some(f64::from(good[SIDE + 1])));
    assert_refused(
        Pattern::read(&path, Some("Y"), Encoding::Srgb),
        &["p.exr", "no channel \"Y\"", "B, G, R"],
    );
    Ok(())
}

#[test]
fn portable_float_maps_run_from_the_bottom() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("p.pfm");
    let good = values();
    // Even and odd numbers of rows, both byte orders, grey and colour.
    for rows in [SIDE, SIDE - 1] {
        for (components, little) in [(1, true), (1, false), (3, true), (3, false)] {
            let grey = &good[..rows * SIDE];
            let all: Vec<f32> =
                grey.iter().flat_map(|v| std::iter::repeat_n(*v, components)).collect();
            let bytes = pfm(SIDE, &all, components, little);
            std::fs::write(&path, &bytes)?;
            let pattern = read(&path)?;
            assert_eq!((pattern.width, pattern.height), (SIDE, rows));
            assert!(pattern.intensity.iter().zip(grey).all(|(a, b)| *a == f64::from(*b)));

            // A decoder of other hands agrees where it turns over rows rightly.
            if rows % 2 == 0 {
                let decoded = PPMDecoder::new(ZCursor::new(&bytes)).decode();
                let Ok(DecodingResult::F32(other)) = decoded else { panic!("no f32") };
                assert_eq!(other, all);
            }
        }
    }
    // A first pixel that begins like white space or a comment is a pixel.
    for first in [0x20, 0x0a, 0x23] {
        let mut odd = good.clone();
        odd[(SIDE - 1) * SIDE] = f32::from_le_bytes([first, 0, 0x80, 0x3e]);
        std::fs::write(&path, pfm(SIDE, &odd, 1, true))?;
        assert_eq!(read(&path)?.at(0, SIDE - 1), Some(f64::from(odd[(SIDE - 1) * SIDE])));
    }
    Ok(())
}

#[test]
fn malformed_portable_float_maps_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("p.pfm");
    for (bytes, parts) in [
        (&b""[..], &["p.pfm", "malformed PFM", "signature"][..]),
        (b"P5\n2 2\n-1\n", &["p.pfm", "Pf or PF", "\"P5\""]),
        (b"Pf\n2", &["p.pfm", "ends before its width"]),
        (b"Pf\n0 2\n-1\n", &["p.pfm", "width", "\"0\""]),
        (b"Pf\n2 two\n-1\n", &["p.pfm", "height", "\"two\""]),
        (b"Pf\n2 2\n0\n", &["p.pfm", "scale factor", "\"0\""]),
        (b"Pf\n2 2\nnan\n", &["p.pfm", "scale factor", "\"nan\""]),
        (b"Pf\n2 2\n-1", &["p.pfm", "ends before its scale factor"]),
        (b"Pf\n2 2\n-1\n1234", &["p.pfm", "4 bytes", "expected 16", "2 × 2"]),
        (
            b"Pf\n1000000000 2000000000\n-1\n1234",
            &["p.pfm", "4 bytes", "expected 8000000000000000000"],
        ),
        (b"PF\n1 1\n-1\n1234567890123", &["p.pfm", "13 bytes", "expected 12", "3 f32"]),
    ] {
        std::fs::write(&path, bytes)?;
        assert_refused(read(&path), parts);
    }
    Ok(())
}

#[test]
fn values_that_are_no_pattern_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let with = |changes: &[(usize, f32)]| {
        let mut values = values();
        for (at, value) in changes {
            values[*at] = *value;
        }
        values
    };
    let saturated: Vec<(usize, f32)> = (100..106).map(|at| (at, 2.0)).collect();
    for (values, parts) in [
        (vec![0.0; SIDE * SIDE], &["p.exr", "all 576 pixels are black"][..]),
        (vec![0.25; SIDE * SIDE], &["p.exr", "all 576 pixels are 0.25", "varies"]),
        (
            with(&[(30, f32::NAN), (40, f32::INFINITY)]),
            &["p.exr", "2 of 576 pixels are not finite", "column 6, row 1", "NaN"],
        ),
        (with(&[(50, -0.5)]), &["1 of 576 pixels are negative", "column 2, row 2", "-0.5"]),
        (with(&saturated), &["6 of 576", "largest value", "at most 1 %", "column 4, row 4", "2"]),
    ] {
        assert_refused(read(exr(folder.path(), &[("Y", values)])?), parts);
    }
    // Five of 576 pixels are 0.87 %.
    read(exr(folder.path(), &[("Y", with(&saturated[..5]))])?)?;

    let path = folder.path().join("p.png");
    let codes: Vec<u8> = (0..SIDE * SIDE).map(|at| (value(at) * 700.0).min(255.0) as u8).collect();
    let at_most = codes.iter().filter(|code| **code == 255).count();
    let side = SIDE as u32;
    image::GrayImage::from_raw(side, side, codes).ok_or("size")?.save(&path)?;
    assert_refused(read(&path), &["p.png", &format!("{at_most} of 576"), "saturated", "is 1"]);

    std::fs::write(folder.path().join("p.pfm"), pfm(4, &[0.1, 0.2, 0.3, 0.4], 1, true))?;
    assert_refused(read(folder.path().join("p.pfm")), &["p.pfm", "4 × 1 pixels", "at least 2"]);
    std::fs::write(folder.path().join("p.pfm"), pfm(1, &[0.1, 0.2, 0.3, 0.4], 1, true))?;
    assert_refused(read(folder.path().join("p.pfm")), &["p.pfm", "1 × 4 pixels", "at least 2"]);
    assert_refused(read("p.tif"), &["p.tif", "unknown format", ".png", ".exr", ".pfm"]);
    assert_refused(read(folder.path().join("q.png")), &["q.png", "cannot read"]);
    Ok(())
}

#[test]
fn a_symmetric_peak_is_not_saturation() -> Outcome {
    let pattern = |intensity: Vec<f64>| Pattern {
        width: 4,
        height: intensity.len() / 4,
        intensity,
        origin: "memory".into(),
    };
    pattern(vec![0.1, 1.0, 1.0, 0.2, 0.3, 1.0, 1.0, 0.4]).check()?;
    assert_refused(
        pattern(vec![1.0, 1.0, 1.0, 0.2, 0.3, 1.0, 1.0, 0.4]).check(),
        &["memory", "5 of 8", "saturated", "column 0, row 0"],
    );
    let short = Pattern { width: 3, ..pattern(vec![0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]) };
    assert_refused(short.check(), &["memory", "8 values", "expected 6"]);
    Ok(())
}
