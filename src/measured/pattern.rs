//! Diffraction patterns as a camera records them at one wavelength.

/// Intensity over a regular grid, one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Linear intensity in any unit, row by row from the top; finite and not negative.
    pub intensity: Vec<f64>,
    /// One line on the origin: file and SHA-256.
    pub origin: String,
}
