//! Claims of velinov2018 on area lights, recomputed.

use std::f64::consts::{PI, TAU};

use super::columns::SPHERE as SPHERE_COLUMNS;
use super::draws::Draw;
use super::measured::{Loaded, Points, relative_l2};
use super::regions::REGIONS;
use super::{SPHERE, TRIANGLE};
use crate::effect::exhibit::ExhibitError;
use crate::effect::{Finding, FittedConstants};

/// Command that prints the findings.
const COMMAND: &str = "striae report";

/// What is found for each claim on lights.
pub(in super::super) fn findings(fitted: &FittedConstants) -> Vec<Finding> {
    let mut all = vec![
        exponent(),
        largest_deviation(),
        disc(),
        second_root(),
        sign_of_zero(),
        coherence_of_figure_eleven(),
    ];
    all.extend(claims_on_regions(fitted).unwrap_or_else(|error| {
        vec![finding("velinov2018 §3.4", "a closed form", error.to_string(), "not evaluated")]
    }));
    all
}

fn finding(place: &str, printed: &str, found: String, verdict: &str) -> Finding {
    Finding {
        place: place.into(),
        printed: printed.into(),
        found,
        verdict: verdict.into(),
        command: COMMAND.into(),
    }
}

fn exponent() -> Finding {
    // σ = 60 µm at 550 nm, one standard deviation of intensity off the line.
    let ks = TAU / 0.55 * 60.0;
    let off = 1.0 / (2.0_f64.sqrt() * ks);
    let [above, below] = [off, -off].map(|xi_1| (-ks * ks * xi_1).exp());
    finding(
        "velinov2018 eq. 25",
        "exp(-sigma^2 k^2 xi_1)",
        format!(
            "at xi_1 = ±{off:.3e}, one standard deviation for sigma 60 um and 550 nm, the printed weight is \
             exp(∓{:.0}), that of eq. 10, exp(-sigma^2 k^2 xi_1^2), is {:.3} on both sides",
            ks * ks * off,
            (-ks * ks * off * off).exp()
        ),
        // A weight of a lobe is the same on both sides, and at most 1.
        if above == below { "holds" } else { "does not hold: the square of xi_1 is missing" },
    )
}

fn largest_deviation() -> Finding {
    let deviation = |wavelength_um: f64| wavelength_um / (2.0 * 2.0_f64.sqrt() * PI * 60.0);
    let [nanometres, micrometres] = [deviation(0.75), deviation(750.0)];
    // Six digits are printed.
    let printed = |value: f64| (value / 1.40674e-3 - 1.0).abs() < 5e-6;
    finding(
        "velinov2018 eq. 26",
        "lambda_max = 750 um, s_max = lambda_max/(2 sqrt(2 pi sigma)) = 1.40674e-3",
        format!(
            "lambda/(2 sqrt(2) pi sigma) with sigma = 60 um is {:.5e} for 750 nm and {:.5} for 750 um",
            nanometres, micrometres
        ),
        match (printed(nanometres), printed(micrometres)) {
            (true, false) => "holds for 750 nm, with pi and sigma outside the root",
            (false, true) => "holds with pi and sigma outside the root",
            _ => "does not hold",
        },
    )
}

fn disc() -> Finding {
    let ratios = [0.1_f64, 0.5, 0.9];
    let errors = ratios.map(|ratio| ratio.atan() / ratio.asin() - 1.0);
    let words: Vec<String> = ratios
        .iter()
        .zip(errors)
        .map(|(ratio, error)| format!("{:+.1} % at r/p = {ratio}", 100.0 * error))
        .collect();
    let to_a_percent = errors.map(|error| error.abs() <= 0.01);
    finding(
        "velinov2018 eq. 31",
        "the boundary of a sphere is the disc of its radius at the distance of its centre",
        format!("half-angle atan(r/p) against asin(r/p) of the silhouette: {}", words.join(", ")),
        match to_a_percent {
            [_, _, true] => "holds to 1 %",
            [true, ..] => "holds for small lights only; not defined for r >= p, where all is lit",
            _ => "does not hold to 1 %",
        },
    )
}

/// Residual of c + t cos γ + b sin γ at v = tan(γ/2), over the size of its terms.
fn residual([c, t, b]: [f64; 3], v: f64) -> f64 {
    let scale = c.abs() + t.abs() + b.abs();
    if v.is_infinite() {
        return (c - t).abs() / scale;
    }
    let square = v * v;
    ((c + (t * (1.0 - square) + 2.0 * b * v) / (1.0 + square)) / scale).abs()
}

/// Residual up to which a root counts as one.
const ROOT: f64 = 1e-6;

