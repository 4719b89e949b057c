//! Draws beside the distributions that they should have.

use super::bare;
use crate::document::{Cell, PrintedTable, Section, Verdict, number};
use crate::numeric::measured::Measured;
use crate::validate::draws::{Draws, DrawsStudy, SIGNIFICANCE};
use crate::validate::study::Study;

/// The forms of `study` that draw from a distribution, region by region; none if none does.
pub fn draws_section(study: &Study) -> Option<Section> {
    let rows: Vec<(&str, &str, &DrawsStudy)> = study
        .candidates
        .iter()
        .flat_map(|fit| fit.draws.iter().map(|(region, of)| (bare(&fit.name), region.as_str(), of)))
        .collect();
    let one_in = number(1.0 / SIGNIFICANCE, 3);
    let caption = format!(
        "Mean, variance and frequencies of the draws against those of the reference, the worst over the \
         points of a region, in f32. Draws are fair unless mean or χ² is so far off anywhere in the region \
         once in {one_in} times or less: the smallest p is held against the limit of Šidák for as many \
         points. The corrected p is what `mean_p` and the metric `chi2_p` of a gate are."
    );
    let on_device = |of: &DrawsStudy| match &of.device {
        Measured::Value(draws) => verdict(draws),
        Measured::NotMeasured(reason) => Cell::missing(reason.as_str()),
    };
    let table = PrintedTable::over(caption, &rows)
        .code("fit", |(fit, ..)| *fit)
        .text("region", |(_, region, _)| *region)
        .number("points", "1", |(.., of)| of.f32.points.len())
        .number("draws", "1", |(.., of)| {
            of.f32.points.iter().map(|point| point.draws).sum::<usize>()
        })
        .number("max |mean z|", "1", |(.., of)| (of.f32.worst_mean_z, 4))
        .number("its corrected p", "1", |(.., of)| of.f32.mean_p)
        .number("max variance ratio", "1", |(.., of)| (of.f32.worst_variance_ratio, 4))
        .number("smallest p of χ²", "1", |(.., of)| of.f32.least_p)
        .number("its limit", "1", |(.., of)| of.f32.sidak_limit)
        .number("corrected", "1", |(.., of)| of.f32.chi_squared_p)
        .verdict("f32", |(.., of)| verdict(&of.f32))
        .verdict("device", |(.., of)| on_device(of))
        .table();
    (!rows.is_empty()).then(|| Section::new("Draws").block(table))
}

fn verdict(draws: &Draws) -> Cell {
    match draws.fair() {
        true => Cell::verdict_as(Verdict::Pass, "fair"),
        false => Cell::verdict_as(Verdict::Fail, "not fair"),
    }
}
