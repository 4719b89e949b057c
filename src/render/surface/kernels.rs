//! A diffraction table and what is made of it before anything is rendered.

use std::fmt::Display;

use crate::effects::diffraction::{self, OrderGrowth};
use crate::factor::{
    Alignment, ConvolutionNorm, ConvolvedOptions, Decomposition, DirectionalKernel, LowRank,
    NormOptions, SearchOptions, convolved, directional, main_directions,
};
use crate::measured::MeasuredError;
use crate::measured::environment::Environment;
use crate::measured::spectra::Spectra;
use crate::render::RenderError;
use crate::render::scene::TableSource;
use crate::render::sphere_map::{AngularKernel, Taps, along};
use crate::table::Grid;

use super::orders::{Orders, zero_order_shares};

/// Share of |S| that sums over a reconstructed table leave out.
const LEFT_OUT: f64 = 1e-3;
/// Half width of a line of the sum of directional blurs, in texels of the table.
const LINE_HALF_WIDTH: f64 = 4.0;

/// A diffraction table with its kernels.
#[derive(Debug, Clone)]
pub struct DiffractionKernels {
    /// S_d over h_x and h_y, channels R, G, B.
    pub table: Grid,
    /// Its orders, for sums at every point.
    pub orders: Orders,
    /// Directions along which it is factorised.
    pub alignment: Alignment,
    /// It over the angles of the passes.
    pub angular: AngularKernel,
    decomposition: Decomposition,
}

impl DiffractionKernels {
    /// Reads or simulates a table and, with `align`, straightens it.
    ///
    /// # Errors
    /// [`RenderError`]: a table that does not load or has other axes or channels, settings that the
    /// simulator refuses, or one that cannot be factorised.
    pub fn new(source: &TableSource, align: bool, spectra: &Spectra) -> Result<Self, RenderError> {
        let (table, growth) = table(source, spectra)?;
        let alignment = if align {
            main_directions(&table, &SearchOptions::default())?.alignment
        } else {
            Alignment::identity()
        };
        let angular = AngularKernel::new(&table, &alignment, &growth);
        let decomposition = Decomposition::of_aligned(&angular.grid, alignment)?;
        let orders = Orders::of_table(&table, growth);
        Ok(Self { table, orders, alignment, angular, decomposition })
    }

    /// Factors of the kernel by singular value decomposition.
    ///
    /// # Errors
    /// [`RenderError::LowRank`]: a rank above that of the table.
    pub fn factors(&self, rank: usize) -> Result<LowRank, RenderError> {
        Ok(self.decomposition.low_rank(rank)?)
    }

    /// Factors of the kernel of least error after convolution with `environments`.
    ///
    /// # Errors
    /// [`RenderError::LowRank`]: a rank above that of the table, environments without light.
    pub fn factors_after_convolution(
        &self,
        rank: usize,
        environments: &[Environment],
    ) -> Result<LowRank, RenderError> {
        let grid = &self.angular.grid;
        let options = NormOptions { alignment: self.alignment, ..NormOptions::default() };
        let norm = ConvolutionNorm::from_environments(environments, grid.x(), grid.y(), &options)?;
        let fitted = convolved(grid, self.alignment, rank, &norm, &ConvolvedOptions::default())?;
        Ok(fitted.0)
    }

    /// The taps of two directional blurs over a map: the kernel integrated across its two axes.
    ///
    /// # Errors
    /// As [`directional`].
    pub fn blurs(&self) -> Result<Taps, RenderError> {
        let axes = [[1.0, 0.0], [0.0, 1.0]];
        let width = LINE_HALF_WIDTH * self.angular.grid.x().step().abs();
        let lines = directional(&self.angular.grid, &axes, width)?;
        let mut taps = Taps::default();
        for (line, direction) in lines.kernels.iter().zip(self.angular.directions) {
            taps.push_line(&line.axis, along(direction), profiles(line));
        }
        Ok(taps)
    }

    /// The orders of one blur along the first direction of a surface: the table integrated across it.
    ///
    /// # Errors
    /// As [`directional`].
    pub fn line(&self) -> Result<Orders, RenderError> {
        let lines = directional(&self.table, &[[1.0, 0.0]], f64::INFINITY)?;
        let mut taps = Taps::default();
        for line in &lines.kernels {
            let ([x, y], step) = (line.direction, line.axis.step().abs());
            let zero_order = zero_order_shares(&line.axis);
            let profiles = [0, 1, 2].map(|channel| -> Vec<f64> {
                let density = self.orders.growth.zero_order[channel] / step;
                let values = profiles(line)[channel].iter().zip(&zero_order);
                values.map(|(value, share)| value - share * density).collect()
            });
            let profiles = profiles.each_ref().map(Vec::as_slice);
            taps.push_line(&line.axis, |h| [h * x, h * y, step], profiles);
        }
        Ok(self.orders.by(taps))
    }

    /// The orders of the table that factors of rank `rank` of it give.
    ///
    /// # Errors
    /// [`RenderError::LowRank`]: a rank above that of the table.
    pub fn reconstructed(&self, rank: usize) -> Result<Orders, RenderError> {
        let factors = Decomposition::of(&self.table)?.low_rank(rank)?;
        let table = factors.to_grid(self.table.x(), self.table.y())?;
        Ok(self.orders.by(self.orders.taps_of(&table)).thinned(LEFT_OUT))
    }
}

/// What a line has in the first three channels of its table: R, G, B.
fn profiles(line: &DirectionalKernel) -> [&[f64]; 3] {
    [0, 1, 2].map(|channel| line.channels[channel].1.as_slice())
}

/// Reads or simulates a table and checks its axes and channels; how its orders grow with w is known of
/// simulated heights.
fn table(source: &TableSource, spectra: &Spectra) -> Result<(Grid, OrderGrowth), RenderError> {
    let (grid, growth) = match source {
        TableSource::File(path) => {
            (Grid::read_exr(path).map_err(MeasuredError::from)?, OrderGrowth::unknown())
        }
        TableSource::Simulated(settings) => {
            let refused = |error: &dyn Display| RenderError::Unusable(error.to_string());
            let settings = diffraction::settings(settings).map_err(|error| refused(&error))?;
            diffraction::simulated_table(&settings, spectra).map_err(|error| refused(&error))?
        }
    };
    grid.check_plane().map_err(MeasuredError::from)?;
    for (axis, name) in [(grid.x(), "h_x"), (grid.y(), "h_y")] {
        if axis.name != name || axis.unit != "1" {
            return Err(RenderError::Unusable(format!(
                "{}: expected an axis {name} [1], got {} [{}]",
                grid.origin, axis.name, axis.unit
            )));
        }
    }
    for channel in ["R", "G", "B"] {
        grid.require(channel).map_err(MeasuredError::from)?;
    }
    Ok((grid, growth))
}
