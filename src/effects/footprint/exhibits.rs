//! Fig. 5 of velinov2018, and errors against the half-extent and against the tilt.

use crate::effect::FittedConstants;
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitError, ExhibitPlot, ExhibitSeries, ExhibitTable,
    Stroke,
};
use crate::numeric::statistics::percentile;

use super::approximation::{Approximation, Line, Mean, NotMeasured};
use super::pixels::{Camera, Footprint};
use super::reference::{coverage, response};
use super::regions::equal_ratios;

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
const ERROR: ExhibitAxis = ExhibitAxis { label: "relative L2 error", unit: "1", log: true };

/// What the effect shows beyond its fits.
pub(super) fn exhibits(fitted: &FittedConstants) -> Result<Vec<Exhibit>, ExhibitError> {
    Ok(vec![figure_five(fitted)?, errors(fitted)?, cameras(fitted)?])
}

fn series(name: &str, points: Vec<(f64, f64)>, stroke: Stroke) -> ExhibitSeries {
    ExhibitSeries { name: name.into(), points, stroke }
}

fn pairs(x: &[f64], y: Vec<f64>) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y).collect()
}

fn figure_five(fitted: &FittedConstants) -> Result<Exhibit, NotMeasured> {
    let shown: [(&str, &str, Mean, &[&str]); 2] = [
        ("response", "1", response, &["eq16_printed", "eq16", "soft_chord"]),
        (
            "coverage",
            "1",
            coverage,
            &["coverage_eq18", "coverage_blend_area", "coverage_soft_chord"],
        ),
    ];
    let mut plots = Vec::new();
    for (label, unit, mean, forms) in shown {
        let y = ExhibitAxis { label, unit, log: false };
        let ratios = equal_ratios(0.1, 100.0, 121);
        let lines: Vec<Line> = ratios
            .iter()
            .map(|&ratio| Line::new(mean, ratio.sqrt(), ratio, vec![0.0]))
            .collect::<Result<_, _>>()?;
        let exact = lines.iter().map(|line| line.exact[0]).collect();
        let mut at_centre = vec![series("exact", pairs(&ratios, exact), Stroke::Strong)];
        let circle =
            Line::new(mean, 10_f64.sqrt(), 10.0, (0..=120).map(|i| 0.05 * f64::from(i)).collect())?;
        let mut over_offset =
            vec![series("exact", pairs(&circle.offsets, circle.exact.clone()), Stroke::Strong)];
        for form in forms {
            let approximation = Approximation::named(form, fitted)?;
            let values = lines
                .iter()
                .map(|line| Ok(approximation.over(line)?.into_iter().next().unwrap_or(f64::NAN)))
                .collect::<Result<Vec<f64>, NotMeasured>>()?;
            // Eq. 18 has no bound: what is above 2 would hide the rest.
            let within = pairs(&ratios, values).into_iter().filter(|(_, v)| *v <= 2.0).collect();
            at_centre.push(series(form, within, Stroke::Line));
            let values = approximation.over(&circle)?;
            over_offset.push(series(form, pairs(&circle.offsets, values), Stroke::Line));
        }
        let (stem, stem_offset) = match label {
            "response" => ("footprint-response-area", "footprint-response-offset"),
            _ => ("footprint-coverage-area", "footprint-coverage-offset"),
        };
        plots.push(ExhibitPlot {
            stem,
            title: format!("{label} at s = 0"),
            caption: format!(
                "Mean {label} of a scratch through the centre of a circular footprint. Fig. 5 marks \
                 the ratios 1, 10 and 20. Values above 2 are not drawn."
            ),
            x: ExhibitAxis { label: "A_P/A_C", unit: "1", log: true },
            y,
            series: at_centre,
        });
        plots.push(ExhibitPlot {
            stem: stem_offset,
            title: format!("{label} at A_P/A_C = 10"),
            caption: format!(
                "Mean {label} over the offset for a circle ten coherence areas large."
            ),
            x: ExhibitAxis { label: "offset s", unit: "σ", log: false },
            y,
            series: over_offset,
        });
    }
    Ok(Exhibit {
        title: "Fig. 5 of velinov2018".into(),
        text: vec![
            "Response and coverage of circular footprints: exact, as printed, with the missing \
             factor π or the missing correction for small footprints, and with a soft chord."
                .into(),
        ],
        plots,
        tables: Vec::new(),
    })
}

