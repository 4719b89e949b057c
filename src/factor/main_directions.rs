//! The two main directions of a pattern (toisoul2017 §4.2).
//!
//! The paper looks for the two rays from the specular lobe along which the green channel sums to
//! most, at least a given angle apart. Here both halves of a line count, as a pattern seen at normal
//! incidence is even in h, and all pairs of lines are compared. The pair is then refined: the lines
//! about which most of Σ S² lies, each texel weighed by a Gaussian of its distance from the line. An
//! order of magnitude A at distance r then pulls with A² r², as in a least-squares fit of the order's
//! place, and any order that is symmetric about the line leaves the maximum on it.
//!
//! The angles that leave least beyond the first singular value of the aligned table are another
//! choice, and were tried: they are off by up to 0.27° where round orders stand on skewed lines,
//! since the shear of a round order is of no low rank, and by up to 1.2° with noise of 2 %.

use std::f64::consts::{FRAC_PI_2, PI};

use argmin::core::{CostFunction, Error, Executor, IterState, State};
use argmin::solver::neldermead::NelderMead;
use faer::Mat;
use nalgebra::DVector;
use rayon::prelude::*;

use super::alignment::bicubic;
use super::{Alignment, LowRankError};
use crate::table::{Axis, Edge, Grid, GridChannel, centres};

/// How the directions are searched.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchOptions {
    /// Channel that is summed; without one `G` if the table has it, else the sum of all.
    pub channel: Option<String>,
    /// Least angle between the two lines, rad; the paper's 60°.
    pub minimum_angle_rad: f64,
    /// Radius of the specular lobe, in the table's coordinates, that the sums leave out; without
    /// one 1/20 of half the smaller side.
    pub central_radius: Option<f64>,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self { channel: None, minimum_angle_rad: PI / 3.0, central_radius: None }
    }
}

/// What the search found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MainDirections {
    /// Angles in h of the directions that become the x and the y axis, rad: of the four ways to
    /// name two lines, that with the least turning of the axes in sum.
    pub angles_rad: [f64; 2],
    /// Main directions before the refinement, rad.
    pub searched_rad: [f64; 2],
    /// What of ‖S‖² is beyond the first singular value: unaligned, as searched, and refined.
    pub beyond_rank_one: [f64; 3],
    /// Whether at least as much of Σ S² lies about the line that becomes the x axis as about the
    /// other.
    pub brighter_is_x: bool,
    /// The map of the refined angles.
    pub alignment: Alignment,
}

/// Lines over half a turn in the search: a quarter of a degree apart.
const LINES: usize = 720;
/// First edges of the simplices of the refinement, rad.
const EDGES_RAD: [f64; 2] = [4e-3, 5e-4];
/// Iterations of each.
const ITERATIONS: u64 = 60;
/// How far the refinement may go, rad.
const REACH_RAD: f64 = 0.05;
/// Standard deviation of a line's width in the refinement, in texels.
const WIDTH_TEXELS: f64 = 2.0;
/// Widths from a line at which a texel no longer counts.
const FAR: f64 = 5.0;
/// Steps of the power iteration for the first singular value.
const POWER_STEPS: usize = 40;

/// Finds the main directions of a table about h = 0.
///
/// # Errors
/// As [`Grid::check_plane`] and [`Grid::require`]; [`LowRankError::Setting`] unless the least angle is in
/// [1°, 90°] and h = 0 on the table with something of it outside the central radius;
/// [`LowRankError::AllZero`] if the channel is 0.
pub fn main_directions(
    table: &Grid,
    options: &SearchOptions,
) -> Result<MainDirections, LowRankError> {
    table.check_plane()?;
    let least = options.minimum_angle_rad;
    if !(PI / 180.0 * 0.999..=FRAC_PI_2).contains(&least) {
        let got = format!("{}°", least.to_degrees());
        return Err(LowRankError::setting("minimum angle", "1° to 90°", got));
    }
    let (plane, channel) = intensity(table, options.channel.as_deref())?;
    if channel.values.iter().all(|v| *v == 0.0) {
        return Err(LowRankError::AllZero { origin: table.origin.clone() });
    }
    let radius = radius(table)?;
    let central = options.central_radius.unwrap_or(radius / 20.0);
    if !(0.0..radius).contains(&central) {
        let expected = format!("0 to {radius}, half the smaller side");
        return Err(LowRankError::setting("central radius", expected, central.to_string()));
    }
    let sums: Vec<f64> = (0..LINES)
        .into_par_iter()
        .map(|k| line_sum(&plane, &channel, k as f64 * PI / LINES as f64, central, radius))
        .collect();
    let searched_rad = least_turned(best_pair(&sums, least));

    let orders = Orders::of(&plane, &channel, central, radius);
    let angles_rad = orders.refined(searched_rad);
    let beyond = |angles: [f64; 2]| beyond_rank_one(&plane, &channel, angles);
    Ok(MainDirections {
        brighter_is_x: orders.about(angles_rad[0]) >= orders.about(angles_rad[1]),
        angles_rad,
        searched_rad,
        beyond_rank_one: [beyond([0.0, FRAC_PI_2]), beyond(searched_rad), beyond(angles_rad)],
        alignment: Alignment::of_directions(angles_rad[0], angles_rad[1])?,
    })
}

