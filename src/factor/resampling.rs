//! A table between its texels, smoothly.

use crate::table::{Grid, GridChannel};

/// The value of `channel` at h: Catmull & Rom's cubic through the sixteen texels around, held within
/// their range so that a table that is not negative stays so; 0 beyond the table's outer edges.
pub(super) fn bicubic(table: &Grid, channel: &GridChannel, h: [f64; 2]) -> f64 {
    let (nx, ny) = (table.x().count, table.y().count);
    let (tx, ty) = (table.x().texel(h[0]), table.y().texel(h[1]));
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
    let (wx, wy) = (catmull_rom(tx - left), catmull_rom(ty - top));
    let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
    for (j, y) in (top as i64 - 1..).zip(wy) {
        for (i, x) in (left as i64 - 1..).zip(wx) {
            let value = at(i, j);
            sum += x * y * value;
            low = value.min(low);
            high = value.max(high);
        }
    }
    sum.clamp(low, high)
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
