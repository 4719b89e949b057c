//! The far field of a phase screen: where its power goes, by a fast Fourier transform.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | λ, k | `wavelength_nm`, 2π/λ | nm | wavelength |
//! | w | `w` | 1 | ω_i·n + ω_o·n, 2 at normal incidence and exitance |
//! | f | | µm⁻¹ | spatial frequency; it leaves in the direction h = λ f |
//! | a, h | [`PreparedHeights`] | 1, nm | amplitude and height |
//! | N_x, N_y | `nx`, `ny` | 1 | samples of the transform, with padding |
//!
//! With n_x n_y samples of mean square 1 and zeros around them, |Σ a e^(−ikwh) e^(−2πi f·x)|²/(n_x n_y N_x N_y)
//! is the power of the cell of Δf_x Δf_y around f: the discrete form of |P(f)|²/A · Δf_x Δf_y. Over
//! all cells it sums to 1 exactly, for every padding.

use std::sync::Arc;

use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use super::DiffractionError;
use super::preparation::{MOST_SAMPLES, PreparedHeights};
use super::resample::Cells;

/// Power over cells of spatial frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct FarField {
    /// Cells along f_x, in µm⁻¹.
    pub x: Cells,
    /// Cells along f_y, in µm⁻¹.
    pub y: Cells,
    /// Share of the reflected power per cell, row-major from the lowest frequencies; sums to 1.
    pub power: Vec<f64>,
    /// Wavelength, nm.
    pub wavelength_nm: f64,
}

/// Transforms for screens of one size.
pub struct FarFieldTransform {
    nx: usize,
    ny: usize,
    along_x: Arc<dyn Fft<f64>>,
    along_y: Arc<dyn Fft<f64>>,
}

impl FarFieldTransform {
    /// For a surface padded to `padding` times its samples along each side that has more than one.
    ///
    /// # Errors
    /// [`DiffractionError::OutOfRange`] if padding is 0 or the padded surface is larger than
    /// [`MOST_SAMPLES`].
    pub fn new(surface: &PreparedHeights, padding: usize) -> Result<Self, DiffractionError> {
        let padded = |n: usize| if n > 1 { n.saturating_mul(padding) } else { 1 };
        let (nx, ny) = (padded(surface.nx), padded(surface.ny));
        if padding == 0 || nx.saturating_mul(ny) > MOST_SAMPLES {
            return Err(DiffractionError::OutOfRange {
                quantity: "padding",
                got: padding as f64,
                unit: "1",
                expected: "1 or more, and at most 2^25 samples with it",
            });
        }
        let mut planner = FftPlanner::new();
        let (along_x, along_y) = (planner.plan_fft_forward(nx), planner.plan_fft_forward(ny));
        Ok(Self { nx, ny, along_x, along_y })
    }

    /// The far field of the surface that the transform was made for.
    ///
    /// The phase is −k w h: with exp(−2πi f·x) beside it, a slope s sends light to h = −w s, where a
    /// mirror of that slope does. With +k w h the pattern would be turned by 180°.
    pub fn far_field(&self, surface: &PreparedHeights, wavelength_nm: f64, w: f64) -> FarField {
        let (nx, ny) = (self.nx, self.ny);
        let k = std::f64::consts::TAU / wavelength_nm;
        let mut rows = vec![Complex64::default(); nx * surface.ny];
        rows.par_chunks_mut(nx).enumerate().for_each(|(y, row)| {
            let at = y * surface.nx..(y + 1) * surface.nx;
            let screen = surface.height_nm[at.clone()].iter().zip(&surface.amplitude[at]);
            for (value, (h, a)) in row.iter_mut().zip(screen) {
                let (sin, cos) = core_math::sincos(-k * w * h);
                *value = Complex64::new(a * cos, a * sin);
            }
            self.along_x.process(row);
        });
        let scale = 1.0 / (surface.nx * surface.ny) as f64 / (nx * ny) as f64;
        let cells: Vec<usize> = (0..nx).map(|cell| from_lowest(cell, nx)).collect();
        // Columns side by side, so that what is read of a row lies in few lines of the cache.
        let columns: Vec<Vec<f64>> = cells
            .par_chunks(16)
            .flat_map_iter(|cells| {
                let mut columns = vec![vec![Complex64::default(); ny]; cells.len()];
                for (y, row) in rows.chunks(nx).enumerate() {
                    columns.iter_mut().zip(cells).for_each(|(column, at)| column[y] = row[*at]);
                }
                columns.into_iter().map(|mut column| {
                    self.along_y.process(&mut column);
                    (0..ny).map(|cell| column[from_lowest(cell, ny)].norm_sqr() * scale).collect()
                })
            })
            .collect();
        let mut power = vec![0.0; nx * ny];
        power.par_chunks_mut(nx).enumerate().for_each(|(y, row)| {
            row.iter_mut().zip(&columns).for_each(|(power, column)| *power = column[y]);
        });
        FarField {
            x: Cells::around_zero(nx, 1.0 / (nx as f64 * surface.dx_um)),
            y: Cells::around_zero(ny, 1.0 / (ny as f64 * surface.dy_um)),
            power,
            wavelength_nm,
        }
    }
}

/// Place in a transform of the cell that is `cell`-th from the lowest frequency.
fn from_lowest(cell: usize, n: usize) -> usize {
    (cell + n - n / 2) % n
}

impl FarField {
    /// The cells along x and y in terms of h = λ f.
    pub fn cells(&self) -> [Cells; 2] {
        let wavelength_um = 1e-3 * self.wavelength_nm;
        [self.x.scaled(wavelength_um), self.y.scaled(wavelength_um)]
    }

    /// Sum of all powers: 1 but for rounding.
    pub fn total(&self) -> f64 {
        crate::numeric::statistics::sum(self.power.iter().copied())
    }

    /// Share of the power with f inside `inside`, by the centres of the cells, µm⁻¹.
    pub fn share(&self, inside: impl Fn(f64, f64) -> bool + Sync) -> f64 {
        let fx: Vec<f64> = (0..self.x.count).map(|i| self.x.centre(i)).collect();
        let rows = self.power.par_chunks(self.x.count.max(1)).enumerate();
        let kept: Vec<f64> = rows
            .flat_map_iter(|(y, row)| {
                let (fy, inside) = (self.y.centre(y), &inside);
                row.iter().zip(&fx).filter(move |(_, fx)| inside(**fx, fy)).map(|(p, _)| *p)
            })
            .collect();
        crate::numeric::statistics::sum(kept)
    }

    /// The strongest of the cells that are `allowed`, by place along x and y: its power and place, power
    /// 0 if there is none.
    pub(super) fn strongest(&self, allowed: impl Fn(usize, usize) -> bool) -> (f64, usize, usize) {
        let mut best = (0.0, 0, 0);
        for (y, row) in self.power.chunks(self.x.count).enumerate() {
            for (x, power) in row.iter().enumerate() {
                if *power > best.0 && allowed(x, y) {
                    best = (*power, x, y);
                }
            }
        }
        best
    }

    /// Share of the power beyond |h| = 1, which no direction of light has: evanescent in Kirchhoff's
    /// approximation at normal exitance.
    pub fn evanescent(&self) -> f64 {
        let wavelength_um = 1e-3 * self.wavelength_nm;
        self.share(|fx, fy| {
            let square = wavelength_um * wavelength_um * (fx * fx + fy * fy);
            // The slow function where rounding could decide.
            let near = (square - 1.0).abs() < 1e-12;
            if near { wavelength_um * fx.hypot(fy) > 1.0 } else { square > 1.0 }
        })
    }
}
