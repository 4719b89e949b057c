//! Error curves: the published form beside ours.

use super::{EffectEvidence, bare};
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Figure, Section};
use crate::effect::Region;
use crate::table::Table;
use crate::validate::ValidateError;
use crate::validate::curves::{Curve, against_reference};
use crate::validate::study::CandidateStudy;

/// Arguments per curve.
const POINTS: usize = 2000;
/// Below this largest error a curve shows nothing beside the others on a linear axis.
const VISIBLE: f64 = 1e-3;
/// Curves closer than this, relative to their largest error, are drawn as one.
const SAME: f64 = 0.02;

/// The span of a region along one argument.
struct Span {
    name: &'static str,
    unit: &'static str,
    low: f64,
    high: f64,
    /// Whether it covers several decades on one side of 0, where the other side is its mirror.
    wide: bool,
}

pub(super) fn section(evidence: &EffectEvidence<'_>) -> Result<Section, ValidateError> {
    let mut section = Section::new("Error curves").paragraph(
        "Form minus reference in f32, with the constants as shipped. Fits whose curves lie within \
         2 % of one already drawn are left out.",
    );
    for (number, region) in evidence.effect.regions.iter().enumerate() {
        let points = (region.points)();
        let mut curves: Vec<Curve> = Vec::new();
        let mut shown = None;
        for fit in ordered(evidence) {
            let Some(span) = span(fit, &points) else { continue };
            let curve = curve(fit, &span)?;
            if !curves.iter().any(|drawn| same(drawn, &curve)) {
                curves.push(curve);
            }
            shown = Some(span);
        }
        if let Some(span) = shown {
            section = figures(section, evidence, region, number, &span, &curves);
        }
    }
    Ok(section)
}

/// The fits that return values, the baseline first, so that it is drawn and others are compared with it.
fn ordered<'a>(evidence: &EffectEvidence<'a>) -> Vec<&'a CandidateStudy> {
    let valued = evidence.study.candidates.iter().filter(|fit| fit.draws.is_empty());
    let mut fits: Vec<&CandidateStudy> = valued.collect();
    fits.sort_by_key(|fit| !evidence.effect.baselines.contains(&fit.name.as_str()));
    fits
}

fn figures(
    mut section: Section,
    evidence: &EffectEvidence<'_>,
    region: &Region,
    number: usize,
    span: &Span,
    curves: &[Curve],
) -> Section {
    let slug = evidence.effect.name.replace('_', "-");
    let axis = || match span.wide {
        true => PlotAxis::log(span.name, span.unit),
        false => PlotAxis::linear(span.name, span.unit),
    };
    let coarse: Vec<&Curve> = curves.iter().filter(|curve| largest(curve) > VISIBLE).collect();
    if !coarse.is_empty() {
        let title = format!("Error over {}", region.name);
        let mut plot = Plot::new(title, axis(), PlotAxis::linear("error", "1"));
        for curve in &coarse {
            let series = Series::line(bare(&curve.name), curve.points.iter().copied());
            let baseline = evidence.effect.baselines.contains(&curve.name.as_str());
            plot = plot.series(if baseline { series.strong() } else { series });
        }
        let finer = match coarse.len() < curves.len() {
            true => " Forms below 1e-3 are in the next figure.",
            false => "",
        };
        let caption = format!("Error over {}. {}.{finer}", region.name, sentence(region));
        section = section.block(Figure::new(format!("{slug}-error-{number}"), caption, plot));
    }
    if curves.len() > 1 {
        let title = format!("|error| over {}", region.name);
        let mut plot =
            Plot::new(title, axis(), PlotAxis::log("|error|, largest in each cell", "1"));
        for curve in curves {
            plot = plot.series(Series::line(bare(&curve.name), envelope(&curve.points)));
        }
        let caption = format!(
            "Magnitude of the error over {}, the largest in each of 160 cells. {}.",
            region.name,
            sentence(region)
        );
        section = section.block(Figure::new(format!("{slug}-magnitude-{number}"), caption, plot));
    }
    section
}

fn sentence(region: &Region) -> &'static str {
    region.description.trim_end_matches('.')
}

fn curve(fit: &CandidateStudy, span: &Span) -> Result<Curve, ValidateError> {
    let at = |t: f64| match span.wide {
        true => span.low * (span.high / span.low).powf(t),
        false => span.low + (span.high - span.low) * t,
    };
    let arguments: Vec<f64> = (0..POINTS).map(|i| at((i as f64 + 0.5) / POINTS as f64)).collect();
    against_reference(&fit.candidate, fit.reference, &arguments)
}

/// The span of the region's points along the one argument of the fit's reference.
fn span(fit: &CandidateStudy, points: &Table) -> Option<Span> {
    let [argument] = fit.reference.arguments else { return None };
    let values = &points.column(argument.name)?.values;
    let bounds = |of: &dyn Fn(f64) -> f64| {
        values
            .iter()
            .map(|value| of(*value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    let (nearest, farthest) = bounds(&f64::abs);
    let wide = nearest > 1e-3 && farthest / nearest > 50.0;
    let (low, high) = if wide { (nearest, farthest) } else { bounds(&|value| value) };
    (low < high).then_some(Span { name: argument.name, unit: argument.unit, low, high, wide })
}

fn largest(curve: &Curve) -> f64 {
    curve.points.iter().map(|(_, error)| error.abs()).fold(0.0, f64::max)
}

fn same(drawn: &Curve, curve: &Curve) -> bool {
    let difference =
        drawn.points.iter().zip(&curve.points).map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max);
    difference < SAME * largest(curve)
}

/// The largest magnitude in each of 160 runs of points, so that a log plot shows an envelope and
/// not the zero crossings.
fn envelope(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    points
        .chunks(points.len().div_ceil(160).max(1))
        .filter_map(|run| {
            let middle = run.get(run.len() / 2)?.0;
            Some((middle, run.iter().map(|(_, error)| error.abs()).fold(0.0, f64::max)))
        })
        .collect()
}
