//! Environment maps: geometry, means, resizing, rotation, files, and what is refused.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use image::Rgb;
use image::codecs::hdr::HdrEncoder;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use striae::measured::{Environment, MeasuredError, Negative};
use striae::render::image::{Channel, Image};
use striae::table::provenance::Provenance;

use crate::{Outcome, assert_refused, outside, repository};

/// Uniform numbers in [0, 1).
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    f64::from(random.next_u32()) / 4_294_967_296.0
}

/// A map of random radiance over four decades.
fn random_map(height: usize) -> Result<Environment, MeasuredError> {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut texel = || 10f64.powf(4.0 * uniform(&mut random) - 2.0) as f32;
    let radiance = (0..2 * height * height).map(|_| [texel(), texel(), texel()]).collect();
    Environment::new(2 * height, height, radiance, "random")
}

/// A map that is 1 + (x + y z)/2 of the direction, in all channels but with other offsets.
fn smooth_map(height: usize) -> Result<Environment, MeasuredError> {
    let blank =
        Environment::new(2 * height, height, vec![[1.0; 3]; 2 * height * height], "smooth")?;
    let texel = |at: usize| {
        let (i, j) = ((at % (2 * height)) as f64, (at / (2 * height)) as f64);
        smooth(blank.layout().direction(i + 0.5, j + 0.5)).map(|v| v as f32)
    };
    let radiance = (0..2 * height * height).map(texel).collect();
    Environment::new(2 * height, height, radiance, "smooth")
}

fn smooth([x, y, z]: [f64; 3]) -> [f64; 3] {
    let value = 1.0 + 0.5 * (x + y * z);
    [value, 2.0 * value, 3.0 + value]
}

fn hdr(
    folder: &Path,
    width: usize,
    texels: &[[f32; 3]],
) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let path = folder.join("e.hdr");
    let pixels: Vec<Rgb<f32>> = texels.iter().map(|t| Rgb(*t)).collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, width, texels.len() / width)?;
    std::fs::write(&path, bytes)?;
    Ok(path)
}

