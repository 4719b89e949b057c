//! How much of an error is left after the convolution with environments.
//!
//! What is seen is not a kernel but its convolution with the light (toisoul2017 eq. 7). An error D
//! of the kernel, seen under environments E_e at all positions s, has the size
//!
//! ‖D‖²_R = Σ_e Σ_s (Σ_h D(h) E_e(h + s))² = Σ_h Σ_h' D(h) R(h − h') D(h') = ⟨D, R ⋆ D⟩
//!
//! with R = Σ_e the autocorrelation of E_e: even, and positive semi-definite as a sum of
//! autocorrelations. A single point light has R = δ, and the norm is Frobenius'; soft light hides
//! fine detail of D.
//!
//! R is taken from patches of the environments around random normals with random tangents. Within a
//! patch the light is taken as shifting rigidly in direction cosines when the normal tilts, which
//! holds for small tilts; [`seen_error`] makes no such assumption.

use faer::Mat;
use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::fourier::Transform;
use super::illumination::{Patch, Radiance, Sampler, frame};
use super::matrix::{inner, of_channel};
use super::methods::require_size;
use super::{Alignment, LowRank, LowRankError};
use crate::measured::environment::Environment;
use crate::table::{Axis, Grid};

/// How environments are sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormOptions {
    /// Random normals and tangents per environment.
    pub orientations: usize,
    /// Their seed.
    pub seed: u64,
    /// What of the radiance counts.
    pub radiance: Radiance,
    /// From h to the coordinates of the axes.
    pub alignment: Alignment,
}

impl Default for NormOptions {
    fn default() -> Self {
        Self {
            orientations: 32,
            seed: 1,
            radiance: Radiance::Luminance,
            alignment: Alignment::identity(),
        }
    }
}

/// The norm ‖·‖_R on tables of one size.
#[derive(Clone)]
pub struct ConvolutionNorm {
    nx: usize,
    ny: usize,
    /// R over lags, (2 ny − 1) × (2 nx − 1), lag 0 in the middle, where it is 1.
    lags: Mat<f64>,
    transform: Transform,
    /// Transform of R, real, transposed, over the number of texels.
    spectrum: Vec<f64>,
}

impl ConvolutionNorm {
    /// The norm under environments, each divided by its own power (R_e at lag 0) so that none
    /// dominates, and averaged. The same for any number of threads.
    ///
    /// The patches have twice the extent of the table, or that of the unit disc where this is
    /// smaller; the table's spacing; and 0 outside the unit disc.
    ///
    /// # Errors
    /// [`LowRankError::Setting`] without environments or orientations;
    /// [`LowRankError::Unusable`] for texels that are missing, negative or not finite, or if no
    /// patch has any light.
    pub fn from_environments(
        environments: &[Environment],
        x: &Axis,
        y: &Axis,
        options: &NormOptions,
    ) -> Result<Self, LowRankError> {
        let counts = [("environments", environments.len()), ("orientations", options.orientations)];
        if let Some((name, _)) = counts.into_iter().find(|(_, count)| *count == 0) {
            return Err(LowRankError::setting(name, "at least one", "none"));
        }
        let patch = patch(x, y, &options.alignment);
        let [width, height] = patch.count;
        let transform = Transform::new(width + x.count - 1, height + y.count - 1);
        let (nx, ny) = (x.count, y.count);
        let mut lags = Mat::<f64>::zeros(2 * ny - 1, 2 * nx - 1);
        for (index, environment) in environments.iter().enumerate() {
            let sampler = Sampler::new(environment, options.radiance)?;
            let mut power = power_spectrum(&patch, &transform, sampler, options, index);
            transform.inverse(&mut power);
            let at = |dy: i64, dx: i64| {
                let row = dy.rem_euclid(transform.height as i64) as usize;
                let column = dx.rem_euclid(transform.width as i64) as usize;
                power.get(row * transform.width + column).map_or(0.0, |c| c.re)
            };
            let own = at(0, 0);
            if !(own.is_finite() && own > 0.0) {
                let origin = format!("environment {}", environment.origin);
                let what = "dark around every normal that was drawn";
                return Err(LowRankError::unusable(origin, what));
            }
            for iy in 0..2 * ny - 1 {
                for ix in 0..2 * nx - 1 {
                    let (dy, dx) = (iy as i64 - (ny as i64 - 1), ix as i64 - (nx as i64 - 1));
                    let even = 0.5 * (at(dy, dx) + at(-dy, -dx));
                    lags[(iy, ix)] += even / (own * environments.len() as f64);
                }
            }
        }
        Ok(Self::from_lags(nx, ny, lags))
    }

