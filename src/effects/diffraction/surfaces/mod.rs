//! Height maps made to a documented geometry.
//!
//! Every surface is sampled over a square patch. An edge crosses a sample with the share of the sample
//! that lies on its far side, so that moving it by a fraction of a sample moves the orders as it should.
//! Directions are turned counter-clockwise from the x axis. Random numbers are counter-based: stream s
//! of seed n is the same however many streams are drawn, and in whichever order.

mod disc;
mod gratings;
mod pixels;

use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;

pub use disc::{CompactDisc, compact_disc};
pub use gratings::{Grating, HolographicPaper, Profile, grating, holographic_paper};
pub use pixels::{PixelLattice, pixel_lattice};

use crate::measured::height_map::HeightMap;

/// Patch over which a surface is sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Samples per side; along y alone where `line` says so.
    pub samples: usize,
    /// Length of a side, µm.
    pub side_um: f64,
    /// One row only, for what does not vary along y.
    pub line: bool,
}

impl Patch {
    /// Distance of samples, µm.
    pub fn pitch_um(&self) -> f64 {
        self.side_um / self.samples as f64
    }

    /// The heights `height(x, y)`, nm, with the origin of x and y, µm, at the centre of the patch.
    fn heights(&self, origin: String, height: impl Fn(f64, f64) -> f64) -> HeightMap {
        let (nx, ny) = (self.samples, if self.line { 1 } else { self.samples });
        let d = self.pitch_um();
        let at = |i: usize, n: usize| ((i as f64 + 0.5) - 0.5 * n as f64) * d;
        let rows = (0..ny).flat_map(|y| (0..nx).map(move |x| (x, y)));
        HeightMap {
            nx,
            ny,
            dx_um: d,
            // A line stands for a patch that is much longer than light resolves.
            dy_um: if self.line { LINE_LENGTH_UM } else { d },
            height_nm: rows.map(|(x, y)| height(at(x, nx), at(y, ny))).collect(),
            origin,
        }
    }
}

/// Length along y that one row stands for, µm: 1e-4 in h at 1 µm.
const LINE_LENGTH_UM: f64 = 1e4;

/// Stream `stream` of `seed`.
fn random(seed: u64, stream: u64) -> ChaCha12Rng {
    let mut generator = ChaCha12Rng::seed_from_u64(seed);
    generator.set_stream(stream);
    generator
}

/// Share of a sample of width `pitch` inside an interval of half-width `half`, its centre `distance`
/// from the interval's.
fn coverage(distance: f64, half: f64, pitch: f64) -> f64 {
    ((half - distance.abs()) / pitch + 0.5).clamp(0.0, 1.0)
}

/// x and y in a frame turned by `angle`, rad.
fn turned(x: f64, y: f64, angle: f64) -> (f64, f64) {
    let (sin, cos) = core_math::sincos(angle);
    (x * cos + y * sin, y * cos - x * sin)
}

/// `x` modulo `period`, in [−period/2, period/2).
fn folded(x: f64, period: f64) -> f64 {
    x - period * (x / period + 0.5).floor()
}

#[cfg(test)]
mod tests;
