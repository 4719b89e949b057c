//! The same convolution by FFT along azimuth: the peer of the passes, and their reference.
//!
//! The frame (east, north, outwards) of a texel turns with its azimuth, so that the taps of a row
//! weigh the texels of every other row by their difference of columns alone. A row's taps are
//! collected once into such weights, with the bilinear weights of the lookup; applied by FFT they give
//! the sum over all taps, to rounding, for any map.

use std::f64::consts::PI;

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;

use super::{SphereMap, Taps};
use crate::measured::environment::LatLong;

/// A list of taps as weights between rows, per channel transformed along azimuth.
#[derive(Debug)]
pub struct AzimuthalOperator {
    width: usize,
    height: usize,
    /// `[row][channel]`: spectra of the weights of all rows, one after the other.
    spectra: Vec<[Vec<Complex64>; 3]>,
}

impl AzimuthalOperator {
    /// For maps of `width` × `height` texels. Takes 48 `width` · `height`² bytes.
    pub fn new(taps: &Taps, width: usize, height: usize) -> Self {
        let forward = FftPlanner::new().plan_fft_forward(width);
        let spectra = (0..height)
            .into_par_iter()
            .map(|row| {
                let mut weights = row_weights(taps, row, LatLong { width, height });
                for channel in &mut weights {
                    // Whole rows, one after the other.
                    forward.process(channel);
                }
                weights
            })
            .collect();
        Self { width, height, spectra }
    }

    /// The convolved map; `map` has the size of the operator.
    pub fn apply(&self, map: &SphereMap) -> SphereMap {
        let mut planner = FftPlanner::new();
        let forward = planner.plan_fft_forward(self.width);
        let inverse = planner.plan_fft_inverse(self.width);
        let spectrum = |channel: usize| {
            let values = map.rgb.iter().skip(channel).step_by(3);
            let mut values: Vec<Complex64> = values.map(|v| f64::from(*v).into()).collect();
            forward.process(&mut values);
            values
        };
        let map_spectra = [0, 1, 2].map(spectrum);
        let rows: Vec<Vec<f32>> = self
            .spectra
            .par_iter()
            .map(|row| {
                let mut line = vec![0.0_f32; 3 * self.width];
                for (channel, (weights, values)) in row.iter().zip(&map_spectra).enumerate() {
                    let mut sums = vec![Complex64::default(); self.width];
                    let pairs =
                        weights.chunks_exact(self.width).zip(values.chunks_exact(self.width));
                    for (weights, values) in pairs {
                        for ((sum, weight), value) in sums.iter_mut().zip(weights).zip(values) {
                            *sum += weight.conj() * value;
                        }
                    }
                    inverse.process(&mut sums);
                    for (at, sum) in sums.iter().enumerate() {
                        line[3 * at + channel] = (sum.re / self.width as f64) as f32;
                    }
                }
                line
            })
            .collect();
        SphereMap { width: self.width, height: self.height, rgb: rows.concat() }
    }
}

/// Weights of every texel, relative to the column of a texel in `row`, per channel.
fn row_weights(taps: &Taps, row: usize, layout: LatLong) -> [Vec<Complex64>; 3] {
    let LatLong { width, height } = layout;
    let mut weights = [0, 1, 2].map(|_| vec![Complex64::default(); width * height]);
    let (sin, cos) = (PI * (row as f64 + 0.5) / height as f64).sin_cos();
    for ([east, north, outwards], weight) in taps.iter() {
        if weight == [0.0; 3] {
            continue;
        }
        // In the frame of azimuth 0: east is y, north (−cos θ, 0, sin θ), outwards (sin θ, 0, cos θ).
        let (x, y, z) = (outwards * sin - north * cos, east, outwards * cos + north * sin);
        let (column, line) = layout.unwrapped([x, y, z]);
        // Relative to a column, so that the column of a texel's centre is whole.
        for (at, share) in layout.between(column, line - 0.5) {
            for (channel, weight) in weights.iter_mut().zip(weight) {
                channel[at].re += weight * share;
            }
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Backend;
    use crate::render::sphere_map::convolved;

    /// Two ways to one sum: taps on f32 lanes, and weights by FFT in f64.
    #[test]
    fn the_fft_way_is_the_sum_over_taps() {
        let (width, height) = (32, 16);
        let rgb = (0..3 * width * height).map(|i| ((i * 7919) % 101) as f32 / 101.0).collect();
        let map = SphereMap { width, height, rgb };
        let mut taps = Taps::default();
        for i in 0..9 {
            for j in 0..9 {
                let (u, v) = (0.2 * f64::from(i) - 0.8, 0.15 * f64::from(j) - 0.6);
                let square: f64 = u * u + v * v;
                if square < 1.0 {
                    taps.push([u, v, (1.0 - square).sqrt()], [0.1, 0.02 * u, 0.05 - 0.1 * v]);
                }
            }
        }
        let ours = AzimuthalOperator::new(&taps, width, height).apply(&map);
        let lanes = convolved(&[map], &[taps], Backend::Lanes).expect("a kernel");
        let worst = ours.rgb.iter().zip(&lanes[0].rgb).map(|(a, b)| (a - b).abs());
        let worst = worst.fold(0.0, f32::max);
        // What f32 leaves of 81 taps with four products each.
        assert!(worst < 1e-5, "{worst}");
    }
}
