//! Raw height maps: f32 numbers in one file, and their size in a JSON sidecar.

use std::path::Path;

use serde::Deserialize;

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
    let implausible = |reason: String| MeasuredError::implausible(origin, reason);
    if let Some(dtype) = &sidecar.dtype {
        if !dtype.starts_with(NUMBERS) {
            return Err(implausible(format!("dtype: expected {NUMBERS:?}, got {dtype:?}")));
        }
        if let Some((_, rest)) = dtype.split_once(HEIGHT_IN) {
            let unit = rest.split([',', ';', ' ']).next().unwrap_or_default();
            require_nm(origin, "dtype", unit)?;
        }
    }
    if let Some(unit) = &sidecar.height_unit {
        require_nm(origin, "height_unit", unit)?;
    }
    Ok(sidecar)
}

fn require_nm(origin: &str, key: &str, unit: &str) -> Result<(), MeasuredError> {
    if unit == "nm" {
        return Ok(());
    }
    let reason = format!("{key}: expected heights in nm, got {unit:?}");
    Err(MeasuredError::implausible(origin, reason))
}

fn heights(
    origin: &str,
    bytes: &[u8],
    sidecar_origin: &str,
    sidecar: &Sidecar,
) -> Result<HeightMap, MeasuredError> {
    let (nx, ny) = (sidecar.nx, sidecar.ny);
    let expected = (nx as u64).saturating_mul(ny as u64).saturating_mul(4);
    if bytes.len() as u64 != expected {
        return Err(MeasuredError::Length {
            origin: origin.into(),
            what: "bytes",
            got: bytes.len() as u64,
            expected,
            width: nx,
            height: ny,
            hint: format!(" samples of 4 bytes, as {sidecar_origin} says"),
        });
    }
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
    match map.range_nm() {
        Some([low, high]) if high > low && high - low < LEAST_RANGE_NM => {
            let range = high - low;
            let reason = format!(
                "heights range over {range:e} nm, less than {LEAST_RANGE_NM} nm; expected heights \
                 in nm, not in m or µm"
            );
            Err(MeasuredError::implausible(origin, reason))
        }
        _ => Ok(map),
    }
}
