//! What `compare` prints.

use std::path::Path;

use serde_json::{Value, json};

use super::compare::Metric;
use super::output::name;
use crate::document::{Block, PrintedColumn, PrintedTable, Section, number};
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

/// How a column or a channel differs, or all channels together.
struct Part {
    name: String,
    /// Unit of a column.
    unit: Option<String>,
    difference: Difference,
    /// Where the largest error is, by coordinate.
    place: Value,
}

/// What is compared of images beside their channels.
pub(super) struct Pictures {
    all: Part,
    /// FLIP, or why there is none.
    pub(super) flip: Result<Flip, String>,
    /// The noise test, if there are standard errors.
    pub(super) z: Option<ZTest>,
    /// The scale of the error map, if one was written.
    pub(super) scale: Option<f64>,
}

/// What came out of a comparison.
pub(super) struct Compared {
    /// The columns of tables, or the channels of images.
    parts: Vec<Part>,
    pictures: Option<Pictures>,
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

/// Difference of the means relative to the reference's; 0 if they are equal.
fn relative_bias(difference: &Difference) -> f64 {
    let error = (difference.mean - difference.reference_mean).abs();
    if error == 0.0 { 0.0 } else { error / difference.reference_mean.abs() }
}

impl Part {
    /// Name, and the unit that is not 1, of a column.
    fn heading(&self) -> String {
        match self.unit.as_deref() {
            None | Some("1") => self.name.clone(),
            Some(unit) => format!("{} [{unit}]", self.name),
        }
    }

    /// `row 3`, or `x 1, y 2, R`.
    fn at(&self) -> String {
        let coordinate = |(name, value): (&String, &Value)| match value.as_str() {
            Some(channel) => channel.to_owned(),
            None => format!("{name} {value}"),
        };
        let coordinates = self.place.as_object().into_iter().flatten().map(coordinate);
        coordinates.collect::<Vec<_>>().join(", ")
    }

    fn json(&self) -> Value {
        let d = &self.difference;
        json!({
            "name": self.name, "mean": d.mean, "reference_mean": d.reference_mean, "rms": d.rms,
            "relative_rms": d.relative_rms, "max": d.max, "max_at": self.place,
            "non_finite": d.non_finite, "reference_non_finite": d.reference_non_finite,
        })
    }
}

impl Compared {
    /// Of tables.
    pub(super) fn tables(columns: Vec<ColumnDifference>) -> Self {
        let part = |ColumnDifference { name, unit, difference }: ColumnDifference| {
            let place = json!({ "row": difference.max_at + 1 });
            Part { name, unit: Some(unit), difference, place }
        };
        Self { parts: columns.into_iter().map(part).collect(), pictures: None }
    }

    /// Of images.
    pub(super) fn images(
        of: &ImageDifference,
        flip: Result<Flip, String>,
        z: Option<ZTest>,
        scale: Option<f64>,
    ) -> Self {
        let part = |name: &str, difference, place| {
            let name = name.to_owned();
            Part { name, unit: None, difference, place }
        };
        let channel = |(name, difference): &(String, Difference)| {
            let (x, y) = of.pixel(difference.max_at);
            part(name, *difference, json!({ "x": x, "y": y }))
        };
        let place = of.max_place();
        let place = json!({ "x": place.x, "y": place.y, "channel": place.channel });
        let all = part("all", of.all, place);
        let parts = of.channels.iter().map(channel).collect();
        Self { parts, pictures: Some(Pictures { all, flip, z, scale }) }
    }

    /// The value of a metric, or why there is none.
    pub(super) fn metric(&self, metric: Metric) -> Result<f64, String> {
        let none = || "tables have no such metric".to_owned();
        let worse = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
        let plain = |of: fn(&Difference) -> f64| match &self.pictures {
            Some(pictures) => Ok(of(&pictures.all.difference)),
            None => {
                let values = self.parts.iter().map(|part| of(&part.difference));
                values.reduce(worse).ok_or_else(none)
            }
        };
        let pictures = || self.pictures.as_ref().ok_or_else(none);
        match metric {
            Metric::Mean => plain(relative_bias),
            Metric::Rms => plain(|difference| difference.rms),
            Metric::RelativeRms => plain(|difference| difference.relative_rms),
            Metric::Max => plain(|difference| difference.max),
            Metric::Flip => pictures()?.flip.as_ref().map(|flip| flip.value).map_err(Clone::clone),
            Metric::Z | Metric::Significance => {
                let z = pictures()?.z.as_ref().ok_or("neither image has all channels stderr.…")?;
                Ok(if metric == Metric::Z { z.worst_z.abs() } else { 1.0 - z.p })
            }
        }
    }

