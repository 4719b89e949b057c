//! Claims of velinov2018 on the footprint, recomputed from what ships and from the references.

use std::f64::consts::{FRAC_2_SQRT_PI, PI, TAU};

use super::line::{Line, Mean, errors};
use super::pixels::Footprint;
use super::reference::{coverage, response};
use crate::effect::claim::ClaimCheck;
use crate::effect::{Candidates, ClaimError, Found};
use crate::numeric::quadrature::GaussLegendre;

/// Offsets per footprint.
const OFFSETS: u32 = 400;

/// Checks of the claims, by name.
pub(super) const CLAIMS: &[(&str, ClaimCheck<Candidates>)] = &[
    ("missing_pi", missing_pi),
    ("area_blend", area_blend),
    ("small_footprints", small_footprints),
    ("seven_times", seven_times),
    ("across", across),
    ("density", density),
];

/// Relative L2 errors of a candidate for circles of half-extents `h`.
fn circles<const N: usize>(
    candidates: &Candidates,
    name: &str,
    mean: Mean,
    h: [f64; N],
) -> Result<[f64; N], ClaimError> {
    let lines = Line::all(mean, &h.map(|h| (h, h * h)), OFFSETS)?;
    let found = errors(candidates.get(name)?, &lines)?;
    Ok(std::array::from_fn(|i| found.get(i).copied().unwrap_or(f64::NAN)))
}

fn missing_pi(candidates: &Candidates) -> Result<Found, ClaimError> {
    let radii = [0.1, 1.0, 1.4];
    let printed = circles(candidates, "footprint/eq16_printed", response, radii)?;
    let corrected = circles(candidates, "footprint/eq16", response, radii)?;
    let pairs = [0, 1, 2]
        .map(|i| format!("{:.3} and {:.3} at {}σ", printed[i], corrected[i], radii[i]))
        .join(", ");
    let found = format!(
        "for A_P → 0 the second term must become eq. 10, 2πσ² exp(−s²/σ²), and has no π; relative \
         L2 error for circular footprints as printed and with π: {pairs}"
    );
    Ok(Found::new(found, "does not hold"))
}

fn area_blend(candidates: &Candidates) -> Result<Found, ClaimError> {
    let footprints = [0.0, TAU / 4.0].map(|angle| {
        let f = Footprint::new(0.5, 87_f64.to_radians(), angle);
        (f.half_extent, f.area_ratio())
    });
    let lines = Line::all(response, &footprints, OFFSETS)?;
    let theirs = errors(candidates.get("footprint/eq16")?, &lines)?;
    let ours = errors(candidates.get("footprint/soft_chord")?, &lines)?;
    let [(along, area_ratio), (across, _)] = footprints;
    let found = format!(
        "the exact mean depends on h and s alone. A footprint of 0.5σ tilted by 87° has \
         A_P/A_C = {area_ratio:.1}, so α = 1; along the tilt, h = {along:.1}, the scratch has a \
         relative L2 error of {:.3}, across it, h = {across:.1}, of {:.3} (with a soft chord {:.4} \
         and {:.4})",
        theirs[0], theirs[1], ours[0], ours[1]
    );
    Ok(Found::new(found, "does not hold"))
}

fn small_footprints(_: &Candidates) -> Result<Found, ClaimError> {
    let ratios = [0.1, 1.0, 2.0, 10.0]
        .iter()
        .map(|&area_ratio: &f64| {
            let h = area_ratio.sqrt();
            let chord = FRAC_2_SQRT_PI / h;
            Ok(format!("{:.2} at A_P/A_C = {area_ratio}", chord / response(h, 0.0)?))
        })
        .collect::<Result<Vec<_>, ClaimError>>()?;
    let found = format!("eq. 15 over the exact mean at s = 0, circles: {}", ratios.join(", "));
    Ok(Found::new(found, "holds"))
}

fn seven_times(candidates: &Candidates) -> Result<Found, ClaimError> {
    let [eq16] = circles(candidates, "footprint/eq16", response, [7_f64.sqrt()])?;
    let [ours] = circles(candidates, "footprint/soft_chord", response, [7_f64.sqrt()])?;
    let found = format!(
        "relative L2 error of a circle with A_P/A_C = 7: {eq16:.3} (eq. 16, printed and corrected \
         agree where α = 1), {ours:.4} with a soft chord"
    );
    Ok(Found::new(found, "differs"))
}

fn across(candidates: &Candidates) -> Result<Found, ClaimError> {
    let outside = |h: f64| {
        // The integral over s is √π for every h.
        let beyond = |s| response(h, s).unwrap_or(f64::NAN);
        200.0 * GaussLegendre::new(20).integral_in_panels(beyond, h, h + 8.0, 8) / PI.sqrt()
    };
    let h = [1.0, 3.0, 10.0];
    let ours = circles(candidates, "footprint/soft_chord", response, h)?;
    let found = format!(
        "the exact mean filters across too: {:.1} %, {:.1} % and {:.1} % of it lie where eq. 15 is 0, \
         beyond the rim, at h = 1, 3 and 10; soft chords keep it, with relative L2 errors of \
         {:.4}, {:.4} and {:.4}",
        outside(h[0]),
        outside(h[1]),
        outside(h[2]),
        ours[0],
        ours[1],
        ours[2]
    );
    Ok(Found::new(found, "not needed"))
}

fn density(candidates: &Candidates) -> Result<Found, ClaimError> {
    let h = [1.0, 10.0, 20.0].map(f64::sqrt);
    let mut centre = [0.0; 3];
    for (centre, h) in centre.iter_mut().zip(h) {
        *centre = (8.0 / PI).sqrt() / h / coverage(h, 0.0)?;
    }
    let theirs = circles(candidates, "footprint/coverage_eq18", coverage, h)?;
    let ours = circles(candidates, "footprint/coverage_soft_chord", coverage, h)?;
    let found = format!(
        "at A_P/A_C = 1, 10 and 20 eq. 18 is {:.2}, {:.2} and {:.2} times the exact mean at s = 0, \
         its relative L2 error {:.3}, {:.3} and {:.3} (soft chord {:.4}, {:.4} and {:.4})",
        centre[0], centre[1], centre[2], theirs[0], theirs[1], theirs[2], ours[0], ours[1], ours[2]
    );
    Ok(Found::new(found, "holds, slowly"))
}
