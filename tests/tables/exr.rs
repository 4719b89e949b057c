//! Grids as EXR with their sidecar.

use std::path::Path;

use striae::table::{Axis, Grid, GridChannel, TableError, sidecar_path};

use crate::assert_says;

/// Three channels over 7 × 5 texels, named out of EXR's alphabetical order.
pub(crate) fn grid() -> Grid {
    let axis = |name: &str, unit: &str, from, to, count| Axis {
        name: name.into(),
        unit: unit.into(),
        from,
        to,
        count,
    };
    let (x, y) = (axis("mu", "1", 0.0, 1.0, 7), axis("wavelength", "nm", 700.0, 400.0, 5));
    let channel = |name: &str, unit: &str, scale: f32| GridChannel {
        name: name.into(),
        unit: unit.into(),
        values: (0..35).map(|i| (i as f32 * scale).sin() * 1e-3).collect(),
    };
    let channels =
        vec![channel("s", "1", 0.3), channel("p", "1", 0.7), channel("intensity", "sr^-1", 1.1)];
    Grid { axes: vec![x, y], channels, origin: "made".into() }
}

fn refusal(pixels: &[u8], sidecar: &str) -> String {
    match Grid::read_exr_bytes("g.exr", pixels, "g.exr.axes.toml", sidecar) {
        Ok(_) => panic!("was read"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_grid_reads_back_as_it_was_written() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("g.exr");
    let written = grid();
    written.write_exr(&path)?;
    assert!(folder.path().join("g.exr.axes.toml").is_file());
    let read = Grid::read_exr(&path)?;
    assert_says(&read.origin, &["g.exr (sha256 "]);
    assert_eq!(Grid { origin: written.origin.clone(), ..read }, written);
    assert_eq!(written.to_exr()?, written.to_exr()?, "the same grid gave other bytes");
    Ok(())
}

#[test]
fn texels_stand_for_their_centres() {
    let grid = grid();
    assert_eq!(grid.y().centres(), [670.0, 610.0, 550.0, 490.0, 430.0]);
    assert_eq!(grid.x().centre(3), 0.5);
    for i in 0..grid.x().count {
        assert!((grid.x().texel(grid.x().centre(i)) - i as f64).abs() < 1e-14);
    }
    assert_eq!(grid.x().texel(0.0), -0.5);
    let p = &grid.channels[1].values;
    assert_eq!(grid.at("p", &[2, 3]), Some(p[3 * 7 + 2]));
    assert_eq!([grid.at("p", &[7, 0]), grid.at("p", &[0, 5]), grid.at("q", &[0, 0])], [None; 3]);
}

#[test]
fn faults_of_the_sidecar_are_named() -> Result<(), TableError> {
    let (pixels, sidecar) = grid().to_exr()?;
    let with = |from: &str, to: &str| {
        assert!(sidecar.contains(from), "{sidecar}");
        refusal(&pixels, &sidecar.replacen(from, to, 1))
    };
    assert_says(&with("count = 7", "count = 8"), &["axes.toml", "8 × 5", "g.exr", "7 × 5"]);
    assert_says(&with("count = 7", "count = -7"), &["axes.toml", "line"]);
    assert_says(&with("unit = \"nm\"", "unit = \"mile\""), &["axes.toml", "\"mile\"", "nm"]);
    assert_says(&with("to = 1.0", "to = 0.0"), &["axes.toml", "\"mu\"", "no range"]);
    assert_says(&with("to = 1.0", "to = nan"), &["axes.toml", "\"mu\""]);
    assert_says(&with("name = \"p\"", "name = \"q\""), &["\"q\"", "g.exr", "p"]);
    assert_says(&with("name = \"p\"", "name = \"s\""), &["\"s\""]);
    assert_says(&with("from", "form"), &["axes.toml", "form"]);
    let last = sidecar.rfind("[[channel]]").unwrap_or(0);
    assert_says(&refusal(&pixels, &sidecar[..last]), &["axes.toml", "\"intensity\""]);
    Ok(())
}

#[test]
fn faults_of_the_pixels_are_named() -> Result<(), Box<dyn std::error::Error>> {
    let (pixels, sidecar) = grid().to_exr()?;
    assert_says(&refusal(b"", &sidecar), &["g.exr"]);
    assert_says(&refusal(b"not an image at all", &sidecar), &["g.exr"]);
    for length in 0..pixels.len() {
        assert_says(&refusal(&pixels[..length], &sidecar), &["g.exr"]);
    }
    let mut not_finite = grid();
    not_finite.channels[2].values[9] = f32::NAN;
    let message = not_finite.to_exr().err().ok_or("written")?.to_string();
    assert_says(&message, &["intensity", "texel (2, 1)", "NaN"]);
    let mut short = grid();
    short.channels[0].values.pop();
    let message = short.to_exr().err().ok_or("written")?.to_string();
    assert_says(&message, &["\"s\"", "34", "35"]);
    Ok(())
}

#[test]
fn a_header_that_asks_for_too_much_is_refused_before_memory_is() -> Result<(), TableError> {
    let (pixels, sidecar) = grid().to_exr()?;
    // The windows and the number of blocks of 16 lines, as they stand in the header.
    let int = |v: &i32| v.to_le_bytes();
    let window = |x: i32, y: i32| [0, 0, x - 1, y - 1].iter().flat_map(int).collect::<Vec<u8>>();
    let blocks = |y: i32| [&b"chunkCount\0int\0\x04\0\0\0"[..], &int(&((y + 15) / 16))].concat();
    let enlarged = |x: i32, y: i32| {
        let mut bytes = pixels.clone();
        for (old, new) in [(window(7, 5), window(x, y)), (blocks(5), blocks(y))] {
            for at in 0..=bytes.len() - old.len() {
                if bytes[at..at + old.len()] == old[..] {
                    bytes[at..at + old.len()].copy_from_slice(&new);
                }
            }
        }
        bytes
    };
    assert_eq!(enlarged(7, 5), pixels);
    assert_says(&refusal(&enlarged(20_000, 20_000), &sidecar), &["g.exr", "largest grid"]);
    assert_says(
        &refusal(&enlarged(3_000, 3_000), &sidecar),
        &["g.exr", "as much as a file of this size can hold"],
    );
    assert_says(&refusal(&enlarged(i32::MAX / 4, i32::MAX / 4), &sidecar), &["g.exr"]);
    Ok(())
}

#[test]
fn the_sidecar_stands_beside_the_file() {
    assert_eq!(sidecar_path(Path::new("a/b.exr")), Path::new("a/b.exr.axes.toml"));
}

#[test]
fn grids_of_any_dimension_read_back() -> Result<(), Box<dyn std::error::Error>> {
    let axes = [
        Axis::new("mu", "1", [0.0, 1.0], 3),
        Axis::new("roughness", "1", [1.0, 0.0], 2),
        Axis::new("wavelength", "nm", [400.0, 700.0], 4),
        Axis::new("angle", "rad", [-1.0, 1.0], 5),
    ];
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("g.exr");
    for dimension in 1..=axes.len() {
        let axes = axes[..dimension].to_vec();
        let texels: usize = axes.iter().map(|axis| axis.count).product();
        let values: Vec<f32> = (0..texels).map(|i| (i as f32).sqrt()).collect();
        let written = Grid::new(axes, vec![GridChannel::new("f", "sr^-1", values)], "made")?;
        written.write_exr(&path)?;
        let read = Grid::read_exr(&path)?;
        assert_eq!(Grid { origin: written.origin.clone(), ..read }, written);
        let (_, sidecar) = written.to_exr()?;
        assert_eq!(sidecar.matches("[[axis]]").count(), dimension.saturating_sub(2), "{sidecar}");
    }
    // Planes of 3 × 2 texels below each other, the last axis slowest.
    let read = Grid::read_exr(&path)?;
    assert_eq!(read.at("f", &[2, 1, 3, 4]), read.channels[0].values.last().copied());
    assert_eq!(read.at("f", &[0, 0, 1, 0]), Some(6f32.sqrt()));

    let (pixels, sidecar) = read.to_exr()?;
    assert_says(&refusal(&pixels, &sidecar.replace("[y]", "[[axis]]")), &["axes.toml", "[y]"]);
    let longer = sidecar.replace("count = 5", "count = 6");
    assert_says(&refusal(&pixels, &longer), &["axes.toml", "3 × 48", "3 × 40"]);
    let mile = sidecar.replace("unit = \"rad\"", "unit = \"mile\"");
    assert_says(&refusal(&pixels, &mile), &["axes.toml", "angle", "mile"]);
    Ok(())
}