/// The channel that is summed, alone on the table's axes.
fn intensity(table: &Grid, name: Option<&str>) -> Result<(Grid, GridChannel), LowRankError> {
    let values = match (name, table.channel("G")) {
        (Some(name), _) => table.require(name)?.values.clone(),
        (None, Some(green)) => green.values.clone(),
        (None, None) => {
            let mut sum = vec![0.0f32; table.texels()];
            for channel in &table.channels {
                for (slot, value) in sum.iter_mut().zip(&channel.values) {
                    *slot += value;
                }
            }
            sum
        }
    };
    let (axes, origin) = (table.axes.clone(), table.origin.clone());
    let plane = Grid { axes, channels: Vec::new(), origin };
    Ok((plane, GridChannel::new("intensity", "1", values)))
}

/// Half the smaller side about h = 0.
fn radius(table: &Grid) -> Result<f64, LowRankError> {
    let half = |axis: &Axis| {
        let (low, high) = (axis.from.min(axis.to), axis.from.max(axis.to));
        (-low).min(high)
    };
    let radius = half(table.x()).min(half(table.y()));
    if radius > 0.0 {
        return Ok(radius);
    }
    let (x, y) = (table.x(), table.y());
    let got = format!("{} to {}, {} to {}", x.from, x.to, y.from, y.to);
    Err(LowRankError::setting("axes", "h = 0 inside the table", got))
}

/// Σ along both halves of the line at `angle`, in steps of half a texel.
fn line_sum(plane: &Grid, channel: &GridChannel, angle: f64, central: f64, radius: f64) -> f64 {
    let step = 0.5 * plane.x().step().abs().min(plane.y().step().abs());
    let (sin, cos) = angle.sin_cos();
    let count = ((radius - central) / step).floor() as usize;
    (0..=count)
        .map(|k| {
            let r = central + k as f64 * step;
            let at = |r: f64| plane.sample(channel, &[r * cos, r * sin], Edge::Held);
            at(r) + at(-r)
        })
        .sum()
}

/// The two lines of the largest sum that are `least` apart; the first of several.
fn best_pair(sums: &[f64], least: f64) -> [f64; 2] {
    let step = PI / LINES as f64;
    let apart = ((least / step) - 1e-9).ceil() as usize;
    let mut best = (f64::NEG_INFINITY, [0.0, FRAC_PI_2]);
    for (i, a) in sums.iter().enumerate() {
        for (j, b) in sums.iter().enumerate().skip(i + apart) {
            if j - i <= LINES - apart && a + b > best.0 {
                best = (a + b, [i as f64 * step, j as f64 * step]);
            }
        }
    }
    best.1
}

/// Two lines named as x and y direction so that the axes turn least in sum; the first on a tie.
fn least_turned([a, b]: [f64; 2]) -> [f64; 2] {
    // x into (−90°, 90°], y into (0°, 180°].
    let x = |angle: f64| FRAC_PI_2 - (FRAC_PI_2 - angle).rem_euclid(PI);
    let y = |angle: f64| PI - (PI - angle).rem_euclid(PI);
    let turning = |[p, q]: &[f64; 2]| p.abs() + (q - FRAC_PI_2).abs();
    let (first, second) = ([x(a), y(b)], [x(b), y(a)]);
    if turning(&second) < turning(&first) { second } else { first }
}

