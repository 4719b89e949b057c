//! `striae compare` from outside.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use predicates::str::contains;
use striae::render::image::{Channel, Image};

fn striae(folder: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("striae").expect("the binary is built");
    command.current_dir(folder).arg("compare").args(arguments).assert()
}

fn picture(gain: f32) -> Image {
    let colour = |at: usize| {
        let (x, y) = ((at % 64) as f32 / 64.0, (at / 64) as f32 / 48.0);
        [gain * (0.2 + x), gain * (0.1 + y), gain * 0.5]
    };
    Image::rgb(64, 48, &(0..64 * 48).map(colour).collect::<Vec<_>>())
}

/// A folder with `a.exr`, which is 1 % brighter than `b.exr`, both also as PNG.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, gain) in [("a", 1.01), ("b", 1.0)] {
        let path =
            |extension: &str| -> PathBuf { folder.path().join(format!("{name}.{extension}")) };
        picture(gain).write_exr(path("exr")).expect("written");
        picture(gain).write_png(path("png"), 0.0).expect("written");
    }
    folder
}

#[test]
fn images_are_compared_and_held_to_limits() {
    let folder = folder();
    let run = |arguments: &[&str]| striae(folder.path(), arguments);
    run(&["a.exr", "b.exr"]).code(0).stdout(contains("relative rms")).stdout(contains("HDR"));
    run(&["a.png", "b.png"]).code(0).stdout(contains("(LDR, 67.02 pixels per degree)"));
    run(&["a.exr", "b.exr", "--exposure", "-1"]).code(0).stdout(contains("LDR at -1 stops"));
    let held = ["a.exr", "b.exr", "--fail-above", "relative_rms=0.0101", "--fail-above"];
    run(&[&held[..], &["flip=0.5"]].concat()).code(0).stdout(contains("PASS flip"));
    run(&[&held[..], &["mean=0.005"]].concat()).code(1).stdout(contains("FAIL mean 0.01"));
}

#[test]
fn json_has_the_numbers() {
    let folder = folder();
    let output = striae(folder.path(), &["a.exr", "b.exr", "--json", "--fail-above", "max=1"]);
    let output = output.code(0).get_output().stdout.clone();
    let json: serde_json::Value = serde_json::from_slice(&output).expect("JSON");
    let number = |pointer: &str| json.pointer(pointer).and_then(serde_json::Value::as_f64);
    assert!((number("/all/relative_rms").expect("a number") - 0.01).abs() < 1e-6);
    assert_eq!(number("/all/max_at/x"), Some(63.0));
    assert!(number("/flip/mean").expect("a number") > 0.0);
    assert_eq!(json["limits"][0]["passed"], serde_json::json!(true));
}

#[test]
fn maps_are_written() {
    let folder = folder();
    striae(folder.path(), &["a.exr", "b.exr", "-o", "e.png", "--flip-map", "f.png"])
        .code(0)
        .stdout(contains("error map from 0 to 0.02 of the reference's RMS"));
    let map = Image::read(folder.path().join("e.png")).expect("a PNG");
    assert_eq!(map.width, 64);
    assert!(map.height > 48, "no legend");
    let map = Image::read(folder.path().join("f.png")).expect("a PNG");
    assert_eq!((map.width, map.height), (64, 48));
}

#[test]
fn noise_is_judged() {
    let folder = folder();
    let mut noisy = picture(1.01);
    for channel in picture(1.0).channels {
        let values = channel.values.iter().map(|value| 0.05 * value).collect();
        noisy.channels.push(Channel { name: format!("stderr.{}", channel.name), values });
    }
    noisy.write_exr(folder.path().join("noisy.exr")).expect("written");
    let arguments = ["noisy.exr", "b.exr", "--fail-above", "significance=0.99"];
    // 1 % everywhere with 5 % noise in each of 3072 pixels: z = 0.2 √3072 = 11 in a channel.
    striae(folder.path(), &arguments).code(1).stdout(contains("noise does not explain it"));
    let arguments = ["a.exr", "b.exr", "--fail-above", "z=3"];
    striae(folder.path(), &arguments).code(2).stderr(contains("stderr"));
}

