//! What directions off the normal cost: w away from 2, and the solid angle of a texel.

use super::{GREEN_NM, TEXTS, disc};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{ClaimError, Exhibit};
use crate::effects::diffraction::DiffractionError;
use crate::effects::diffraction::far_field::FarFieldTransform;
use crate::effects::diffraction::table::{NORMAL, at_wavelength};
use crate::numeric::statistics::relative_l2;

/// Relative error of (w/2)² S at w = 2 against S at w = 1 + cos θ in any order but 0 of a rectangular
/// grating, whose powers go as sin²(k w D/2).
pub(in crate::effects::diffraction) fn grating_error(depth_nm: f64, incidence: f64) -> f64 {
    let k = std::f64::consts::TAU / GREEN_NM;
    let w = 1.0 + core_math::cos(incidence);
    let order = |w: f64| core_math::sin(0.5 * k * w * depth_nm).powi(2);
    0.25 * w * w * order(NORMAL) / order(w) - 1.0
}

/// The disc's table at w = 2 times (w/2)² against the table whose every texel has its own
/// w = 1 + √(1 − h²), by rings of |h|: relative L2 error and relative error of the ring's power.
pub(in crate::effects::diffraction) fn fixed_cosine_error()
-> Result<Vec<(f64, f64, f64, f64)>, DiffractionError> {
    const SIZE: usize = 129;
    const STEPS: usize = 20;
    let surface = disc()?;
    let transform = FarFieldTransform::new(&surface, 1)?;
    let w_at = |i: usize| 1.0 + i as f64 / STEPS as f64;
    let mut axes = None;
    let tables: Vec<Vec<f64>> = (0..=STEPS)
        .map(|i| {
            let field = transform.far_field(&surface, GREEN_NM, w_at(i));
            let (texels, [x, _]) = at_wavelength(&field, [SIZE, SIZE], 1.0);
            axes = Some(x);
            texels
        })
        .collect();
    let (Some(x), Some(normal)) = (axes, tables.last()) else { return Ok(Vec::new()) };
    let centres = x.centres();
    let mut rings = Vec::new();
    for (low, high) in [(0.12, 0.5), (0.5, 0.8), (0.8, 0.95), (0.12, 0.95)] {
        let mut pairs = Vec::new();
        for (iy, hy) in centres.iter().enumerate() {
            for (ix, hx) in centres.iter().enumerate() {
                let h = hx.hypot(*hy);
                if !(low..high).contains(&h) {
                    continue;
                }
                let w = 1.0 + (1.0 - h * h).sqrt();
                let place = (w - 1.0) * STEPS as f64;
                let below = (place.floor() as usize).min(STEPS - 1);
                let t = place - below as f64;
                let at = iy * SIZE + ix;
                let exact = (1.0 - t) * tables[below][at] + t * tables[below + 1][at];
                pairs.push((0.25 * w * w * normal[at], exact));
            }
        }
        let sums = pairs.iter().fold((0.0, 0.0), |sums, p| (sums.0 + p.0, sums.1 + p.1));
        rings.push((low, high, relative_l2(pairs), sums.0 / sums.1 - 1.0));
    }
    Ok(rings)
}

/// One table for every angle.
pub(super) fn one_table() -> Result<Section, ClaimError> {
    let curve = |depth: f64| {
        let error = |degrees: f64| (degrees, grating_error(depth, degrees.to_radians()));
        Series::line(format!("{depth} nm"), (0..=85).map(f64::from).map(error))
    };
    let angles = [0.0_f64, 20.1, 43.4, 60.0, 75.0]
        .map(|degrees| vec![degrees.into(), grating_error(120.0, degrees.to_radians()).into()]);
    let rings = fixed_cosine_error()?;
    let rings = rings.into_iter().map(|r| [r.0, r.1, r.2, r.3].map(Cell::from).to_vec());
    let exhibit = Exhibit::of(TEXTS, "cosine", &[]).figure([20.0, 60.0, 120.0, 150.0].map(curve));
    Ok(exhibit.table(angles).table(rings).section())
}

/// Mean of 1/cos θ over the disc |h| ≤ `extent`: 2 (1 − √(1 − u²))/u².
pub(in crate::effects::diffraction) fn mean_over_disc(extent: f64) -> f64 {
    let square = extent * extent;
    2.0 * square / (1.0 + (1.0 - square).sqrt()) / square
}

/// For a disc under a white sky, away from the mirror (|h| > 0.12) and up to each half-width: Σ ((1 + ω_i·ω_o)²/4) S_d ΔA
/// as printed, and with 1/cos θ_i.
pub(in crate::effects::diffraction) fn disc_furnace(
    extents: &[f64],
) -> Result<Vec<(f64, f64, f64)>, DiffractionError> {
    const SIZE: usize = 257;
    let surface = disc()?;
    let field = FarFieldTransform::new(&surface, 1)?.far_field(&surface, GREEN_NM, NORMAL);
    let (texels, [x, _]) = at_wavelength(&field, [SIZE, SIZE], 1.0);
    let centres = x.centres();
    let sums = |extent: f64| {
        let (mut printed, mut whole) = (0.0, 0.0);
        for (row, hy) in texels.chunks(SIZE).zip(&centres) {
            for (power, hx) in row.iter().zip(&centres) {
                let square = hx * hx + hy * hy;
                if square <= extent * extent && square > 0.0144 {
                    let cosine = (1.0 - square).sqrt();
                    let share = 0.25 * (1.0 + cosine) * (1.0 + cosine) * power;
                    printed += share;
                    whole += share / cosine;
                }
            }
        }
        (extent, printed, whole)
    };
    Ok(extents.iter().map(|e| sums(*e)).collect())
}

/// The solid angle of a texel.
pub(super) fn solid_angle() -> Result<Section, ClaimError> {
    let widths: Vec<f64> = (1..=49).map(|i| 0.02 * f64::from(i)).collect();
    let edge = |u: f64| 1.0 / (1.0 - u * u).sqrt();
    let missing = |(u, printed, whole): (f64, f64, f64)| (u, whole / printed - 1.0);
    let shown: Vec<f64> = widths.iter().copied().filter(|u| *u >= 0.2).collect();
    let at_edge = widths.iter().map(|&u| (u, edge(u) - 1.0));
    let even = widths.iter().map(|&u| (u, mean_over_disc(u) - 1.0));
    let of_disc = disc_furnace(&shown)?.into_iter().map(missing);
    let rows = disc_furnace(&[0.25, 0.5, 0.75, 0.9, 0.98])?.into_iter().map(missing);
    let rows = rows.map(|(u, of_disc)| {
        [u, edge(u) - 1.0, mean_over_disc(u) - 1.0, of_disc].map(Cell::from).to_vec()
    });
    let curves = [
        Series::dashed("at the edge", at_edge),
        Series::line("even table", even),
        Series::line("disc", of_disc).strong(),
    ];
    Ok(Exhibit::of(TEXTS, "jacobian", &[]).figure(curves).table(rows).section())
}
