//! `render` of a surface scene: what is written and printed.

use std::path::Path;

use serde::Serialize;

use super::Ending;
use super::context::Context;
use super::output::{significant, table};
use crate::numeric::measured::Measured;
use crate::render::scene::{FIGURES, SHEET};
use crate::render::sheet::surface_comparison;
use crate::render::surface::scene::{Method, ReferenceMethod, SurfaceScene};
use crate::render::surface::{AngleError, ConvolutionTimes, RenderedSurface};
use crate::table::store::atomic_write;

/// What goes to `scene.json` and, as a table, to stdout.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    scene: &'a str,
    description: &'a str,
    frames: Vec<&'a str>,
    reference: ReferenceMethod,
    backend: &'a str,
    albedo: [f64; 3],
    directions_deg: [f64; 2],
    approximations: Vec<Line<'a>>,
    times: &'a Measured<ConvolutionTimes>,
    cheapest_within_limits: Option<&'a Result<String, String>>,
    by_incidence_angle: &'a [AngleError],
}

#[derive(Debug, Serialize)]
struct Line<'a> {
    name: &'a str,
    method: Method,
    relative_rms: f64,
    flip: f64,
    max: f64,
    mean: f64,
    frame_ms: &'a Measured<f64>,
    over_budget: Vec<String>,
}

/// Error maps, the sheet, the figures; prints the table.
pub(super) fn finish(
    scene: &SurfaceScene,
    rendered: &RenderedSurface,
    folder: &Path,
    context: &Context,
) -> anyhow::Result<Ending> {
    for found in &rendered.approximations {
        let file = |extension| folder.join(format!("{}.error.{extension}", found.name));
        found.error.write_png(file("png"), true)?;
        found.error.image().write_exr(file("exr"))?;
    }
    let sheet = surface_comparison(scene.exposure, rendered)?;
    sheet.write_png(folder.join(format!("{SHEET}.png")), scene.exposure.log2())?;
    let lines = rendered.approximations.iter().map(|found| Line {
        name: &found.name,
        method: found.method,
        relative_rms: found.metrics.relative_rms,
        flip: found.metrics.flip,
        max: found.metrics.max,
        mean: found.metrics.mean,
        frame_ms: &found.ms,
        over_budget: found.over_budget(),
    });
    let summary = Summary {
        scene: &scene.name,
        description: &scene.description,
        frames: scene.frames.iter().map(|frame| frame.environment.as_str()).collect(),
        reference: rendered.method,
        backend: &rendered.backend,
        albedo: rendered.albedo,
        directions_deg: rendered.directions_deg,
        approximations: lines.collect(),
        times: &rendered.times,
        cheapest_within_limits: rendered.choice.as_ref(),
        by_incidence_angle: &rendered.by_angle,
    };
    let json = serde_json::to_string_pretty(&summary)?;
    atomic_write(&folder.join(format!("{FIGURES}.json")), format!("{json}\n").as_bytes())?;
    context.output.result(&summary, || text(scene, rendered))?;
    let over: Vec<String> =
        summary.approximations.iter().flat_map(|line| line.over_budget.clone()).collect();
    over.iter().for_each(|line| context.output.note(line));
    Ok(if over.is_empty() { Ending::Done } else { Ending::GateFailed })
}

fn text(scene: &SurfaceScene, rendered: &RenderedSurface) -> String {
    let camera = &scene.camera;
    let mut text = format!(
        "{} ({} frames of {} x {}), reference: {}, on {}\n",
        scene.name,
        scene.frames.len(),
        camera.width,
        camera.height,
        match rendered.method {
            ReferenceMethod::Full => "the whole kernel under n = view = mirror direction",
            ReferenceMethod::Integral => "eq. 3 at every pixel",
        },
        rendered.backend
    );
    let full = match &rendered.times {
        Measured::Value(times) => times.full_ms.value().copied(),
        Measured::NotMeasured(_) => None,
    };
    let shown = |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 3));
    let header =
        ["approximation", "how", "relative RMS", "FLIP", "max", "ms per frame", "whole table / it"];
    let mut rows: Vec<Vec<String>> = rendered
        .approximations
        .iter()
        .map(|found| {
            let ms = found.ms.value().copied();
            vec![
                found.name.clone(),
                found.method.words(),
                significant(found.metrics.relative_rms, 4),
                significant(found.metrics.flip, 4),
                significant(found.metrics.max, 4),
                shown(ms),
                shown(ms.zip(full).map(|(ms, full)| full / ms)),
            ]
        })
        .collect();
    let blank = || "0".to_owned();
    rows.push(vec![
        "whole table".into(),
        "sum over all cells".into(),
        blank(),
        blank(),
        blank(),
        shown(full),
        shown(full.map(|_| 1.0)),
    ]);
    text += &table(&header, rows);
    match &rendered.choice {
        Some(Ok(name)) => text += &format!("cheapest within the limits of the scene: {name}\n"),
        Some(Err(why)) => text += &format!("{why}\n"),
        None => {}
    }
    text += "n = view = mirror direction, against eq. 3, by incidence in the first frame:\n";
    let rows = rendered.by_angle.iter().map(|line| {
        vec![
            format!("{:.0}", line.angle_deg),
            significant(line.relative_rms, 3),
            significant(line.mean_ratio, 3),
        ]
    });
    text + &table(&["incidence, deg", "relative RMS", "mean / mean of eq. 3"], rows.collect())
}
