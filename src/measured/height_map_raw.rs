//! Raw height maps: f32 numbers in one file, and their size in a JSON sidecar.

use std::path::Path;

use serde::Deserialize;

use super::error::require;
use super::{HeightMap, MeasuredError};
use crate::table::store;

/// What a `dtype` begins with.
const NUMBERS: &str = "little-endian f32, row-major [y][x]";

/// What a `dtype` says before the unit.
const HEIGHT_IN: &str = "height in ";

/// Raw heights that differ by less are not in nm: it is a hundredth of an atom's radius.
const LEAST_RANGE_NM: f64 = 1e-3;

/// What stands in `<stem>.json`.
#[derive(Debug, Deserialize)]
struct Sidecar {
    nx: usize,
    ny: usize,
    dx_um: f64,
    dy_um: f64,
    dtype: Option<String>,
    #[serde(alias = "z_unit", alias = "unit")]
    height_unit: Option<String>,
}

/// Reads the file and its sidecar.
pub(super) fn read(path: &Path) -> Result<HeightMap, MeasuredError> {
    let sidecar_path = path.with_extension("json");
    let sidecar_origin = sidecar_path.display().to_string();
    let bytes = store::read(path)?;
    let sidecar = parse(&sidecar_origin, &store::read_text(&sidecar_path)?)?;
    let mut map = heights(&path.display().to_string(), &bytes, &sidecar_origin, &sidecar)?;
    map.origin = store::origin(path, &bytes);
    Ok(map)
}

fn parse(origin: &str, text: &str) -> Result<Sidecar, MeasuredError> {
    let sidecar: Sidecar = serde_json::from_str(text).map_err(|e| MeasuredError::Malformed {
        origin: origin.into(),
        line: e.line().max(1) as u64,
        reason: e.to_string(),
    })?;
    if let Some(dtype) = &sidecar.dtype {
        require(dtype.starts_with(NUMBERS), origin, || {
            format!("dtype: expected {NUMBERS:?}, got {dtype:?}")
        })?;
    }
    let in_dtype = sidecar.dtype.as_deref().and_then(|dtype| dtype.split_once(HEIGHT_IN));
    let in_dtype = in_dtype.and_then(|(_, rest)| rest.split([',', ';', ' ']).next());
    for (key, unit) in [("dtype", in_dtype), ("height_unit", sidecar.height_unit.as_deref())] {
        let unit = unit.unwrap_or("nm");
        require(unit == "nm", origin, || format!("{key}: expected heights in nm, got {unit:?}"))?;
    }
    Ok(sidecar)
}

fn heights(
    origin: &str,
    bytes: &[u8],
    sidecar_origin: &str,
    sidecar: &Sidecar,
) -> Result<HeightMap, MeasuredError> {
    let (nx, ny) = (sidecar.nx, sidecar.ny);
    let expected = (nx as u64).saturating_mul(ny as u64).saturating_mul(4);
    let got = bytes.len() as u64;
    require(got == expected, origin, || {
        let of = format!("{nx} × {ny} samples of 4 bytes, as {sidecar_origin} says");
        format!("{got} bytes, expected {expected} for {of}")
    })?;
    let (samples, _) = bytes.as_chunks();
    let map = HeightMap {
        nx,
        ny,
        dx_um: sidecar.dx_um,
        dy_um: sidecar.dy_um,
        height_nm: samples.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect(),
        origin: origin.into(),
    };
    map.check()?;
    let range = map.range_nm().map_or(0.0, |[low, high]| high - low);
    require(range == 0.0 || range >= LEAST_RANGE_NM, origin, || {
        format!(
            "heights range over {range:e} nm, less than {LEAST_RANGE_NM} nm; expected heights in nm, \
             not in m or µm"
        )
    })?;
    Ok(map)
}
