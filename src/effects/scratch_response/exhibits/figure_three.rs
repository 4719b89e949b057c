//! Fig. 3: one scratch under a vertical light, small angles against the angles themselves.

use std::f64::consts::FRAC_PI_2;

use super::{TEXTS, grid};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::Exhibit;
use crate::effects::scratch_response::amplitude::{depth_factor, sinc_pi};

/// Wavelength of fig. 3, µm.
const WAVELENGTH_UM: f64 = 0.7;
/// Width and depth of the reproduction, µm: the caption states neither.
const WIDTH_UM: f64 = 2.0;
const DEPTH_UM: f64 = 1.0;

/// (W/λ)² sinc² |𝒟|² under a vertical light at exitance `angle`, the depth phase at γ + γᵢ = `mu_sum`.
fn lobe(width_um: f64, depth_um: f64, angle: f64, mu_sum: f64) -> f64 {
    let spectral = width_um / WAVELENGTH_UM * sinc_pi(width_um * angle.sin() / WAVELENGTH_UM);
    spectral * spectral * depth_factor(depth_um, WAVELENGTH_UM, mu_sum).norm_sqr()
}

/// Energy of the side lobes (beyond the first zero) at small angles and at the angles, over exitances
/// above the surface.
pub(in super::super) fn side_lobe_energy(width_um: f64, depth_um: f64) -> (f64, f64) {
    let first = WAVELENGTH_UM / width_um;
    let nodes = 400;
    let step = (1.0 - first) / f64::from(nodes);
    (0..nodes).map(|i| first + (f64::from(i) + 0.5) * step).fold((0.0, 0.0), |sums, sine: f64| {
        let angle = sine.asin();
        (
            sums.0 + step * lobe(width_um, depth_um, angle, 2.0),
            sums.1 + step * lobe(width_um, depth_um, angle, 1.0 + angle.cos()),
        )
    })
}

/// The figure, and side-lobe energies over depths.
pub(super) fn exhibit() -> Section {
    let angles: Vec<f64> = grid(-0.999 * FRAC_PI_2, 0.999 * FRAC_PI_2, 901).collect();
    let peak = lobe(WIDTH_UM, DEPTH_UM, 0.0, 2.0);
    let curve = |mu_sum: fn(f64) -> f64| -> Vec<(f64, f64)> {
        let value = |angle: f64| lobe(WIDTH_UM, DEPTH_UM, angle, mu_sum(angle)) / peak;
        angles.iter().map(|&angle| (angle.to_degrees(), value(angle).max(1e-5))).collect()
    };
    let curves = [
        Series::line("small angles, exp(i 4 pi D/lambda)", curve(|_| 2.0)).strong(),
        Series::dashed(
            "at its angles, exp(i 2 pi (g + g_i) D/lambda)",
            curve(|angle| 1.0 + angle.cos()),
        ),
    ];
    let rows = [0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.3, 2.0, 3.0, 6.0].map(|depth| {
        let (small, angular) = side_lobe_energy(WIDTH_UM, depth);
        [depth, small, angular, small / angular].map(Cell::from).to_vec()
    });
    let values = [("WIDTH_UM", WIDTH_UM.to_string()), ("DEPTH_UM", DEPTH_UM.to_string())];
    Exhibit::of(TEXTS, "figure_three", &values).figure(curves).table(rows).section()
}
