//! Seeded mutations of a good file of each format: read or refused with a message that names the
//! file, and never a panic.

use std::path::Path;

use image::codecs::hdr::HdrEncoder;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use striae::measured::{Encoding, Environment, HeightMap, Pattern};

use crate::height_maps::{HEIGHTS, SIDECAR, raw};
use crate::patterns::pfm;
use crate::{Outcome, repository};

const MUTATIONS: u64 = 400;

/// Bytes of the header are hit more often than those of the pixels.
fn mutated(good: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = good.to_vec();
    for _ in 0..=random.next_u32() % 3 {
        let head = if random.next_u32().is_multiple_of(2) { 400 } else { bytes.len() };
        let at = random.next_u64() as usize % head.min(bytes.len()).max(1);
        match random.next_u32() % 5 {
            0 => bytes.truncate(at),
            1 if at < bytes.len() => bytes[at] ^= 1 << (random.next_u32() % 8),
            2 if at < bytes.len() => bytes[at] = random.next_u32() as u8,
            3 => bytes.iter_mut().skip(at).for_each(|byte| *byte = random.next_u32() as u8),
            _ => drop(bytes.drain(at..(at + 7).min(bytes.len()))),
        }
    }
    bytes
}

/// Reads each mutation of the file at `path`; `read` returns the error's message. Messages name a
/// file by its stem.
fn survives(
    seed: u64,
    path: &Path,
    read: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), Box<dyn std::error::Error>> {
    let good = std::fs::read(path)?;
    let stem = path.file_stem().and_then(|s| s.to_str()).ok_or("a name")?;
    assert_eq!(read(path), Ok(()), "the good file");
    let mut refused = 0;
    for i in 0..MUTATIONS {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(i);
        std::fs::write(path, mutated(&good, &mut random))?;
        if let Err(message) = read(path) {
            refused += 1;
            assert!(message.contains(stem), "mutation {i}: {message:?}");
        }
    }
    assert!(refused > MUTATIONS / 5, "only {refused} mutations were refused");
    Ok(())
}

fn pattern(path: &Path) -> Result<(), String> {
    Pattern::read(path, None, Encoding::Srgb).map(drop).map_err(|e| e.to_string())
}

fn environment(path: &Path) -> Result<(), String> {
    Environment::read(path).map(drop).map_err(|e| e.to_string())
}

fn heights(path: &Path) -> Result<(), String> {
    HeightMap::read(path.with_extension("f32")).map(drop).map_err(|e| e.to_string())
}

#[test]
fn raw_heights_and_their_sidecar() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = raw(folder.path(), &HEIGHTS, SIDECAR)?;
    survives(51, &path, heights)?;
    raw(folder.path(), &HEIGHTS, SIDECAR)?;
    survives(52, &path.with_extension("json"), heights)
}

#[test]
fn patterns() -> Outcome {
    let folder = tempfile::tempdir()?;
    let codes: Vec<u8> = (0..=255).map(|code| code as u8).collect();
    let path = folder.path().join("p.png");
    image::GrayImage::from_raw(16, 16, codes.clone()).ok_or("size")?.save(&path)?;
    survives(61, &path, pattern)?;
    let path = folder.path().join("p.pfm");
    let values: Vec<f32> = codes.iter().map(|code| f32::from(*code)).collect();
    std::fs::write(&path, pfm(16, &values, 1, true))?;
    survives(62, &path, pattern)
}

#[test]
fn environments() -> Outcome {
    let folder = tempfile::tempdir()?;
    let small =
        Environment::read(repository("data/measured/environments/hall.exr"))?.resized(32)?;
    let path = folder.path().join("e.exr");
    small.write_exr(&path)?;
    survives(71, &path, environment)?;
    let path = folder.path().join("e.hdr");
    let pixels: Vec<image::Rgb<f32>> = small.radiance.iter().map(|t| image::Rgb(*t)).collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, 32, 16)?;
    std::fs::write(&path, bytes)?;
    survives(72, &path, environment)
}
