//! Fig. 5 of velinov2018, and errors against the half-extent and against the tilt.

use super::line::{Line, Mean, errors};
use super::pixels::{Footprint, of_cameras};
use super::reference::{coverage, response};
use super::regions::equal_ratios;
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{Candidate, Candidates, ClaimError, Exhibit};
use crate::numeric::statistics::percentile;

/// What is said of the exhibits.
const TEXTS: &str = include_str!("exhibits.toml");
/// Fits shown of the response, in the order of the legend.
const RESPONSES: [&str; 7] = [
    "eq16_printed",
    "eq16",
    "blend_area",
    "blend_half_extent",
    "matched_gaussian",
    "softplus_chord",
    "soft_chord",
];
/// Fits shown of the coverage.
const COVERAGES: [&str; 5] = [
    "coverage_eq18",
    "coverage_blend_area",
    "coverage_blend_half_extent",
    "coverage_matched_gaussian",
    "coverage_soft_chord",
];

/// What the effect shows beyond its fits.
pub(super) fn exhibits(candidates: &Candidates) -> Result<Vec<Section>, ClaimError> {
    Ok(vec![
        figure_five(candidates)?,
        against_half_extent_and_tilt(candidates)?,
        cameras(candidates)?,
    ])
}

fn named<'a>(candidates: &'a Candidates, fit: &str) -> Result<&'a Candidate, ClaimError> {
    Ok(candidates.get(&format!("footprint/{fit}"))?)
}

fn pairs(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

fn figure_five(candidates: &Candidates) -> Result<Section, ClaimError> {
    let responses = ["eq16_printed", "eq16", "soft_chord"];
    let coverages = ["coverage_eq18", "coverage_blend_area", "coverage_soft_chord"];
    let mut exhibit = Exhibit::of(TEXTS, "figure_five", &[]);
    for (mean, fits) in [(response as Mean, responses), (coverage, coverages)] {
        let ratios = equal_ratios(0.1, 100.0, 121);
        let rows: Vec<_> = ratios.iter().map(|&ratio| [ratio.sqrt(), 0.0, ratio]).collect();
        let centres = Line::new(mean, &rows)?;
        let offsets: Vec<f64> = (0..=120).map(|i| 0.05 * f64::from(i)).collect();
        let rows: Vec<_> = offsets.iter().map(|&s| [10_f64.sqrt(), s, 10.0]).collect();
        let circle = Line::new(mean, &rows)?;
        let mut at_centre = vec![Series::line("exact", pairs(&ratios, &centres.exact)).strong()];
        let mut over_offset = vec![Series::line("exact", pairs(&offsets, &circle.exact)).strong()];
        for fit in fits {
            let candidate = named(candidates, fit)?;
            let values = pairs(&ratios, &candidate.values_at(&centres.points)?);
            // Eq. 18 has no bound: what is above 2 would hide the rest.
            at_centre.push(Series::line(fit, values.into_iter().filter(|(_, v)| *v <= 2.0)));
            let values = candidate.values_at(&circle.points)?;
            over_offset.push(Series::line(fit, pairs(&offsets, &values)));
        }
        exhibit = exhibit.figure(at_centre).figure(over_offset);
    }
    Ok(exhibit.section())
}

fn against_half_extent_and_tilt(candidates: &Candidates) -> Result<Section, ClaimError> {
    let h = equal_ratios(0.05, 1000.0, 61);
    let circles: Vec<(f64, f64)> = h.iter().map(|&h| (h, h * h)).collect();
    let tilts: Vec<f64> = (0..=89).map(f64::from).collect();
    // Along the tilt the half-extent stays as it is and the area grows.
    let tilted: Vec<(f64, f64)> = tilts
        .iter()
        .map(|tilt| Footprint::new(0.7, tilt.to_radians(), 0.0))
        .map(|f| (f.half_extent, f.area_ratio()))
        .collect();
    let against = |over, footprints, mean, fits: &[&str]| {
        let lines = Line::all(mean, footprints, 96)?;
        let curve = |fit: &&str| {
            let errors = errors(named(candidates, fit)?, &lines)?;
            let series = Series::line(*fit, pairs(over, &errors));
            Ok(if fit.ends_with("soft_chord") { series.strong() } else { series })
        };
        fits.iter().map(curve).collect::<Result<Vec<_>, ClaimError>>()
    };
    Ok(Exhibit::of(TEXTS, "half_extent_and_tilt", &[])
        .figure(against(&h, &circles, response, &RESPONSES)?)
        .figure(against(&h, &circles, coverage, &COVERAGES)?)
        .figure(against(&tilts, &tilted, response, &RESPONSES)?)
        .section())
}

fn cameras(candidates: &Candidates) -> Result<Section, ClaimError> {
    let pixels: Vec<(f64, f64)> =
        of_cameras(45).take(300).map(|f| (f.half_extent, f.area_ratio())).collect();
    let mut rows = Vec::new();
    for (mean, fits) in
        [(response as Mean, RESPONSES.as_slice()), (coverage as Mean, COVERAGES.as_slice())]
    {
        let lines = Line::all(mean, &pixels, 32)?;
        for fit in fits {
            let errors = errors(named(candidates, fit)?, &lines)?;
            let mut row = vec![Cell::text(format!("`footprint/{fit}`"))];
            row.extend([50.0, 95.0, 100.0].map(|p| Cell::from(percentile(&errors, p))));
            rows.push(row);
        }
    }
    Ok(Exhibit::of(TEXTS, "cameras", &[]).table(rows).section())
}