    /// The Frobenius norm: R = δ, light from one point.
    pub fn point_light(x: &Axis, y: &Axis) -> Self {
        let (nx, ny) = (x.count, y.count);
        let middle = |iy, ix| if (iy, ix) == (ny - 1, nx - 1) { 1.0 } else { 0.0 };
        Self::from_lags(nx, ny, Mat::from_fn(2 * ny - 1, 2 * nx - 1, middle))
    }

    fn from_lags(nx: usize, ny: usize, lags: Mat<f64>) -> Self {
        let transform = Transform::new(2 * nx - 1, 2 * ny - 1);
        let size = [transform.width, transform.height];
        let mut norm = Self { nx, ny, lags, transform, spectrum: Vec::new() };
        // Negative lags stand at the end.
        let lag = |i: usize, n: usize| if 2 * i < n { i as i64 } else { i as i64 - n as i64 };
        let correlation = |row: usize, column: usize| {
            Complex::new(norm.correlation(lag(column, size[0]), lag(row, size[1])), 0.0)
        };
        let texels = (size[0] * size[1]) as f64;
        norm.spectrum =
            norm.transform.of(size, correlation).iter().map(|c| c.re / texels).collect();
        norm
    }

    /// R at a lag in texels, relative to lag 0; 0 beyond the table.
    pub fn correlation(&self, dx: i64, dy: i64) -> f64 {
        let index =
            |d: i64, n: usize| usize::try_from(d + n as i64 - 1).ok().filter(|i| *i < 2 * n - 1);
        match (index(dy, self.ny), index(dx, self.nx)) {
            (Some(iy), Some(ix)) => self.lags[(iy, ix)],
            _ => 0.0,
        }
    }

    pub(super) fn lags(&self) -> &Mat<f64> {
        &self.lags
    }

    /// R ⋆ d on the texels of the table.
    pub(super) fn convolved(&self, d: &Mat<f64>) -> Mat<f64> {
        let width = self.transform.width;
        let mut data =
            self.transform.of([self.nx, self.ny], |iy, ix| Complex::new(d[(iy, ix)], 0.0));
        for (value, factor) in data.iter_mut().zip(&self.spectrum) {
            *value *= *factor;
        }
        self.transform.inverse(&mut data);
        Mat::from_fn(self.ny, self.nx, |iy, ix| data.get(iy * width + ix).map_or(0.0, |c| c.re))
    }

    /// ‖d‖²_R.
    pub(super) fn squared(&self, d: &Mat<f64>) -> f64 {
        inner(d.as_ref(), self.convolved(d).as_ref()).max(0.0)
    }

    /// ‖S − Ŝ‖_R/‖S‖_R per channel; 0 for a channel that is 0.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] if the table has another size than the norm or other channels
    /// than the factors.
    pub fn relative_errors(
        &self,
        table: &Grid,
        factors: &LowRank,
    ) -> Result<Vec<f64>, LowRankError> {
        self.require(table)?;
        factors.relative_errors_by(table, |d| self.squared(d))
    }

    pub(super) fn require(&self, table: &Grid) -> Result<(), LowRankError> {
        require_size(table, [self.nx, self.ny], "the norm was made for")
    }
}

/// Cells of the table's spacing over twice its extent, or the unit disc.
fn patch(x: &Axis, y: &Axis, alignment: &Alignment) -> Patch {
    let mut patch = Patch::of_table(x, y, alignment);
    // The unit disc in aligned coordinates reaches as far as the rows of the matrix are long.
    for (k, (n, row)) in [x.count, y.count].into_iter().zip(alignment.matrix).enumerate() {
        let reach = row[0].hypot(row[1]);
        let step = patch.step[k];
        let most = (2.0 * reach / step.abs()).ceil().max(1.0) as usize;
        patch.count[k] = (2 * n).min(most).max(1);
        patch.from[k] = -0.5 * (patch.count[k] as f64 - 1.0) * step;
    }
    patch
}

