//! The ends of a scratch: the limit of an infinite scratch and the matched Gaussian against eq. 5.

use std::f64::consts::PI;

use super::{axis, columns, grid, log_grid, series, text};
use crate::effect::exhibit::{
    Exhibit, ExhibitCell, ExhibitError, ExhibitPlot, ExhibitTable, Stroke,
};
use crate::effects;
use crate::effects::scratch_response::amplitude::along_factor;
use crate::form::FormError;
use crate::numeric::statistics::relative_l2;

/// Wavelength and σ of the study, µm; the results depend on σkξ₁ and on ends over σ alone.
const WAVELENGTH_UM: f64 = 0.55;
const SIGMA_UM: f64 = 60.0;

/// Relative RMS errors over ξ₁ of the infinite scratch and of the matched Gaussian, for ends over σ.
pub(in super::super) fn response_errors(begin: f64, end: f64) -> Result<[f64; 2], FormError> {
    // To where the lobe of the shorter of scratch and window has ended.
    let widest = 6.0 * (1.0 + 2.0 / (end - begin));
    let q: Vec<f64> = grid(-widest, widest, 601).collect();
    let exact = q.iter().map(|&q| along_factor(q, begin, end).norm_sqr());
    let infinite = q.iter().map(|&q| (-q * q).exp());
    let matched = matched_ends(&q, begin, end)?;
    Ok([relative_l2(infinite.zip(exact.clone())), relative_l2(matched.into_iter().zip(exact))])
}

/// Energy over ξ₁ of a finite scratch over that of the infinite one, by Parseval:
/// (erf(end) − erf(begin))/2 for ends over σ.
pub(in super::super) fn energy_ratio(begin: f64, end: f64) -> f64 {
    // The intensity window is that of σ/√2.
    along_factor(0.0, begin * std::f64::consts::SQRT_2, end * std::f64::consts::SQRT_2).re
}

/// The registered form as the factor along the scratch: over its value for an infinite scratch at 0.
fn matched_ends(q: &[f64], begin: f64, end: f64) -> Result<Vec<f64>, FormError> {
    let form = effects::form("scratch_response/matched_ends")?.load()?;
    let all = |value: f64| vec![value; q.len()];
    // |𝒟|² = 4 at a quarter of the wavelength; the profile is then 8 (W/λ)².
    let (width, depth) = (WAVELENGTH_UM, 0.25 * WAVELENGTH_UM);
    let along = q.iter().map(|q| q * WAVELENGTH_UM / (2.0 * PI * SIGMA_UM)).collect();
    let inputs = [
        all(width),
        all(depth),
        all(WAVELENGTH_UM),
        all(SIGMA_UM),
        along,
        all(0.0),
        all(0.0),
        all(begin * SIGMA_UM),
        all(end * SIGMA_UM),
        all(2.0),
    ];
    let columns: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
    let values = form.eval_f64(&[], &columns)?.into_iter().next().unwrap_or_default();
    Ok(values.into_iter().map(|value| value / 8.0).collect())
}

/// Errors against length over σ, for a scratch centred on the shaded point and one that begins there.
pub(super) fn exhibit() -> Result<Exhibit, ExhibitError> {
    let failed = |error: FormError| ExhibitError(error.to_string());
    let lengths: Vec<f64> = log_grid(0.2, 12.0, 41).collect();
    let mut all = Vec::new();
    for (name, begin) in [("centred", -0.5), ("begins at the point", 0.0)] {
        let errors: Result<Vec<[f64; 2]>, FormError> =
            lengths.iter().map(|l| response_errors(begin * l, (begin + 1.0) * l)).collect();
        let errors = errors.map_err(failed)?;
        for (form, stroke, i) in [("infinite", Stroke::Strong, 0), ("matched", Stroke::Line, 1)] {
            let points = lengths.iter().zip(&errors).map(|(l, e)| (*l, e[i])).collect();
            all.push(series(&format!("{form}, {name}"), stroke, points));
        }
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
    let rows: Result<Vec<Vec<ExhibitCell>>, FormError> = cases
        .iter()
        .map(|&(name, begin, end)| {
            let [infinite, matched] = response_errors(begin, end)?;
            let energy = 1.0 / energy_ratio(begin, end);
            Ok([text(name)]
                .into_iter()
                .chain([infinite, energy, matched].map(ExhibitCell::Number))
                .collect())
        })
        .collect();
    Ok(Exhibit {
        title: "Ends: infinite scratch, matched Gaussian".into(),
        text: vec![
            "Without ends (eq. 8) a scratch keeps the peak and the width along xi_1 of one that spans the coherence \
             area. The matched Gaussian has the exact peak and the exact energy of the finite scratch, by \
             four real error functions, and stays separable: integrated over a light wider than its narrow \
             side it is exact, and its error is the shape along xi_1 alone."
                .into(),
        ],
        plots: vec![ExhibitPlot {
            stem: "scratch-ends",
            title: "Ends: error against length".into(),
            caption: "RMS error over xi_1 over RMS of eq. 5; a scratch centred on the shaded point, and one that \
                      begins there."
                .into(),
            x: axis("length over sigma", "1", true),
            y: axis("relative RMS error", "1", true),
            series: all,
        }],
        tables: vec![ExhibitTable {
            caption: "By the place of the ends. Energy: of the infinite scratch over that of the finite one; \
                      that of the matched Gaussian is exact."
                .into(),
            columns: columns(&[
                ("scratch", ""),
                ("infinite, error", "1"),
                ("infinite, energy ratio", "1"),
                ("matched, error", "1"),
            ]),
            rows: rows.map_err(failed)?,
        }],
    })
}
