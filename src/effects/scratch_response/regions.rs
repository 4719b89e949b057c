//! Where the forms are judged: what scenes reach, with and without ends, the neighbourhood of the mirror
//! direction, and points that have broken implementations. Every value is an f32, so that form and reference see the same point.

use std::f64::consts::PI;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use crate::effect::{Points, points};
use crate::table::Table;

/// Radius of the coherence area in the paper, µm.
const SIGMA_UM: f64 = 60.0;
/// Draws per wavelength.
const DRAWS: usize = 400;

/// Regions of the effect, by name: points that are judged and that are fitted.
pub(super) const REGIONS: &[(&str, Points, Option<Points>)] = &[
    ("visible", || draws(1, visible), Some(|| draws(101, visible))),
    ("long", || draws(2, long), Some(|| draws(102, long))),
    ("mirror", || draws(3, mirror), Some(|| draws(103, mirror))),
    ("mirror, ends", || draws(5, mirror_with_ends), Some(|| draws(105, mirror_with_ends))),
    ("pair", || pair_draws(4), Some(|| pair_draws(104))),
];

/// Hard cases, by name.
pub(super) const HARD_CASES: &[(&str, Points)] =
    &[("hard cases", || table(&hard_rows(), |_| true, "hard cases"))];

/// Names and units of the columns, in the order of [`Row`].
pub(super) const COLUMNS: [(&str, &str); 15] = [
    ("width_um", "um"),
    ("depth_um", "um"),
    ("wavelength_um", "um"),
    ("sigma_um", "um"),
    ("xi_along", "1"),
    ("xi_across", "1"),
    ("offset_um", "um"),
    ("mu_sum", "1"),
    ("begin_um", "um"),
    ("end_um", "um"),
    ("mu_o", "1"),
    ("second_width_um", "um"),
    ("second_depth_um", "um"),
    ("second_offset_um", "um"),
    ("turn_rad", "rad"),
];

/// A point: values of [`COLUMNS`].
pub(super) type Row = [f64; 15];

/// Rows as a table of the columns that `kept` holds, rounded to f32.
pub(super) fn table(rows: &[Row], kept: impl Fn(&str) -> bool, origin: &str) -> Table {
    let mut table = points::of_rows(COLUMNS, rows, format!("scratch_response: {origin}"));
    table.columns.retain(|column| kept(&column.name));
    points::rounded(table)
}

/// A column of the second scratch of a pair.
fn of_second(name: &str) -> bool {
    name.starts_with("second") || name.starts_with("turn")
}

/// A column that a pair of infinite scratches does not have.
fn of_ends(name: &str) -> bool {
    ["begin_um", "end_um", "mu_o"].contains(&name)
}

fn draws(seed: u64, draw: fn(&mut ChaCha12Rng, f64) -> Row) -> Table {
    table(&rows(seed, draw), |name| !of_second(name), "seeded draws")
}

fn pair_draws(seed: u64) -> Table {
    table(&rows(seed, pair), |name| !of_ends(name), "seeded draws of pairs")
}

/// Draws at nine wavelengths.
fn rows(seed: u64, draw: fn(&mut ChaCha12Rng, f64) -> Row) -> Vec<Row> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let wavelengths = (0..9).map(|i| 0.38 + 0.05 * f64::from(i));
    wavelengths.flat_map(|um| (0..DRAWS).map(move |_| um)).map(|um| draw(&mut rng, um)).collect()
}

