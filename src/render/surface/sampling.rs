//! Monte Carlo over the cells of a diffraction table: the sum at a pixel, with cells drawn in proportion to their weight (Walker's alias method).

use super::orders::Orders;
use super::sums::{self, hit_columns};
use crate::form::DataTable;
use crate::render::RenderError;
use crate::render::backend::Kernel;
use crate::render::geometry::Hit;
use crate::render::monte_carlo::{RANDOM, seed_word};
use crate::render::scene::SAMPLES_PER_PASS;
use crate::render::shading::Columns;
use crate::render::sphere_map::{SphereMap, Taps};

/// The text of the draws.
const TEXT: &str = include_str!("surface_samples.wgsl");
/// Keeps these random numbers apart from those over lights.
const SALT: u32 = 0x85eb_ca6b;

/// The kernel of one pass under `map`; inputs as [`draws`] makes them.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub(super) fn kernel(map: &SphereMap, orders: &Orders, seed: u64) -> Result<Kernel, RenderError> {
    let size = |weight: [f64; 3]| weight.iter().map(|channel| channel.abs()).sum::<f64>();
    let sizes: Vec<f64> = orders.taps.iter().map(|(_, weight)| size(weight)).collect();
    let total: f64 = sizes.iter().sum();
    let mut drawn = Taps::default();
    for (place, weight) in orders.taps.iter() {
        // The weight over the probability of the draw.
        let share = size(weight) / total;
        drawn.push(place, weight.map(|w| if share > 0.0 { w / share } else { 0.0 }));
    }
    let constants = format!(
        "const SAMPLE_DRAWS: u32 = {SAMPLES_PER_PASS}u;\nconst SAMPLE_SEED: u32 = {}u;\n",
        seed_word(seed, SALT)
    );
    let text = [sums::TEXT, TEXT, RANDOM, &constants].join("\n");
    let alias = DataTable::vectors("alias_table", &alias_table(&sizes));
    sums::kernel(&text, "surface_samples", map, (&drawn, orders), 1, Some(alias))
}

/// What a hit is drawn for: its directions, the number of its pixel and the first sample.
pub(super) fn draws(pixels: &[usize], hits: &[Hit], first: u32) -> Columns {
    let mut columns = hit_columns(hits);
    columns.push(pixels.iter().map(|pixel| *pixel as f32).collect());
    columns.push(vec![first as f32; hits.len()]);
    columns
}

/// Per cell the chance that it stands for itself when it is drawn, and the cell that stands for it
/// otherwise (Vose 1991): drawn evenly, cells come up in proportion to `sizes`.
fn alias_table(sizes: &[f64]) -> Vec<[f32; 2]> {
    let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
    let mut shares: Vec<f64> = sizes.iter().map(|size| size / mean).collect();
    let mut table: Vec<[f32; 2]> = (0..sizes.len()).map(|at| [1.0, at as f32]).collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) =
        (0..shares.len()).partition(|at| shares[*at] < 1.0);
    while let (Some(less), Some(more)) = (small.pop(), large.pop()) {
        table[less] = [shares[less] as f32, more as f32];
        shares[more] -= 1.0 - shares[less];
        if shares[more] < 1.0 { small.push(more) } else { large.push(more) }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_come_up_in_proportion_to_their_sizes() {
        let sizes = [0.5, 0.0, 3.0, 1.5, 1.0, 0.25];
        let table = alias_table(&sizes);
        let mut found = [0.0; 6];
        for (at, [own, other]) in table.iter().enumerate() {
            found[at] += f64::from(*own) / 6.0;
            found[*other as usize] += f64::from(1.0 - own) / 6.0;
        }
        for (found, size) in found.iter().zip(sizes) {
            assert!((found - size / 6.25).abs() < 1e-6, "{found} for {size}");
        }
    }
}