fn relative(got: [f64; 3], want: [f64; 3]) -> f64 {
    got.iter().zip(want).map(|(g, w)| (g / w - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn directions_and_coordinates_are_inverse() -> Outcome {
    let map = random_map(8)?;
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    // Azimuth 0 at the left edge, +y a quarter of the way around, the zenith at the top.
    assert!(near(map.layout().direction(0.0, 4.0), [1.0, 0.0, 0.0]));
    assert!(near(map.layout().direction(4.0, 4.0), [0.0, 1.0, 0.0]));
    assert!(near(map.layout().direction(3.0, 0.0), [0.0, 0.0, 1.0]));
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..1000 {
        let (x, y) = (16.0 * uniform(&mut random), 8.0 * uniform(&mut random));
        for length in [3.0, 1e-200, 1e200] {
            let direction = map.layout().direction(x, y).map(|c| length * c);
            let (got_x, got_y) = map.layout().coordinates(direction);
            // Measured: 1.8e-15.
            assert!(
                (got_x - x).abs() < 1e-13 && (got_y - y).abs() < 1e-13,
                "{x} {y}: {got_x} {got_y}"
            );
        }
    }
    let (x, _) = map.layout().coordinates([1.0, -1e-300, 0.0]);
    assert!((0.0..16.0).contains(&x), "{x}");
    Ok(())
}

#[test]
fn radiance_is_bilinear_around_and_over_the_poles() -> Outcome {
    let map = random_map(8)?;
    let texel = |i: usize, j: usize| map.radiance[j * 16 + i].map(f64::from);
    let at = |x: f64, y: f64| map.radiance(map.layout().direction(x, y));
    let mean =
        |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|c| 0.5 * (a[c] + b[c])) };
    for (i, j) in [(0, 0), (15, 7), (7, 3), (3, 7)] {
        assert!(relative(at(i as f64 + 0.5, j as f64 + 0.5), texel(i, j)) < 1e-10);
    }
    assert!(relative(at(3.0, 4.5), mean(texel(2, 4), texel(3, 4))) < 1e-10);
    assert!(relative(at(5.5, 4.0), mean(texel(5, 3), texel(5, 4))) < 1e-10);
    assert!(relative(at(0.0, 4.5), mean(texel(15, 4), texel(0, 4))) < 1e-10, "around");
    // At a pole two texels that face each other count alike, from whatever side it is reached.
    let zenith = map.radiance([1e-12, 3e-13, 1.0]);
    let (x, _) = map.layout().coordinates([1e-12, 3e-13, 1.0]);
    let i = x as usize;
    let u = x - 0.5 - (x - 0.5).floor();
    let (left, right) = ((x - 0.5).floor() as i64, (x - 0.5).floor() as i64 + 1);
    let column = |c: i64| c.rem_euclid(16) as usize;
    let across = |c: i64| mean(texel(column(c), 0), texel(column(c + 8), 0));
    let want: [f64; 3] =
        std::array::from_fn(|c| (1.0 - u) * across(left)[c] + u * across(right)[c]);
    assert!(relative(zenith, want) < 1e-9, "{zenith:?}, expected {want:?} (column {i})");
    // No step across the poles.
    for z in [1.0, -1.0] {
        let (one, other) = (map.radiance([1e-13, 0.0, z]), map.radiance([-1e-13, 0.0, z]));
        assert!(relative(one, other) < 1e-9, "{one:?}, {other:?}");
    }
    assert!(map.radiance([f64::NAN, 0.0, 0.0]).iter().all(|v| v.is_nan()));
    Ok(())
}

#[test]
fn solid_angles_are_exact() -> Outcome {
    for height in [4, 8, 64, 1024] {
        let map =
            Environment::new(2 * height, height, vec![[1.0; 3]; 2 * height * height], "uniform")?;
        let width = 2.0 * height as f64;
        let sum: f64 = (0..height).map(|row| width * map.solid_angle(row)).sum();
        assert!((sum / (4.0 * PI) - 1.0).abs() < 1e-13, "{sum}");
        let edge = |row: f64| (PI * row / height as f64).cos();
        for row in [0, height / 2 - 1, height - 1] {
            let want = 2.0 * PI / width * (edge(row as f64) - edge(row as f64 + 1.0));
            // The difference of cosines loses digits at the poles, the product does not.
            // Measured: 4.4e-12; 1.2e-15 for the sums.
            assert!((map.solid_angle(row) / want - 1.0).abs() < 1e-10, "{height}, {row}");
        }
        assert!(relative(map.mean(), [1.0; 3]) < 1e-13);
        assert!((map.contrast() - 1.0).abs() < 1e-13);
    }
    Ok(())
}

#[test]
fn the_mean_is_that_of_the_integral() -> Outcome {
    // x + y z has no mean over the sphere, nor over the texels of a row. Measured: 1.2e-9.
    let map = smooth_map(64)?;
    assert!(relative(map.mean(), [1.0, 2.0, 4.0]) < 1e-8, "{:?}", map.mean());
    // One white texel of the equator among black ones, in luminance of Rec. 709.
    let mut radiance = vec![[0.0; 3]; 2 * 16 * 16];
    radiance[8 * 32 + 5] = [1.0, 2.0, 4.0];
    let lamp = Environment::new(32, 16, radiance, "lamp")?;
    assert!((lamp.contrast() * lamp.solid_angle(8) / (4.0 * PI) - 1.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn resizing_keeps_the_mean() -> Outcome {
    for height in [12, 50, 256] {
        let map = random_map(height)?;
        for width in [8, 10, 34, 64, 100, 128, 200, 514] {
            let other = map.resized(width)?;
            assert_eq!((other.width, other.height), (width, width / 2));
            // Measured: 1.0e-8, the rounding of the texels to f32.
            let off = relative(other.mean(), map.mean());
            assert!(off < 5e-8, "{height} rows to {width} columns: {off:e}");
        }
        let same = map.resized(map.width)?;
        let moved = same.radiance.iter().flatten().zip(map.radiance.iter().flatten());
        assert!(moved.into_iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-6));
    }
    // Two by two texels into one, by hand: rows count by their solid angles.
    let map = random_map(8)?;
    let half = map.resized(8)?;
    let (top, bottom) = (map.solid_angle(0), map.solid_angle(1));
    let green = |at: usize| f64::from(map.radiance[at][1]);
    let want =
        (top * (green(2) + green(3)) + bottom * (green(18) + green(19))) / (2.0 * (top + bottom));
    assert!((f64::from(half.radiance[1][1]) / want - 1.0).abs() < 1e-7);
    for (width, parts) in [
        (9, &["9 × 4", "twice as wide"][..]),
        (0, &["0 × 0", "at least 8 × 4"]),
        (6, &["6 × 3", "at least 8 × 4"]),
        (1 << 40, &["declares", "the limit"]),
        (usize::MAX, &["random, resized", "twice as wide"]),
    ] {
        assert_refused(map.resized(width), parts);
    }
    Ok(())
}

#[test]
fn a_rotation_turns_the_lights() -> Outcome {
    let map = smooth_map(64)?;
    let (sin, cos) = 0.7f64.sin_cos();
    // About z, then +x to +y to +z.
    for rows in [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    ] {
        let turned = map.rotated(rows);
        turned.check()?;
        for v in [[0.48, 0.6, 0.64], [-0.6, 0.0, -0.8], [0.0, -0.96, 0.28]] {
            let r_v = rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
            // Bilinear between texels of 2.8°. Measured: 4.9e-4.
            let off = relative(turned.radiance(r_v), smooth(v));
            assert!(off < 1e-3, "{v:?}: {off:e}");
        }
        // Measured: 1.0e-9; this map has next to nothing that a texel cannot hold.
        assert!(relative(turned.mean(), map.mean()) < 1e-8);
    }
    Ok(())
}

#[test]
fn radiance_files_are_read() -> Outcome {
    let folder = tempfile::tempdir()?;
    let map = random_map(16)?;
    let path = hdr(folder.path(), 32, &map.radiance)?;
    let read = Environment::read(&path)?;
    assert_eq!((read.width, read.height), (32, 16));
    assert!(read.origin.contains("e.hdr (sha256 "), "{}", read.origin);
    for (got, want) in read.radiance.iter().zip(&map.radiance) {
        // Eight bits of mantissa, shared by three channels.
        let step = want.iter().fold(0.0f32, |a, b| a.max(*b)) / 128.0;
        assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() <= step), "{got:?}, {want:?}");
    }
    let good = std::fs::read(&path)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(text(&good).starts_with("#?RADIANCE\n"));
    let mut exposed = b"#?RGBE\nEXPOSURE=2\nEXPOSURE=4\nCOLORCORR=1 2 1\n".to_vec();
    exposed.extend(&good["#?RADIANCE\n".len()..]);
    std::fs::write(&path, &exposed)?;
    let divided = Environment::read(&path)?;
    for (got, want) in divided.radiance.iter().zip(&read.radiance) {
        assert_eq!(*got, [want[0] / 8.0, want[1] / 16.0, want[2] / 8.0]);
    }
    for (line, parts) in [
        ("EXPOSURE=0\n", &["e.hdr", "positive EXPOSURE"][..]),
        ("EXPOSURE=nan\n", &["e.hdr", "positive EXPOSURE"]),
        ("COLORCORR=1 -1 1\n", &["e.hdr", "positive EXPOSURE and COLORCORR", "1 -1 1"]),
        ("FORMAT=32-bit_rle_xyze\n", &["e.hdr", "malformed Radiance file", "xyze"]),
    ] {
        let mut bytes = format!("#?RADIANCE\n{line}").into_bytes();
        bytes.extend(&good["#?RADIANCE\n".len()..]);
        std::fs::write(&path, bytes)?;
        assert_refused(Environment::read(&path), parts);
    }
    std::fs::write(&path, &good[..good.len() / 2])?;
    assert_refused(Environment::read(&path), &["e.hdr", "malformed Radiance file"]);
    std::fs::write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 40000\n")?;
    assert_refused(Environment::read(&path), &["e.hdr", "9600000000 bytes", "1073741824"]);
    // Run lengths that add up to more than an integer holds.
    let mut runs = b"#?RADIANCE\n\n-Y 4 +X 8\n\x09\x09\x09\x80".to_vec();
    runs.extend([1, 1, 1, 0].repeat(7));
    runs.extend([1, 1, 1, 255].repeat(40));
    std::fs::write(&path, runs)?;
    assert_refused(Environment::read(&path), &["e.hdr", "malformed Radiance file"]);
    assert_refused(Environment::read("e.jpg"), &["e.jpg", "unknown format", ".hdr", ".exr"]);
    assert_refused(Environment::read(folder.path().join("f.hdr")), &["f.hdr", "cannot read"]);
    Ok(())
}

#[test]
fn exr_files_return_as_halves() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("e.exr");
    let map = random_map(16)?;
    map.write_exr(&path)?;
    let size = std::fs::metadata(&path)?.len();
    let read = Environment::read(&path)?;
    for (got, want) in read.radiance.iter().flatten().zip(map.radiance.iter().flatten()) {
        assert!((got / want - 1.0).abs() <= 1.0 / 2048.0, "{got}, {want}");
    }
    read.write_exr(&path)?;
    assert_eq!(Environment::read(&path)?.radiance, read.radiance, "halves return exactly");

    // What no half holds is written in full.
    for scale in [1e6, 1e-12] {
        let bright = map.radiance.iter().map(|t| t.map(|v| v * scale)).collect();
        let bright = Environment::new(32, 16, bright, "bright")?;
        bright.write_exr(&path)?;
        assert_eq!(Environment::read(&path)?.radiance, bright.radiance);
        assert!(std::fs::metadata(&path)?.len() > size * 3 / 2);
    }
    Ok(())
}

