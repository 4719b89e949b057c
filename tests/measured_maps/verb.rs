//! `striae import` of maps, from outside.

use std::path::Path;

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use predicates::str::contains;
use striae::measured::{Environment, HeightMap};

use crate::height_maps::{HEIGHTS, SIDECAR, raw};
use crate::{Outcome, repository};

fn import(folder: &Path, arguments: &[&str]) -> Assert {
    let mut command = Command::cargo_bin("striae").expect("the binary is built");
    command.current_dir(folder).arg("import").args(arguments).assert()
}

/// Exit code 2, every part in the message, no panic, and nothing written.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str], parts: &[&str]) {
    let assert = import(folder, arguments).code(2);
    let message = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(message.starts_with("error: ") && !message.contains("panicked"), "{message}");
    for part in parts {
        assert!(message.contains(part), "{arguments:?}: `{part}` is not in: {message}");
    }
    assert!(!folder.join("out.exr").exists() && !folder.join("out.csv").exists());
}

#[test]
fn environment_maps_are_imported_and_resized() -> Outcome {
    let folder = tempfile::tempdir()?;
    let source = repository("data/measured/environments/hall.exr");
    std::fs::copy(&source, folder.path().join("hall.exr"))?;
    let run = |arguments: &[&str]| import(folder.path(), arguments).code(0);
    run(&["hall.exr", "-o", "same.exr"]).stdout(contains("EXR environment map"));
    assert_eq!(std::fs::read(&source)?, std::fs::read(folder.path().join("same.exr"))?);
    run(&["hall.exr", "--width", "20", "-o", "small.exr", "--json"])
        .stdout(contains("\"width\": 20"))
        .stdout(contains("\"contrast\""))
        .stdout(contains("\"output\": \"small.exr\""));
    let (small, whole) =
        (Environment::read(folder.path().join("small.exr"))?, Environment::read(&source)?);
    assert_eq!((small.width, small.height), (20, 10));
    // Halves: 2⁻¹¹ each.
    for (got, want) in small.mean().into_iter().zip(whole.mean()) {
        assert!((got / want - 1.0).abs() < 5e-4, "{got}, expected {want}");
    }
    Ok(())
}

#[test]
fn height_maps_are_imported() -> Outcome {
    let folder = tempfile::tempdir()?;
    raw(folder.path(), &HEIGHTS, SIDECAR)?;
    import(folder.path(), &["m.f32", "-o", "m.exr", "--json"])
        .code(0)
        .stdout(contains("\"nx\": 3"))
        .stdout(contains("\"valid_fraction\": 0.83"));
    assert_eq!(HeightMap::read(folder.path().join("m.exr"))?.at(1, 1), Some(4.0));
    import(folder.path(), &["m.exr", "-o", "again.exr"]).code(0).stdout(contains("83.33 % valid"));
    let read = |name: &str| std::fs::read(folder.path().join(name));
    assert_eq!(read("m.exr")?, read("again.exr")?);
    assert_eq!(read("m.exr.axes.toml")?, read("again.exr.axes.toml")?);
    Ok(())
}

#[test]
fn bad_maps_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    raw(folder, &HEIGHTS, SIDECAR)?;
    std::fs::write(folder.join("t.csv"), "x [1]\n1\n")?;
    std::fs::write(folder.join("e.hdr"), "#?RADIANCE\n\n-Y 8 +X 8\n")?;
    std::fs::write(folder.join("e.exr"), "no EXR")?;
    std::fs::write(folder.join("g.exr"), "no EXR")?;
    std::fs::write(folder.join("g.exr.axes.toml"), "no axes")?;
    let out = ["-o", "out.exr"];
    refused(folder, &["e.hdr", out[0], out[1]], &["e.hdr", "8 × 8", "twice as wide"]);
    refused(folder, &["e.exr", out[0], out[1]], &["e.exr", "malformed"]);
    refused(folder, &["g.exr", out[0], out[1]], &["g.exr.axes.toml", "malformed"]);
    refused(folder, &["absent.hdr", out[0], out[1]], &["absent.hdr", "cannot read"]);
    refused(folder, &["m.sur", out[0], out[1]], &["m.sur", "unknown format", ".f32", ".hdr"]);
    refused(folder, &["m.f32", "-o", "out.csv"], &["out.csv", "a height map", ".exr"]);
    refused(folder, &["t.csv", out[0], out[1]], &["out.exr", "a table", ".csv"]);
    refused(folder, &["m.f32", "--width", "8", out[0], out[1]], &["--width", "a height map"]);
    let flag = "--negative-as-black";
    refused(folder, &["t.csv", flag, "-o", "out.csv"], &[flag, "t.csv is a table"]);
    let hall = repository("data/measured/environments/hall.exr");
    let hall = hall.to_str().ok_or("a name")?;
    refused(folder, &[hall, "--width", "9", out[0], out[1]], &["9 × 4", "twice as wide"]);
    std::fs::remove_file(folder.join("m.json"))?;
    refused(folder, &["m.f32", out[0], out[1]], &["m.json", "cannot read"]);
    std::fs::write(folder.join("m.json"), SIDECAR.replace("\"nx\": 3", "\"nx\": 5"))?;
    refused(folder, &["m.f32", out[0], out[1]], &["m.f32", "24 bytes", "expected 40"]);
    Ok(())
}