#[test]
fn what_is_not_finite_fails() {
    let folder = folder();
    let mut broken = picture(1.0);
    broken.channels[0].values[70] = f32::NAN;
    broken.write_exr(folder.path().join("nan.exr")).expect("written");
    for metric in ["mean=9", "rms=9", "relative_rms=9", "max=9", "flip=9"] {
        striae(folder.path(), &["nan.exr", "b.exr", "--fail-above", metric])
            .code(1)
            .stdout(contains("x 6, y 1"))
            .stderr(contains("1 in A, 0 in B"));
    }
}

#[test]
fn tables_are_compared_by_column() {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write("a.csv", "x [um],y\n1,2\n2,4.5\n");
    write("b.csv", "x [um],y\n1,2\n2,4\n");
    write("c.csv", "x [um],z\n1,2\n2,4\n");
    write("d.csv", "x [um],y\n1,2\n");
    write("n.csv", "x [um],y\n1,NaN\n2,4\n");
    let run = |arguments: &[&str]| striae(folder.path(), arguments);
    run(&["a.csv", "b.csv"]).code(0).stdout(contains("x [um]")).stdout(contains("row 2"));
    run(&["a.csv", "b.csv", "--fail-above", "max=0.4"]).code(1);
    run(&["a.csv", "b.csv", "--fail-above", "max=0.6"]).code(0);
    run(&["n.csv", "b.csv", "--fail-above", "max=0.6"]).code(1);
    run(&["a.csv", "c.csv"]).code(2).stderr(contains("in the reference: y"));
    run(&["a.csv", "d.csv"]).code(2).stderr(contains("2 rows"));
    run(&["a.csv", "b.csv", "--fail-above", "flip=1"]).code(2).stderr(contains("flip"));
    run(&["a.csv", "b.csv", "-o", "e.png"]).code(2).stderr(contains("--output"));
    run(&["a.csv", "b.exr"]).code(2).stderr(contains("the other an image"));
}

#[test]
fn bad_input_is_named() {
    let folder = folder();
    Image::rgb(2, 2, &[[0.5; 3]; 4]).write_exr(folder.path().join("small.exr")).expect("written");
    let mut other = picture(1.0);
    other.channels[2].name = "depth".into();
    other.write_exr(folder.path().join("depth.exr")).expect("written");
    let run = |arguments: &[&str]| striae(folder.path(), arguments);
    run(&["a.exr", "small.exr"]).code(2).stderr(contains("64 × 48")).stderr(contains("2 × 2"));
    run(&["a.exr", "depth.exr"]).code(2).stderr(contains("depth"));
    run(&["a.exr", "none.exr"]).code(2).stderr(contains("none.exr"));
    run(&["a.exr", "b.bmp"]).code(2).stderr(contains("b.bmp"));
    run(&["a.exr", "b.exr", "--fail-above", "ssim=1"])
        .code(2)
        .stderr(contains("unknown metric \"ssim\"; known metrics: mean, rms"));
    run(&["a.exr", "b.exr", "--fail-above", "flip"]).code(2);
    for ppd in ["0", "0.1", "-1", "1e12", "1e300", "nan", "inf"] {
        let ppd = format!("--ppd={ppd}");
        run(&["a.exr", "b.exr", &ppd]).code(2).stderr(contains("pixels per degree"));
    }
    for stops in ["101", "-1e300", "nan", "inf"] {
        let stops = format!("--exposure={stops}");
        run(&["a.exr", "b.exr", &stops]).code(2).stderr(contains("exposure in stops"));
    }
    run(&["a.exr", "b.exr", "-o", "no/folder.png"]).code(2).stderr(contains("folder.png"));
    run(&["a.exr", "b.exr", "-o", "e.png", "--scale", "-1"]).code(2).stderr(contains("scale"));
}
