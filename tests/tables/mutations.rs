//! A thousand seeded mutations of a good file of each format: each is read or refused with a
//! message that names the file, without a panic and in bounded time.

use std::time::{Duration, Instant};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use striae::measured::refractive_index::RefractiveIndex;
use striae::table::provenance::Provenance;
use striae::table::{Grid, Table};

use crate::repository;

const MUTATIONS: u64 = 1000;

/// No single file may take longer. Measured: 700 000 mutations of these files in 48 s.
const LONGEST: Duration = Duration::from_secs(60);

/// Pieces that have broken parsers before.
const NASTY: &[&str] = &[
    "NaN",
    "inf",
    "-1e999",
    "1e-999",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "#",
    ",",
    ":",
    "|",
    "&a",
    "*a",
    "!!",
    "%",
    "\n",
    "\r",
    "\t",
    "\0",
    "\u{feff}",
    "é",
    "- ",
    "---\n",
    "...\n",
    "u(",
    "0x",
    "-0",
    "99999999999999999999",
    "= ",
    "<<: *a\n",
];

fn below(random: &mut ChaCha8Rng, bound: usize) -> usize {
    (random.next_u64() % bound.max(1) as u64) as usize
}

/// `good` with one to four edits.
fn mutated(good: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = good.to_vec();
    for _ in 0..=below(random, 4) {
        let at = below(random, bytes.len());
        let end = (at + 1 + below(random, 40)).min(bytes.len());
        match below(random, 7) {
            0 if at < bytes.len() => bytes[at] ^= 1 << below(random, 8),
            1 if at < bytes.len() => bytes[at] = random.next_u32() as u8,
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let piece = bytes[at..end].to_vec();
                let to = below(random, bytes.len());
                bytes.splice(to..to, piece);
            }
            5 => {
                let piece = NASTY[below(random, NASTY.len())];
                bytes.splice(at..at, piece.bytes());
            }
            _ => {
                let piece = NASTY[below(random, NASTY.len())];
                bytes.splice(at..end, piece.bytes());
            }
        }
    }
    bytes
}

/// Reads every mutation; `read` returns the error's message.
fn survives(seed: u64, good: &[u8], names: &[&str], read: impl Fn(&[u8]) -> Result<(), String>) {
    assert_eq!(read(good), Ok(()), "the good file");
    let mut refused = 0;
    for i in 0..MUTATIONS {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(i);
        let bytes = mutated(good, &mut random);
        let start = Instant::now();
        if let Err(message) = read(&bytes) {
            refused += 1;
            assert!(names.iter().any(|n| message.contains(n)), "mutation {i}: {message:?}");
        }
        assert!(start.elapsed() < LONGEST, "mutation {i} took {:?}", start.elapsed());
    }
    assert!(refused > MUTATIONS / 5, "only {refused} mutations were refused");
}

/// What a reader from a path would see: bytes that are not UTF-8 are refused as such.
fn text(origin: &str, bytes: &[u8]) -> Result<String, String> {
    striae::table::store::text(origin, bytes).map(str::to_owned).map_err(|e| e.to_string())
}

#[test]
fn csv() -> Result<(), Box<dyn std::error::Error>> {
    let good = std::fs::read(repository("data/measured/optical_constants/Au.Johnson.csv"))?;
    survives(11, &good, &["m.csv"], |bytes| {
        let table = Table::read_csv_str("m.csv", &text("m.csv", bytes)?);
        table.and_then(|t| t.check()).map_err(|e| e.to_string())
    });
    Ok(())
}

#[test]
fn record() -> Result<(), Box<dyn std::error::Error>> {
    for (seed, name) in [(21, "Au.Johnson"), (22, "N-BK7.Schott"), (23, "TiO2.Devore-o")] {
        let good = std::fs::read(repository(&format!("tests/tables/records/{name}.yml")))?;
        survives(seed, &good, &["m.yml:", "m.yml: "], |bytes| {
            let record = RefractiveIndex::parse("m.yml", &text("m.yml", bytes)?);
            let table = record.and_then(|r| r.to_table());
            table.map_err(|e| e.to_string()).and_then(|t| t.check().map_err(|e| e.to_string()))
        });
    }
    Ok(())
}

#[test]
fn provenance() -> Result<(), Box<dyn std::error::Error>> {
    let good = std::fs::read(repository("data/measured/spectra/SOURCE.toml"))?;
    survives(31, &good, &["SOURCE.toml"], |bytes| {
        let parsed = Provenance::parse("SOURCE.toml", &text("SOURCE.toml", bytes)?);
        parsed.map(|_| ()).map_err(|e| e.to_string())
    });
    Ok(())
}

#[test]
fn exr_pixels() -> Result<(), Box<dyn std::error::Error>> {
    let (good, sidecar) = crate::exr::grid().to_exr()?;
    survives(41, &good, &["m.exr"], |bytes| {
        let grid = Grid::read_exr_bytes("m.exr", bytes, "m.exr.axes.toml", &sidecar);
        grid.map(|_| ()).map_err(|e| e.to_string())
    });
    Ok(())
}

#[test]
fn exr_sidecar() -> Result<(), Box<dyn std::error::Error>> {
    let (pixels, good) = crate::exr::grid().to_exr()?;
    survives(42, good.as_bytes(), &["m.exr.axes.toml"], |bytes| {
        let sidecar = text("m.exr.axes.toml", bytes)?;
        let grid = Grid::read_exr_bytes("m.exr", &pixels, "m.exr.axes.toml", &sidecar);
        grid.map(|_| ()).map_err(|e| e.to_string())
    });
    Ok(())
}
