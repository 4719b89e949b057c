//! `striae factor`, from outside.

use striae::factor::LowRank;
use striae::table::Grid;

use super::project::{Project, striae};
use super::tables::{cross, windows};

/// A folder with a table of 32 × 32 and an environment.
fn prepared() -> Project {
    let project = Project::new();
    cross(32, [0.2, 1.7]).write_exr(project.path("t.exr")).expect("writable");
    let environment = windows(1);
    let file = std::fs::File::create(project.path("room.hdr")).expect("writable");
    let pixels: Vec<_> = environment.radiance.iter().map(|texel| image::Rgb(*texel)).collect();
    image::codecs::hdr::HdrEncoder::new(file)
        .encode(&pixels, environment.width, environment.height)
        .expect("an HDR file");
    project
}

#[test]
fn all_methods_end_to_end() {
    let project = prepared();
    let output = striae(&project.path(""))
        .args(["factor", "t.exr", "--rank", "1..2", "--method", "all", "--environment", "room.hdr"])
        .args(["--align", "--directional", "2", "--orientations", "4", "-o", "out", "--json"])
        .output()
        .expect("runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 5 * 2 * 3, "five methods, two ranks, three channels");
    let error = |method: &str, what: &str| -> f64 {
        let row =
            rows.iter().find(|r| r["method"] == method && r["rank"] == 1 && r["channel"] == "G");
        row.and_then(|r| r[what].as_f64()).expect("measured")
    };
    assert!(
        error("convolution", "error_after_convolution") <= error("svd", "error_after_convolution")
    );
    assert!(error("svd", "relative_error") <= error("convolution", "relative_error"));
    let angles = json["alignment"]["angles_deg"].as_array().expect("angles");
    let expected = [0.2f64.to_degrees(), 1.7f64.to_degrees()];
    for (got, want) in angles.iter().zip(expected) {
        // Measured 1.4° off: 32 texels to a side hold few orders outside the centre.
        assert!((got.as_f64().expect("a number") - want).abs() < 1.6, "{angles:?}");
    }
    let errors = project.read("out/errors.csv");
    assert!(errors.starts_with("method,rank,channel,relative_error,error_after_convolution,ms\n"));
    assert_eq!(errors.lines().count(), 31);
    for method in ["svd", "joint", "weighted", "convolution", "nonnegative"] {
        let kernel = LowRank::read(&project.path(&format!("out/{method}"))).expect("factors");
        assert_eq!((kernel.rank(), kernel.channels.len()), (2, 3));
        assert!(project.path(&format!("out/{method}_1.png")).is_file());
    }
    for file in ["table.png", "alignment.toml", "line_1.csv", "line_2.csv"] {
        assert!(project.path(&format!("out/{file}")).is_file(), "{file}");
    }
    let again = striae(&project.path(""))
        .args(["factor", "t.exr", "--error", "0.5", "--directional", "1", "-o", "short"])
        .output()
        .expect("runs");
    let text = String::from_utf8_lossy(&again.stdout);
    assert!(again.status.success() && text.contains("svd") && text.contains("error G"), "{text}");
    assert!(text.contains("energy on no line: R 0 %"), "{text}");
}

#[test]
fn bad_input() {
    let project = prepared();
    let mut zero = cross(8, [0.0, 1.5]);
    zero.channels.iter_mut().for_each(|c| c.values.fill(0.0));
    zero.write_exr(project.path("zero.exr")).expect("writable");
    let mut negative = cross(8, [0.0, 1.5]);
    negative.channels[1].values[9] = -1.0;
    negative.write_exr(project.path("negative.exr")).expect("writable");
    std::fs::copy(project.path("t.exr"), project.path("bare.exr")).expect("writable");
    std::fs::copy(project.path("t.exr"), project.path("fewer.exr")).expect("writable");
    let sidecar = project.read("t.exr.axes.toml").replace("name = \"B\"", "name = \"X\"");
    project.write("fewer.exr.axes.toml", sidecar);
    project.write("square.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd");
    project.write("broken.hdr", "no map");
    let refused = |arguments: &[&str], part: &str| {
        let output =
            striae(&project.path("")).arg("factor").args(arguments).output().expect("runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(
            message.contains(part) && !message.contains("panicked"),
            "{arguments:?}: {message}"
        );
        assert!(!project.path("o").exists(), "{arguments:?}: nothing is written");
    };
    let out = ["-o", "o"];
    for (arguments, part) in [
        (vec!["t.exr"], "--output"),
        (vec!["t.exr", "--rank", "33"], "ranks 1 to 32"),
        (vec!["t.exr", "--rank", "0"], "rank from 1"),
        (vec!["t.exr", "--rank", "3..1"], "1..3"),
        (vec!["t.exr", "--rank", "one"], "rank from 1"),
        (vec!["t.exr", "--rank", "1", "--error", "0.1"], "cannot be used"),
        (vec!["t.exr", "--error", "-1"], "from 0 to 1"),
        (vec!["t.exr", "--error", "nan"], "from 0 to 1"),
        (vec!["t.exr", "--align", "--min-angle", "0"], "1° to 90°"),
        (vec!["t.exr", "--method", "best"], "best"),
        (vec!["t.exr", "--method", "convolution"], "--environment"),
        (vec!["t.exr", "--environment", "none.hdr"], "none.hdr"),
        (vec!["t.exr", "--environment", "square.hdr"], "square.hdr"),
        (vec!["t.exr", "--environment", "broken.hdr"], "broken.hdr"),
        (vec!["t.exr", "--environment", "t.exr"], "twice as wide"),
        (vec!["t.exr", "--environment", "t.png"], "unknown format"),
        (vec!["t.exr", "--directional", "3"], "1..=2"),
        (vec!["t.exr", "--directional", "2", "--half-width", "-1"], "above 0"),
        (vec!["bare.exr"], "bare.exr.axes.toml"),
        (vec!["none.exr"], "none.exr"),
        (vec!["fewer.exr"], "\"X\""),
        (vec!["zero.exr"], "every value is 0"),
        (vec!["negative.exr", "--method", "nonnegative"], "texel (1, 1): -1 is negative"),
    ] {
        let tail: &[&str] = if part == "--output" { &[] } else { &out };
        refused(&[&arguments, tail].concat(), part);
    }
    let output = striae(&project.path(""))
        .args(["factor", "negative.exr", "--rank", "1", "--method", "all", "-o", "o"])
        .output()
        .expect("runs");
    let notes = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && notes.contains("nonnegative: not measured"), "{notes}");
    assert!(notes.contains("convolution: not measured"), "{notes}");
    assert!(Grid::read_exr(project.path("t.exr")).is_ok());
}
