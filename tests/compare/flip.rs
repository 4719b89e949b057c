//! FLIP against NVIDIA's evaluator: `tests/oracles/flip.py` makes the same images.

use std::path::Path;

use striae::render::compare::flip::{FlipMap, hdr_flip, ldr_flip};
use striae::render::compare::{ExposureRule, Exposures};
use striae::render::image::Image;

/// Largest difference per pixel: measured 2.7e-6; the evaluator computes in f32.
const PER_PIXEL: f64 = 4e-6;
/// Largest difference of a mean: measured 8.1e-8.
const MEAN: f64 = 2e-7;

struct Case {
    name: String,
    width: usize,
    height: usize,
    pixels_per_degree: f64,
    hdr: bool,
    kind: String,
    mean: f64,
    exposures: Option<(f64, f64, usize)>,
}

fn rows(name: &str) -> Vec<csv::StringRecord> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles").join(name);
    let mut reader = csv::Reader::from_path(path).expect("the oracle is committed");
    reader.records().map(|row| row.expect("an oracle is well-formed")).collect()
}

fn cases() -> Vec<Case> {
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let size = |text: &str| text.parse::<usize>().expect("a size");
    let case = |row: csv::StringRecord| Case {
        name: row[0].to_owned(),
        width: size(&row[1]),
        height: size(&row[2]),
        pixels_per_degree: number(&row[3]),
        hdr: &row[4] == "HDR",
        kind: row[5].to_owned(),
        mean: number(&row[6]),
        exposures: (!row[7].is_empty()).then(|| (number(&row[7]), number(&row[8]), size(&row[9]))),
    };
    rows("flip.csv").into_iter().map(case).collect()
}

fn hashed(x: u32, y: u32, channel: u32) -> u32 {
    let mut h = x
        .wrapping_mul(0x9E37_79B1)
        .wrapping_add(y.wrapping_mul(0x85EB_CA77))
        .wrapping_add(channel.wrapping_mul(0xC2B2_AE3D));
    h ^= h >> 15;
    h = h.wrapping_mul(0x2C1B_3C6D);
    h ^= h >> 12;
    h >> 22
}

impl Case {
    fn reference(&self, x: u32, y: u32, channel: u32) -> f64 {
        let width = self.width as u32;
        let value = match channel {
            0 => x * 1023 / (width - 1),
            1 if ((x + y) / 9).is_multiple_of(2) => 700,
            1 => 180,
            _ if (x / 5 + y / 7).is_multiple_of(2) => 900,
            _ => 64,
        };
        let stops = if self.hdr { (12 * x / width) as i32 - 6 } else { 0 };
        f64::from(value) / 1024.0 * 2.0_f64.powi(stops)
    }

    fn test(&self, x: u32, y: u32, channel: u32) -> f64 {
        let value = self.reference(x, y, channel);
        let test = match self.kind.as_str() {
            "noise" => value * (0.75 + f64::from(hashed(x, y, channel)) / 2048.0),
            "shift" => self.reference(x.saturating_sub(2), y, channel),
            _ => value * [0.5, 0.875, 1.0][channel as usize],
        };
        if self.hdr { test } else { test.min(1.0) }
    }

    fn image(&self, value: impl Fn(u32, u32, u32) -> f64) -> Image {
        let pixels =
            (0..self.height as u32).flat_map(|y| (0..self.width as u32).map(move |x| (x, y)));
        let colours: Vec<[f32; 3]> =
            pixels.map(|(x, y)| [0, 1, 2].map(|channel| value(x, y, channel) as f32)).collect();
        Image::rgb(self.width, self.height, &colours)
    }

    fn map(&self) -> FlipMap {
        let test = self.image(|x, y, channel| self.test(x, y, channel));
        let reference = self.image(|x, y, channel| self.reference(x, y, channel));
        let ppd = self.pixels_per_degree;
        if self.hdr {
            let exposures = Exposures::of(&reference, ExposureRule::Standard).expect("it is lit");
            let (start, stop, count) = self.exposures.expect("HDR has exposures");
            assert!((exposures.start - start).abs() < 1e-6, "{}: {}", self.name, exposures.start);
            assert!((exposures.stop - stop).abs() < 1e-6, "{}: {}", self.name, exposures.stop);
            assert_eq!(exposures.count, count);
            hdr_flip(&test, &reference, &exposures, ppd).expect("they match")
        } else {
            ldr_flip(&test, &reference, 0.0, ppd).expect("they match")
        }
    }
}

#[test]
fn flip_is_that_of_its_authors() {
    let pixels = rows("flip_pixels.csv");
    let cases = cases();
    assert_eq!(cases.len(), 9);
    let (mut worst_mean, mut worst_pixel) = (0.0_f64, 0.0_f64);
    for case in &cases {
        let map = case.map();
        let mean = (map.mean - case.mean).abs();
        let mut count = 0;
        let mut pixel = 0.0_f64;
        for row in pixels.iter().filter(|row| row[0] == case.name) {
            let number = |at: usize| row[at].parse::<f64>().expect("a number");
            let at = number(2) as usize * case.width + number(1) as usize;
            pixel = pixel.max((f64::from(map.values[at]) - number(3)).abs());
            count += 1;
        }
        assert_eq!(count, (case.width * case.height).div_ceil(13));
        println!("{}: mean {mean:.2e}, {count} pixels {pixel:.2e}", case.name);
        (worst_mean, worst_pixel) = (worst_mean.max(mean), worst_pixel.max(pixel));
    }
    println!("largest: mean {worst_mean:.2e}, pixel {worst_pixel:.2e}");
    assert!(worst_mean <= MEAN && worst_pixel <= PER_PIXEL);
}

#[test]
fn equal_images_have_none_and_the_order_does_not_matter() {
    let case = &cases()[0];
    let test = case.image(|x, y, channel| case.test(x, y, channel));
    let reference = case.image(|x, y, channel| case.reference(x, y, channel));
    let ppd = case.pixels_per_degree;
    assert_eq!(ldr_flip(&test, &test, 0.0, ppd).expect("same").mean, 0.0);
    let there = ldr_flip(&test, &reference, 0.0, ppd).expect("they match");
    assert_eq!(there, ldr_flip(&reference, &test, 0.0, ppd).expect("they match"));
}

#[test]
fn what_is_not_finite_is_never_invisible() {
    let good = Image::rgb(40, 40, &[[0.5; 3]; 1600]);
    for bad in [f32::NAN, f32::INFINITY] {
        let mut test = good.clone();
        test.channels[1].values[820] = bad;
        assert!(ldr_flip(&test, &good, 0.0, 67.0).expect("same size").mean.is_nan());
        let exposures = Exposures::of(&good, ExposureRule::Standard).expect("it is lit");
        let map = hdr_flip(&test, &good, &exposures, 67.0).expect("same size");
        assert!(map.mean.is_nan() && map.values[820].is_nan() && map.values[0] == 0.0);
    }
    let mut negative = good.clone();
    negative.channels[0].values[3] = -0.1;
    assert_eq!(ldr_flip(&negative, &good, 0.0, 67.0).expect("same size").negative, 1);
    assert!(ldr_flip(&good, &good, 0.0, 0.0).is_err());
}
