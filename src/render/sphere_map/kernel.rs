//! A diffraction table over the two angles of the passes.

use crate::effects::diffraction::OrderGrowth;
use crate::factor::{Alignment, ChannelFactors, LowRank};
use crate::table::{Axis, Grid, GridChannel, centres};

use super::Taps;
use crate::render::surface::zero_order_shares;

/// The channels of a kernel.
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Parts of a texel along each side that are taken to angles one by one.
const PARTS: usize = 4;

/// Where a move by an angle along a direction of h leads from the outward direction.
pub(in crate::render) fn along([x, y]: [f64; 2]) -> impl Fn(f64) -> [f64; 3] {
    move |angle| {
        let (sin, cos) = angle.sin_cos();
        [sin * x, sin * y, cos]
    }
}

/// A table over two angles: what a convolution under
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
    /// Takes the table `grid` (axes h_x and h_y, channels R, G, B) to angles by area, with `growth` at the
    /// w of normal exitance. Nothing is lost: what lies beyond the horizon, and what orders lose at their
    /// w, is the mirror's.
    pub fn new(grid: &Grid, alignment: &Alignment, growth: &OrderGrowth) -> Self {
        let axis = |name: &str, of: &Axis| {
            let edges = [of.from, of.to].map(|h| h.clamp(-1.0, 1.0).asin());
            Axis::new(name, "rad", edges, of.count)
        };
        let axes = vec![axis("s_x", grid.x()), axis("s_y", grid.y())];
        let directions = alignment.directions();
        let mut shares = vec![[0.0; 3]; axes[0].count * axes[1].count];
        let sources = CHANNELS.map(|name| grid.channel(name));
        let zero_order = [grid.x(), grid.y()].map(zero_order_shares);
        let area = (grid.x().step() * grid.y().step()).abs();
        let mut left = [0.0; 3];
        for (at, _) in centres(grid.x(), grid.y()).enumerate() {
            let [ix, iy] = [at % grid.x().count, at / grid.x().count];
            let of_zero_order = zero_order[0][ix] * zero_order[1][iy];
            let all = [0, 1, 2].map(|channel| {
                let values = sources[channel].map_or(&[][..], |source| &source.values);
                area * values.get(at).map_or(0.0, |value| f64::from(*value))
            });
            left.iter_mut().zip(all).for_each(|(left, all)| *left += all);
            for part in 0..PARTS * PARTS {
                let within =
                    |texel: usize, part: usize| texel as f64 + (part as f64 + 0.5) / PARTS as f64;
                let h =
                    [grid.x().at(within(ix, part % PARTS)), grid.y().at(within(iy, part / PARTS))];
                let Some((angles, c)) = angles(h, directions) else { continue };
                let factor = growth.at(1.0 + c);
                let orders = [0, 1, 2].map(|channel| {
                    let zero_order = of_zero_order * growth.zero_order[channel];
                    (all[channel] - zero_order) * factor[channel] / (PARTS * PARTS) as f64
                });
                left.iter_mut().zip(orders).for_each(|(left, order)| *left -= order);
                let width = [grid.x(), grid.y()].map(|axis| axis.step().abs() / PARTS as f64);
                spread(&mut shares, &axes, angles, width, orders);
            }
        }
        let [beside, ahead] = [0, 1].map(|at| zero_order_shares(&axes[at]));
        for (iy, ahead) in ahead.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            for (ix, beside) in beside.iter().enumerate() {
                let cell = shares[iy * axes[0].count + ix].iter_mut();
                cell.zip(left).for_each(|(cell, left)| *cell += ahead * beside * left);
            }
        }
        let cell = (axes[0].step() * axes[1].step()).abs();
        let channels = [0, 1, 2].map(|channel| {
            let values = shares.iter().map(|share| (share[channel] / cell) as f32).collect();
            GridChannel::new(CHANNELS[channel], "1", values)
        });
        let grid = Grid { axes, channels: channels.into(), origin: grid.origin.clone() };
        Self { grid, directions }
    }

    /// h at two angles.
    fn at(&self, s_x: f64, s_y: f64) -> [f64; 2] {
        let [first, second] = self.directions;
        let (along, beside) = (s_x.sin(), s_x.cos() * s_y.sin());
        [0, 1].map(|at| along * first[at] + beside * second[at])
    }

    /// One tap per cell.
    pub fn taps(&self) -> Taps {
        let grid = &self.grid;
        let mut taps = Taps::default();
        let cell = self.cell();
        for (at, [s_x, s_y]) in centres(grid.x(), grid.y()).enumerate() {
            let h = self.at(s_x, s_y);
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

/// The two angles of h along `directions`, and c; none beyond the horizon.
fn angles(h: [f64; 2], [first, second]: [[f64; 2]; 2]) -> Option<([f64; 2], f64)> {
    let square = h[0] * h[0] + h[1] * h[1];
    let skew = first[0] * second[1] - first[1] * second[0];
    let along = (h[0] * second[1] - h[1] * second[0]) / skew;
    let beside = (first[0] * h[1] - first[1] * h[0]) / skew;
    let s_x = along.asin();
    let s_y = (beside / s_x.cos()).asin();
    let inside = square < 1.0 && s_x.is_finite() && s_y.is_finite();
    inside.then(|| ([s_x, s_y], (1.0 - square).max(0.0).sqrt()))
}

/// Adds `share` to the cells under a part of a texel, `width` across in h, by area; what reaches over the
/// edge goes to the outermost cells.
fn spread(
    shares: &mut [[f64; 3]],
    axes: &[Axis],
    angles: [f64; 2],
    width: [f64; 2],
    share: [f64; 3],
) {
    let cos = [angles[0].cos(), angles[0].cos() * angles[1].cos()];
    let [beside, ahead] = [0, 1].map(|at| {
        let axis = &axes[at];
        let half = 0.5 * width[at] / cos[at].max(width[at]);
        let place = |angle: f64| (angle - axis.from) / axis.step();
        overlaps(place(angles[at] - half), place(angles[at] + half), axis.count)
    });
    for (iy, ahead) in ahead {
        for &(ix, beside) in &beside {
            let cell = shares[iy * axes[0].count + ix].iter_mut();
            cell.zip(share).for_each(|(cell, share)| *cell += ahead * beside * share);
        }
    }
}

/// The cells of `count` that [low, high] lies over, each with its part of it.
fn overlaps(low: f64, high: f64, count: usize) -> Vec<(usize, f64)> {
    let last = count.saturating_sub(1);
    let cell = |place: f64| (place.floor().max(0.0) as usize).min(last);
    let of = |at: usize| {
        let from = if at == 0 { low } else { low.max(at as f64) };
        let to = if at == last { high } else { high.min((at + 1) as f64) };
        (at, (to - from).max(0.0) / (high - low))
    };
    (cell(low)..=cell(high)).map(of).collect()
}