/// Σ over orientations of |transform of the patch|². Two patches share one complex transform: the
/// even part of |F(a + ib)|² is |F(a)|² + |F(b)|², and the odd part is lost when R is made even.
fn power_spectrum(
    patch: &Patch,
    transform: &Transform,
    sampler: Sampler<'_>,
    options: &NormOptions,
    environment: usize,
) -> Vec<Complex<f64>> {
    const AT_ONCE: usize = 8;
    let size = transform.width * transform.height;
    let mut sum = vec![Complex::new(0.0, 0.0); size];
    let pairs: Vec<usize> = (0..options.orientations.div_ceil(2)).collect();
    for some in pairs.chunks(AT_ONCE) {
        let spectra: Vec<Vec<Complex<f64>>> = some
            .par_iter()
            .map(|pair| {
                let of = |k: usize| {
                    let index = 2 * pair + k;
                    let at = environment * options.orientations + index;
                    (index < options.orientations)
                        .then(|| patch.radiance(sampler, &frame(options.seed, at)))
                };
                let (first, second) = (of(0), of(1));
                let value = |list: &Option<Vec<f64>>, i: usize| {
                    list.as_ref().and_then(|l| l.get(i)).copied().unwrap_or(0.0)
                };
                transform.of(patch.count, |iy, ix| {
                    let i = iy * patch.count[0] + ix;
                    Complex::new(value(&first, i), value(&second, i))
                })
            })
            .collect();
        for spectrum in &spectra {
            for (slot, value) in sum.iter_mut().zip(spectrum) {
                slot.re += value.norm_sqr();
            }
        }
    }
    sum
}

/// Error of what is seen under one environment: √(Σ (Σ_h w (S − Ŝ) E)²/Σ (Σ_h w S E)²) over
/// `orientations` random frames and all channels, with w = (1 + ω_i·ω_o)²/4, E the radiance of that
/// channel (luminance for a channel that is not R, G or B) and every texel lit from its own
/// direction. Independent of [`ConvolutionNorm`]: no shift, no autocorrelation.
///
/// # Errors
/// [`LowRankError::Unusable`] for texels that are missing, negative or not finite, and if the factors
/// have other channels or axes.
pub fn seen_error(
    table: &Grid,
    factors: &LowRank,
    environment: &Environment,
    orientations: usize,
    seed: u64,
) -> Result<f64, LowRankError> {
    let pairs = factors.matched(table)?;
    let weight = super::Weight::of_incidence(table.x(), table.y(), &factors.alignment);
    let patch = Patch::of_table(table.x(), table.y(), &factors.alignment);
    let mut squares = (0.0, 0.0);
    for (channel, terms) in pairs {
        let radiance = match channel.name.as_str() {
            "R" => Radiance::Red,
            "G" => Radiance::Green,
            "B" => Radiance::Blue,
            _ => Radiance::Luminance,
        };
        let sampler = Sampler::new(environment, radiance)?;
        let s = of_channel(table, channel);
        let d = terms.residual(&s);
        let seen: Vec<(f64, f64)> = (0..orientations)
            .into_par_iter()
            .map(|index| {
                let light = patch.radiance(sampler, &frame(seed, index));
                let lit = |m: &Mat<f64>| -> f64 {
                    let rows = light.chunks(table.x().count).enumerate();
                    rows.map(|(i, row)| {
                        let texels = row.iter().enumerate();
                        texels.map(|(j, e)| weight.root(i, j) * m[(i, j)] * e).sum::<f64>()
                    })
                    .sum()
                };
                (lit(&d).powi(2), lit(&s).powi(2))
            })
            .collect();
        for (error, whole) in seen {
            squares.0 += error;
            squares.1 += whole;
        }
    }
    Ok(if squares.1 == 0.0 { 0.0 } else { (squares.0 / squares.1).sqrt() })
}
