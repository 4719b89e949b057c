//! The footprints that cameras produce.
//!
//! A pixel whose ray meets the surface at the distance D under the tilt τ covers an ellipse of
//! semi-axes a = D tan(FOV/2)/rows across the tilt and a/cos τ along it: the circle inscribed in the
//! pixel, projected. A scratch at the angle ψ to the tilt sees it as the image of the unit disc
//! under y = hu, x = mu + lv, with h² = (a² cos²ψ + (a²/cos²τ) sin²ψ)/σ², l = a²/(cos τ h σ²) and
//! m = (a²/cos²τ − a²) sin ψ cos ψ/(h σ²).

use std::f64::consts::TAU;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// Half-extent beyond which a footprint is left out: it holds hundreds of scratches, each as
/// good as a line.
const LARGEST_HALF_EXTENT: f64 = 1000.0;

/// A footprint as a scratch sees it, in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Footprint {
    /// h: half-extent across the scratch.
    pub(super) half_extent: f64,
    /// l: half-chord along the scratch through the centre.
    pub(super) half_length: f64,
    /// m: displacement of the chord's centre from the centre to the rim.
    pub(super) shear: f64,
}

impl Footprint {
    /// The ellipse of semi-axis `across` the tilt and `across`/cos `tilt` along it, for a scratch at
    /// `angle` to the direction of the tilt.
    pub(super) fn new(across: f64, tilt: f64, angle: f64) -> Self {
        let along = across / tilt.cos();
        let (sin, cos) = angle.sin_cos();
        let half_extent = (across * cos).hypot(along * sin);
        Self {
            half_extent,
            half_length: across * along / half_extent,
            shear: (along - across) * (along + across) * sin * cos / half_extent,
        }
    }

    /// A_P/A_C.
    pub(super) fn area_ratio(self) -> f64 {
        self.half_extent * self.half_length
    }
}

/// A seeded stream of footprints: distances of 0.2 to 20 m in equal ratios, tilts of 0 to 89°, 720
/// to 2160 rows over fields of view of 20 to 90°, scratches in every direction, and σ of 60 µm
/// for half of them, 20 to 120 µm in equal ratios for the others.
pub(super) fn of_cameras(seed: u64) -> impl Iterator<Item = Footprint> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let all = std::iter::repeat_with(move || {
        let distance_um = 0.2e6 * 100_f64.powf(rng.random());
        let tilt = rng.random_range(0.0..89.0_f64).to_radians();
        let rows = [720.0, 1080.0, 1440.0, 2160.0][rng.random_range(0..4)];
        let field_of_view = rng.random_range(20.0..90.0_f64).to_radians();
        let other_sigma = 20.0 * 6_f64.powf(rng.random());
        let sigma_um = if rng.random() { 60.0 } else { other_sigma };
        let angle = rng.random_range(0.0..TAU);
        let across = distance_um * (0.5 * field_of_view).tan() / rows / sigma_um;
        Footprint::new(across, tilt, angle)
    });
    all.filter(|footprint| footprint.half_extent <= LARGEST_HALF_EXTENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_and_across_the_tilt() {
        let tilt = 60_f64.to_radians();
        let along = Footprint::new(2.0, tilt, 0.0);
        assert!((along.half_extent - 2.0).abs() < 1e-12 && (along.half_length - 4.0).abs() < 1e-12);
        let across = Footprint::new(2.0, tilt, TAU / 4.0);
        assert!((across.half_extent - 4.0).abs() < 1e-12 && across.shear.abs() < 1e-12);
    }

    #[test]
    fn area_does_not_depend_on_the_scratch() {
        for angle in [0.0, 0.3, 1.0, 2.0] {
            let ratio = Footprint::new(1.5, 1.2, angle).area_ratio();
            assert!((ratio - 1.5 * 1.5 / 1.2_f64.cos()).abs() < 1e-12, "{ratio}");
        }
    }

    /// The image of the unit circle under (u, v) → (mu + lv, hu) satisfies the ellipse's equation.
    #[test]
    fn the_sheared_disc_is_the_ellipse() {
        let (a, tilt, angle) = (1.3, 1.1_f64, 0.7_f64);
        let footprint = Footprint::new(a, tilt, angle);
        for turn in 0..16 {
            let (v, u) = (f64::from(turn) * TAU / 16.0).sin_cos();
            let x = footprint.shear * u + footprint.half_length * v;
            let y = footprint.half_extent * u;
            // Along the tilt and across it; the scratch makes `angle` with the former.
            let p = x * angle.cos() + y * angle.sin();
            let q = x * angle.sin() - y * angle.cos();
            let one = (p * tilt.cos() / a).powi(2) + (q / a).powi(2);
            assert!((one - 1.0).abs() < 1e-12, "{one}");
        }
    }
}
