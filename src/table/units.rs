//! The units that a table may use: a closed list, so that a misspelt unit is an error and not a
//! silently different quantity.

use super::TableError;

/// A unit: its symbol, what it measures, and its size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As written between the brackets of a header.
    pub symbol: &'static str,
    /// What it measures, in words; units of one dimension convert into each other.
    pub dimension: &'static str,
    /// Power of ten of its size in the dimension's coherent unit.
    pub exponent: i32,
    /// What the power of ten is multiplied by; 1 for a metric unit.
    pub scale: f64,
}

const fn unit(symbol: &'static str, dimension: &'static str, exponent: i32) -> Unit {
    Unit { symbol, dimension, exponent, scale: 1.0 }
}

/// Every known unit.
pub const KNOWN: &[Unit] = &[
    unit("1", "pure number", 0),
    unit("%", "pure number", -2),
    unit("nm", "length", -9),
    unit("um", "length", -6),
    unit("µm", "length", -6),
    unit("mm", "length", -3),
    unit("m", "length", 0),
    unit("nm^2", "area", -18),
    unit("um^2", "area", -12),
    unit("mm^2", "area", -6),
    unit("m^2", "area", 0),
    unit("nm^-1", "wavenumber", 9),
    unit("um^-1", "wavenumber", 6),
    unit("mm^-1", "wavenumber", 3),
    unit("m^-1", "wavenumber", 0),
    unit("rad", "angle", 0),
    Unit { symbol: "deg", dimension: "angle", exponent: 0, scale: std::f64::consts::PI / 180.0 },
    unit("sr", "solid angle", 0),
    unit("sr^-1", "reciprocal solid angle", 0),
    Unit { symbol: "eV", dimension: "energy", exponent: -19, scale: 1.602_176_634 },
    unit("J", "energy", 0),
    unit("W", "power", 0),
    unit("W/m^2", "irradiance", 0),
    unit("W/(m^2 nm)", "spectral irradiance", 9),
    unit("W/(m^2 sr)", "radiance", 0),
    unit("W/(m^2 sr nm)", "spectral radiance", 9),
    unit("K", "temperature", 0),
    unit("ns", "time", -9),
    unit("us", "time", -6),
    unit("ms", "time", -3),
    unit("s", "time", 0),
    unit("px", "pixels", 0),
    unit("ulp", "units in the last place", 0),
];

/// The unit written `symbol`.
///
/// # Errors
/// [`TableError::Content`] naming `origin`, `column` and the known units.
pub fn require(symbol: &str, origin: &str, column: &str) -> Result<&'static Unit, TableError> {
    KNOWN.iter().find(|unit| unit.symbol == symbol).ok_or_else(|| {
        let known = KNOWN.iter().map(|unit| unit.symbol).collect::<Vec<_>>().join(", ");
        let reason = format!("column {column:?}: unknown unit {symbol:?}; known units: {known}");
        TableError::content(origin, reason)
    })
}

/// What a value in `from` is multiplied by to be in `to`; exactly 1 for equal units.
///
/// # Errors
/// [`TableError::Content`] for a symbol that is not known, or where the dimensions differ.
pub fn conversion(from: &str, to: &str, origin: &str, column: &str) -> Result<f64, TableError> {
    let (a, b) = (require(from, origin, column)?, require(to, origin, column)?);
    if a.dimension != b.dimension {
        let (expected, example) = (b.dimension, b.symbol);
        let reason = format!(
            "column {column:?}: expected a unit of {expected} (such as {example:?}), got {from:?}"
        );
        return Err(TableError::content(origin, reason));
    }
    // Apart from the power of ten, so that nm to m is exactly the nearest number to 1e-9.
    let shift = a.exponent - b.exponent;
    let power = 10f64.powi(shift.abs());
    let scale = a.scale / b.scale;
    Ok(if shift < 0 { scale / power } else { scale * power })
}
