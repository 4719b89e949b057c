//! Image files: what is written reads back, and what is broken is named.

use std::fs;

use striae::render::image::{Channel, Clipped, Image, ImageError};

fn sample() -> Image {
    let mut image = Image::rgb(
        3,
        2,
        &[
            [0.0, 0.5, 1.0],
            [2.0, -0.25, 1e-9],
            [1e9, 0.1, 0.2],
            [0.3, 0.4, 0.5],
            [0.6, 0.7, 0.8],
            [0.9, 1.0, 1.1],
        ],
    );
    let values = vec![f32::NAN, f32::INFINITY, 0.0, -0.0, 1.5, 3.0];
    image.channels.push(Channel { name: "stderr.R".into(), values });
    image
}

#[test]
fn exr_returns_every_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    sample().write_exr(&path).expect("written");
    let image = Image::read(&path).expect("read");
    assert_eq!(image.names(), ["R", "G", "B", "stderr.R"]);
    let bits = |image: &Image| -> Vec<Vec<u32>> {
        image.channels.iter().map(|c| c.values.iter().map(|v| v.to_bits()).collect()).collect()
    };
    assert_eq!(bits(&image), bits(&sample()));
    assert_eq!(image.non_finite(), 2);
    assert_eq!(image.standard_error("R").expect("it has them").name, "stderr.R");
    assert_eq!(image.quantities().count(), 3);
    let first = fs::read(&path).expect("bytes");
    sample().write_exr(&path).expect("written again");
    assert_eq!(first, fs::read(&path).expect("bytes"));
}

#[test]
fn png_clips_openly() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.png");
    let mut image = sample();
    image.channels[1].values[5] = f32::NAN;
    let clipped = image.write_png(&path, 0.0).expect("written");
    assert_eq!(clipped, Clipped { below: 1, above: 2, non_finite: 1 });
    let read = Image::read(&path).expect("read");
    assert_eq!(read.names(), ["R", "G", "B"]);
    let colours = read.colours().expect("colours");
    assert_eq!(colours[5], [1.0, 0.0, 1.0]);
    assert_eq!(colours[1], [1.0, 0.0, 0.0]);
    // Half a code of 8 bits near 0.5 is 0.0036 in linear light.
    assert!((colours[0][1] - 0.5).abs() < 0.004);
    let darker = image.write_png(&path, -30.0).expect("written");
    assert_eq!(darker, Clipped { below: 1, above: 0, non_finite: 1 });
}

#[test]
fn a_picture_needs_colours() {
    let mut image = sample();
    image.channels.remove(2);
    let refused = image.colours();
    assert!(matches!(refused, Err(ImageError::MissingChannel { ref name, .. }) if name == "B"));
    image.channels.truncate(1);
    assert_eq!(image.colours().expect("grey")[1], [2.0; 3]);
    image.channels[0].values.pop();
    let refused = image.check();
    assert!(matches!(refused, Err(ImageError::Length { expected: 6, got: 5, .. })));
}

#[test]
fn broken_files_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    sample().write_exr(path("whole.exr")).expect("written");
    sample().write_png(path("whole.png"), 0.0).expect("written");
    for (from, to) in [("whole.exr", "cut.exr"), ("whole.png", "cut.png")] {
        let bytes = fs::read(path(from)).expect("bytes");
        fs::write(path(to), &bytes[..bytes.len() / 2]).expect("written");
    }
    fs::write(path("text.exr"), "not an image").expect("written");
    fs::write(path("empty.png"), "").expect("written");
    fs::write(path("image.tiff"), "II*").expect("written");
    for name in ["cut.exr", "cut.png", "text.exr", "empty.png", "image.tiff", "missing.exr"] {
        let message = Image::read(path(name)).expect_err(name).to_string();
        assert!(message.contains(name), "{name}: {message}");
        assert!(!message.contains("panicked"), "{name}: {message}");
    }
    let unwritable = sample().write_exr(path("no/such/folder.exr"));
    assert!(unwritable.expect_err("no folder").to_string().contains("folder.exr"));
}
