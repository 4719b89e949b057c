use super::grating::disc;
use super::{GREEN_NM, TEXTS};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{ClaimError, Exhibit};
use crate::effects::diffraction::DiffractionError;
use crate::effects::diffraction::far_field::FarFieldTransform;
use crate::effects::diffraction::table::{NORMAL, at_wavelength};

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

pub(super) fn exhibit() -> Result<Section, ClaimError> {
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
