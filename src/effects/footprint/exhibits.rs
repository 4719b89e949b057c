//! Fig. 5 of velinov2018, and errors against the half-extent and against the tilt.

use super::line::{Line, Mean, errors};
use super::pixels::{Camera, Footprint};
use super::reference::{coverage, response};
use super::regions::equal_ratios;
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedTable, Section};
use crate::effect::{Candidate, Candidates, ClaimError};
use crate::numeric::statistics::percentile;

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
    let mut section = Section::new("Fig. 5 of velinov2018").paragraph(
        "Response and coverage of circular footprints: exact, as printed, with the missing factor π \
         or the missing correction for small footprints, and with a soft chord.",
    );
    let shown = [("response", response as Mean, responses), ("coverage", coverage, coverages)];
    for (label, mean, fits) in shown {
        let ratios = equal_ratios(0.1, 100.0, 121);
        let rows: Vec<_> = ratios.iter().map(|&ratio| [ratio.sqrt(), 0.0, ratio]).collect();
        let centres = Line::new(mean, &rows)?;
        let offsets: Vec<f64> = (0..=120).map(|i| 0.05 * f64::from(i)).collect();
        let rows: Vec<_> = offsets.iter().map(|&s| [10_f64.sqrt(), s, 10.0]).collect();
        let circle = Line::new(mean, &rows)?;
        let value = PlotAxis::linear(label, "1");
        let area = PlotAxis::log("A_P/A_C", "1");
        let mut at_centre = Plot::new(format!("{label} at s = 0"), area, value.clone())
            .series(Series::line("exact", pairs(&ratios, &centres.exact)).strong());
        let offset = PlotAxis::linear("offset s", "σ");
        let mut over_offset = Plot::new(format!("{label} at A_P/A_C = 10"), offset, value)
            .series(Series::line("exact", pairs(&offsets, &circle.exact)).strong());
        for fit in fits {
            let candidate = named(candidates, fit)?;
            let values = pairs(&ratios, &candidate.values_at(&centres.points)?);
            // Eq. 18 has no bound: what is above 2 would hide the rest.
            let within = values.into_iter().filter(|(_, v)| *v <= 2.0);
            at_centre = at_centre.series(Series::line(fit, within));
            let values = candidate.values_at(&circle.points)?;
            over_offset = over_offset.series(Series::line(fit, pairs(&offsets, &values)));
        }
        let caption = format!(
            "Mean {label} of a scratch through the centre of a circular footprint. Fig. 5 marks the \
             ratios 1, 10 and 20. Values above 2 are not drawn."
        );
        section = section.block(Figure::new(format!("footprint-{label}-area"), caption, at_centre));
        let caption =
            format!("Mean {label} over the offset for a circle ten coherence areas large.");
        section =
            section.block(Figure::new(format!("footprint-{label}-offset"), caption, over_offset));
    }
    Ok(section)
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
    let against = |stem, caption, title, x, over, footprints, mean, fits: &[&str]| {
        let lines = Line::all(mean, footprints, 96)?;
        let mut plot = Plot::new(title, x, PlotAxis::log("relative L2 error", "1"));
        for fit in fits {
            let series = Series::line(*fit, pairs(over, &errors(named(candidates, fit)?, &lines)?));
            let strong = fit.ends_with("soft_chord");
            plot = plot.series(if strong { series.strong() } else { series });
        }
        Ok::<_, ClaimError>(Figure::new(stem, caption, plot))
    };
    let circular = |stem, title, mean, fits| {
        let caption = "Over the offsets of a circular footprint, to 4.5σ past its rim.";
        against(stem, caption, title, PlotAxis::log("half-extent h", "σ"), &h, &circles, mean, fits)
    };
    Ok(Section::new("Error against half-extent and tilt")
        .paragraph(
            "The exact mean depends on the half-extent across the scratch alone: the tilt along it \
             changes only what forms that look at the area make of it.",
        )
        .block(circular("footprint-error-response", "Response", response, &RESPONSES)?)
        .block(circular("footprint-error-coverage", "Coverage", coverage, &COVERAGES)?)
        .block(against(
            "footprint-error-tilt",
            "A footprint of 0.7σ across the scratch, tilted along it: h stays, A_P grows.",
            "Response, tilted",
            PlotAxis::linear("tilt", "°"),
            &tilts,
            &tilted,
            response,
            &RESPONSES,
        )?))
}

fn cameras(candidates: &Candidates) -> Result<Section, ClaimError> {
    let pixels: Vec<(f64, f64)> =
        Camera::seeded(45).take(300).map(|f| (f.half_extent, f.area_ratio())).collect();
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
    let columns = [("fit", ""), ("median", "1"), ("95 %", "1"), ("worst", "1")];
    Ok(Section::new("Pixels of cameras")
        .paragraph(
            "300 pixels as in the region `camera`, other draws: relative L2 error over the offsets \
             of each.",
        )
        .block(PrintedTable::of_rows("Relative L2 error per pixel", columns, rows)))
}
