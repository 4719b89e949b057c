//! Two-dimensional discrete Fourier transforms of real tables, padded.

use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// Transforms of one size.
#[derive(Clone)]
pub(super) struct Transform {
    pub(super) width: usize,
    pub(super) height: usize,
    rows: [Arc<dyn Fft<f64>>; 2],
    columns: [Arc<dyn Fft<f64>>; 2],
}

/// The smallest length from `least` on without prime factors above 5, which transforms quickly.
pub(super) fn good_length(least: usize) -> usize {
    let smooth = |mut n: usize| {
        for p in [2usize, 3, 5] {
            while n > 1 && n.is_multiple_of(p) {
                n /= p;
            }
        }
        n <= 1
    };
    (least.max(1)..).find(|n| smooth(*n)).unwrap_or(least)
}

impl Transform {
    /// At least `width` × `height`.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let (width, height) = (good_length(width), good_length(height));
        let mut planner = FftPlanner::new();
        Self {
            width,
            height,
            rows: [planner.plan_fft_forward(width), planner.plan_fft_inverse(width)],
            columns: [planner.plan_fft_forward(height), planner.plan_fft_inverse(height)],
        }
    }

    /// The transform of a table of `width` × `height` values at (row, column), 0 around it.
    pub(super) fn of(
        &self,
        [width, height]: [usize; 2],
        value: impl Fn(usize, usize) -> Complex<f64>,
    ) -> Vec<Complex<f64>> {
        let mut data = vec![Complex::default(); self.width * self.height];
        for (row, values) in data.chunks_mut(self.width).take(height).enumerate() {
            let places = values.iter_mut().take(width).enumerate();
            places.for_each(|(column, slot)| *slot = value(row, column));
        }
        self.forward(&mut data);
        data
    }

    /// Transforms rows of `width`, then columns; the result is transposed: columns of `height`.
    fn forward(&self, data: &mut Vec<Complex<f64>>) {
        self.rows[0].process(data);
        *data = transposed(data, self.width, self.height);
        self.columns[0].process(data);
    }

    /// Back from what [`Transform::forward`] gives, times `width` · `height`.
    pub(super) fn inverse(&self, data: &mut Vec<Complex<f64>>) {
        self.columns[1].process(data);
        *data = transposed(data, self.height, self.width);
        self.rows[1].process(data);
    }
}

fn transposed(data: &[Complex<f64>], width: usize, height: usize) -> Vec<Complex<f64>> {
    const TILE: usize = 16;
    let mut out = vec![Complex::default(); data.len()];
    for top in (0..height).step_by(TILE) {
        for left in (0..width).step_by(TILE) {
            for j in top..(top + TILE).min(height) {
                for i in left..(left + TILE).min(width) {
                    if let (Some(to), Some(from)) =
                        (out.get_mut(i * height + j), data.get(j * width + i))
                    {
                        *to = *from;
                    }
                }
            }
        }
    }
    out
}
