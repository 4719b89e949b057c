//! The depth phase: at small angles (eq. 4, fig. 3), in the mirror direction, and at the angles themselves.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{TEXTS, grid, log_grid};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::Exhibit;
use crate::effects::scratch_response::amplitude::{depth_factor, sinc_pi};
use crate::numeric::statistics::relative_l2;

/// Where γ + γᵢ is taken.
#[derive(Debug, Clone, Copy)]
pub(in super::super) enum DepthPhase {
    /// 2, eq. 4.
    SmallAngle,
    /// 2γ.
    Mirror,
}

/// Scratches and a light in the plane across them over which an error is taken.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Sampling {
    /// Widths, µm, each end included.
    pub(in super::super) width_um: [f64; 2],
    /// Depths, µm.
    pub(in super::super) depth_um: [f64; 2],
    /// Wavelength, µm.
    pub(in super::super) wavelength_um: f64,
    /// Incidence, rad.
    pub(in super::super) incidence_rad: f64,
}

/// The sizes of velinov2018 §5 in green light from above.
const PAPER: Sampling = Sampling {
    width_um: [0.8, 6.0],
    depth_um: [0.8, 6.0],
    wavelength_um: 0.55,
    incidence_rad: 0.0,
};

impl Sampling {
    /// Lobes with the approximate and with the exact depth phase over widths and depths, at one exitance.
    fn lobes(self, exitance: f64, phase: DepthPhase) -> impl Iterator<Item = (f64, f64)> {
        let across = exitance.sin() + self.incidence_rad.sin();
        let exact = exitance.cos() + self.incidence_rad.cos();
        let taken = match phase {
            DepthPhase::SmallAngle => 2.0,
            DepthPhase::Mirror => 2.0 * exitance.cos(),
        };
        let range =
            |[from, to]: [f64; 2], count: u32| grid(from, to, if from < to { count } else { 2 });
        range(self.width_um, 6).flat_map(move |width| {
            let spectral = (width * sinc_pi(width * across / self.wavelength_um)).powi(2);
            range(self.depth_um, 17).map(move |depth| {
                let lobe = |mu| spectral * depth_factor(depth, self.wavelength_um, mu).norm_sqr();
                (lobe(taken), lobe(exact))
            })
        })
    }

    /// Relative RMS error over every exitance to 85°.
    pub(in super::super) fn error(self, phase: DepthPhase) -> f64 {
        let exitances = grid(-85.0, 85.0, 121).map(f64::to_radians);
        relative_l2(exitances.flat_map(|angle| self.lobes(angle, phase)))
    }

    /// Relative RMS error at one exitance.
    fn error_at(self, exitance: f64, phase: DepthPhase) -> f64 {
        relative_l2(self.lobes(exitance, phase))
    }
}

/// Error against exitance, incidence, wavelength, W and D.
pub(super) fn exhibit() -> Section {
    let curves = |points: &dyn Fn(DepthPhase) -> Vec<(f64, f64)>| {
        let small = Series::line("small angles (eq. 4)", points(DepthPhase::SmallAngle)).strong();
        [small, Series::line("mirror direction (ours)", points(DepthPhase::Mirror))]
    };
    let over = |values: Vec<f64>, sampling: fn(f64) -> Sampling| {
        move |phase| values.iter().map(|&v| (v, sampling(v).error(phase))).collect::<Vec<_>>()
    };
    let sizes: Vec<f64> = log_grid(0.3, 20.0, 25).collect();
    let against_exitance = |phase| {
        let error = |angle: f64| PAPER.error_at(angle.to_radians(), phase);
        grid(0.0, 85.0, 86).map(|angle| (angle, error(angle))).collect()
    };
    let against_incidence = over(grid(0.0, 80.0, 17).collect(), |degrees| Sampling {
        incidence_rad: degrees * PI / 180.0,
        ..PAPER
    });
    let against_wavelength =
        over(grid(0.38, 0.78, 21).collect(), |um| Sampling { wavelength_um: um, ..PAPER });
    let against_width = over(sizes.clone(), |width| Sampling { width_um: [width; 2], ..PAPER });
    let against_depth =
        over(sizes, |depth| Sampling { depth_um: [0.9 * depth, 1.1 * depth], ..PAPER });
    Exhibit::of(TEXTS, "depth_phase", &[])
        .figure(curves(&against_exitance))
        .figure(curves(&against_incidence))
        .figure(curves(&against_wavelength))
        .figure(curves(&against_width))
        .figure(curves(&against_depth))
        .table(by_incidence())
        .section()
}

/// Errors of scratches by incidence.
fn by_incidence() -> Vec<Vec<Cell>> {
    let bands = [
        ("W, D 0.8 to 6 um", [0.8, 6.0], [0.8, 6.0]),
        ("W 20, D 0.3 um", [20.0; 2], [0.3; 2]),
        ("W 6, D 0.8 um", [6.0; 2], [0.8; 2]),
        ("W 0.8, D 6 um", [0.8; 2], [6.0; 2]),
    ];
    let rows = bands.into_iter().flat_map(|(name, width_um, depth_um)| {
        [0.0, 20.0, 45.0, 70.0].map(|degrees| {
            let incidence_rad = degrees * PI / 180.0;
            let sampling = Sampling { width_um, depth_um, incidence_rad, ..PAPER };
            let errors = [DepthPhase::SmallAngle, DepthPhase::Mirror].map(|p| sampling.error(p));
            vec![name.into(), degrees.into(), errors[0].into(), errors[1].into()]
        })
    });
    rows.collect()
}

/// Wavelength of fig. 3, µm.
const WAVELENGTH_UM: f64 = 0.7;
/// Width and depth of the reproduction, µm: the caption states neither.
const WIDTH_UM: f64 = 2.0;
const DEPTH_UM: f64 = 1.0;

/// (W/λ)² sinc² |𝒟|² under a vertical light at exitance `angle`, the depth phase at γ + γᵢ = `mu_sum`.
fn lobe_at(width_um: f64, depth_um: f64, angle: f64, mu_sum: f64) -> f64 {
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
            sums.0 + step * lobe_at(width_um, depth_um, angle, 2.0),
            sums.1 + step * lobe_at(width_um, depth_um, angle, 1.0 + angle.cos()),
        )
    })
}

/// The figure, and side-lobe energies over depths.
pub(super) fn figure_three() -> Section {
    let angles: Vec<f64> = grid(-0.999 * FRAC_PI_2, 0.999 * FRAC_PI_2, 901).collect();
    let peak = lobe_at(WIDTH_UM, DEPTH_UM, 0.0, 2.0);
    let curve = |mu_sum: fn(f64) -> f64| -> Vec<(f64, f64)> {
        let value = |angle: f64| lobe_at(WIDTH_UM, DEPTH_UM, angle, mu_sum(angle)) / peak;
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
