//! Fig. 3: one scratch under a vertical light, small angles against the angles themselves.

use std::f64::consts::FRAC_PI_2;

use super::grid;
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedTable, Section};
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
    let plot = Plot::new(
        "Radiance of one scratch (velinov2018 fig. 3)",
        PlotAxis::linear("exitance", "degrees"),
        PlotAxis::log("radiance over that at 0", "1"),
    )
    .series(Series::line("small angles, exp(i 4 pi D/lambda)", curve(|_| 2.0)).strong())
    .series(Series::dashed(
        "at its angles, exp(i 2 pi (g + g_i) D/lambda)",
        curve(|angle| 1.0 + angle.cos()),
    ));
    let caption = format!(
        "Vertical light of 700 nm, plane across the scratch, over the value in the mirror direction; W = \
         {WIDTH_UM} um, D = {DEPTH_UM} um, since the caption states neither. Drawn from 1e-5 up."
    );
    let rows = [0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.3, 2.0, 3.0, 6.0].map(|depth| {
        let (small, angular) = side_lobe_energy(WIDTH_UM, depth);
        [depth, small, angular, small / angular].map(Cell::from).to_vec()
    });
    Section::new("Depth phase at small angles: fig. 3")
        .paragraph(
            "Both curves share the zeros of the sinc; the depth phase multiplies its lobes. At small angles every \
             lobe has one factor, at its angles each lobe has its own, so colours move with the angle.",
        )
        .block(Figure::new("scratch-figure-three", caption, plot))
        .block(PrintedTable::of_rows(
            "Energy of the side lobes of the same scratch, by its depth",
            [("D", "um"), ("at small angles", "1"), ("at its angles", "1"), ("ratio", "1")],
            rows,
        ))
}
