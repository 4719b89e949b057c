//! Tables of points: rows of arguments of a reference, rounded to f32.

use crate::effect::{Quantity, points};
use crate::table::Table;

const KW: Quantity = Quantity { name: "kw", unit: "1", domain: "(0, inf)" };
const KS: Quantity = Quantity { name: "ks", unit: "1", domain: "(0, inf)" };

/// A finite number with a name.
const fn any(name: &'static str, unit: &'static str) -> Quantity {
    Quantity { name, unit, domain: "any finite" }
}

/// Arguments of `sphere_light`.
pub(super) const SPHERE: [Quantity; 8] = [
    KW,
    KS,
    any("view_x", "1"),
    any("view_y", "1"),
    any("centre_x", "length"),
    any("centre_y", "length"),
    any("centre_z", "length"),
    Quantity { name: "radius", unit: "length", domain: "(0, inf)" },
];

/// Arguments of `triangle_light`.
pub(super) const TRIANGLE: [Quantity; 13] = [
    KW,
    KS,
    any("view_x", "1"),
    any("view_y", "1"),
    any("a_x", "length"),
    any("a_y", "length"),
    any("a_z", "length"),
    any("b_x", "length"),
    any("b_y", "length"),
    any("b_z", "length"),
    any("c_x", "length"),
    any("c_y", "length"),
    any("c_z", "length"),
];

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

/// The rows as a table with one column per argument, every number rounded to f32.
pub(super) fn table<const N: usize>(
    arguments: &[Quantity; N],
    rows: &[[f64; N]],
    origin: &str,
) -> Table {
    let columns = arguments.iter().map(|argument| (argument.name, argument.unit));
    points::rounded(points::of_rows(columns, rows, format!("area_light: {origin}")))
}
