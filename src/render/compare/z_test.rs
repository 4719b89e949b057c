//! Whether the noise of two images explains their difference.
//!
//! For a pixel with values t and r and standard errors s_t and s_r, d = t − r has the variance
//! v = s_t² + s_r² (plus that of rounding both to f32, (ulp/2)²/3 each, so that without noise
//! rounding is no difference unless it prefers a side). One pixel of a Monte Carlo image is far
//! from normal: few samples hit a small light, and where none did, both d and the estimated v are
//! too small together. So pixels are summed into cells:
//!
//! - blocks of `block` × `block` pixels of one channel;
//! - a block in which fewer than `contributors` pixels carry the variance, (Σv)²/Σv² (Kish), is
//!   pooled with the next such ones, and what is left at the end with the last cell;
//! - each whole channel as one cell more, which finds a small bias everywhere.
//!
//! z = Σd/√Σv is then close to normal, its two-sided p-value erfc(|z|/√2). The worst of m cells is
//! judged after Šidák, 1 − (1 − p)^m; cells that overlap make that conservative. Fair images fail at
//! 1 % in 1 % of the cases with 30 hits per pixel and against an exact reference in 2.4 % with 3,
//! where a cell with few hits also states too small an error (`tests/compare/noise.rs`).
//!
//! | symbol | here |
//! |---|---|
//! | m | [`ZTest::cells`] |
//! | z | [`ZTest::worst_z`] |
//! | 1 − (1 − p)^m | [`ZTest::p`] |

use errorfunctions::RealErrorFunctions;

use super::CompareError;
use super::metrics::matched;
use crate::render::image::{Channel, Image};

/// How pixels become cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pooling {
    /// Side of a block in pixels, at least 1.
    pub block: usize,
    /// Pixels that must carry the variance of a cell, at least 1.
    pub contributors: usize,
}

impl Default for Pooling {
    /// Blocks of 8 × 8 pixels, a quarter of which must contribute.
    fn default() -> Self {
        Self { block: 8, contributors: 16 }
    }
}

/// Result of the test.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ZTest {
    /// Number of cells.
    pub cells: usize,
    /// The z of the cell with the largest magnitude; NaN if a value or its error is not finite.
    pub worst_z: f64,
    /// p-value of that cell after Šidák's correction: the chance of a worst cell at least this far
    /// off, if the images differ by noise only.
    pub p: f64,
    /// The worst pool.
    pub worst: Pool,
    /// Values or standard errors, in either image, that are not finite, or errors below 0.
    pub unusable: usize,
}

/// A pool of pixels of one channel, as the place to look at.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize)]
pub struct Pool {
    /// The channel.
    pub channel: String,
    /// Column of the first pixel.
    pub x: usize,
    /// Row of the first pixel.
    pub y: usize,
    /// Number of pixels.
    pub pixels: usize,
}

impl ZTest {
    /// Tests `test` against `reference`; one of them or both have `stderr.` channels.
    ///
    /// # Errors
    /// [`CompareError`]: sizes or channels that differ; a channel without standard errors in either
    /// image; a pooling of zeros.
    pub fn of(test: &Image, reference: &Image, pooling: Pooling) -> Result<Self, CompareError> {
        for (what, got) in
            [("side of a block", pooling.block), ("contributors of a cell", pooling.contributors)]
        {
            if got == 0 {
                return Err(CompareError::Setting { what, expected: "at least 1", got: 0.0 });
            }
        }
        let mut sums = Vec::new();
        let mut unusable = 0;
        for (tested, expected) in matched(test, reference)? {
            let errors =
                [test.standard_error(&tested.name), reference.standard_error(&tested.name)];
            if errors.iter().all(Option::is_none) {
                let channel = &tested.name;
                return Err(CompareError::Unusable(format!(
                    "neither image has standard errors of channel {channel:?}; expected \
                     \"stderr.{channel}\""
                )));
            }
            let noise = Noise { tested, expected, errors };
            unusable += noise.unusable();
            sums.extend(cells(&noise, [test.width, test.height], pooling));
        }
        let worst = sums.iter().max_by(|a, b| a.1.z().abs().total_cmp(&b.1.z().abs()));
        let (place, worst_z) = worst.map(|(cell, sum)| (cell.clone(), sum.z())).unwrap_or_default();
        let sidak = |p: f64| -(sums.len() as f64 * (-p).ln_1p()).exp_m1();
        let p = sidak(RealErrorFunctions::erfc(worst_z.abs() * std::f64::consts::FRAC_1_SQRT_2));
        let sound = |value: f64| if unusable > 0 { f64::NAN } else { value };
        Ok(Self { cells: sums.len(), worst_z: sound(worst_z), p: sound(p), worst: place, unusable })
    }

