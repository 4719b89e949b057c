//! Tables of points: rows of arguments of a reference, rounded to f32.

use crate::effect::points;
use crate::effects::area_light::EFFECT;
use crate::table::Table;

/// Arguments of `sphere_light` at one point.
pub(super) fn sphere_row(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    centre: [f64; 3],
    radius: f64,
) -> [f64; 8] {
    [kw, ks, view[0], view[1], centre[0], centre[1], centre[2], radius]
}

/// Arguments of `triangle_light` at one point.
pub(super) fn triangle_row(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    [a, b, c]: [[f64; 3]; 3],
) -> [f64; 13] {
    [kw, ks, view[0], view[1], a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
}

/// The rows as a table with one column per argument of `reference`, every number rounded to f32.
pub(super) fn table<const N: usize>(reference: &str, rows: &[[f64; N]], origin: &str) -> Table {
    let arguments = EFFECT.reference(reference).arguments.iter();
    let columns = arguments.map(|argument| (argument.name, argument.unit));
    points::rounded(points::of_rows(columns, rows, format!("area_light: {origin}")))
}
