//! What `compare` prints.

use std::path::Path;

use serde_json::{Value, json};

use super::compare::Metric;
use crate::document::{Cell, PrintedColumn, PrintedTable, Section, number};
use crate::render::compare::columns::ColumnDifference;
use crate::render::compare::flip::FlipMap;
use crate::render::compare::metrics::{Difference, ImageDifference};
use crate::render::compare::z_test::ZTest;

/// Level of the noise test.
const LEVEL: f64 = 0.01;

/// FLIP, or why it has no value.
pub(super) struct Flip {
    /// The mean.
    pub(super) value: f64,
    /// Kind, exposures and observer.
    pub(super) conditions: String,
    /// Negative components, which count as 0.
    pub(super) negative: usize,
    /// Per pixel.
    pub(super) map: Option<FlipMap>,
}

/// What came out of a comparison of images.
pub(super) struct ImageComparison {
    /// The plain errors.
    pub(super) difference: ImageDifference,
    /// FLIP, or why there is none.
    pub(super) flip: Result<Flip, String>,
    /// The noise test, if there are standard errors.
    pub(super) z: Option<ZTest>,
    /// The scale of the error map, if one was written.
    pub(super) scale: Option<f64>,
}

/// What came out of a comparison.
pub(super) enum Compared {
    /// Of images.
    Images(Box<ImageComparison>),
    /// Of tables.
    Tables(Vec<ColumnDifference>),
}

/// A metric held to a limit.
pub(super) struct Judgement {
    pub(super) metric: Metric,
    pub(super) value: f64,
    pub(super) limit: f64,
}

impl Judgement {
    /// Whether the value is a number and not above the limit.
    pub(super) fn passed(&self) -> bool {
        self.value <= self.limit
    }
}

fn plain(difference: &Difference, metric: Metric) -> Option<f64> {
    match metric {
        Metric::Mean => Some(relative_bias(difference)),
        Metric::Rms => Some(difference.rms),
        Metric::RelativeRms => Some(difference.relative_rms),
        Metric::Max => Some(difference.max),
        Metric::Flip | Metric::Z | Metric::Significance => None,
    }
}

/// Difference of the means relative to the reference's; 0 if they are equal.
fn relative_bias(difference: &Difference) -> f64 {
    let error = (difference.mean - difference.reference_mean).abs();
    if error == 0.0 { 0.0 } else { error / difference.reference_mean.abs() }
}

impl Compared {
    /// The value of a metric, or why there is none.
    pub(super) fn metric(&self, metric: Metric) -> Result<f64, String> {
        match self {
            Self::Tables(columns) => {
                let values = columns.iter().map(|column| plain(&column.difference, metric));
                let worse = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
                let worst = values.collect::<Option<Vec<f64>>>();
                worst
                    .and_then(|values| values.into_iter().reduce(worse))
                    .ok_or_else(|| "tables have no such metric".to_owned())
            }
            Self::Images(images) => match metric {
                Metric::Flip => match &images.flip {
                    Ok(flip) => Ok(flip.value),
                    Err(why) => Err(why.clone()),
                },
                Metric::Z | Metric::Significance => {
                    let z = images.z.as_ref().ok_or("neither image has all channels stderr.…")?;
                    Ok(if metric == Metric::Z { z.worst_z.abs() } else { 1.0 - z.p })
                }
                _ => {
                    plain(&images.difference.all, metric).ok_or_else(|| "no such metric".to_owned())
                }
            },
        }
    }

    /// Remarks for stderr.
    pub(super) fn notes(&self) -> Vec<String> {
        let differences: Vec<(&str, &Difference)> = match self {
            Self::Tables(columns) => {
                columns.iter().map(|c| (c.name.as_str(), &c.difference)).collect()
            }
            Self::Images(images) => {
                images.difference.channels.iter().map(|(name, d)| (name.as_str(), d)).collect()
            }
        };
        let mut notes: Vec<String> = differences
            .into_iter()
            .filter(|(_, d)| d.non_finite + d.reference_non_finite > 0)
            .map(|(name, d)| {
                let (a, b) = (d.non_finite, d.reference_non_finite);
                format!("note: {name}: values that are not finite: {a} in A, {b} in B")
            })
            .collect();
        if let Self::Images(images) = self {
            if let Ok(flip) = &images.flip
                && flip.negative > 0
            {
                let count = flip.negative;
                notes.push(format!("note: FLIP takes {count} negative components as 0"));
            }
            if let Some(z) = &images.z
                && z.unusable > 0
            {
                notes.push(format!("note: the noise test has {} unusable values", z.unusable));
            }
        }
        notes
    }
}

/// A comparison with its judgements, to be printed.
pub(super) struct Comparison<'a> {
    pub(super) a: &'a Path,
    pub(super) b: &'a Path,
    pub(super) compared: &'a Compared,
    pub(super) judgements: &'a [Judgement],
}

