//! What a simulation says of its table: orders, energies, and what each step of the preparation did.

use super::DiffractionError;
use super::far_field::{FarField, FarFieldTransform};
use super::orders::{fundamental, orders, predicted_power, sinusoid_amplitude};
use super::preparation::{
    Detrend, MOST_SAMPLES, Missing, Preparation, PreparedHeights, Window, prepared,
};
use super::simulate::{Origin, padding, preparation, shape, w};
use super::table::{DiffractionTable, at_wavelength};
use crate::document::{Cell, PrintedTable};
use crate::effect::simulator::{Settings, Simulation};
use crate::measured::height_map::HeightMap;
use crate::numeric::statistics::{relative_l2, sum};

/// Share of the heights' variance above which a surface counts as a sinusoid.
const SINUSOIDAL: f64 = 0.4;
/// Highest order that is looked for.
const MOST_ORDERS: i32 = 3;

pub(super) fn described(
    settings: &Settings,
    table: DiffractionTable,
    origin: Origin,
) -> Result<Simulation, DiffractionError> {
    let mut notes = Vec::new();
    let mut tables = vec![energies(&table)];
    match origin {
        Origin::Pattern(placing) => notes.push(format!(
            "S at λ is (λ₀/λ)^{} times S at λ₀ = {} nm, scaled in h by λ/λ₀; the pattern's total \
             counts as all power at λ₀",
            placing.exponent, placing.wavelength_nm
        )),
        Origin::Heights(heights, surface) => {
            let wavelength = settings.number("report_nm", 1.0, 1e5)?;
            let shape = shape(settings)?;
            let (size, extent) = (shape.size[0], shape.extent);
            let transform = FarFieldTransform::new(&surface, padding(settings)?)?;
            let field = transform.far_field(&surface, wavelength, w(settings)?);
            notes.push(sampling(&surface, &field, size, extent));
            let hann =
                prepared(&heights, Preparation { window: Window::Hann, ..preparation(settings)? })?;
            if let Some(frequency) = fundamental(&hann)? {
                notes.push(zero_order(&field, frequency));
                let (note, table) =
                    order_table(settings, &surface, &field, frequency, size, extent)?;
                notes.extend(note);
                tables.push(table);
            }
            let steps = steps(&heights, &surface, preparation(settings)?, padding(settings)?);
            tables.push(changes(&steps, wavelength, w(settings)?, size, extent)?);
        }
    }
    Ok(Simulation { grid: table.grid, notes, tables })
}

fn number(value: f64) -> Cell {
    Cell::number(value, 4)
}

/// Shares of the power at the first, the middle and the last wavelength.
fn energies(table: &DiffractionTable) -> PrintedTable {
    let last = table.shares.len().saturating_sub(1);
    let mut at = vec![0, last / 2, last];
    at.dedup();
    let rows = at.into_iter().filter_map(|i| table.shares.get(i)).map(|of| {
        let outside = of.total - of.inside;
        [of.wavelength_nm, of.total, of.inside, outside, of.evanescent].map(number).to_vec()
    });
    PrintedTable::of_rows(
        "Shares of the reflected power",
        [
            ("wavelength", "nm"),
            ("sum over all frequencies", "1"),
            ("inside the table", "1"),
            ("outside", "1"),
            ("beyond |h| = 1", "1"),
        ],
        rows,
    )
}

fn sampling(surface: &PreparedHeights, field: &FarField, size: usize, extent: f64) -> String {
    let wavelength_um = 1e-3 * field.wavelength_nm;
    let [cell_x, cell_y] = field.cells().map(|cells| cells.pitch);
    let reach = |d: f64| wavelength_um / (2.0 * d);
    format!(
        "{} × {} samples of {:.4} × {:.4} µm: at {} nm a cell of the transform is {:.5} × {:.5} in h, \
         a texel {:.5}, and the samples reach |h| = {:.2} and {:.2}; tilt of {:.3} and {:.3} nm/µm \
         taken off, {} samples missing",
        surface.nx,
        surface.ny,
        surface.dx_um,
        surface.dy_um,
        field.wavelength_nm,
        cell_x,
        cell_y,
        2.0 * extent / size as f64,
        reach(surface.dx_um),
        reach(surface.dy_um),
        surface.removed.slope[0],
        surface.removed.slope[1],
        surface.missing
    )
}

fn zero_order(field: &FarField, frequency: [f64; 2]) -> String {
    let near = 0.5 * frequency[0].hypot(frequency[1]);
    let share = field.share(|fx, fy| fx.hypot(fy) < near);
    format!(
        "zero order, |h| below half the first: {:.4} of the power at {} nm",
        share, field.wavelength_nm
    )
}