    /// Remarks for stderr.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for Part { name, difference, .. } in &self.parts {
            let (a, b) = (difference.non_finite, difference.reference_non_finite);
            if a + b > 0 {
                notes.push(format!("note: {name}: values that are not finite: {a} in A, {b} in B"));
            }
        }
        let Some(Pictures { flip, z, .. }) = &self.pictures else { return notes };
        let negative = flip.as_ref().map_or(0, |flip| flip.negative);
        if negative > 0 {
            notes.push(format!("note: FLIP takes {negative} negative components as 0"));
        }
        let unusable = z.as_ref().map_or(0, |z| z.unusable);
        if unusable > 0 {
            notes.push(format!("note: the noise test has {unusable} unusable values"));
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
        let Compared { parts, pictures } = self.compared;
        type Number = fn(&Difference) -> f64;
        let numbers: [(&str, Number); 5] = [
            ("mean", |of| of.mean),
            ("reference", |of| of.reference_mean),
            ("rms", |of| of.rms),
            ("relative rms", |of| of.relative_rms),
            ("max", |of| of.max),
        ];
        let caption = format!("{} against {}", self.a.display(), self.b.display());
        let all = pictures.iter().map(|pictures| &pictures.all);
        let table = PrintedTable::over(caption, parts.iter().chain(all))
            .text("", |part| part.heading())
            .columns(
                numbers,
                |(title, _)| PrintedColumn::figures(*title),
                |part, (_, number)| (number(&part.difference), 5),
            )
            .text("at", |part| part.at());
        let mut section = Section::default().block(table);
        if let Some(Pictures { flip, z, scale, .. }) = pictures {
            section = section.paragraph(match flip {
                Ok(flip) => format!("FLIP {} ({})", number(flip.value, 5), flip.conditions),
                Err(why) => format!("FLIP not defined: {why}"),
            });
            let scale = scale.map(|to| format!("error map from 0 to {to} of the reference's RMS"));
            let more = z.as_ref().map(noise).into_iter().chain(scale);
            section = section.blocks(more.map(|text| Block::Paragraph(text.into())));
        }
        self.judgements.iter().fold(section, |section, judgement| {
            let verdict = if judgement.passed() { "PASS" } else { "FAIL" };
            let (name, value) = (name(judgement.metric), number(judgement.value, 5));
            section.paragraph(format!("{verdict} {name} {value}, limit {}", judgement.limit))
        })
    }

    /// As JSON; what is NaN is null.
    pub(super) fn json(&self) -> Value {
        let judgement = |j: &Judgement| {
            let (metric, passed) = (name(j.metric), j.passed());
            json!({ "metric": metric, "value": j.value, "limit": j.limit, "passed": passed })
        };
        let mut value = json!({
            "a": self.a.display().to_string(),
            "b": self.b.display().to_string(),
            "limits": self.judgements.iter().map(judgement).collect::<Vec<_>>(),
        });
        let parts: Value = self.compared.parts.iter().map(Part::json).collect();
        let Some(Pictures { all, flip, z, scale }) = &self.compared.pictures else {
            value["columns"] = parts;
            return value;
        };
        value["channels"] = parts;
        value["all"] = all.json();
        value["flip"] = match flip {
            Ok(flip) => json!({ "mean": flip.value, "conditions": flip.conditions }),
            Err(why) => json!({ "mean": null, "conditions": why }),
        };
        let noise = |z: &ZTest| {
            json!({
                "cells": z.cells, "z": z.worst_z, "p": z.p, "passes": z.passes(LEVEL),
                "worst": z.worst,
            })
        };
        value["noise"] = z.as_ref().map_or(Value::Null, noise);
        value["error_map_scale"] = json!(scale);
        value
    }
}

fn noise(z: &ZTest) -> String {
    let verdict = if z.passes(LEVEL) { "noise explains it" } else { "noise does not explain it" };
    let worst = &z.worst;
    format!(
        "noise: worst z {} of {} cells ({}, {} pixels from x {}, y {}), p {}: {verdict} at 1 %",
        number(z.worst_z, 4),
        z.cells,
        worst.channel,
        worst.pixels,
        worst.x,
        worst.y,
        number(z.p, 3),
    )
}
