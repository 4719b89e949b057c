//! The filters of FLIP, all of them separable.

use std::f64::consts::PI;

use rayon::prelude::*;

/// Width of the feature detector in degrees.
const FEATURE_WIDTH_DEG: f64 = 0.082;

/// One component of an image.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    /// Convolved along the rows with a kernel of odd length; beyond the edge its pixel repeats.
    pub(super) fn along_rows(&self, kernel: &[f64]) -> Self {
        let radius = kernel.len() / 2;
        let row = |row: &[f64]| -> Vec<f64> {
            let (first, last) = (row.first().copied(), row.last().copied());
            let padded: Vec<f64> = std::iter::repeat_n(first, radius)
                .chain(row.iter().copied().map(Some))
                .chain(std::iter::repeat_n(last, radius))
                .flatten()
                .collect();
            padded
                .windows(kernel.len())
                .map(|window| window.iter().zip(kernel).map(|(value, weight)| value * weight).sum())
                .collect()
        };
        self.with(self.values.par_chunks(self.width).flat_map_iter(row).collect())
    }

    /// The same along the columns.
    pub(super) fn along_columns(&self, kernel: &[f64]) -> Self {
        let radius = kernel.len() / 2;
        let column = |y: usize| -> Vec<f64> {
            let mut sums = vec![0.0; self.width];
            for (offset, weight) in kernel.iter().enumerate() {
                let from = (y + offset).saturating_sub(radius).min(self.height - 1);
                let row = &self.values[from * self.width..(from + 1) * self.width];
                for (sum, value) in sums.iter_mut().zip(row) {
                    *sum += weight * value;
                }
            }
            sums
        };
        self.with((0..self.height).into_par_iter().flat_map_iter(column).collect())
    }

    /// The sum of two planes.
    pub(super) fn plus(&self, other: &Self) -> Self {
        self.with(self.values.iter().zip(&other.values).map(|(a, b)| a + b).collect())
    }

    /// The length of the vector that two planes hold the components of.
    pub(super) fn length(&self, other: &Self) -> Self {
        self.with(
            self.values.iter().zip(&other.values).map(|(a, b)| (a * a + b * b).sqrt()).collect(),
        )
    }

    fn with(&self, values: Vec<f64>) -> Self {
        Self { width: self.width, height: self.height, values }
    }
}

/// Contrast sensitivity as blur, one kernel per axis of the opponent colours. The one of blue and
/// yellow is a sum of two Gaussians, each separable.
pub(super) struct SpatialKernels {
    pub(super) luminance: Vec<f64>,
    pub(super) red_green: Vec<f64>,
    pub(super) blue_yellow: [Vec<f64>; 2],
}

/// Kernels with the constants of the paper's table 1: a√(π/b) exp(−π²x²/b), x in degrees, cut at
/// three standard deviations of the widest and normalised over the plane.
pub(super) fn spatial_kernels(pixels_per_degree: f64) -> SpatialKernels {
    const LUMINANCE: f64 = 0.0047;
    const RED_GREEN: f64 = 0.0053;
    const BLUE_YELLOW: [(f64, f64); 2] = [(34.1, 0.04), (13.5, 0.025)];
    let widest = BLUE_YELLOW[0].1;
    let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil();
    let profile = |b: f64| -> Vec<f64> {
        offsets(radius)
            .map(|i| {
                let x_deg = i / pixels_per_degree;
                core_math::exp(-PI * PI * x_deg * x_deg / b)
            })
            .collect()
    };
    let normalised = |b: f64| {
        let profile = profile(b);
        let sum: f64 = profile.iter().sum();
        profile.into_iter().map(|weight| weight / sum).collect()
    };
    // Over the plane, a term weighs its amplitude times the square of its profile's sum; each axis
    // takes the root.
    let terms = BLUE_YELLOW.map(|(a, b)| (a * (PI / b).sqrt(), profile(b)));
    let weight = |(amplitude, profile): &(f64, Vec<f64>)| {
        let sum: f64 = profile.iter().sum();
        amplitude * sum * sum
    };
    let total: f64 = terms.iter().map(weight).sum();
    SpatialKernels {
        luminance: normalised(LUMINANCE),
        red_green: normalised(RED_GREEN),
        blue_yellow: terms.map(|(amplitude, profile)| {
            let scale = (amplitude / total).sqrt();
            profile.into_iter().map(|weight| weight * scale).collect()
        }),
    }
}

/// Detectors of edges and points: a Gaussian and its first two derivatives.
pub(super) struct FeatureKernels {
    pub(super) gaussian: Vec<f64>,
    pub(super) first: Vec<f64>,
    pub(super) second: Vec<f64>,
}

/// Kernels whose Gaussian sums to 1 and whose derivatives have positive and negative weights that
/// sum to 1 and −1.
pub(super) fn feature_kernels(pixels_per_degree: f64) -> FeatureKernels {
    let sigma = 0.5 * FEATURE_WIDTH_DEG * pixels_per_degree;
    let radius = (3.0 * sigma).ceil();
    let gaussian: Vec<f64> =
        offsets(radius).map(|x| core_math::exp(-x * x / (2.0 * sigma * sigma))).collect();
    let derivative = |factor: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let weights: Vec<f64> =
            offsets(radius).zip(&gaussian).map(|(x, g)| factor(x) * g).collect();
        let positive: f64 = weights.iter().filter(|w| **w > 0.0).sum();
        let negative: f64 = -weights.iter().filter(|w| **w < 0.0).sum::<f64>();
        let normalised = |w: f64| if w > 0.0 { w / positive } else { w / negative };
        weights.into_iter().map(normalised).collect()
    };
    let first = derivative(&|x| -x);
    let second = derivative(&|x| x * x / (sigma * sigma) - 1.0);
    let sum: f64 = gaussian.iter().sum();
    FeatureKernels { gaussian: gaussian.into_iter().map(|g| g / sum).collect(), first, second }
}

/// −radius … radius in steps of 1.
fn offsets(radius: f64) -> impl Iterator<Item = f64> {
    let count = 2 * radius as usize + 1;
    (0..count).map(move |i| i as f64 - radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_normalised_over_the_plane() {
        for pixels_per_degree in [5.0, 67.02, 200.0] {
            let kernels = spatial_kernels(pixels_per_degree);
            let square = |kernel: &Vec<f64>| kernel.iter().sum::<f64>().powi(2);
            let plane = [
                square(&kernels.luminance),
                square(&kernels.red_green),
                kernels.blue_yellow.iter().map(square).sum(),
            ];
            for sum in plane {
                assert!((sum - 1.0_f64).abs() < 1e-14, "{sum} at {pixels_per_degree}");
            }
            let features = feature_kernels(pixels_per_degree);
            assert!(features.first.iter().sum::<f64>().abs() < 1e-14);
            assert!(features.second.iter().sum::<f64>().abs() < 1e-14);
        }
    }

    #[test]
    fn edges_repeat() {
        let plane = Plane { width: 3, height: 1, values: vec![1.0, 2.0, 4.0] };
        assert_eq!(plane.along_rows(&[1.0, 0.0, 0.0]).values, [1.0, 1.0, 2.0]);
        let plane = Plane { width: 1, height: 3, values: vec![1.0, 2.0, 4.0] };
        assert_eq!(plane.along_columns(&[0.0, 0.0, 1.0]).values, [2.0, 4.0, 4.0]);
    }
}