#[test]
fn exr_files_of_other_content_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("e.exr");
    let refused = |width: usize, height: usize, channels: &[(&str, f32)], parts: &[&str]| {
        let channel = |(name, value): &(&str, f32)| Channel {
            name: (*name).into(),
            values: vec![*value; width * height],
        };
        let channels = channels.iter().map(channel).collect();
        Image { width, height, channels }.write_exr(&path).expect("written");
        assert_refused(Environment::read(&path), parts);
    };
    let rgb = |r, g, b| [("R", r), ("G", g), ("B", b)];
    refused(16, 8, &[("R", 1.0), ("Y", 1.0)], &["e.exr", "no channel G, B", "it has: R, Y"]);
    refused(16, 9, &rgb(1.0, 1.0, 1.0), &["e.exr", "16 × 9 texels", "twice as wide as high"]);
    refused(8, 16, &rgb(1.0, 1.0, 1.0), &["e.exr", "8 × 16 texels", "twice as wide"]);
    refused(6, 3, &rgb(1.0, 1.0, 1.0), &["e.exr", "6 × 3 texels", "at least 8 × 4"]);
    refused(16, 8, &rgb(0.0, 0.0, 0.0), &["e.exr", "all 128 texels are black"]);
    refused(
        16,
        8,
        &rgb(1.0, f32::INFINITY, 1.0),
        &["e.exr", "128 of 128 texels are not finite", "column 0, row 0", "inf"],
    );
    refused(16, 8, &rgb(1.0, 1.0, -2.0), &["e.exr", "128 of 128", "negative", "is -2"]);
    std::fs::write(&path, "no EXR")?;
    assert_refused(Environment::read(&path), &["e.exr", "malformed"]);

    let mut radiance = vec![[1.0; 3]; 128];
    radiance[37][2] = f32::NAN;
    radiance[99][0] = f32::INFINITY;
    assert_refused(
        Environment::new(16, 8, radiance, "memory"),
        &["memory", "2 of 128 texels are not finite", "column 5, row 2", "NaN"],
    );
    assert_refused(
        Environment::new(16, 8, vec![[1.0; 3]; 100], "memory"),
        &["memory", "100 values", "expected 128", "16 × 8"],
    );
    assert_refused(Environment::new(1 << 20, 1 << 19, vec![], "memory"), &["memory", "declares"]);
    Ok(())
}

