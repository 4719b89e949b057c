//! The optical constants in `data/measured/optical_constants/`: `<Material>.<Source>.csv` with
//! columns `wavelength`, `n` and, for what absorbs, `k`.

use std::path::Path;

use super::MeasuredError;
use super::error::require;
use super::spectra::increasing;
use super::tabulation::{ends, linear};
use crate::table::{Table, TableError};

/// n and k of one material as one source measured them.
#[derive(Debug, Clone, PartialEq)]
pub struct OpticalConstants {
    /// Material, such as `Au`.
    pub material: String,
    /// Who measured, such as `Johnson`.
    pub source: String,
    /// The table as read.
    pub table: Table,
    wavelength_nm: Vec<f64>,
    n: Vec<f64>,
    k: Vec<f64>,
}

impl OpticalConstants {
    /// Reads `<Material>.<Source>.csv`.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file: a name of another shape, a faulty table, wavelengths
    /// that do not increase, n ≤ 0 or k < 0.
    pub fn read(path: &Path) -> Result<Self, MeasuredError> {
        let origin = path.display().to_string();
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
        let Some((material, source)) = stem.split_once('.') else {
            return Err(MeasuredError::unusable(origin, "expected a name <Material>.<Source>.csv"));
        };
        let table = Table::read_csv(path)?;
        let wavelength_nm = increasing(&origin, &table)?;
        let n = table.values_in("n", "1")?;
        let k = match table.column("k") {
            Some(_) => table.values_in("k", "1")?,
            None => vec![0.0; n.len()],
        };
        for n in &n {
            require(*n > 0.0, &origin, || format!("expected n > 0, got {n}"))?;
        }
        for k in &k {
            require(*k >= 0.0, &origin, || format!("expected k ≥ 0, got {k}"))?;
        }
        let (material, source) = (material.to_owned(), source.to_owned());
        Ok(Self { material, source, table, wavelength_nm, n, k })
    }

    /// `Material.Source`.
    pub fn name(&self) -> String {
        format!("{}.{}", self.material, self.source)
    }

    /// The measured wavelengths, nm, increasing.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelength_nm
    }

    /// First and last measured wavelength, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        ends(&self.wavelength_nm)
    }

    /// (n, k) at a wavelength in nm, linear between the measured wavelengths; k is 0 where the
    /// source gives none.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] outside [`OpticalConstants::range_nm`].
    pub fn at(&self, wavelength_nm: f64) -> Result<(f64, f64), MeasuredError> {
        let value = |values| linear(&self.wavelength_nm, values, wavelength_nm);
        match (value(&self.n), value(&self.k)) {
            (Some(n), Some(k)) => Ok((n, k)),
            _ => {
                let range = self.range_nm();
                Err(MeasuredError::out_of_range(&self.name(), "n, k", range, wavelength_nm))
            }
        }
    }
}

/// Every `*.csv` of a folder, sorted by material and source.
///
/// # Errors
/// As [`OpticalConstants::read`]; [`TableError::Content`] for a folder without CSV files.
pub fn load(folder: &Path) -> Result<Vec<OpticalConstants>, MeasuredError> {
    let unreadable = |source| TableError::Unreadable { path: folder.into(), source };
    let mut constants = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|e| e == "csv") {
            constants.push(OpticalConstants::read(&path)?);
        }
    }
    if constants.is_empty() {
        let origin = folder.display().to_string();
        return Err(TableError::content(origin, "no CSV files in the folder").into());
    }
    constants.sort_by(|a, b| (&a.material, &a.source).cmp(&(&b.material, &b.source)));
    Ok(constants)
}
