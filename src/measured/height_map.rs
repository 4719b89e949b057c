//! Height maps of surfaces, as profilers and atomic force microscopes measure them.

use std::path::Path;

use serde::Deserialize;

use super::MeasuredError;
use super::error::require;
use super::import::{extension, unknown_format};
use super::samples::{Samples, size_fault};
use crate::table::{Axis, Grid, GridChannel, store, units};

/// Name of the channel of heights in a grid.
const HEIGHT: &str = "height";

/// Name of the channel that is 1 where a grid has data and 0 where it has none.
const VALID: &str = "valid";

/// What a `dtype` begins with.
const NUMBERS: &str = "little-endian f32, row-major [y][x]";

/// What a `dtype` says before the unit.
const HEIGHT_IN: &str = "height in ";

/// Raw heights that differ by less are not in nm: it is a hundredth of an atom's radius.
const LEAST_RANGE_NM: f64 = 1e-3;

/// Heights of a surface over a regular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    /// Samples along x.
    pub nx: usize,
    /// Samples along y.
    pub ny: usize,
    /// Distance of samples along x, µm.
    pub dx_um: f64,
    /// Distance of samples along y, µm.
    pub dy_um: f64,
    /// Heights in nm, row-major `[y][x]`; NaN where there is no data.
    pub height_nm: Vec<f64>,
    /// One line on the origin: file and SHA-256, or what made it.
    pub origin: String,
}

