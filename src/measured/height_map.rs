//! Height maps of surfaces, as profilers and atomic force microscopes measure them.

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