fn order_table(
    settings: &Settings,
    surface: &PreparedHeights,
    field: &FarField,
    frequency: [f64; 2],
    size: usize,
    extent: f64,
) -> Result<(Vec<String>, PrintedTable), DiffractionError> {
    let mut notes = vec![format!(
        "pitch of the heights: {:.4} µm, at {:.2}° from x",
        1.0 / frequency[0].hypot(frequency[1]),
        frequency[1].atan2(frequency[0]).to_degrees()
    )];
    let phase_per_nm = std::f64::consts::TAU * w(settings)? / field.wavelength_nm;
    let amplitude = sinusoid_amplitude(surface, frequency);
    let sinusoid = amplitude.filter(|a| a.explained > SINUSOIDAL);
    if let Some(a) = amplitude {
        notes.push(format!(
            "a sinusoid of that pitch explains {:.1} % of the variance, row by row; amplitude \
             {:.2} ± {:.2} nm ({:.2} nm from row to row, {:.1} independent rows), phase {:.4} rad{}",
            100.0 * a.explained,
            a.nm,
            a.standard_error_nm,
            a.spread_nm,
            a.effective_rows,
            phase_per_nm * a.nm,
            if sinusoid.is_some() { "" } else { ": no sinusoid, J_m² does not apply" }
        ));
    }
    let widths = [surface.nx as f64 * surface.dx_um, surface.ny as f64 * surface.dy_um];
    let found = orders(field, frequency, widths, MOST_ORDERS, size, extent);
    let mut rows = Vec::new();
    for order in &found {
        let predicted = sinusoid.and_then(|a| {
            let (phase, error) = (phase_per_nm * a.nm, phase_per_nm * a.standard_error_nm);
            predicted_power(order.order.unsigned_abs(), phase.min(20.0), error).ok()
        });
        let [power, uncertainty] = match predicted {
            Some((power, uncertainty)) => [power, uncertainty].map(number),
            None => ["–", "–"].map(Cell::text),
        };
        let ([x, y], [x_found, y_found]) = (order.predicted, order.found);
        let places = [f64::from(order.order), x, y, x_found, y_found, order.texels_off];
        let mut row = places.map(number).to_vec();
        row.extend([power, uncertainty, number(order.power)]);
        rows.push(row);
    }
    let table = PrintedTable::of_rows(
        format!("Orders at {} nm: m λ/d, and what the table has", field.wavelength_nm),
        [
            ("m", "1"),
            ("h_x predicted", "1"),
            ("h_y predicted", "1"),
            ("h_x found", "1"),
            ("h_y found", "1"),
            ("off", "texels"),
            ("J_m²", "1"),
            ("u(J_m²)", "1"),
            ("power found", "1"),
        ],
        rows,
    );
    Ok((notes, table))
}

fn steps<'a>(
    heights: &'a HeightMap,
    surface: &PreparedHeights,
    usual: Preparation,
    padding: usize,
) -> Vec<Step<'a>> {
    let step = |name, preparation, padding| Step { name, heights, preparation, padding };
    let mut steps = vec![step("as set", usual, padding)];
    if usual.detrend != Detrend::Nothing {
        let tilted = Preparation { detrend: Detrend::Nothing, ..usual };
        steps.push(step("trend left in", tilted, padding));
    }
    let windows = [
        ("no window", Window::Rectangle),
        ("Hann window", Window::Hann),
        ("Tukey window", Window::Tukey),
    ];
    for (name, window) in windows.into_iter().filter(|(_, window)| *window != usual.window) {
        steps.push(step(name, Preparation { window, ..usual }, padding));
    }
    if surface.missing > 0 {
        let (name, missing) = match usual.missing {
            Missing::Fill => ("missing samples masked", Missing::Mask),
            Missing::Mask => ("missing samples filled", Missing::Fill),
        };
        steps.push(step(name, Preparation { missing, ..usual }, padding));
    }
    let (more, samples) = (2 * padding, heights.nx.saturating_mul(heights.ny));
    if samples.saturating_mul(more * more) <= MOST_SAMPLES {
        steps.push(step("twice the padding", usual, more));
    }
    steps
}

/// Heights and their preparation, under a name.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Step<'a> {
    /// What is done otherwise.
    pub(super) name: &'static str,
    /// The heights.
    pub(super) heights: &'a HeightMap,
    /// The preparation.
    pub(super) preparation: Preparation,
    /// Padding of the transform.
    pub(super) padding: usize,
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

/// What every step does to the table of the first at one wavelength, in four significant digits.
///
/// # Errors
/// As [`prepared`] and [`FarFieldTransform::new`].
pub(super) fn changes(
    steps: &[Step<'_>],
    wavelength_nm: f64,
    w: f64,
    size: usize,
    extent: f64,
) -> Result<PrintedTable, DiffractionError> {
    let mut first: Option<Vec<f64>> = None;
    let mut rows = Vec::new();
    for step in steps {
        let surface = prepared(step.heights, step.preparation)?;
        let transform = FarFieldTransform::new(&surface, step.padding)?;
        let field = transform.far_field(&surface, wavelength_nm, w);
        let (texels, _) = at_wavelength(&field, [size, size], extent);
        let ([along_x, along_y], width) =
            strongest_order(&field, surface.nx as f64 * surface.dx_um);
        let against = first.get_or_insert_with(|| texels.clone());
        let pairs = texels.iter().copied().zip(against.iter().copied());
        let (difference, inside) = (relative_l2(pairs), sum(texels.iter().copied()));
        let numbers = [difference, along_x, along_y, width, field.total(), inside];
        let mut row = vec![Cell::text(step.name)];
        row.extend(numbers.map(|value| Cell::number(value, 4)));
        rows.push(row);
    }
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