impl HeightMap {
    /// Reads a height map, of the format that the name ends in.
    ///
    /// - `.f32`: little-endian f32, row-major `[y][x]`, nm, NaN where there is no data. Beside it,
    ///   `<stem>.json` holds `nx`, `ny`, `dx_um` and `dy_um`. Where it also has a `dtype` or a
    ///   `height_unit`, they must say the same; other keys are not looked at.
    /// - `.exr`: a [`Grid`] with its sidecar of axes, see [`HeightMap::from_grid`].
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file: not there, another format, a sidecar that is missing,
    /// malformed or of another size than the file, heights in another unit, and as
    /// [`HeightMap::check`]. Raw heights that differ by less than a picometre in all are refused
    /// too: they are in µm or m.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeasuredError> {
        let path = path.as_ref();
        match extension(path).as_str() {
            "f32" => read_raw(path),
            "exr" => Self::from_grid(&Grid::read_exr(path)?),
            _ => Err(unknown_format(
                path,
                "raw height map (.f32 with .json); grid (.exr with .exr.axes.toml)",
            )),
        }
    }

    /// The height map in a grid: channel `height` with a unit of length, axes that increase with
    /// units of length, and optionally `valid` \[1\], 0 where there is no data and else 1.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the grid's origin: no such channel, another unit, an axis that
    /// falls, and as [`HeightMap::check`].
    pub fn from_grid(grid: &Grid) -> Result<Self, MeasuredError> {
        grid.check_plane()?;
        let origin = grid.origin.clone();
        let channel = grid.require(HEIGHT)?;
        let to_nm = units::conversion(&channel.unit, "nm", &origin, HEIGHT)?;
        let spacing = |axis: &Axis| {
            let to_um = units::conversion(&axis.unit, "um", &origin, &axis.name)?;
            Ok::<f64, MeasuredError>(to_um * axis.step())
        };
        let (dx_um, dy_um) = (spacing(grid.x())?, spacing(grid.y())?);
        let mut height_nm: Vec<f64> =
            channel.values.iter().map(|value| f64::from(*value) * to_nm).collect();
        if let Some(valid) = grid.channel(VALID) {
            units::conversion(&valid.unit, "1", &origin, VALID)?;
            let samples = Samples { origin: &origin, width: grid.x().count, values: &valid.values };
            samples.refuse("values of `valid` are neither 0 nor 1", "0 or 1", |value| {
                (*value != 0.0 && *value != 1.0).then_some(f64::from(*value))
            })?;
            for (height, valid) in height_nm.iter_mut().zip(&valid.values) {
                if *valid == 0.0 {
                    *height = f64::NAN;
                }
            }
        }
        let (nx, ny) = (grid.x().count, grid.y().count);
        let map = Self { nx, ny, dx_um, dy_um, height_nm, origin };
        map.check()?;
        Ok(map)
    }

    /// The height map as a grid: axes `x` and `y` in µm from 0, `height` in nm rounded to f32, and
    /// `valid` if any sample has no data, which is then written as height 0.
    ///
    /// # Errors
    /// As [`HeightMap::check`]; a height beyond the range of f32.
    pub fn to_grid(&self) -> Result<Grid, MeasuredError> {
        self.check()?;
        let axis = |name: &str, count: usize, spacing: f64| {
            Axis::new(name, "um", [0.0, count as f64 * spacing], count)
        };
        let height = |nm: &f64| if nm.is_nan() { 0.0 } else { *nm as f32 };
        let mut channels =
            vec![GridChannel::new(HEIGHT, "nm", self.height_nm.iter().map(height).collect())];
        if self.height_nm.iter().any(|nm| nm.is_nan()) {
            let valid = |nm: &f64| if nm.is_nan() { 0.0 } else { 1.0 };
            channels.push(GridChannel::new(VALID, "1", self.height_nm.iter().map(valid).collect()));
        }
        let axes = [axis("x", self.nx, self.dx_um), axis("y", self.ny, self.dy_um)];
        Ok(Grid::new(axes, channels, &self.origin)?)
    }

    /// Height in nm at sample (`ix`, `iy`); `None` outside the map and where there is no data.
    pub fn at(&self, ix: usize, iy: usize) -> Option<f64> {
        if ix >= self.nx {
            return None;
        }
        let index = iy.checked_mul(self.nx)?.checked_add(ix)?;
        self.height_nm.get(index).copied().filter(|nm| !nm.is_nan())
    }

    /// Share of the samples that have data, 1, in [0, 1]; 0 for a map without samples.
    pub fn valid_fraction(&self) -> f64 {
        let valid = self.height_nm.iter().filter(|nm| !nm.is_nan()).count();
        valid as f64 / self.height_nm.len().max(1) as f64
    }

    /// Lateral size along x and y, µm: number of samples times their distance.
    pub fn size_um(&self) -> [f64; 2] {
        [self.nx as f64 * self.dx_um, self.ny as f64 * self.dy_um]
    }

    /// Lowest and highest height, nm; `None` where no sample has data.
    pub fn range_nm(&self) -> Option<[f64; 2]> {
        let known = self.height_nm.iter().copied().filter(|nm| !nm.is_nan());
        known.fold(None, |range, nm| match range {
            None => Some([nm, nm]),
            Some([low, high]) => Some([nm.min(low), nm.max(high)]),
        })
    }

    /// Checks what reading guarantees, for a map made in memory: at least two samples along either
    /// axis, positive finite distances, one height per sample, none infinite, not all missing, and
    /// a range of heights that is no larger than the lateral size.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), MeasuredError> {
        let (origin, width, height) = (self.origin.as_str(), self.nx, self.ny);
        let size = [width, height];
        if width.min(height) < 2 {
            return Err(size_fault(origin, size, "samples", "at least 2 along x and along y"));
        }
        for (name, spacing) in [("dx_um", self.dx_um), ("dy_um", self.dy_um)] {
            require(spacing.is_finite() && spacing > 0.0, origin, || {
                format!("{name} is {spacing} µm, expected a positive finite distance")
            })?;
        }
        let samples = Samples::filling(origin, size, &self.height_nm)?;
        samples.refuse("heights are infinite", "nm, or NaN where there is no data", |nm| {
            nm.is_infinite().then_some(*nm)
        })?;
        let Some([low, high]) = self.range_nm() else {
            let total = self.height_nm.len();
            let reason = format!("none of {total} samples has data: all are NaN");
            return Err(MeasuredError::unusable(origin, reason));
        };
        let [x, y] = self.size_um();
        let range = high - low;
        require(range <= 1e3 * x.max(y), origin, || {
            format!(
                "heights range over {range} nm, more than the lateral size of {x} × {y} µm; \
                 expected heights in nm and distances in µm"
            )
        })
    }
}

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

/// Reads f32 numbers in one file, and their size in a JSON sidecar.
fn read_raw(path: &Path) -> Result<HeightMap, MeasuredError> {
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
