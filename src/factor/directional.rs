//! Kernels along lines: the table integrated across each (toisoul2017 table 2, "1D" and "Sum").

use super::LowRankError;
use crate::table::{Axis, Grid, centres};

/// A kernel along a line through h = 0, integrated across it: K(h) ≈ line(h·d) δ(h·e), e ⟂ d.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionalKernel {
    /// Unit vector d in h.
    pub direction: [f64; 2],
    /// Axis along the line, in the length of h.
    pub axis: Axis,
    /// Name and one value per texel of `axis`, per channel of the table: the table integrated
    /// across the line, so that Σ line · Δs is the energy of the line.
    pub channels: Vec<(String, Vec<f64>)>,
}

/// Kernels along lines and what they leave out.
#[derive(Debug, Clone, PartialEq)]
pub struct Directional {
    /// One per direction, in order.
    pub kernels: Vec<DirectionalKernel>,
    /// Name of each channel and the part of its energy Σ S Δh_x Δh_y that lies on no line: in
    /// [0, 1] for a table that is not negative; 0 for a channel without energy.
    pub lost: Vec<(String, f64)>,
}

/// Integrates a table across lines through h = 0.
///
/// A texel belongs to every line whose distance from its centre is at most `half_width` (in h;
/// infinite takes the whole table) and gives each an equal share, so that the overlap about the
/// centre counts once. Along a line, its energy goes to the two nearest texels of the line's axis in
/// proportion, which keeps both its sum and its centroid. The axis has the spacing of the finer of
/// the table's two and reaches as far as the table does along the line, evenly about 0.
///
/// # Errors
/// As [`Grid::check_plane`]; [`LowRankError::Setting`] without directions, for one of length 0 or not
/// finite, or for a half width that is not above 0.
pub fn directional(
    table: &Grid,
    directions: &[[f64; 2]],
    half_width: f64,
) -> Result<Directional, LowRankError> {
    table.check_plane()?;
    if half_width.is_nan() || half_width <= 0.0 {
        return Err(LowRankError::setting("half width", "above 0", half_width.to_string()));
    }
    let mut units = Vec::with_capacity(directions.len());
    for [x, y] in directions {
        let length = x.hypot(*y);
        if !(length.is_finite() && length > 0.0) {
            let expected = "a finite vector that is not 0";
            return Err(LowRankError::setting("direction", expected, format!("({x}, {y})")));
        }
        units.push([x / length, y / length]);
    }
    if units.is_empty() {
        return Err(LowRankError::setting("directions", "at least one", "none"));
    }
    let axes: Vec<Axis> = units.iter().map(|d| axis_along(table, *d)).collect();
    let area = spacing(table.x()) * spacing(table.y());
    let mut lost = Vec::with_capacity(table.channels.len());
    let mut lines: Vec<Vec<(String, Vec<f64>)>> = vec![Vec::new(); units.len()];
    for channel in &table.channels {
        let mut profiles: Vec<Vec<f64>> = axes.iter().map(|axis| vec![0.0; axis.count]).collect();
        let (mut whole, mut outside) = (0.0, 0.0);
        for (h, value) in centres(table.x(), table.y()).zip(&channel.values) {
            let energy = f64::from(*value) * area;
            whole += energy;
            let on = |d: &[f64; 2]| (h[1] * d[0] - h[0] * d[1]).abs() <= half_width;
            let sharing = units.iter().filter(|d| on(d)).count();
            if sharing == 0 {
                outside += energy;
                continue;
            }
            for ((d, axis), profile) in units.iter().zip(&axes).zip(&mut profiles) {
                if on(d) {
                    let along = h[0] * d[0] + h[1] * d[1];
                    deposit(axis, profile, along, energy / (sharing as f64 * spacing(axis)));
                }
            }
        }
        let part = if whole == 0.0 { 0.0 } else { outside / whole };
        lost.push((channel.name.clone(), part));
        for (line, profile) in lines.iter_mut().zip(profiles) {
            line.push((channel.name.clone(), profile));
        }
    }
    let kernels = units
        .into_iter()
        .zip(axes)
        .zip(lines)
        .map(|((direction, axis), channels)| DirectionalKernel { direction, axis, channels })
        .collect();
    Ok(Directional { kernels, lost })
}

fn spacing(axis: &Axis) -> f64 {
    axis.step().abs()
}

/// As far as the table reaches along d, and a texel more, so that both texels of every deposit exist.
fn axis_along(table: &Grid, d: [f64; 2]) -> Axis {
    let furthest = |axis: &Axis| axis.from.abs().max(axis.to.abs());
    let reach = furthest(table.x()) * d[0].abs() + furthest(table.y()) * d[1].abs();
    let step = spacing(table.x()).min(spacing(table.y()));
    let half = (reach / step).ceil() as usize + 1;
    let edge = half as f64 * step;
    Axis::new("s", &table.x().unit, [-edge, edge], 2 * half)
}

fn deposit(axis: &Axis, profile: &mut [f64], along: f64, amount: f64) {
    let Some((low, high, part)) = axis.between(along) else { return };
    for (index, share) in [(low, 1.0 - part), (high, part)] {
        if let Some(slot) = profile.get_mut(index) {
            *slot += share * amount;
        }
    }
}
