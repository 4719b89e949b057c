//! A diffraction table over the two angles of the passes.

use crate::factor::{Alignment, ChannelFactors, LowRank};
use crate::table::{Axis, Edge, Grid, GridChannel, centres};

use super::Taps;

/// The channels of a kernel.
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Where a move by an angle along a direction of h leads from the outward direction.
pub(in crate::render) fn along([x, y]: [f64; 2]) -> impl Fn(f64) -> [f64; 3] {
    move |angle| {
        let (sin, cos) = angle.sin_cos();
        [sin * x, sin * y, cos]
    }
}

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
        let axis = |name: &str, of: &Axis| {
            let edges = [of.from, of.to].map(|h| h.clamp(-1.0, 1.0).asin());
            Axis::new(name, "rad", edges, of.count)
        };
        let (x, y) = (axis("s_x", grid.x()), axis("s_y", grid.y()));
        let channels = CHANNELS.map(|name| GridChannel::new(name, "1", Vec::new()));
        let axes = vec![x.clone(), y.clone()];
        let mut kernel = Self {
            grid: Grid { axes, channels: channels.into(), origin: grid.origin.clone() },
            directions: alignment.directions(),
        };
        let sources = CHANNELS.map(|name| grid.channel(name));
        for iy in 0..y.count {
            for ix in 0..x.count {
                let mut sum = [0.0; 3];
                for sub in 0..9 {
                    let within = |axis: &Axis, texel: usize, sub: usize| {
                        axis.at(texel as f64 + (sub as f64 + 0.5) / 3.0)
                    };
                    let (h, weight) = kernel.at(within(&x, ix, sub % 3), within(&y, iy, sub / 3));
                    for (sum, source) in sum.iter_mut().zip(sources) {
                        let value = source.map_or(0.0, |c| grid.sample(c, &h, Edge::Fading));
                        *sum += weight * value / 9.0;
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
        for (at, [s_x, s_y]) in centres(grid.x(), grid.y()).enumerate() {
            let (h, _) = self.at(s_x, s_y);
            let weight = [0, 1, 2].map(|c| cell * f64::from(grid.channels[c].values[at]));
            let out = (1.0 - h[0] * h[0] - h[1] * h[1]).max(0.0).sqrt();
            taps.push([h[0], h[1], out], weight);
        }
        taps
    }

    /// The taps of every term of `factors`, which were made from this grid, in the first pass and in
    /// the second.
    pub fn passes(&self, factors: &LowRank) -> [Vec<Taps>; 2] {
        let pass = |at: usize, lists: fn(&ChannelFactors) -> &[Vec<f64>]| {
            let channels = [0, 1, 2].map(|channel| lists(&factors.channels[channel]));
            let terms = 0..channels.map(<[_]>::len).into_iter().min().unwrap_or(0);
            let taps = terms.map(|term| {
                let mut taps = Taps::default();
                let place = along(self.directions[at]);
                taps.push_line(&self.grid.axes[at], place, channels.map(|c| c[term].as_slice()));
                taps
            });
            taps.collect()
        };
        [pass(0, |c| &c.horizontal), pass(1, |c| &c.vertical)]
    }

    /// Area of a cell, rad².
    pub fn cell(&self) -> f64 {
        (self.grid.x().step() * self.grid.y().step()).abs()
    }

    /// Sum of the weights of R, G, B: the radiance in an environment of radiance 1.
    pub fn albedo(&self) -> [f64; 3] {
        let sum = |values: &[f32]| values.iter().map(|value| f64::from(*value)).sum::<f64>();
        [0, 1, 2].map(|channel| self.cell() * sum(&self.grid.channels[channel].values))
    }
}