/// 1 − σ₁²/‖·‖² of the table aligned to two directions; 1 if they are one line.
fn beyond_rank_one(plane: &Grid, channel: &GridChannel, [x, y]: [f64; 2]) -> f64 {
    let Ok(alignment) = Alignment::of_directions(x, y) else { return 1.0 };
    let inverse = alignment.inverse();
    let (xs, ys) = (plane.x().centres(), plane.y().centres());
    let rows: Vec<Vec<f64>> = ys
        .par_iter()
        .map(|ay| {
            let at = |ax: &f64| bicubic(plane, channel, inverse.apply([*ax, *ay]));
            xs.iter().map(at).collect()
        })
        .collect();
    let table = Mat::from_fn(ys.len(), xs.len(), |i, j| {
        rows.get(i).and_then(|row| row.get(j)).copied().unwrap_or(0.0)
    });
    let whole = table.squared_norm_l2();
    let mut right = Mat::<f64>::from_fn(xs.len(), 1, |_, _| 1.0);
    let mut first = 0.0;
    for _ in 0..POWER_STEPS {
        let length = right.squared_norm_l2().sqrt();
        if length == 0.0 || whole == 0.0 {
            return 1.0;
        }
        right *= faer::Scale(1.0 / length);
        let left = &table * &right;
        first = left.squared_norm_l2();
        right = table.transpose() * left.as_ref();
    }
    1.0 - first / whole
}

/// What the refinement looks at: places outside the centre and S² there.
struct Orders {
    places: Vec<([f64; 2], f64)>,
    width: f64,
    whole: f64,
}

impl Orders {
    fn of(plane: &Grid, channel: &GridChannel, central: f64, radius: f64) -> Self {
        let places: Vec<([f64; 2], f64)> = centres(plane.x(), plane.y())
            .zip(&channel.values)
            .map(|(h, value)| (h, f64::from(*value).powi(2)))
            .filter(|(h, _)| (central..=radius).contains(&h[0].hypot(h[1])))
            .collect();
        let whole = places.iter().map(|(_, energy)| energy).sum();
        let texel = plane.x().step().abs().max(plane.y().step().abs());
        Self { places, width: WIDTH_TEXELS * texel, whole }
    }

    /// Part of Σ S² about the line at `angle`.
    fn about(&self, angle: f64) -> f64 {
        if self.whole == 0.0 {
            return 0.0;
        }
        let (sin, cos) = angle.sin_cos();
        let weighed = |(h, energy): &([f64; 2], f64)| {
            let across = (h[1] * cos - h[0] * sin) / self.width;
            if across.abs() > FAR { 0.0 } else { energy * (-0.5 * across * across).exp() }
        };
        self.places.iter().map(weighed).sum::<f64>() / self.whole
    }

    /// Nelder & Mead over both angles from `start`, restarted once with a smaller simplex; never
    /// worse than the start.
    fn refined(&self, start: [f64; 2]) -> [f64; 2] {
        type Iteration = IterState<DVector<f64>, (), (), (), (), f64>;
        let cost = |[x, y]: [f64; 2]| -(self.about(x) + self.about(y));
        let mut best = (cost(start), start);
        for edge in EDGES_RAD {
            let corner = |x: f64, y: f64| DVector::from_vec(vec![x, y]);
            let simplex = vec![corner(0.0, 0.0), corner(edge, 0.0), corner(0.0, edge)];
            let around = Around { orders: self, centre: best.1 };
            let run = NelderMead::new(simplex).with_sd_tolerance(1e-12).and_then(|solver| {
                Executor::new(around, solver)
                    .configure(|state: Iteration| state.max_iters(ITERATIONS))
                    .ctrlc(false)
                    .run()
            });
            let Ok(result) = run else { continue };
            let Some(z) = result.state().get_best_param() else { continue };
            let at = |k: usize| best.1[k] + z.get(k).copied().unwrap_or(0.0);
            let found = [at(0), at(1)];
            let value = cost(found);
            if value < best.0 {
                best = (value, found);
            }
        }
        best.1
    }
}

/// What lies about neither line, over the two angles about where the search ended.
struct Around<'a> {
    orders: &'a Orders,
    centre: [f64; 2],
}

impl CostFunction for Around<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, z: &DVector<f64>) -> Result<f64, Error> {
        if z.amax() > REACH_RAD {
            return Ok(z.amax());
        }
        let about = |k: usize| self.orders.about(self.centre[k] + z.get(k).copied().unwrap_or(0.0));
        Ok(-(about(0) + about(1)))
    }
}