fn second_root() -> Finding {
    let mut draw = Draw::new(40);
    let (mut solvable, mut printed, mut right) = (0, 0, 0);
    for _ in 0..10_000 {
        let case = [0; 3].map(|_| draw.between(-1.0, 1.0));
        let [c, t, b] = case;
        let square = b * b + t * t - c * c;
        if square < 0.0 {
            continue;
        }
        solvable += 1;
        let q = -(b + 1.0_f64.copysign(b) * square.sqrt());
        printed += usize::from(residual(case, (c - t) / q) > ROOT);
        right += usize::from(residual(case, (c + t) / q) > ROOT);
    }
    finding(
        "velinov2018 eq. 35 and 40",
        "v = (-(b + sgn(b) sqrt(D))/(c - t))^(±1)",
        format!(
            "of {solvable} random solvable cases of c + t cos + b sin = 0 the reciprocal fails in {printed}, \
             (c + t)/q, q = -(b + sgn(b) sqrt(D)), in {right}"
        ),
        match (printed, right) {
            (0, _) => "holds",
            (_, 0) => "does not hold: the second root is C/q, not A/q, unless t = 0",
            _ => "does not hold",
        },
    )
}

fn sign_of_zero() -> Finding {
    let mut draw = Draw::new(41);
    let (mut cases, mut zero, mut one) = (0, 0, 0);
    for _ in 0..1000 {
        let case = [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), 0.0];
        let [c, t, _] = case;
        if t.abs() <= c.abs() {
            continue;
        }
        cases += 1;
        let root = (t * t - c * c).sqrt();
        // With sgn(0) = 0 the numerator of the first root is 0.
        zero += usize::from(residual(case, 0.0) > ROOT);
        one += usize::from(residual(case, -root / (c - t)) > ROOT);
    }
    finding(
        "velinov2018 eq. 40",
        "sgn(b), of the coefficient of the sine",
        format!(
            "with b = 0, of {cases} solvable cases sgn(0) = 0 fails in {zero}, sgn(0) = 1 in {one}"
        ),
        match (zero, one) {
            (0, _) => "holds",
            (_, 0) => {
                "holds if sgn(0) counts as 1, and sgn is that of the coefficient in use, not of b_xi1"
            }
            _ => "does not hold",
        },
    )
}

fn coherence_of_figure_eleven() -> Finding {
    let ks = TAU / 550.0 * 10.0;
    let least = (-ks * ks * 4.0).exp();
    finding(
        "velinov2018 fig. 11",
        "sigma = 10 nm",
        format!(
            "k sigma = {ks:.3} at 550 nm: over all of the hemisphere exp(-(k sigma xi_1)^2) stays above {:.3}",
            least
        ),
        if least > 0.5 {
            "cannot be: nothing would be specular along the scratch; micrometres are likely"
        } else {
            "may be: the lobe is narrower than the hemisphere"
        },
    )
}

/// Claims that are measured on the regions.
fn claims_on_regions(fitted: &FittedConstants) -> Result<Vec<Finding>, ExhibitError> {
    let mut single = Vec::new();
    let mut energy = Vec::new();
    let (mut line_errors, mut biases) = (Vec::new(), Vec::new());
    for region in &REGIONS {
        let Some(points) = region.fitted else { continue };
        let points = Points::new(points());
        let sphere = points.columns.len() == SPHERE_COLUMNS.len();
        let (light, reference) = if sphere { ("sphere", &SPHERE) } else { ("triangle", &TRIANGLE) };
        let exact = points.exact(reference)?;
        let total: f64 = exact.iter().sum();
        let with = |name: &str| Loaded::new(&format!("{light}_{name}"), fitted)?.single(&points);
        let (line, nodes) = (with("line_medium")?, with("covered_three_medium")?);
        line_errors.push(relative_l2(&line, &exact));
        single.push(format!(
            "{} {:.1} % ({:.1} %)",
            region.name,
            100.0 * relative_l2(&line, &exact),
            100.0 * relative_l2(&nodes, &exact)
        ));
        let bias = with("line_printed")?.iter().sum::<f64>() / total - 1.0;
        energy.push(format!("{} {:+.1} %", region.name, 100.0 * bias));
        biases.push(bias);
    }
    Ok(vec![
        finding(
            "velinov2018 §3.4, eq. 26",
            "the Gaussian is so narrow that one line stands for all",
            format!(
                "relative L2 error of the line with exact bands, in brackets of three slices where the light \
                 covers the lobe: {}",
                single.join(", ")
            ),
            &extent_of(&line_errors, 0.1),
        ),
        finding(
            "velinov2018 §3.4.1",
            "can be used without performing extraneous normalization",
            format!(
                "light in all of the published form against the reference: {}",
                energy.join(", ")
            ),
            &extent_of(&biases, 0.05),
        ),
    ])
}

/// On how many regions a claim holds, to a relative error.
fn extent_of(errors: &[f64], limit: f64) -> String {
    let held = errors.iter().filter(|error| error.abs() <= limit).count();
    let percent = 100.0 * limit;
    match held {
        0 => format!("does not hold: to {percent} % on none of {} regions", errors.len()),
        _ if held == errors.len() => format!("holds: to {percent} % on all {held} regions"),
        _ => format!("in part: to {percent} % on {held} of {} regions", errors.len()),
    }
}
