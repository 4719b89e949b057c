//! Environment maps of another size, by exact overlaps of texels.

use std::f64::consts::FRAC_PI_2;

use super::environment::require_size;
use super::{Environment, MeasuredError};

impl Environment {
    /// The map with `width` texels around and `width`/2 rows: each texel is the mean of the texels
    /// that it overlaps, weighted with the solid angles of the overlaps, also where it is smaller
    /// than they are. Keeps [`Environment::mean`] to the rounding of f32.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] if `width` is odd or below 8, and as [`Environment::check`].
    pub fn resized(&self, width: usize) -> Result<Self, MeasuredError> {
        let height = width / 2;
        let origin = format!("{}, resized to {width} × {height}", self.origin);
        require_size(&origin, width, height)?;
        self.check()?;
        let columns = shares(self.width, width, |from, to| to - from);
        // Texels of a row differ in solid angle as the cosines of their edges do, here as a product.
        let rows = shares(self.height, height, |from, to| {
            (FRAC_PI_2 * (from + to)).sin() * (FRAC_PI_2 * (to - from)).sin()
        });
        let mut radiance = Vec::with_capacity(width * height);
        for overlaps in &rows {
            let mut band = vec![[0.0; 3]; self.width];
            for (row, share) in overlaps {
                let texels = self.radiance.chunks(self.width).nth(*row).unwrap_or_default();
                for (sum, texel) in band.iter_mut().zip(texels) {
                    add(sum, *share, texel.map(f64::from));
                }
            }
            for overlaps in &columns {
                let mut sum = [0.0; 3];
                for (column, share) in overlaps {
                    add(&mut sum, *share, band.get(*column).copied().unwrap_or_default());
                }
                radiance.push(sum.map(|value| value as f32));
            }
        }
        Self::new(width, height, radiance, origin)
    }
}

fn add(sum: &mut [f64; 3], share: f64, values: [f64; 3]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += share * value;
    }
}

/// For each of `target` equal parts of [0, 1], the `source` equal parts that it overlaps with their
/// shares, which add up to 1. `measure` is the size of an interval.
fn shares(
    source: usize,
    target: usize,
    measure: impl Fn(f64, f64) -> f64,
) -> Vec<Vec<(usize, f64)>> {
    let edge = |i: usize, count: usize| i as f64 / count as f64;
    let overlaps = |part: usize| {
        let (from, to) = (edge(part, target), edge(part + 1, target));
        let first = (from * source as f64).floor() as usize;
        let overlap = |i: usize| {
            let (low, high) = (edge(i, source).max(from), edge(i + 1, source).min(to));
            (high > low).then(|| (i, measure(low, high)))
        };
        let last = ((to * source as f64).ceil() as usize).min(source);
        let found: Vec<(usize, f64)> = (first..last).filter_map(overlap).collect();
        let total: f64 = found.iter().map(|(_, size)| size).sum();
        found.into_iter().map(|(i, size)| (i, size / total)).collect()
    };
    (0..target).map(overlaps).collect()
}
