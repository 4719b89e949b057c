//! Maps of radiance over the sphere, and their convolution with a diffraction kernel
//! (toisoul2017 §3.2, §4.3 and §5).
//!
//! # Symbols
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | ω_i, ω_o | | 1 | directions of light and of view, unit |
//! | r_v | `outwards` | 1 | ω_o mirrored in the surface |
//! | h | `h_x`, `h_y` | 1 | ω_i + ω_o projected on the surface, not normalised |
//! | S_d | table | sr⁻¹ | energy per area of direction cosines, 1 in total for a lossless surface |
//! | w | | 1 | n·ω_i + n·ω_o |
//! | F₀ | | 1 | reflectance at normal incidence, applied by the surface |
//!
//! # What is summed
//!
//! A surface sends to the eye L = F₀ ∫∫ S_d(h; w) L_i dh_x dh_y (see [`crate::render::surface`]). Under
//! n = ω_o = r_v the direction of light with the projection h is (h_x, h_y, c), c = √(1 − |h|²), and
//! w = 1 + c. Orders with |h| > 1 do not exist; what they hold in a table is the mirror's, as what orders
//! lose at their w, so that the sum of the weights is that of the table.
//!
//! Eq. 6 and 7 of toisoul2017 sum ((1 + c)/2)² S_d L_i, without the area of a cell and the 1/c of eq. 3;
//! the pseudo-code divides by the largest sum of weights.
//!
//! # Why two passes are exact on the sphere, but for the poles
//!
//! A pass moves a direction by an angle along a great circle. Moved by s₂ along the meridian and then
//! by s₁ to the east, r goes to sin s₁ e + cos s₁ (sin s₂ n + cos s₂ r): the projection on the frame
//! (e, n) of r is h = (sin s₁, cos s₁ sin s₂), because the east stays the same along a meridian.
//! Tabulated over the two angles, by area, a kernel of rank r is
//! convolved by r pairs of passes exactly; over h_x and h_y it would not be. What is left is the
//! interpolation of the map between the passes, and the poles of its frame: a move along a meridian
//! that crosses one comes down with the east turned about, so that what of the kernel is odd in s₁
//! is mirrored there. Maps turned into the frame of a surface have their poles where its plane is.

mod azimuthal;
mod kernel;
mod passes;
mod taps;

pub use azimuthal::AzimuthalOperator;
pub use kernel::AngularKernel;
pub(in crate::render) use kernel::along;
pub(in crate::render) use passes::{MOST_TAPS, STILL, kernel, lookup, summed};
pub use passes::{convolved, turned};
pub use taps::Taps;

use crate::measured::environment::{Environment, LatLong};

/// R, G, B over the sphere, laid out as an [`Environment`]; values may be negative.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereMap {
    /// Texels around.
    pub width: usize,
    /// Texels from zenith to nadir.
    pub height: usize,
    /// Three numbers per texel, row by row.
    pub rgb: Vec<f32>,
}

impl From<&Environment> for SphereMap {
    fn from(environment: &Environment) -> Self {
        Self {
            width: environment.width,
            height: environment.height,
            rgb: environment.radiance.as_flattened().to_vec(),
        }
    }
}

impl SphereMap {
    fn layout(&self) -> LatLong {
        LatLong { width: self.width, height: self.height }
    }

    /// R, G, B in a direction of any length but 0, in f64: bilinear ([`LatLong::bilinear`]).
    pub fn bilinear(&self, direction: [f64; 3]) -> [f64; 3] {
        self.layout().bilinear(direction, self.rgb.as_chunks().0)
    }

    /// Columns of the texels' places, `first` and `layer` as [`passes`] take them.
    fn places(&self) -> [Vec<f32>; 2] {
        let texels = 0..self.width * self.height;
        let column = texels.clone().map(|at| (at % self.width) as f32).collect();
        [column, texels.map(|at| (at / self.width) as f32).collect()]
    }

    /// A map of the same size.
    fn with(&self, columns: &[Vec<f32>]) -> Self {
        let mut rgb = Vec::with_capacity(self.rgb.len());
        for at in 0..self.width * self.height {
            rgb.extend(columns.iter().map(|column| column.get(at).copied().unwrap_or(f32::NAN)));
        }
        Self { rgb, ..*self }
    }
}
