//! Height maps, raw and as EXR grids.

use std::path::{Path, PathBuf};

use striae::measured::HeightMap;
use striae::table::{Axis, Grid, GridChannel};

use crate::{Outcome, assert_refused, outside};

/// A sidecar of 3 × 2 samples.
pub(crate) const SIDECAR: &str = r#"{
 "dtype": "little-endian f32, row-major [y][x], height in nm, NaN = no data",
 "nx": 3,
 "ny": 2,
 "dx_um": 0.5,
 "dy_um": 0.25,
 "note": "made by a test"
}"#;

/// Six heights, one of which is missing.
pub(crate) const HEIGHTS: [f32; 6] = [0.0, 1.5, -2.0, f32::NAN, 4.0, 5.0];

/// Writes `m.f32` and `m.json`.
pub(crate) fn raw(folder: &Path, heights: &[f32], sidecar: &str) -> std::io::Result<PathBuf> {
    let path = folder.join("m.f32");
    std::fs::write(&path, heights.iter().flat_map(|h| h.to_le_bytes()).collect::<Vec<u8>>())?;
    std::fs::write(folder.join("m.json"), sidecar)?;
    Ok(path)
}

fn grid() -> Grid {
    let axis = |name: &str, unit: &str, to: f64, count| Axis {
        name: name.into(),
        unit: unit.into(),
        from: 0.0,
        to,
        count,
    };
    let channel = |name: &str, unit: &str, values: &[f32]| GridChannel {
        name: name.into(),
        unit: unit.into(),
        values: values.to_vec(),
    };
    Grid {
        axes: vec![axis("x", "mm", 0.003, 3), axis("y", "um", 5.0, 2)],
        channels: vec![
            channel("height", "um", &[0.0, 0.5, 1.0, 1.5, 2.0, -0.25]),
            channel("valid", "1", &[1.0, 1.0, 0.0, 1.0, 1.0, 1.0]),
        ],
        origin: "g.exr".into(),
    }
}

#[test]
fn a_raw_map_is_read_row_by_row() -> Outcome {
    let folder = tempfile::tempdir()?;
    let map = HeightMap::read(raw(folder.path(), &HEIGHTS, SIDECAR)?)?;
    assert_eq!((map.nx, map.ny, map.dx_um, map.dy_um), (3, 2, 0.5, 0.25));
    assert_eq!((map.at(1, 0), map.at(2, 0), map.at(1, 1)), (Some(1.5), Some(-2.0), Some(4.0)));
    assert_eq!((map.at(0, 1), map.at(3, 0), map.at(0, 2)), (None, None, None));
    assert_eq!(map.at(0, usize::MAX), None);
    assert_eq!(map.valid_fraction(), 5.0 / 6.0);
    assert_eq!((map.size_um(), map.range_nm()), ([1.5, 0.5], Some([-2.0, 5.0])));
    assert!(map.origin.contains("m.f32 (sha256 "), "{}", map.origin);
    Ok(())
}

#[test]
fn wrong_sidecars_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (from, to, parts) in [
        ("\"nx\": 3", "\"nx\": 4", &["m.f32", "24 bytes", "expected 32", "4 × 2", "m.json"][..]),
        (
            "\"nx\": 3",
            "\"nx\": 18446744073709551615",
            &["m.f32", "24 bytes", "expected 18446744073709551615"],
        ),
        ("\"nx\": 3", "\"nx\": -3", &["m.json:3", "-3"]),
        ("\"nx\": 3", "\"nx\": 3.5", &["m.json:3", "3.5"]),
        ("\"nx\": 3,\n", "", &["m.json:", "missing field `nx`"]),
        ("dx_um", "dx_nm", &["m.json:", "missing field `dx_um`"]),
        ("0.5", "0", &["m.f32", "dx_um is 0 µm", "positive"]),
        ("0.25", "-0.25", &["m.f32", "dy_um is -0.25 µm", "positive"]),
        ("0.5", "1e999", &["m.json:5"]),
        ("height in nm", "height in µm", &["m.json", "expected heights in nm", "\"µm\""]),
        ("height in nm", "height in m", &["m.json", "expected heights in nm", "\"m\""]),
        ("\"note\"", "\"height_unit\": \"um\", \"note\"", &["m.json", "height_unit", "\"um\""]),
        ("\"note\"", "\"z_unit\": \"m\", \"note\"", &["m.json", "expected heights in nm"]),
        ("little-endian f32", "big-endian f32", &["m.json", "dtype", "little-endian", "big-"]),
        ("{", "[", &["m.json:"]),
    ] {
        assert!(SIDECAR.contains(from), "{from}");
        let path = raw(folder.path(), &HEIGHTS, &SIDECAR.replacen(from, to, 1))?;
        assert_refused(HeightMap::read(path), parts);
    }
    let path = raw(folder.path(), &HEIGHTS, SIDECAR)?;
    std::fs::remove_file(folder.path().join("m.json"))?;
    assert_refused(HeightMap::read(path), &["m.json", "cannot read"]);
    assert_refused(HeightMap::read(folder.path().join("n.f32")), &["n.f32", "cannot read"]);
    assert_refused(HeightMap::read("m.sur"), &["m.sur", "unknown format", ".f32", ".exr"]);
    Ok(())
}

