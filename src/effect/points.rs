//! Tables of points at which forms are judged, fitted, shown and held to laws.

use crate::table::{Column, Table};

/// Rows of numbers as a table with one column per name and unit.
pub fn of_rows<'a, const N: usize>(
    columns: impl IntoIterator<Item = (&'a str, &'a str)>,
    rows: &[[f64; N]],
    origin: String,
) -> Table {
    let values = |at: usize| rows.iter().map(|row| row[at]).collect();
    let columns = columns.into_iter().take(N).enumerate();
    Table {
        columns: columns.map(|(at, (name, unit))| Column::new(name, unit, values(at))).collect(),
        origin,
    }
}

/// The table with every number rounded to f32, so that a form in f32 and a reference in f64 see the
/// same points.
#[must_use]
pub fn rounded(mut table: Table) -> Table {
    for value in table.columns.iter_mut().flat_map(|column| &mut column.values) {
        *value = f64::from(*value as f32);
    }
    table
}

/// The f32 nearest to `x`, between the ones beside it.
pub fn neighbours(x: f64) -> [f32; 3] {
    let x = x as f32;
    [x.next_down(), x, x.next_up()]
}