/// Standard normal, by the sum of twelve uniforms: its tails end at 6.
fn normal(rng: &mut ChaCha12Rng) -> f64 {
    (0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0
}

fn visible(rng: &mut ChaCha12Rng, wavelength_um: f64) -> Row {
    let size = |rng: &mut ChaCha12Rng| 0.3 * (20.0_f64 / 0.3).powf(rng.random());
    let sizes = [size(rng), size(rng)];
    let ends = ends_of_every_second(rng);
    row(rng, wavelength_um, sizes, ends, lobe_or_anywhere)
}

/// Ends over σ: none inside the coherence area, or one.
fn ends_of_every_second(rng: &mut ChaCha12Rng) -> [f64; 2] {
    if rng.random() {
        [-10.0, 10.0]
    } else {
        let begin = rng.random_range(-2.0..2.0);
        [begin, begin + 0.1 * 100_f64.powf(rng.random())]
    }
}

/// W and D of velinov2018 section 5.
fn sizes(rng: &mut ChaCha12Rng) -> [f64; 2] {
    [rng.random_range(0.8..6.0), rng.random_range(0.8..6.0)]
}

fn long(rng: &mut ChaCha12Rng, wavelength_um: f64) -> Row {
    let sizes = sizes(rng);
    row(rng, wavelength_um, sizes, [-10.0, 10.0], lobe_or_anywhere)
}

fn mirror(rng: &mut ChaCha12Rng, wavelength_um: f64) -> Row {
    let sizes = sizes(rng);
    row(rng, wavelength_um, sizes, [-10.0, 10.0], within_mirror)
}

fn mirror_with_ends(rng: &mut ChaCha12Rng, wavelength_um: f64) -> Row {
    let sizes = sizes(rng);
    let ends = ends_of_every_second(rng);
    row(rng, wavelength_um, sizes, ends, within_mirror)
}

/// ξ₂ within the lobe of the mirror.
fn within_mirror(rng: &mut ChaCha12Rng, wavelength_um: f64, _: f64) -> f64 {
    normal(rng) * wavelength_um / (2.0 * PI * SIGMA_UM)
}

fn pair(rng: &mut ChaCha12Rng, wavelength_um: f64) -> Row {
    let mut row = long(rng, wavelength_um);
    [row[11], row[12]] = sizes(rng);
    row[13] = rng.random_range(-2.0..2.0) * SIGMA_UM;
    let most = if rng.random() { PI / 60.0 } else { PI };
    row[14] = rng.random_range(-most..most);
    row
}

/// ξ₂ inside eight lobes or over every exitance.
fn lobe_or_anywhere(rng: &mut ChaCha12Rng, wavelength_um: f64, width_um: f64) -> f64 {
    if rng.random() {
        rng.random_range(-4.0..4.0) * wavelength_um / width_um
    } else {
        rng.random_range(-1.9..1.9)
    }
}

/// A row with the directions drawn until both are above the surface; σ is the paper's.
fn row(
    rng: &mut ChaCha12Rng,
    wavelength_um: f64,
    [width, depth]: [f64; 2],
    [begin, end]: [f64; 2],
    across: fn(&mut ChaCha12Rng, f64, f64) -> f64,
) -> Row {
    let offset = rng.random_range(-2.0..2.0) * SIGMA_UM;
    loop {
        let along = normal(rng) * wavelength_um / (2.0 * PI * SIGMA_UM);
        let across = across(rng, wavelength_um, width);
        let (elevation, azimuth) =
            (rng.random_range(0.0..4.0 * PI / 9.0), rng.random_range(-PI..PI));
        let (x, y) = (elevation.sin() * azimuth.cos(), elevation.sin() * azimuth.sin());
        let beyond = (along - x).powi(2) + (across - y).powi(2);
        if beyond < 0.99 {
            let mu_o = (1.0 - beyond).sqrt();
            let mut row = [0.0; 15];
            row[..7].copy_from_slice(&[
                width,
                depth,
                wavelength_um,
                SIGMA_UM,
                along,
                across,
                offset,
            ]);
            let mu_sum = mu_o + elevation.cos();
            row[7..11].copy_from_slice(&[mu_sum, begin * SIGMA_UM, end * SIGMA_UM, mu_o]);
            return row;
        }
    }
}

/// Points that have broken implementations, every column among them.
pub(super) fn hard_rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for sigma in [0.1, 10.0, 60.0, 1e4] {
        for wavelength in [0.38, 0.55, 0.78] {
            for width in [0.01, 0.3, 3.0, 20.0, 1000.0] {
                for (index, depth) in
                    [0.0, wavelength / 4.0, wavelength / 2.0, 5.25 * wavelength, 20.0, 1000.0]
                        .into_iter()
                        .enumerate()
                {
                    rows.extend(hard_directions([width, depth, wavelength, sigma], index));
                }
            }
        }
    }
    rows
}

/// Directions and ends at one size; `index` picks the ends and the second scratch in turn.
fn hard_directions([width, depth, wavelength, sigma]: [f64; 4], index: usize) -> Vec<Row> {
    let ends = [[-10.0, 10.0], [0.0, 10.0], [-5e-5, 5e-5], [-1e4, 1e4], [4.0, 9.0], [-9.0, 0.0]];
    let [begin, end] = ends[index % ends.len()].map(|end| end * sigma);
    let unit = wavelength / (2.0 * PI * sigma);
    let turn = [0.0, 1e-4, PI / 2.0, PI][index % 4];
    let at = |along: f64, across: f64, offset: f64, mu_sum: f64| -> Row {
        let mut row = [0.0; 15];
        row[..4].copy_from_slice(&[width, depth, wavelength, sigma]);
        row[4..11].copy_from_slice(&[along, across, offset, mu_sum, begin, end, 0.5 * mu_sum]);
        row[11..].copy_from_slice(&[width * 0.5 + 0.1, depth + 0.1, -offset, turn]);
        row
    };
    vec![
        at(0.0, 0.0, 0.0, 2.0),
        at(0.0, wavelength / width, 0.0, 1.9),
        at(unit, -1e-4, sigma, 1.5),
        at(-7.0 * unit, 0.4, -0.3 * sigma, 1.0),
        at(0.0, 1.9, 0.5 * sigma, 0.02),
        at(1.0, 1e-12, 20.0 * sigma, 0.0),
    ]
}