#[test]
fn wrong_heights_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let nan = f32::NAN;
    for (heights, sidecar, parts) in [
        (
            vec![0.0, 1.0, 2.0, f32::INFINITY, 4.0, f32::NEG_INFINITY],
            SIDECAR.to_owned(),
            &["m.f32", "2 of 6 heights are infinite", "column 0, row 1", "is inf"][..],
        ),
        (vec![nan; 6], SIDECAR.to_owned(), &["m.f32", "none of 6 samples has data"]),
        (
            vec![0.0, 0.0, 0.0, 0.0, 0.0, 1501.0],
            SIDECAR.to_owned(),
            &["m.f32", "1501 nm", "1.5 × 0.5 µm", "expected heights in nm"],
        ),
        (
            vec![0.0, 1e-9, 5e-8, 1e-7, 0.0, 0.0],
            SIDECAR.to_owned(),
            &["m.f32", "nm, less than 0.001 nm", "expected heights in nm, not in m"],
        ),
        (
            vec![0.0; 6],
            SIDECAR.replace("\"nx\": 3", "\"nx\": 6").replace("\"ny\": 2", "\"ny\": 1"),
            &["m.f32", "6 × 1 samples", "at least 2"],
        ),
        (
            vec![0.0; 2],
            SIDECAR.replace("\"nx\": 3", "\"nx\": 1"),
            &["m.f32", "1 × 2 samples", "at least 2"],
        ),
        (
            vec![],
            SIDECAR.replace("\"nx\": 3", "\"nx\": 0"),
            &["m.f32", "0 × 2 samples", "at least 2"],
        ),
    ] {
        assert_refused(HeightMap::read(raw(folder.path(), &heights, &sidecar)?), parts);
    }
    let flat = HeightMap::read(raw(folder.path(), &[7.0; 6], SIDECAR)?)?;
    assert_eq!(flat.range_nm(), Some([7.0, 7.0]));
    let short = HeightMap { height_nm: vec![0.0; 5], ..flat };
    assert_refused(short.check(), &["m.f32", "5 values", "expected 6", "3 × 2"]);
    Ok(())
}

#[test]
fn a_map_returns_from_exr() -> Outcome {
    let folder = tempfile::tempdir()?;
    let map = HeightMap::read(raw(folder.path(), &HEIGHTS, SIDECAR)?)?;
    let path = folder.path().join("m.exr");
    map.to_grid()?.write_exr(&path)?;
    let again = HeightMap::read(&path)?;
    assert_eq!((again.nx, again.ny, again.dx_um, again.dy_um), (3, 2, 0.5, 0.25));
    let bits = |map: &HeightMap| map.height_nm.iter().map(|h| h.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&again), bits(&map));

    let whole = HeightMap { height_nm: vec![1.0; 6], ..map };
    assert_eq!(whole.to_grid()?.channels.len(), 1, "no channel `valid` without need");
    let huge = HeightMap { height_nm: vec![1e300; 6], ..whole };
    assert_refused(huge.to_grid(), &["height", "finite", "inf"]);
    Ok(())
}

#[test]
fn a_grid_is_converted_into_nm_and_um() -> Outcome {
    let map = HeightMap::from_grid(&grid())?;
    assert!((map.dx_um - 1.0).abs() < 1e-15 && map.dy_um == 2.5, "{} {}", map.dx_um, map.dy_um);
    assert_eq!((map.at(1, 0), map.at(2, 0), map.at(2, 1)), (Some(500.0), None, Some(-250.0)));
    Ok(())
}

#[test]
fn wrong_grids_are_refused() {
    let refused = |change: fn(&mut Grid), parts: &[&str]| {
        let mut grid = grid();
        change(&mut grid);
        assert_refused(HeightMap::from_grid(&grid), parts);
    };
    refused(|g| g.channels[0].name = "z".into(), &["g.exr", "\"height\"", "z, valid"]);
    refused(|g| g.channels[0].unit = "rad".into(), &["g.exr", "height", "length", "rad"]);
    refused(|g| g.axes[0].unit = "deg".into(), &["g.exr", "x", "length", "deg"]);
    refused(|g| g.axes[1].to = -5.0, &["g.exr", "dy_um is -2.5", "positive"]);
    refused(|g| g.channels[1].unit = "nm".into(), &["g.exr", "valid", "pure number"]);
    refused(|g| g.channels[1].values[4] = 0.5, &["1 of 6", "`valid`", "column 1, row 1", "0.5"]);
    refused(|g| g.channels[0].unit = "mm".into(), &["g.exr", "nm", "lateral size"]);
}

#[test]
fn maps_outside_the_repository_are_read() -> Outcome {
    // Lowest and highest height by NumPy.
    for (name, size, valid, range) in [
        (
            "cd_stamper_afm_gpl3/cd_stamper_afm",
            [512, 512],
            1.0,
            [-297.278_198_242_187_5, 329.217_010_498_046_9],
        ),
        (
            "surface_topography_mit/sinusoidal_grooves_9um",
            [650, 650],
            1.0,
            [-314.420_684_814_453_1, 239.915_512_084_960_94],
        ),
        (
            "surface_topography_mit/unidirectional_ground_metal",
            [768, 576],
            1.0,
            [-111_230.468_75, -101_214.843_75],
        ),
        (
            "striated_metal_x3p/aluminium_wire_cut",
            [231, 172],
            0.705_778_717_406_624_3,
            [-29_960.613_281_25, 24_387.736_328_125],
        ),
    ] {
        let Some(path) = outside(&format!("{name}.f32")) else { continue };
        let map = HeightMap::read(&path)?;
        assert_eq!([map.nx, map.ny], size, "{name}");
        assert!((map.valid_fraction() - valid).abs() < 1e-15, "{name}: {}", map.valid_fraction());
        assert_eq!(map.range_nm(), Some(range), "{name}");
        let again = HeightMap::from_grid(&map.to_grid()?)?;
        assert!((again.dy_um / map.dy_um - 1.0).abs() < 1e-15, "{name}: {}", again.dy_um);
        assert!(again.height_nm.iter().zip(&map.height_nm).all(|(a, b)| a == b || b.is_nan()));
    }
    Ok(())
}
