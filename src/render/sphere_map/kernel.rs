//! A diffraction table over the two angles of the passes.

use crate::factor::{Alignment, LowRank};
use crate::table::{Axis, Channel, Grid};

use super::Taps;

/// A table times the geometric factor and the Jacobian, over two angles: what a convolution under
/// n = ω_o = r_v sums (see [`crate::render::sphere_map`]).
#[derive(Debug, Clone, PartialEq)]
pub struct AngularKernel {
    /// Axes `s_x` and `s_y` in rad, channels `R`, `G`, `B` in sr⁻¹ per cos: the sum over the grid
    /// times the area of a cell is the sum of the weights.
    pub grid: Grid,
    /// Directions in h along which the two angles run, unit vectors.
    pub directions: [[f64; 2]; 2],
}

impl AngularKernel {
    /// Resamples the table `grid` (axes h_x and h_y, channels R, G, B) about h = 0, by the mean over
    /// 3 × 3 points per cell of what is linear between its texels.
    pub fn new(grid: &Grid, alignment: &Alignment) -> Self {
        let inverse = alignment.inverse();
        let directions = [[inverse[0][0], inverse[1][0]], [inverse[0][1], inverse[1][1]]];
        let axis = |name: &str, of: &Axis| Axis {
            name: name.into(),
            unit: "rad".into(),
            from: of.from.clamp(-1.0, 1.0).asin(),
            to: of.to.clamp(-1.0, 1.0).asin(),
            count: of.count,
        };
        let (x, y) = (axis("s_x", &grid.x), axis("s_y", &grid.y));
        let channels = ["R", "G", "B"].map(|name| Channel {
            name: name.into(),
            unit: "1".into(),
            values: Vec::with_capacity(x.count * y.count),
        });
        let mut kernel = Self {
            grid: Grid { x, y, channels: channels.into(), origin: grid.origin.clone() },
            directions,
        };
        let sources: Vec<&[f32]> = ["R", "G", "B"]
            .iter()
            .map(|name| grid.channel(name).map_or(&[][..], |c| c.values.as_slice()))
            .collect();
        let (x, y) = (kernel.grid.x.clone(), kernel.grid.y.clone());
        for iy in 0..y.count {
            for ix in 0..x.count {
                let mut sum = [0.0; 3];
                for sub in 0..9 {
                    let within = |axis: &Axis, at: usize, sub: usize| {
                        axis.from
                            + (at as f64 + (sub as f64 + 0.5) / 3.0) * (axis.to - axis.from)
                                / axis.count as f64
                    };
                    let (s_x, s_y) = (within(&x, ix, sub % 3), within(&y, iy, sub / 3));
                    let (h, weight) = kernel.at(s_x, s_y);
                    let place = (grid.x.texel(h[0]), grid.y.texel(h[1]));
                    for (sum, source) in sum.iter_mut().zip(&sources) {
                        *sum += weight * bilinear(source, grid.x.count, grid.y.count, place) / 9.0;
                    }
                }
                for (channel, value) in kernel.grid.channels.iter_mut().zip(sum) {
                    channel.values.push(value as f32);
                }
            }
        }
        kernel
    }

    /// h at two angles, and ((1 + c)/2)² |dh/ds| / c there.
    fn at(&self, s_x: f64, s_y: f64) -> ([f64; 2], f64) {
        let [first, second] = self.directions;
        let (along, beside) = (s_x.sin(), s_x.cos() * s_y.sin());
        let h = [0, 1].map(|at| along * first[at] + beside * second[at]);
        let square = h[0] * h[0] + h[1] * h[1];
        if square >= 1.0 {
            return (h, 0.0);
        }
        let c = (1.0 - square).sqrt();
        let skew = (first[0] * second[1] - first[1] * second[0]).abs();
        let jacobian = skew * s_x.cos() * s_x.cos() * s_y.cos();
        // At right angles c = cos s_x cos s_y, and the quotient is cos s_x up to the horizon.
        (h, 0.25 * (1.0 + c) * (1.0 + c) * jacobian / c.max(1e-3))
    }

    /// One tap per cell.
    pub fn taps(&self) -> Taps {
        let grid = &self.grid;
        let mut taps = Taps::default();
        let cell = self.cell();
        for iy in 0..grid.y.count {
            for ix in 0..grid.x.count {
                let (h, _) = self.at(grid.x.centre(ix), grid.y.centre(iy));
                let at = iy * grid.x.count + ix;
                let mut weight = [0.0; 3];
                for (weight, channel) in weight.iter_mut().zip(&grid.channels) {
                    *weight = cell * channel.values.get(at).map_or(0.0, |v| f64::from(*v));
                }
                let out = (1.0 - h[0] * h[0] - h[1] * h[1]).max(0.0).sqrt();
                taps.push([h[0], h[1], out], weight);
            }
        }
        taps
    }

    /// The taps of the two passes of every term of `factors`, which were made from this grid:
    /// (first pass, second pass).
    pub fn passes(&self, factors: &LowRank) -> Vec<(Taps, Taps)> {
        let terms = factors.channels.iter().map(|c| c.vertical.len()).min().unwrap_or(0);
        let step = |axis: &Axis| ((axis.to - axis.from) / axis.count as f64).abs();
        let along = |axis: &Axis, direction: [f64; 2], values: &dyn Fn(usize, usize) -> f64| {
            let mut taps = Taps::default();
            for at in 0..axis.count {
                let (sin, cos) = axis.centre(at).sin_cos();
                let weight = [0, 1, 2].map(|channel| values(channel, at) * step(axis));
                taps.push([sin * direction[0], sin * direction[1], cos], weight);
            }
            taps
        };
        let [first, second] = self.directions;
        (0..terms)
            .map(|term| {
                let of = |lists: fn(&crate::factor::ChannelFactors) -> &Vec<Vec<f64>>| {
                    move |channel: usize, at: usize| {
                        let channel = factors.channels.get(channel);
                        channel.and_then(|c| lists(c).get(term)?.get(at).copied()).unwrap_or(0.0)
                    }
                };
                let horizontal = along(&self.grid.x, first, &of(|c| &c.horizontal));
                let vertical = along(&self.grid.y, second, &of(|c| &c.vertical));
                (horizontal, vertical)
            })
            .collect()
    }

    /// Area of a cell, rad².
    pub fn cell(&self) -> f64 {
        let step = |axis: &Axis| (axis.to - axis.from) / axis.count as f64;
        (step(&self.grid.x) * step(&self.grid.y)).abs()
    }

    /// Sum of the weights of R, G, B: the radiance in an environment of radiance 1.
    pub fn albedo(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (sum, channel) in sums.iter_mut().zip(&self.grid.channels) {
            *sum = self.cell() * channel.values.iter().map(|v| f64::from(*v)).sum::<f64>();
        }
        sums
    }
}

/// Bilinear between texel centres, 0 outside.
pub(super) fn bilinear(values: &[f32], nx: usize, ny: usize, (x, y): (f64, f64)) -> f64 {
    let (left, top) = (x.floor(), y.floor());
    let (u, v) = (x - left, y - top);
    let at = |ix: f64, iy: f64| {
        if ix < 0.0 || iy < 0.0 || ix >= nx as f64 || iy >= ny as f64 {
            return 0.0;
        }
        values.get(iy as usize * nx + ix as usize).map_or(0.0, |value| f64::from(*value))
    };
    (at(left, top) * (1.0 - u) + at(left + 1.0, top) * u) * (1.0 - v)
        + (at(left, top + 1.0) * (1.0 - u) + at(left + 1.0, top + 1.0) * u) * v
}