impl Comparison<'_> {
    /// For a reader.
    pub(super) fn section(&self) -> Section {
        let rows: Vec<Vec<Cell>> = match self.compared {
            Compared::Tables(columns) => {
                let row = |column: &ColumnDifference| {
                    let name = match column.unit.as_str() {
                        "1" => column.name.clone(),
                        unit => format!("{} [{unit}]", column.name),
                    };
                    numbers(
                        &name,
                        &column.difference,
                        format!("row {}", column.difference.max_at + 1),
                    )
                };
                columns.iter().map(row).collect()
            }
            Compared::Images(images) => {
                let difference = &images.difference;
                let channel = |(name, d): &(String, Difference)| {
                    let (x, y) = difference.pixel(d.max_at);
                    numbers(name, d, format!("x {x}, y {y}"))
                };
                let place = difference.max_place();
                let place = format!("x {}, y {}, {}", place.x, place.y, place.channel);
                let all = numbers("all", &difference.all, place);
                difference.channels.iter().map(channel).chain([all]).collect()
            }
        };
        let mut columns = vec![PrintedColumn::text("")];
        columns.extend(
            ["mean", "reference", "rms", "relative rms", "max"].map(PrintedColumn::figures),
        );
        columns.push(PrintedColumn::text("at"));
        let caption = format!("{} against {}", self.a.display(), self.b.display());
        let mut section =
            Section::default().block(PrintedTable::new(caption, columns).with_rows(rows));
        if let Compared::Images(images) = self.compared {
            section = section.paragraph(match &images.flip {
                Ok(flip) => format!("FLIP {} ({})", number(flip.value, 5), flip.conditions),
                Err(why) => format!("FLIP not defined: {why}"),
            });
            if let Some(z) = &images.z {
                section = section.paragraph(noise(z));
            }
            if let Some(scale) = images.scale {
                section = section
                    .paragraph(format!("error map from 0 to {scale} of the reference's RMS"));
            }
        }
        self.judgements.iter().fold(section, |section, judgement| {
            let verdict = if judgement.passed() { "PASS" } else { "FAIL" };
            let (name, value) = (judgement.metric.name(), number(judgement.value, 5));
            section.paragraph(format!("{verdict} {name} {value}, limit {}", judgement.limit))
        })
    }

    /// As JSON; what is NaN is null.
    pub(super) fn json(&self) -> Value {
        let judgement = |j: &Judgement| {
            let (metric, passed) = (j.metric.name(), j.passed());
            json!({ "metric": metric, "value": j.value, "limit": j.limit, "passed": passed })
        };
        let mut value = json!({
            "a": self.a.display().to_string(),
            "b": self.b.display().to_string(),
            "limits": self.judgements.iter().map(judgement).collect::<Vec<_>>(),
        });
        match self.compared {
            Compared::Tables(columns) => {
                let column = |c: &ColumnDifference| {
                    let place = json!({ "row": c.difference.max_at + 1 });
                    object(&c.name, &c.difference, place)
                };
                value["columns"] = columns.iter().map(column).collect();
            }
            Compared::Images(images) => {
                let ImageComparison { difference, flip, z, scale } = images.as_ref();
                let channel = |(name, d): &(String, Difference)| {
                    let (x, y) = difference.pixel(d.max_at);
                    object(name, d, json!({ "x": x, "y": y }))
                };
                value["channels"] = difference.channels.iter().map(channel).collect();
                let place = difference.max_place();
                let place = json!({ "x": place.x, "y": place.y, "channel": place.channel });
                value["all"] = object("all", &difference.all, place);
                value["flip"] = match flip {
                    Ok(flip) => json!({ "mean": flip.value, "conditions": flip.conditions }),
                    Err(why) => json!({ "mean": null, "conditions": why }),
                };
                value["noise"] = z.as_ref().map_or(Value::Null, |z| {
                    json!({
                        "cells": z.cells, "z": z.worst_z, "p": z.p, "passes": z.passes(LEVEL),
                        "worst": {
                            "channel": z.worst.channel, "x": z.worst.x, "y": z.worst.y,
                            "pixels": z.worst.pixels,
                        },
                    })
                });
                value["error_map_scale"] = json!(scale);
            }
        }
        value
    }
}

fn numbers(name: &str, d: &Difference, place: String) -> Vec<Cell> {
    let numbers = [d.mean, d.reference_mean, d.rms, d.relative_rms, d.max];
    let mut row = vec![Cell::text(name)];
    row.extend(numbers.map(|value| Cell::number(value, 5)));
    row.push(Cell::text(place));
    row
}

fn object(name: &str, d: &Difference, place: Value) -> Value {
    json!({
        "name": name, "mean": d.mean, "reference_mean": d.reference_mean, "rms": d.rms,
        "relative_rms": d.relative_rms, "max": d.max, "max_at": place,
        "non_finite": d.non_finite, "reference_non_finite": d.reference_non_finite,
    })
}

fn noise(z: &ZTest) -> String {
    let verdict = if z.passes(LEVEL) { "noise explains it" } else { "noise does not explain it" };
    format!(
        "noise: worst z {} of {} cells ({}, {} pixels from x {}, y {}), p {}: {verdict} at 1 %",
        number(z.worst_z, 4),
        z.cells,
        z.worst.channel,
        z.worst.pixels,
        z.worst.x,
        z.worst.y,
        number(z.p, 3),
    )
}
