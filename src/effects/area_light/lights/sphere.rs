//! Sphere lights, cut into slices ξ₁ = const.
//!
//! A sphere of radius r with its centre at distance p > r is seen as the cone of half-angle
//! α = asin(r/p) around p̂. With ω = (sin β, cos β cos φ, cos β sin φ) and p̂ likewise at (β₀, φ₀),
//!
//! ω·p̂ = sin β sin β₀ + cos β cos β₀ cos(φ − φ₀) ≥ cos α
//! ⇔ sin²((φ − φ₀)/2) ≤ sin((α + δ)/2) sin((α − δ)/2) / (cos β cos β₀), δ = |β − β₀|,
//!
//! which keeps its relative accuracy however small the light. The upper hemisphere is φ in
//! (0, π); the interval [φ₀ − Δ, φ₀ + Δ] cut with it is up to two intervals if the centre lies below
//! the horizon. For p ≤ r the light is all around.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::across::{Slice, Sliced};
use super::vector::unit;

/// The cone under which a sphere is seen, from the side of the view.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    /// Latitude β₀ of the axis above the plane x = 0.
    latitude: f64,
    /// Azimuth φ₀ of the axis about x, from y to z, in (−π, π].
    azimuth: f64,
    /// The axis, a unit vector.
    axis: [f64; 3],
    /// Half-angle α, at most π/2.
    half_angle: f64,
    /// view_x + sin β₀: ξ₁ of the axis.
    xi_1: f64,
    view: [f64; 2],
}

impl Cone {
    /// The cone of half-angle `half_angle` around `axis`, not zero, for a view of the given tangential parts.
    pub(super) fn new(axis: [f64; 3], half_angle: f64, view: [f64; 2]) -> Self {
        let axis = unit(axis);
        Self {
            latitude: axis[0].atan2(axis[1].hypot(axis[2])),
            azimuth: axis[2].atan2(axis[1]),
            axis,
            half_angle,
            xi_1: view[0] + axis[0],
            view,
        }
    }

    /// sin² of half the angle Δφ that the slice at offset s of latitude covers to either side.
    fn haversine(&self, s: f64) -> f64 {
        let (sum, difference) = (self.half_angle + s.abs(), self.half_angle - s.abs());
        let scale = (self.latitude + s).cos() * self.latitude.cos();
        let product = (0.5 * sum).sin() * (0.5 * difference).sin();
        if product <= 0.0 { 0.0 } else { product / scale.max(0.0) }
    }

    /// Offsets of latitude at which a point at azimuth `azimuth` lies on the boundary: where the
    /// horizon enters or leaves a slice.
    fn boundary_at(&self, azimuth: f64) -> [f64; 2] {
        // sin β p̂ₓ + cos β (p̂ cos) = cos α.
        let across = self.axis[1] * azimuth.cos() + self.axis[2] * azimuth.sin();
        let angle = self.axis[0].atan2(across);
        let opening = (self.half_angle.cos() / self.axis[0].hypot(across)).acos();
        [angle - opening, angle + opening].map(|latitude| latitude - self.latitude)
    }

    /// Offsets of latitude at which the boundary has ω_y = y.
    fn boundary_at_y(&self, y: f64) -> [f64; 2] {
        let radius = (1.0 - y * y).sqrt();
        let angle = self.axis[2].atan2(self.axis[0]);
        let scale = radius * self.axis[0].hypot(self.axis[2]);
        let opening = ((self.half_angle.cos() - y * self.axis[1]) / scale).acos();
        [angle - opening, angle + opening].map(|turn| (radius * turn.cos()).asin() - self.latitude)
    }
}

impl Sliced for Cone {
    fn range(&self) -> [f64; 2] {
        let from = (-self.half_angle).max(-FRAC_PI_2 - self.latitude);
        let to = self.half_angle.min(FRAC_PI_2 - self.latitude);
        // Below the horizon: as far as the boundary comes up.
        if self.axis[2] >= 0.0 {
            return [from, to];
        }
        let reach = self.axis[0].hypot(self.axis[1]);
        let opening = (self.half_angle.cos() / reach).acos();
        if opening.is_nan() {
            return [0.0, 0.0];
        }
        let turn = self.axis[1].atan2(self.axis[0]);
        let (first, second) = (turn - opening, turn + opening);
        // On the horizon ω_x = cos(turn) is the sine of π/2 less the angle to the x axis.
        let latitude = |turn: f64| {
            let angle = turn.abs();
            FRAC_PI_2 - angle.min(TAU - angle) - self.latitude
        };
        let (mut low, mut high) =
            (latitude(first).min(latitude(second)), latitude(first).max(latitude(second)));
        if first < 0.0 && second > 0.0 {
            high = FRAC_PI_2 - self.latitude;
        }
        if first < -PI || second > PI {
            low = -FRAC_PI_2 - self.latitude;
        }
        [low.max(from), high.min(to)]
    }

    fn xi_1_range(&self) -> [f64; 2] {
        self.range().map(|s| self.xi_1_at(s))
    }

    fn at_xi_1(&self, xi_1: f64) -> f64 {
        (xi_1 - self.view[0]).clamp(-1.0, 1.0).asin() - self.latitude
    }

    fn kinks(&self) -> Vec<f64> {
        // The whole slice is covered from where β + β₀ = ±(π − α) on.
        let whole =
            [PI - self.half_angle, self.half_angle - PI].map(|sum| sum - 2.0 * self.latitude);
        let horizon = [0.0, PI].map(|azimuth| self.boundary_at(azimuth));
        let lobe = self.boundary_at_y(-self.view[1]);
        let all = whole.into_iter().chain(horizon.into_iter().flatten()).chain(lobe);
        all.filter(|s| s.is_finite()).collect()
    }

    fn slice(&self, s: f64, slice: &mut Slice) {
        let cosine = (self.latitude + s).cos().max(0.0);
        slice.xi_1 = self.xi_1_at(s);
        slice.slope = cosine;
        slice.radius = cosine;
        slice.covered.clear();
        let haversine = self.haversine(s);
        if haversine >= 1.0 {
            slice.covered.push([0.0, PI]);
            return;
        }
        if haversine <= 0.0 {
            return;
        }
        let half = 2.0 * haversine.sqrt().asin();
        for turn in [-TAU, 0.0, TAU] {
            let from = (self.azimuth - half + turn).max(0.0);
            let to = (self.azimuth + half + turn).min(PI);
            if from < to {
                slice.covered.push([from, to]);
            }
        }
    }
}

impl Cone {
    /// ξ₁ at offset s of latitude; exact differences for small lights.
    fn xi_1_at(&self, s: f64) -> f64 {
        self.xi_1 + 2.0 * (self.latitude + 0.5 * s).cos() * (0.5 * s).sin()
    }
}

/// The whole upper hemisphere, seen from inside a sphere light: as a cone of half-angle π/2 around
/// the normal.
pub(super) fn hemisphere(view: [f64; 2]) -> Cone {
    Cone::new([0.0, 0.0, 1.0], FRAC_PI_2, view)
}
