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

/// Relative error of (w/2)² S at w = 2 in the zero order of a rectangular grating of half duty, cos²(k w D/2).
pub(in crate::effects::diffraction) fn zero_order_error(depth_nm: f64, incidence: f64) -> f64 {
    let k = std::f64::consts::TAU / GREEN_NM;
    let w = 1.0 + core_math::cos(incidence);
    let order = |w: f64| core_math::cos(0.5 * k * w * depth_nm).powi(2);
    0.25 * w * w * order(NORMAL) / order(w) - 1.0
}

/// What comes back of a white sky at normal exitance, over what should: with ((1 + c)/2)² S_d as in eq. 5
/// to 7, and with 1/c beside it, the solid angle of eq. 3.
#[derive(Debug, Clone, Copy)]
pub(in crate::effects::diffraction) struct WhiteSky {
    pub(in crate::effects::diffraction) half_width: f64,
    pub(in crate::effects::diffraction) printed: f64,
    pub(in crate::effects::diffraction) with_solid_angle: f64,
}

/// Of a table of one value over the disc |h| ≤ `half_width`: means over h dh = c dc.
pub(in crate::effects::diffraction) fn even_table(half_width: f64) -> WhiteSky {
    let square = half_width * half_width;
    let c = (1.0 - square).sqrt();
    // 1 − c without cancellation.
    let cap = square / (1.0 + c);
    let powers = |n: i32| (0..n).map(|i| c.powi(i)).sum::<f64>() * cap / f64::from(n);
    let printed = 0.5 * (powers(2) + 2.0 * powers(3) + powers(4));
    let with_solid_angle = 0.5 * (powers(1) + 2.0 * powers(2) + powers(3));
    WhiteSky { half_width, printed: printed / square, with_solid_angle: with_solid_angle / square }
}

/// Of a disc, away from the mirror (|h| > 0.12) and up to each half-width.
pub(in crate::effects::diffraction) fn disc_in_white_sky(
    half_widths: &[f64],
) -> Result<Vec<WhiteSky>, DiffractionError> {
    const SIZE: usize = 257;
    let surface = disc()?;
    let field = FarFieldTransform::new(&surface, 1)?.far_field(&surface, GREEN_NM, NORMAL);
    let (texels, [x, _]) = at_wavelength(&field, [SIZE, SIZE], 1.0);
    let centres = x.centres();
    let sums = |half_width: f64| {
        let (mut all, mut printed, mut with_solid_angle) = (0.0, 0.0, 0.0);
        for (row, hy) in texels.chunks(SIZE).zip(&centres) {
            for (power, hx) in row.iter().zip(&centres) {
                let square = hx * hx + hy * hy;
                if square <= half_width * half_width && square > 0.0144 {
                    let c = (1.0 - square).sqrt();
                    let share = 0.25 * (1.0 + c) * (1.0 + c) * power;
                    all += power;
                    printed += share;
                    with_solid_angle += share / c;
                }
            }
        }
        WhiteSky { half_width, printed: printed / all, with_solid_angle: with_solid_angle / all }
    };
    Ok(half_widths.iter().map(|half_width| sums(*half_width)).collect())
}

/// (1 + ω_i·ω_o)²/(4 cos θ_i cos θ_o) at the mirror direction: what a mirror returns by Stam's factor beside
/// a table at w = 2.
pub(in crate::effects::diffraction) fn mirror_by_stam(angle: f64) -> f64 {
    let (both, c) = (1.0 + core_math::cos(2.0 * angle), core_math::cos(angle));
    both * both / (4.0 * c * c)
}

/// What factors beside S_d make of a white sky.
pub(super) fn white_sky() -> Result<Section, ClaimError> {
    let widths: Vec<f64> = (1..=49).map(|i| 0.02 * f64::from(i)).collect();
    let shown: Vec<f64> = widths.iter().copied().filter(|u| *u >= 0.2).collect();
    let printed = |of: WhiteSky| (of.half_width, of.printed);
    let whole = |of: WhiteSky| (of.half_width, of.with_solid_angle);
    let even = || widths.iter().copied().map(even_table);
    let of_disc = disc_in_white_sky(&shown)?;
    let disc = || of_disc.iter().copied();
    let curves = [
        Series::dashed("even table, eq. 5 to 7", even().map(printed)),
        Series::line("disc, eq. 5 to 7", disc().map(printed)),
        Series::dashed("even table, eq. 3", even().map(whole)),
        Series::line("disc, eq. 3", disc().map(whole)),
    ];
    let rows = disc_in_white_sky(&[0.25, 0.5, 0.75, 0.9, 0.98])?.into_iter().map(|of| {
        let even = even_table(of.half_width);
        [of.half_width, even.printed, of.printed, even.with_solid_angle, of.with_solid_angle]
            .map(Cell::from)
            .to_vec()
    });
    let mirror = [0.0_f64, 20.0, 45.0, 51.7, 75.0]
        .map(|degrees| vec![degrees.into(), mirror_by_stam(degrees.to_radians()).into()]);
    let exhibit = Exhibit::of(TEXTS, "white_sky", &[]).figure(curves);
    Ok(exhibit.table(rows).table(mirror).section())
}
