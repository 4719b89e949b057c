//! Points that have broken implementations.

use std::f64::consts::PI;

use super::regions::{Row, table};
use crate::effect::Region;

/// The hard cases, as registered.
pub(super) const HARD_CASES: Region = Region {
    name: "hard cases",
    description: "W from 10 nm to 1 mm, depths of whole quarters of the wavelength, the mirror direction, zeros \
                  of the sinc, an end at the shaded point, scratches of 1e-4 and 1e4 sigma, one wholly \
                  outside the coherence area, sigma of 0.1 um and 10 mm, parallel and crossed pairs",
    points: || table(&rows(), |_| true, "hard cases"),
    ..Region::EMPTY
};

/// The rows of the table, every column among them.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for sigma in [0.1, 10.0, 60.0, 1e4] {
        for wavelength in [0.38, 0.55, 0.78] {
            for width in [0.01, 0.3, 3.0, 20.0, 1000.0] {
                for (index, depth) in
                    [0.0, wavelength / 4.0, wavelength / 2.0, 5.25 * wavelength, 20.0, 1000.0]
                        .into_iter()
                        .enumerate()
                {
                    rows.extend(directions([width, depth, wavelength, sigma], index));
                }
            }
        }
    }
    rows
}

/// Directions and ends at one size; `index` picks the ends and the second scratch in turn.
fn directions([width, depth, wavelength, sigma]: [f64; 4], index: usize) -> Vec<Row> {
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
