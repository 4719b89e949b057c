//! A table between its texels.

use crate::table::{Channel, Grid};

/// How a table continues between texel centres; 0 beyond its outer edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Interpolation {
    /// From the four texels around.
    Bilinear,
    /// Catmull & Rom's cubic through the sixteen texels around, held within their range so that a
    /// table that is not negative stays so.
    Bicubic,
}

/// The value of `channel` at h.
pub(super) fn sample(table: &Grid, channel: &Channel, h: [f64; 2], how: Interpolation) -> f64 {
    let (nx, ny) = (table.x.count, table.y.count);
    let (tx, ty) = (table.x.texel(h[0]), table.y.texel(h[1]));
    let on = |t: f64, n: usize| (-0.5..=n as f64 - 0.5).contains(&t);
    if !(on(tx, nx) && on(ty, ny)) {
        return 0.0;
    }
    let (left, top) = (tx.floor(), ty.floor());
    let at = |i: i64, j: i64| {
        let i = i.clamp(0, nx as i64 - 1) as usize;
        let j = j.clamp(0, ny as i64 - 1) as usize;
        channel.values.get(j * nx + i).map_or(0.0, |v| f64::from(*v))
    };
    let (i, j) = (left as i64, top as i64);
    let (u, v) = (tx - left, ty - top);
    match how {
        Interpolation::Bilinear => {
            let row = |j| at(i, j) * (1.0 - u) + at(i + 1, j) * u;
            row(j) * (1.0 - v) + row(j + 1) * v
        }
        Interpolation::Bicubic => {
            let (wx, wy) = (catmull_rom(u), catmull_rom(v));
            let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
            for (dj, y) in (-1..).zip(wy) {
                for (di, x) in (-1..).zip(wx) {
                    let value = at(i + di, j + dj);
                    sum += x * y * value;
                    low = value.min(low);
                    high = value.max(high);
                }
            }
            sum.clamp(low, high)
        }
    }
}

/// Weights of the texels −1, 0, 1, 2 at `t` in [0, 1).
fn catmull_rom(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (-t + 2.0 * t2 - t3),
        0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
        0.5 * (t + 4.0 * t2 - 3.0 * t3),
        0.5 * (t3 - t2),
    ]
}
