use super::{Patch, coverage, folded, turned};
use crate::measured::height_map::HeightMap;

/// The pixels of a screen as a relief: three sub-pixels side by side per pixel, sunk by `depth_nm`
/// under the black matrix between them, on a lattice that may be turned and sheared.
///
/// The matrix of a real screen also absorbs; here only its height acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelLattice {
    /// Side of a square pixel, µm.
    pub pixel_um: f64,
    /// Width of the black matrix over that of a sub-pixel's cell, in [0, 1).
    pub matrix_share: f64,
    /// Depth of the sub-pixels, nm.
    pub depth_nm: f64,
    /// Direction of the rows, rad from the x axis.
    pub angle: f64,
    /// Columns lean by this angle from the normal of the rows, rad.
    pub skew: f64,
}

/// Sub-pixels of a pixel.
const SUB_PIXELS: f64 = 3.0;

/// Heights of a screen.
pub fn pixel_lattice(lattice: PixelLattice, patch: Patch) -> HeightMap {
    let origin = format!("{lattice:?} over {} µm", patch.side_um);
    let cell = lattice.pixel_um / SUB_PIXELS;
    // The matrix is as wide along the columns as across them.
    let matrix = lattice.matrix_share * cell;
    let lean = core_math::tan(lattice.skew);
    patch.heights(origin, |x, y| {
        let (u, v) = turned(x, y, lattice.angle);
        let across = folded(u - lean * v, cell);
        let along = folded(v, lattice.pixel_um);
        let pitch = patch.pitch_um();
        let open = coverage(across, 0.5 * (cell - matrix), pitch)
            * coverage(along, 0.5 * (lattice.pixel_um - matrix), pitch);
        -lattice.depth_nm * open
    })
}
