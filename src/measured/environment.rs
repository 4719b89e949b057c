//! Environment maps: radiance from every direction, in latitude–longitude format.

/// Radiance from every direction of the sphere.
///
/// Rows run from the zenith (+z) to the nadir, columns with increasing azimuth from +x through +y.
/// The centre of texel (i, j) of `width` × `height` stands for the direction of azimuth
/// φ = 2π (i + ½)/width and polar angle θ = π (j + ½)/height, that is
/// (sin θ cos φ, sin θ sin φ, cos θ). `width` = 2 · `height`.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Texels around.
    pub width: usize,
    /// Texels from zenith to nadir.
    pub height: usize,
    /// Linear R, G, B, one per texel, row by row; finite and not negative.
    pub radiance: Vec<[f32; 3]>,
    /// One line on the origin: file and SHA-256.
    pub origin: String,
}
