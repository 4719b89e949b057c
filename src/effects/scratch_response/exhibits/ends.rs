//! The ends of a scratch: the limit of an infinite scratch and the matched Gaussian against eq. 5.

use std::f64::consts::{PI, SQRT_2};

use super::{TEXTS, grid, log_grid};
use crate::document::Section;
use crate::document::plot::Series;
use crate::effect::{Candidates, ClaimError, Exhibit, points};
use crate::effects::scratch_response::amplitude::along_factor;
use crate::effects::scratch_response::regions::COLUMNS;
use crate::numeric::statistics::relative_l2;

/// Wavelength and σ of the study, µm; the results depend on σkξ₁ and on ends over σ alone.
const WAVELENGTH_UM: f64 = 0.55;
const SIGMA_UM: f64 = 60.0;

/// Relative RMS errors over ξ₁ of the infinite scratch and of the matched Gaussian, for ends over σ.
pub(in super::super) fn response_errors(
    candidates: &Candidates,
    begin: f64,
    end: f64,
) -> Result<[f64; 2], ClaimError> {
    // To where the lobe of the shorter of scratch and window has ended.
    let widest = 6.0 * (1.0 + 2.0 / (end - begin));
    let q: Vec<f64> = grid(-widest, widest, 601).collect();
    let exact = q.iter().map(|&q| along_factor(q, begin, end).norm_sqr());
    let infinite = q.iter().map(|&q| (-q * q).exp());
    let matched = matched_ends(candidates, &q, begin, end)?;
    Ok([relative_l2(infinite.zip(exact.clone())), relative_l2(matched.into_iter().zip(exact))])
}

/// Energy over ξ₁ of a finite scratch over that of the infinite one, by Parseval:
/// (erf(end) − erf(begin))/2 for ends over σ.
pub(in super::super) fn energy_ratio(begin: f64, end: f64) -> f64 {
    // The intensity window is that of σ/√2.
    along_factor(0.0, begin * SQRT_2, end * SQRT_2).re
}

/// The registered form as the factor along the scratch: over its value for an infinite scratch at 0.
fn matched_ends(
    candidates: &Candidates,
    q: &[f64],
    begin: f64,
    end: f64,
) -> Result<Vec<f64>, ClaimError> {
    // |𝒟|² = 4 at a quarter of the wavelength; the profile is then 8 (W/λ)².
    let (width, depth) = (WAVELENGTH_UM, 0.25 * WAVELENGTH_UM);
    let rows = q.iter().map(|q| {
        let mut row = [0.0; 15];
        let along = q * WAVELENGTH_UM / (2.0 * PI * SIGMA_UM);
        row[..5].copy_from_slice(&[width, depth, WAVELENGTH_UM, SIGMA_UM, along]);
        row[7..10].copy_from_slice(&[2.0, begin * SIGMA_UM, end * SIGMA_UM]);
        row
    });
    let points = points::of_rows(COLUMNS, &rows.collect::<Vec<_>>(), "ends".to_owned());
    let values = candidates.get("scratch_response/matched_ends")?.values_at(&points)?;
    Ok(values.into_iter().map(|value| value / 8.0).collect())
}

/// Errors against length over σ, for a scratch centred on the shaded point and one that begins there.
pub(super) fn exhibit(candidates: &Candidates) -> Result<Section, ClaimError> {
    let lengths: Vec<f64> = log_grid(0.2, 12.0, 41).collect();
    let mut curves = Vec::new();
    for (name, begin) in [("centred", -0.5), ("begins at the point", 0.0)] {
        let errors = lengths
            .iter()
            .map(|l| response_errors(candidates, begin * l, (begin + 1.0) * l))
            .collect::<Result<Vec<_>, _>>()?;
        let over = |i: usize| lengths.iter().zip(&errors).map(move |(l, e)| (*l, e[i]));
        curves.push(Series::line(format!("infinite, {name}"), over(0)).strong());
        curves.push(Series::line(format!("matched, {name}"), over(1)));
    }
    let cases = [
        ("centred, 10 sigma", -5.0, 5.0),
        ("centred, 4 sigma", -2.0, 2.0),
        ("centred, 2 sigma", -1.0, 1.0),
        ("centred, sigma", -0.5, 0.5),
        ("centred, sigma/5", -0.1, 0.1),
        ("ends 2 sigma past the point", -10.0, 2.0),
        ("ends sigma past the point", -10.0, 1.0),
        ("ends at the point", -10.0, 0.0),
        ("ends sigma short of the point", -10.0, -1.0),
    ];
    let row = |(name, begin, end): (&str, f64, f64)| {
        let [infinite, matched] = response_errors(candidates, begin, end)?;
        let energy = 1.0 / energy_ratio(begin, end);
        Ok(vec![name.into(), infinite.into(), energy.into(), matched.into()])
    };
    let rows = cases.into_iter().map(row).collect::<Result<Vec<_>, ClaimError>>()?;
    Ok(Exhibit::of(TEXTS, "ends", &[]).figure(curves).table(rows).section())
}