#[test]
fn negative_values_become_black_only_where_asked() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("e.exr");
    let write = |r: Vec<f32>| {
        let channel = |name: &str, values: Vec<f32>| Channel { name: name.into(), values };
        let channels =
            vec![channel("R", r), channel("G", vec![2.0; 128]), channel("B", vec![3.0; 128])];
        Image { width: 16, height: 8, channels }.write_exr(&path)
    };
    let mut red = vec![1.0; 128];
    (red[3], red[20]) = (-0.25, -0.5);
    write(red.clone())?;
    let says = ["2 of 128 texels are negative", "column 3, row 0", "is -0.25"];
    assert_refused(Environment::read(&path), &says);
    let map = Environment::read_with(&path, Negative::Black)?;
    assert_eq!((map.radiance[3], map.radiance[4]), ([0.0, 2.0, 3.0], [1.0, 2.0, 3.0]));
    assert!(map.origin.ends_with("), 2 negative values, down to -0.5, taken as 0"));
    red[5] = f32::NEG_INFINITY;
    write(red)?;
    assert_refused(Environment::read_with(&path, Negative::Black), &["1 of 128", "not finite"]);
    Ok(())
}

#[test]
fn maps_of_the_repository_are_soft_and_hard() -> Outcome {
    let folder = repository("data/measured/environments");
    let mut contrasts = Vec::new();
    for file in Provenance::read(&folder)?.files {
        let map = Environment::read(folder.join(&file.name))?;
        let size = std::fs::metadata(folder.join(&file.name))?.len();
        assert!(size < 150_000, "{}: {size} bytes", file.name);
        // Size and contrast stand in SOURCE.toml.
        let stated =
            [format!("{} × {}", map.width, map.height), format!("contrast {:.1}", map.contrast())];
        for text in stated {
            assert!(file.record.contains(&text), "{}: {text} is not in {}", file.name, file.record);
        }
        contrasts.push(map.contrast());
    }
    contrasts.sort_by(f64::total_cmp);
    assert_eq!(contrasts.len(), 4);
    assert!(contrasts[1] * 5.0 < contrasts[2], "two soft and two hard ones: {contrasts:?}");
    Ok(())
}

#[test]
fn maps_outside_the_repository_are_read() -> Outcome {
    for (name, brightest) in [("hall", 610.0), ("studio", 3360.0), ("park", 65146.0)] {
        let Some(path) = outside(&format!("hdri_polyhaven_cc0/{name}.hdr")) else { continue };
        let map = Environment::read(path)?;
        assert_eq!((map.width, map.height), (1024, 512));
        let luminance = |t: &[f32; 3]| 0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2];
        let largest = map.radiance.iter().map(luminance).fold(0.0, f32::max);
        assert!((largest / brightest - 1.0).abs() < 0.01, "{name}: {largest}");
        let small = map.resized(100)?;
        assert!(relative(small.mean(), map.mean()) < 1e-6, "{name}");
    }
    Ok(())
}
