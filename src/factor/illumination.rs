//! Patches of environments around random normals, in the coordinates of a table.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Alignment, LowRankError};
use crate::measured::environment::{Environment, luminance};
use crate::table::Axis;

/// What of the radiance counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Radiance {
    /// Luminance of linear sRGB.
    #[default]
    Luminance,
    /// Its red alone.
    Red,
    /// Its green alone.
    Green,
    /// Its blue alone.
    Blue,
}

impl Radiance {
    fn of(self, [r, g, b]: [f64; 3]) -> f64 {
        match self {
            Self::Luminance => luminance([r, g, b]),
            Self::Red => r,
            Self::Green => g,
            Self::Blue => b,
        }
    }
}

/// An environment whose texels were counted and looked at.
#[derive(Clone, Copy)]
pub(super) struct Sampler<'a> {
    environment: &'a Environment,
    radiance: Radiance,
}

impl<'a> Sampler<'a> {
    /// # Errors
    /// [`LowRankError::Unusable`] if texels are missing, negative or not finite.
    pub(super) fn new(
        environment: &'a Environment,
        radiance: Radiance,
    ) -> Result<Self, LowRankError> {
        let (width, height) = (environment.width, environment.height);
        let origin = || format!("environment {}", environment.origin);
        let fault = |what: String| LowRankError::unusable(origin(), what);
        let expected = width.saturating_mul(height);
        if expected == 0 || environment.radiance.len() != expected {
            let got = environment.radiance.len();
            return Err(fault(format!("{got} texels for {width} × {height}")));
        }
        let good = |texel: &[f32; 3]| texel.iter().all(|v| v.is_finite() && *v >= 0.0);
        if let Some(at) = environment.radiance.iter().position(|texel| !good(texel)) {
            return Err(fault(format!(
                "texel ({}, {}) is negative or not finite",
                at % width,
                at / width
            )));
        }
        Ok(Self { environment, radiance })
    }

    /// Angle between the centres of two rows, rad.
    pub(super) fn spacing_rad(&self) -> f64 {
        PI / self.environment.height as f64
    }

    fn texel(&self, i: usize, j: usize) -> f64 {
        let texel = self.environment.radiance.get(j * self.environment.width + i);
        texel.map_or(0.0, |texel| self.radiance.of(texel.map(f64::from)))
    }

    /// Radiance from a unit vector, bilinear between texel centres, around in azimuth and held
    /// towards the poles.
    ///
    /// Maps are looked up on over the poles everywhere else
    /// ([`LatLong`](crate::measured::environment::LatLong)). Here that would move committed factors,
    /// and pictures made with them by 4e-8.
    pub(super) fn at(&self, [x, y, z]: [f64; 3]) -> f64 {
        let (width, height) = (self.environment.width, self.environment.height);
        let column = y.atan2(x).rem_euclid(TAU) / TAU * width as f64 - 0.5;
        let row = z.clamp(-1.0, 1.0).acos() / PI * height as f64 - 0.5;
        let row = row.clamp(0.0, (height - 1) as f64);
        let (top, down) = (row.floor() as usize, row.fract());
        let below = (top + 1).min(height - 1);
        let across = column - column.floor();
        let left = (column.floor() as i64).rem_euclid(width as i64) as usize;
        let right = (left + 1) % width;
        let line = |j| self.texel(left, j) * (1.0 - across) + self.texel(right, j) * across;
        line(top) * (1.0 - down) + line(below) * down
    }
}

/// A tangent frame: tangent, bitangent, normal.
pub(super) type Frame = [[f64; 3]; 3];

/// The `index`-th of the frames that `seed` gives, uniform over all rotations (Shoemake 1992,
/// Graphics Gems III, 124).
pub(super) fn frame(seed: u64, index: usize) -> Frame {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index as u64);
    let [a, b, c]: [f64; 3] = [random.random(), random.random(), random.random()];
    let (p, q) = ((1.0 - a).sqrt(), a.sqrt());
    let [x, y, z, w] =
        [p * (TAU * b).sin(), p * (TAU * b).cos(), q * (TAU * c).sin(), q * (TAU * c).cos()];
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
        [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
        [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// A regular grid of points in aligned coordinates, and how finely each of its cells is sampled.
pub(super) struct Patch {
    /// Centre of the first cell.
    pub(super) from: [f64; 2],
    /// Steps from cell to cell.
    pub(super) step: [f64; 2],
    /// Cells along x and y.
    pub(super) count: [usize; 2],
    /// From aligned coordinates to h.
    pub(super) inverse: Alignment,
}

impl Patch {
    /// Radiance averaged over each cell, row by row: light from u t + v b + √(1 − u² − v²) n with
    /// (u, v) = h, ω_o along n; 0 outside the unit disc. Cells wider than the environment's texels
    /// are sampled `SUBSAMPLES` times at most to a side.
    pub(super) fn radiance(&self, sampler: Sampler<'_>, frame: &Frame) -> Vec<f64> {
        const SUBSAMPLES: f64 = 4.0;
        let widest = self.step.iter().fold(0.0f64, |most, step| most.max(step.abs()));
        let fine = (widest / sampler.spacing_rad()).ceil().clamp(1.0, SUBSAMPLES);
        let offsets: Vec<f64> = (0..fine as usize).map(|k| (k as f64 + 0.5) / fine - 0.5).collect();
        let [t, b, n] = frame;
        let light = |a: [f64; 2]| {
            let [u, v] = self.inverse.apply(a);
            let cosine_squared = 1.0 - u * u - v * v;
            if cosine_squared < 0.0 {
                return 0.0;
            }
            let w = cosine_squared.sqrt();
            sampler.at([0, 1, 2].map(|k| u * t[k] + v * b[k] + w * n[k]))
        };
        let [nx, ny] = self.count;
        let mut values = Vec::with_capacity(nx * ny);
        for iy in 0..ny {
            for ix in 0..nx {
                let mut sum = 0.0;
                for oy in &offsets {
                    for ox in &offsets {
                        let ax = self.from[0] + (ix as f64 + ox) * self.step[0];
                        let ay = self.from[1] + (iy as f64 + oy) * self.step[1];
                        sum += light([ax, ay]);
                    }
                }
                values.push(sum / (fine * fine));
            }
        }
        values
    }

    /// The cells of a table with these axes.
    pub(super) fn of_table(x: &Axis, y: &Axis, alignment: &Alignment) -> Self {
        Self {
            from: [x.centre(0), y.centre(0)],
            step: [x.centre(1) - x.centre(0), y.centre(1) - y.centre(0)],
            count: [x.count, y.count],
            inverse: alignment.inverse(),
        }
    }
}
