//! Seeded draws of lights, views and scratches, from which regions and hard cases are made, and the rows of
//! arguments that they give.

use std::f64::consts::TAU;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use crate::effect::points;
use crate::effects::area_light::EFFECT;
use crate::table::Table;

/// A seeded source of scenes.
pub(super) struct Draw(ChaCha12Rng);

impl Draw {
    pub(super) fn new(seed: u64) -> Self {
        Self(ChaCha12Rng::seed_from_u64(seed))
    }

    /// Uniformly between two numbers.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Uniformly in the logarithm between two positive numbers.
    pub(super) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.0.random::<f64>())
    }

    /// −1 or 1.
    pub(super) fn sign(&mut self) -> f64 {
        if self.0.random::<bool>() { 1.0 } else { -1.0 }
    }

    /// One of a list that is not empty.
    pub(super) fn one_of(&mut self, list: &[f64]) -> f64 {
        list[self.0.random_range(0..list.len())]
    }

    /// kW of velinov2018's scenes: widths of 0.8 to 6 µm, wavelengths of 380 to 780 nm.
    pub(super) fn kw(&mut self) -> f64 {
        TAU * self.between(0.8, 6.0) / self.between(0.38, 0.78)
    }

    /// kW over all widths from 10 nm to 1 mm, with λ/W from 1e-3 to 10.
    pub(super) fn extreme_kw(&mut self) -> f64 {
        TAU / self.log_between(1e-3, 10.0)
    }

    /// A unit vector, uniformly in solid angle, with z in the given range.
    pub(super) fn direction(&mut self, low: f64, high: f64) -> [f64; 3] {
        let z = self.between(low, high);
        let turn = self.between(0.0, TAU);
        let reach = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        [reach * turn.cos(), reach * turn.sin(), z]
    }

    /// Tangential parts of a direction in the upper hemisphere, uniformly in solid angle.
    pub(super) fn view(&mut self) -> [f64; 2] {
        let [x, y, _] = self.direction(0.0, 1.0);
        [x, y]
    }

    /// ω_o·b for a given ω_o·t: uniformly over what is above the horizon.
    pub(super) fn view_y(&mut self, view_x: f64) -> f64 {
        let reach = ((1.0 - view_x) * (1.0 + view_x)).max(0.0).sqrt();
        self.between(-reach, reach)
    }

    /// A triangle around `centre` whose vertices lie at up to `size` from it.
    pub(super) fn triangle(&mut self, centre: [f64; 3], size: f64) -> [[f64; 3]; 3] {
        std::array::from_fn(|_| {
            let offset = self.direction(-1.0, 1.0);
            let reach = size * self.between(0.3, 1.0);
            [0, 1, 2].map(|axis| centre[axis] + reach * offset[axis])
        })
    }
}

/// Range of ω_x over a sphere seen under the half-angle `half_angle` around the unit vector `axis`
/// above the horizon.
pub(super) fn limbs(axis: [f64; 3], half_angle: f64) -> [f64; 2] {
    let latitude = axis[0].atan2(axis[1].hypot(axis[2]));
    let quarter = std::f64::consts::FRAC_PI_2;
    [-1.0, 1.0].map(|side| (latitude + side * half_angle).clamp(-quarter, quarter).sin())
}

/// Arguments of `sphere_light` at one point.
pub(super) fn sphere_row(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    centre: [f64; 3],
    radius: f64,
) -> [f64; 8] {
    [kw, ks, view[0], view[1], centre[0], centre[1], centre[2], radius]
}

/// Arguments of `triangle_light` at one point.
pub(super) fn triangle_row(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    [a, b, c]: [[f64; 3]; 3],
) -> [f64; 13] {
    [kw, ks, view[0], view[1], a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
}

/// The rows as a table with one column per argument of `reference`, every number rounded to f32.
pub(super) fn table<const N: usize>(reference: &str, rows: &[[f64; N]], origin: &str) -> Table {
    let arguments = EFFECT.reference(reference).arguments.iter();
    let columns = arguments.map(|argument| (argument.name, argument.unit));
    points::rounded(points::of_rows(columns, rows, format!("area_light: {origin}")))
}
