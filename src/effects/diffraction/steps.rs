//! What each step of the preparation does to a table, as numbers.

use super::DiffractionError;
use super::far_field::{FarField, FarFieldTransform};
use super::preparation::{Preparation, prepared};
use super::table::at_wavelength;
use crate::document::{Cell, PrintedTable};
use crate::measured::height_map::HeightMap;

/// Heights and their preparation, under a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Step<'a> {
    /// What is done otherwise.
    pub name: &'static str,
    /// The heights.
    pub heights: &'a HeightMap,
    /// The preparation.
    pub preparation: Preparation,
    /// Padding of the transform.
    pub padding: usize,
}

/// What a step does to the table of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepEffect {
    /// Relative L2 difference of the tables.
    pub relative_l2: f64,
    /// Direction of the strongest order away from the mirror, h.
    pub strongest: [f64; 2],
    /// Full width of that order at half its height along h_x, in h.
    pub width: f64,
    /// Sum of all power.
    pub total: f64,
    /// Share of the power inside the table.
    pub inside: f64,
}

/// The effect of every step on a table at one wavelength, against the first one.
///
/// # Errors
/// As [`prepared`] and [`FarFieldTransform::new`].
pub fn step_effects(
    steps: &[Step<'_>],
    wavelength_nm: f64,
    w: f64,
    size: usize,
    extent: f64,
) -> Result<Vec<StepEffect>, DiffractionError> {
    let mut first: Option<Vec<f64>> = None;
    let mut effects = Vec::new();
    for step in steps {
        let surface = prepared(step.heights, step.preparation)?;
        let transform = FarFieldTransform::new(&surface, step.padding)?;
        let field = transform.far_field(&surface, wavelength_nm, w);
        let (texels, _) = at_wavelength(&field, [size, size], extent);
        let side = surface.nx as f64 * surface.dx_um;
        let (strongest, width) = strongest_order(&field, side);
        let against = first.get_or_insert_with(|| texels.clone());
        let pairs = texels.iter().copied().zip(against.iter().copied());
        effects.push(StepEffect {
            relative_l2: crate::numeric::statistics::relative_l2(pairs),
            strongest,
            width,
            total: field.total(),
            inside: crate::numeric::statistics::sum(texels.iter().copied()),
        });
    }
    Ok(effects)
}

/// The strongest cell that is at least three cells of the unpadded transform away from the mirror
/// along x, and the full width at half maximum through it along x, in h.
fn strongest_order(field: &FarField, side_um: f64) -> ([f64; 2], f64) {
    let [x, y] = field.cells();
    let away = 3.0 / side_um * 1e-3 * field.wavelength_nm;
    let (peak, ix, iy) = field.strongest(|ix, _| x.centre(ix).abs() >= away);
    let at = |i: usize| field.power.get(iy * x.count + i).copied().unwrap_or(0.0);
    // Distance in cells to where the power falls through a half, linear between cells.
    let walk = |step: fn(usize, usize) -> Option<usize>| {
        let mut distance = 0;
        while let Some(next) = step(ix, distance + 1).filter(|i| *i < x.count) {
            let here = step(ix, distance).map_or(0.0, at);
            if at(next) < 0.5 * peak {
                return distance as f64 + (here - 0.5 * peak) / (here - at(next));
            }
            distance += 1;
        }
        distance as f64
    };
    let width = walk(|i, n| i.checked_add(n)) + walk(|i, n| i.checked_sub(n));
    ([x.centre(ix), y.centre(iy)], width * x.pitch)
}

/// [`step_effects`] as a table of four significant digits.
pub(super) fn changes(
    steps: &[Step<'_>],
    wavelength_nm: f64,
    w: f64,
    size: usize,
    extent: f64,
) -> Result<PrintedTable, DiffractionError> {
    let effects = step_effects(steps, wavelength_nm, w, size, extent)?;
    let rows = steps.iter().zip(&effects).map(|(step, effect)| {
        let [along_x, along_y] = effect.strongest;
        let difference = effect.relative_l2;
        let numbers = [difference, along_x, along_y, effect.width, effect.total, effect.inside];
        let mut row = vec![Cell::text(step.name)];
        row.extend(numbers.map(|value| Cell::number(value, 4)));
        row
    });
    Ok(PrintedTable::of_rows(
        format!(
            "What each step does to the table at {wavelength_nm} nm: relative L2 difference from the \
             first row, and the strongest order with its width at half height"
        ),
        [
            ("step", ""),
            ("difference", "1"),
            ("h_x of the order", "1"),
            ("h_y", "1"),
            ("width", "1"),
            ("total power", "1"),
            ("inside the table", "1"),
        ],
        rows,
    ))
}
