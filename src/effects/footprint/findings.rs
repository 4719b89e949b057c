//! Claims of velinov2018 on the footprint, recomputed from the registered forms and the references.

use std::f64::consts::TAU;

use crate::effect::{Finding, FittedConstants};

use super::approximation::{Approximation, Line, Mean, NotMeasured};
use super::pixels::Footprint;
use super::reference::{coverage, response};

/// Offsets per footprint.
const OFFSETS: u32 = 400;

type Claim = fn(&FittedConstants) -> Result<Finding, NotMeasured>;

/// What is found for each claim.
pub(super) fn findings(fitted: &FittedConstants) -> Vec<Finding> {
    let claims: [Claim; 6] = [missing_pi, area_blend, small_ones, seven_times, across, density];
    claims.iter().map(|claim| claim(fitted).unwrap_or_else(|e| not_evaluated(&e))).collect()
}

fn not_evaluated(error: &NotMeasured) -> Finding {
    finding("velinov2018 §3.2", "an approximation", error.to_string(), "not evaluated")
}

fn finding(place: &str, printed: &str, found: String, verdict: &str) -> Finding {
    Finding {
        place: place.into(),
        printed: printed.into(),
        found,
        verdict: verdict.into(),
        command: "striae report".into(),
    }
}

/// Relative L2 errors of the form `name` for circles of half-extents `h`.
fn circles(
    name: &str,
    mean: Mean,
    h: &[f64],
    fitted: &FittedConstants,
) -> Result<Vec<f64>, NotMeasured> {
    let footprints: Vec<(f64, f64)> = h.iter().map(|&h| (h, h * h)).collect();
    Approximation::named(name, fitted)?.errors(&Line::all(mean, &footprints, OFFSETS)?)
}

fn missing_pi(fitted: &FittedConstants) -> Result<Finding, NotMeasured> {
    let radii = [0.1, 1.0, 1.4];
    let printed = circles("eq16_printed", response, &radii, fitted)?;
    let corrected = circles("eq16", response, &radii, fitted)?;
    let pairs: Vec<String> = (0..radii.len())
        .map(|i| format!("{:.3} and {:.3} at {}σ", printed[i], corrected[i], radii[i]))
        .collect();
    let found = format!(
        "for A_P → 0 the second term must become eq. 10, 2πσ² exp(−s²/σ²), and has no π; relative \
         L2 error for circular footprints as printed and with π: {}",
        pairs.join(", ")
    );
    Ok(finding("velinov2018 eq. 16", "2σ²/A_P · (1 − α) A_P exp(−s²/σ²)", found, "does not hold"))
}

fn area_blend(fitted: &FittedConstants) -> Result<Finding, NotMeasured> {
    let eq16 = Approximation::named("eq16", fitted)?;
    let ours = Approximation::named("soft_chord", fitted)?;
    let footprint = |angle: f64| {
        let f = Footprint::new(0.5, 87_f64.to_radians(), angle);
        (f.half_extent, f.area_ratio())
    };
    let lines = Line::all(response, &[footprint(0.0), footprint(TAU / 4.0)], OFFSETS)?;
    let (theirs, ours) = (eq16.errors(&lines)?, ours.errors(&lines)?);
    let found = format!(
        "the exact mean depends on h and s alone. A footprint of 0.5σ tilted by 87° has \
         A_P/A_C = {:.1}, so α = 1; along the tilt, h = {:.1}, the scratch has a relative L2 error \
         of {:.3}, across it, h = {:.1}, of {:.3} (with a soft chord {:.4} and {:.4})",
        lines[0].area_ratio,
        lines[0].half_extent,
        theirs[0],
        lines[1].half_extent,
        theirs[1],
        ours[0],
        ours[1]
    );
    let printed = "the blending factor is a function of A_P/A_C";
    Ok(finding("velinov2018 eq. 16, α", printed, found, "does not hold"))
}

fn small_ones(_: &FittedConstants) -> Result<Finding, NotMeasured> {
    let ratios = [0.1, 1.0, 2.0, 10.0]
        .iter()
        .map(|&area_ratio: &f64| {
            let h = area_ratio.sqrt();
            let chord = std::f64::consts::FRAC_2_SQRT_PI / h;
            Ok(format!("{:.2} at A_P/A_C = {area_ratio}", chord / response(h, 0.0)?))
        })
        .collect::<Result<Vec<_>, NotMeasured>>()?;
    let found = format!("eq. 15 over the exact mean at s = 0, circles: {}", ratios.join(", "));
    let printed = "eq. 15 is valid for larger footprints and overestimates for smaller ones";
    Ok(finding("velinov2018 §3.2, eq. 15", printed, found, "holds"))
}

fn seven_times(fitted: &FittedConstants) -> Result<Finding, NotMeasured> {
    let h = [7_f64.sqrt()];
    let eq16 = circles("eq16", response, &h, fitted)?[0];
    let ours = circles("soft_chord", response, &h, fitted)?[0];
    let found = format!(
        "relative L2 error of a circle with A_P/A_C = 7: {eq16:.3} (eq. 16, printed and corrected \
         agree where α = 1), {ours:.4} with a soft chord"
    );
    let printed = "low errors for the standard case of footprint areas about 7 times larger";
    Ok(finding("velinov2018 §3.2, fig. 5", printed, found, "differs"))
}

fn across(fitted: &FittedConstants) -> Result<Finding, NotMeasured> {
    let outside = |h: f64| -> Result<f64, NotMeasured> {
        // The integral over s is √π for every h.
        let rule = crate::numeric::quadrature::GaussLegendre::new(20);
        let beyond = |s| response(h, s).unwrap_or(f64::NAN);
        Ok(2.0 * rule.integral_in_panels(beyond, h, h + 8.0, 8) / std::f64::consts::PI.sqrt())
    };
    let ours = circles("soft_chord", response, &[1.0, 3.0, 10.0], fitted)?;
    let found = format!(
        "the exact mean filters across too: {:.1} %, {:.1} % and {:.1} % of it lie where eq. 15 is 0, \
         beyond the rim, at h = 1, 3 and 10; soft chords keep it, with relative L2 errors of \
         {:.4}, {:.4} and {:.4}",
        100.0 * outside(1.0)?,
        100.0 * outside(3.0)?,
        100.0 * outside(10.0)?,
        ours[0],
        ours[1],
        ours[2]
    );
    let printed = "antialiasing is only performed along scratches";
    Ok(finding("velinov2018 §3.2, fig. 4", printed, found, "not needed"))
}

fn density(fitted: &FittedConstants) -> Result<Finding, NotMeasured> {
    let h = [1.0, 10.0, 20.0].map(f64::sqrt);
    let centre = h
        .iter()
        .map(|&h| Ok((8.0 / std::f64::consts::PI).sqrt() / h / coverage(h, 0.0)?))
        .collect::<Result<Vec<f64>, NotMeasured>>()?;
    let theirs = circles("coverage_eq18", coverage, &h, fitted)?;
    let ours = circles("coverage_soft_chord", coverage, &h, fitted)?;
    let found = format!(
        "at A_P/A_C = 1, 10 and 20 eq. 18 is {:.2}, {:.2} and {:.2} times the exact mean at s = 0, \
         its relative L2 error {:.3}, {:.3} and {:.3} (soft chord {:.4}, {:.4} and {:.4})",
        centre[0], centre[1], centre[2], theirs[0], theirs[1], theirs[2], ours[0], ours[1], ours[2]
    );
    let printed = "overestimates for smaller ratios; for increasing size only small errors";
    Ok(finding("velinov2018 eq. 18, fig. 5", printed, found, "holds, slowly"))
}