    /// Whether noise explains the difference at the given level, the share of fair images that fail.
    /// Never if something was not finite.
    pub fn passes(&self, level: f64) -> bool {
        self.p >= level
    }
}

/// One channel of both images, with whatever standard errors there are.
struct Noise<'a> {
    tested: &'a Channel,
    expected: &'a Channel,
    errors: [Option<&'a Channel>; 2],
}

impl Noise<'_> {
    fn unusable(&self) -> usize {
        let values = self.tested.values.iter().chain(&self.expected.values);
        let errors = self.errors.iter().flatten().flat_map(|channel| &channel.values);
        values.filter(|v| !v.is_finite()).count()
            + errors.filter(|e| !(e.is_finite() && **e >= 0.0)).count()
    }

    /// Difference and variance of a pixel.
    fn at(&self, at: usize) -> (f64, f64) {
        let value = |channel: &Channel| f64::from(channel.values[at]);
        let rounding = |value: f64| {
            let half_ulp = f64::from(f32::EPSILON) / 2.0 * value;
            half_ulp * half_ulp / 3.0
        };
        let (tested, expected) = (value(self.tested), value(self.expected));
        let errors = self.errors.iter().flatten().map(|channel| value(channel));
        let variance: f64 = errors.map(|error| error * error).sum();
        (tested - expected, variance + rounding(tested) + rounding(expected))
    }
}

/// Sums over the pixels of a cell.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    difference: f64,
    variance: f64,
    variance_squared: f64,
    pixels: usize,
}

impl Sum {
    fn add(&mut self, other: Self) {
        self.difference += other.difference;
        self.variance += other.variance;
        self.variance_squared += other.variance_squared;
        self.pixels += other.pixels;
    }

    fn contributors(&self) -> f64 {
        match self.variance_squared {
            0.0 => 0.0,
            squared => self.variance * self.variance / squared,
        }
    }

    /// 0 where there is neither difference nor variance, infinite for a difference without.
    fn z(&self) -> f64 {
        if self.difference == 0.0 { 0.0 } else { self.difference / self.variance.sqrt() }
    }
}

/// The cells of a channel: blocks, pooled where few pixels contribute, and the whole.
fn cells(noise: &Noise, [width, height]: [usize; 2], pooling: Pooling) -> Vec<(Pool, Sum)> {
    let channel = &noise.tested.name;
    let cell = |(x, y): (usize, usize), sum: Sum| {
        (Pool { channel: channel.clone(), x, y, pixels: sum.pixels }, sum)
    };
    let enough = |sum: &Sum| sum.contributors() >= pooling.contributors as f64;
    let mut cells = Vec::new();
    let mut whole = Sum::default();
    let mut pool: Option<((usize, usize), Sum)> = None;
    for top in (0..height).step_by(pooling.block) {
        for left in (0..width).step_by(pooling.block) {
            let mut block = Sum::default();
            for y in top..(top + pooling.block).min(height) {
                for x in left..(left + pooling.block).min(width) {
                    let (difference, variance) = noise.at(y * width + x);
                    let squared = variance * variance;
                    block.add(Sum { difference, variance, variance_squared: squared, pixels: 1 });
                }
            }
            whole.add(block);
            if enough(&block) {
                cells.push(cell((left, top), block));
                continue;
            }
            let (from, mut sum) = pool.take().unwrap_or(((left, top), Sum::default()));
            sum.add(block);
            if enough(&sum) {
                cells.push(cell(from, sum));
            } else {
                pool = Some((from, sum));
            }
        }
    }
    if let (Some((_, rest)), Some((place, sum))) = (pool, cells.last_mut()) {
        sum.add(rest);
        place.pixels = sum.pixels;
    }
    cells.push(cell((0, 0), whole));
    cells
}