fn errors(fitted: &FittedConstants) -> Result<Exhibit, NotMeasured> {
    let h = equal_ratios(0.05, 1000.0, 61);
    let circles: Vec<(f64, f64)> = h.iter().map(|&h| (h, h * h)).collect();
    let tilts: Vec<f64> = (0..=89).map(f64::from).collect();
    // Along the tilt the half-extent stays as it is and the area grows.
    let tilted: Vec<(f64, f64)> = tilts
        .iter()
        .map(|tilt| Footprint::new(0.7, tilt.to_radians(), 0.0))
        .map(|f| (f.half_extent, f.area_ratio()))
        .collect();
    let x_extent = ExhibitAxis { label: "half-extent h", unit: "σ", log: true };
    let x_tilt = ExhibitAxis { label: "tilt", unit: "°", log: false };
    let against = |stem,
                   title: &str,
                   caption: &str,
                   x,
                   over: &[f64],
                   footprints: &[_],
                   mean,
                   forms: &[&str]| {
        let lines = Line::all(mean, footprints, 96)?;
        let curves = forms
            .iter()
            .map(|form| {
                let errors = Approximation::named(form, fitted)?.errors(&lines)?;
                let stroke =
                    if form.ends_with("soft_chord") { Stroke::Strong } else { Stroke::Line };
                Ok(series(form, pairs(over, errors), stroke))
            })
            .collect::<Result<Vec<_>, NotMeasured>>()?;
        let (title, caption) = (title.to_owned(), caption.to_owned());
        Ok::<_, NotMeasured>(ExhibitPlot { stem, title, caption, x, y: ERROR, series: curves })
    };
    let circular = "Over the offsets of a circular footprint, to 4.5σ past its rim.";
    let thin = "A footprint of 0.7σ across the scratch, tilted along it: h stays, A_P grows.";
    Ok(Exhibit {
        title: "Error against half-extent and tilt".into(),
        text: vec![
            "The exact mean depends on the half-extent across the scratch alone: the tilt along it \
             changes only what forms that look at the area make of it."
                .into(),
        ],
        plots: vec![
            against(
                "footprint-error-response",
                "Response",
                circular,
                x_extent,
                &h,
                &circles,
                response as Mean,
                &RESPONSES,
            )?,
            against(
                "footprint-error-coverage",
                "Coverage",
                circular,
                x_extent,
                &h,
                &circles,
                coverage as Mean,
                &COVERAGES,
            )?,
            against(
                "footprint-error-tilt",
                "Response, tilted",
                thin,
                x_tilt,
                &tilts,
                &tilted,
                response as Mean,
                &RESPONSES,
            )?,
        ],
        tables: Vec::new(),
    })
}

fn cameras(fitted: &FittedConstants) -> Result<Exhibit, NotMeasured> {
    let pixels: Vec<(f64, f64)> =
        Camera::seeded(45).take(300).map(|f| (f.half_extent, f.area_ratio())).collect();
    let mut rows = Vec::new();
    for (mean, forms) in
        [(response as Mean, RESPONSES.as_slice()), (coverage as Mean, COVERAGES.as_slice())]
    {
        let lines = Line::all(mean, &pixels, 32)?;
        for form in forms {
            let errors = Approximation::named(form, fitted)?.errors(&lines)?;
            let mut row = vec![ExhibitCell::Text(format!("`footprint/{form}`"))];
            row.extend([50.0, 95.0, 100.0].map(|p| ExhibitCell::Number(percentile(&errors, p))));
            rows.push(row);
        }
    }
    let number = |name: &str| (name.to_owned(), "1");
    Ok(Exhibit {
        title: "Pixels of cameras".into(),
        text: vec![
            "300 pixels as in the region `camera`, other draws: relative L2 error over the offsets \
             of each."
                .into(),
        ],
        plots: Vec::new(),
        tables: vec![ExhibitTable {
            caption: "Relative L2 error per pixel".into(),
            columns: vec![("fit".into(), ""), number("median"), number("95 %"), number("worst")],
            rows,
        }],
    })
}
