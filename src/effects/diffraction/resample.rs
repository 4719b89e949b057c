//! Power per cell of one regular grid to power per texel of another, with nothing lost.
//!
//! A cell no wider than a texel is uniform and shared out among the texels that it overlaps: the sum
//! integrates over the texel. A wider one falls linearly to its neighbours' centres, so that the density
//! between cells is interpolated linearly, and then integrated over the texel too.

use crate::table::Axis;

/// Cells along one axis: regular, uniform inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cells {
    /// Their number.
    pub count: usize,
    /// Outer edge of the first, in widths: 0 for the cell that begins at 0.
    pub first: f64,
    /// Width of each.
    pub pitch: f64,
}

impl Cells {
    /// `count` cells in the order of increasing frequency, one of them centred at 0.
    pub fn around_zero(count: usize, pitch: f64) -> Self {
        Self { count, first: -((count / 2) as f64 + 0.5), pitch }
    }

    /// Centre of cell `i`.
    pub fn centre(&self, i: usize) -> f64 {
        (self.first + (i as f64 + 0.5)) * self.pitch
    }

    /// These cells in another unit.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { pitch: self.pitch * factor, ..*self }
    }
}

/// The cells that give to a texel, each with the share of the cell that falls into it.
struct Overlap {
    first: usize,
    shares: Vec<f64>,
}

/// Share of a cell's power at less than `t` cells from its centre: a uniform cell.
fn uniform(t: f64) -> f64 {
    (t + 0.5).clamp(0.0, 1.0)
}

/// The same for a cell whose density falls linearly to 0 at its neighbours' centres.
fn triangular(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    if t < 0.0 { 0.5 * (1.0 + t) * (1.0 + t) } else { 1.0 - 0.5 * (1.0 - t) * (1.0 - t) }
}

fn overlaps(cells: Cells, texels: &Axis) -> Vec<Overlap> {
    let width = texels.step();
    let coarser = cells.pitch > width * (1.0 + 1e-9);
    let below = if coarser { triangular } else { uniform };
    let overlap = |i: usize| {
        let place = |edge: f64| (texels.from + edge * width) / cells.pitch - cells.first;
        let (low, high) = (place(i as f64), place(i as f64 + 1.0));
        let within = |cell: f64| cell.clamp(0.0, cells.count as f64) as usize;
        let (first, last) = (within((low - 1.5).floor()), within((high + 1.5).ceil()));
        let share = |cell: usize| {
            let centre = cell as f64 + 0.5;
            below(high - centre) - below(low - centre)
        };
        Overlap { first, shares: (first..last).map(share).collect() }
    };
    (0..texels.count).map(overlap).collect()
}

/// Power per texel. `power` has one entry per cell, rows of constant y one after the other; so has
/// the result per texel. Axes increase.
pub fn gathered(power: &[f64], x: Cells, y: Cells, to_x: &Axis, to_y: &Axis) -> Vec<f64> {
    let (along_x, along_y) = (overlaps(x, to_x), overlaps(y, to_y));
    let mut result = vec![0.0; to_x.count * to_y.count];
    let mut last: Option<(usize, Vec<f64>)> = None;
    for (row, overlap) in result.chunks_mut(to_x.count.max(1)).zip(&along_y) {
        let cells = (overlap.first..).zip(&overlap.shares);
        for (cell, share) in cells.filter(|(_, share)| **share > 0.0) {
            // Neighbouring texels share the cell at their edge.
            let sums = match last.take() {
                Some((at, sums)) if at == cell => sums,
                _ => row_sums(power, cell, x.count, &along_x),
            };
            for (value, sum) in row.iter_mut().zip(&sums) {
                *value += share * sum;
            }
            last = Some((cell, sums));
        }
    }
    result
}

fn row_sums(power: &[f64], row: usize, count: usize, along_x: &[Overlap]) -> Vec<f64> {
    let cells = power.get(row * count..(row + 1) * count).unwrap_or_default();
    let sum = |overlap: &Overlap| -> f64 {
        let inside = cells.get(overlap.first..).unwrap_or_default();
        inside.iter().zip(&overlap.shares).map(|(p, share)| p * share).sum()
    };
    along_x.iter().map(sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(half: f64, count: usize) -> Axis {
        Axis::new("h_x", "1", [-half, half], count)
    }

    #[test]
    fn nothing_is_lost_between_finer_coarser_and_crooked_grids() {
        let cells = Cells::around_zero(37, 0.11);
        let power: Vec<f64> = (0..37 * 37).map(|i| f64::from(i % 7) + 0.1 * f64::from(i)).collect();
        let total: f64 = power.iter().sum();
        for count in [5, 37, 64, 501] {
            let texels = axis(2.5, count);
            let gathered = gathered(&power, cells, cells, &texels, &texels);
            let sum: f64 = gathered.iter().sum();
            assert!((sum / total - 1.0).abs() < 1e-12, "{count}: {sum}");
        }
    }

    #[test]
    fn a_cell_at_zero_falls_into_the_middle_texel_or_the_middle_four() {
        let cells = Cells::around_zero(8, 1e-3);
        let mut power = vec![0.0; 64];
        power[4 * 8 + 4] = 1.0;
        assert_eq!(cells.centre(4), 0.0);
        let odd = gathered(&power, cells, cells, &axis(1.0, 5), &axis(1.0, 5));
        assert_eq!(odd[12], 1.0);
        let even = gathered(&power, cells, cells, &axis(1.0, 4), &axis(1.0, 4));
        for at in [5, 6, 9, 10] {
            assert!((even[at] - 0.25).abs() < 1e-12);
        }
    }

    #[test]
    fn wide_cells_are_interpolated() {
        // A density that is linear in x comes back as such between the outermost centres.
        let cells = Cells { count: 9, first: 0.0, pitch: 1.0 };
        let power: Vec<f64> = (0..9).map(|i| f64::from(i) + 0.5).collect();
        let texels = Axis { from: 1.0, to: 8.0, ..axis(1.0, 28) };
        let one = Cells { count: 1, first: 0.0, pitch: 1.0 };
        let whole = Axis { from: 0.0, to: 1.0, ..axis(1.0, 1) };
        for (i, p) in gathered(&power, cells, one, &texels, &whole).iter().enumerate() {
            assert!((p / 0.25 - texels.centre(i)).abs() < 1e-12, "{i}: {p}");
        }
    }

    #[test]
    fn cells_outside_give_nothing() {
        let cells = Cells { count: 4, first: 10.0, pitch: 1.0 };
        let texels = axis(1.0, 3);
        assert!(gathered(&[1.0; 16], cells, cells, &texels, &texels).iter().all(|p| *p == 0.0));
    }
}
