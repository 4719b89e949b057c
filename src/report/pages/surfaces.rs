//! Surfaces under environments: pictures by rank, errors and times, and what the assumption
//! n = ω_o = r_v costs.

use super::gates;
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{
    Block, Cell, Figure, Inline, NoticeLevel, Page, Picture, PrintedColumn, PrintedTable, Section,
};
use crate::effect::Finding;
use crate::gate::Judgement;
use crate::numeric::measured::Measured;
use crate::render::RenderError;
use crate::render::sheet::{SURFACE_ERROR, surface_comparison};
use crate::render::surface::findings::findings;
use crate::render::surface::scene::{ReferenceMethod, SurfaceScene};
use crate::render::surface::{RenderedSurface, SurfaceApproximation};

/// A surface scene and what was rendered of it.
#[derive(Debug)]
pub struct SurfaceEvidence {
    /// The scene.
    pub scene: SurfaceScene,
    /// Its pictures and their errors.
    pub rendered: RenderedSurface,
}

/// The page of all surface scenes, with the gates on them.
///
/// # Errors
/// If a picture cannot be written as PNG.
pub fn surfaces_page(
    surfaces: &[SurfaceEvidence],
    gates: &[&Judgement],
) -> Result<Page, RenderError> {
    let mut page = Page::new(
        "surfaces",
        "Diffractive surfaces",
        "Surfaces with diffraction tables under environment maps: the whole kernel beside low-rank \
         and directional ones, by rank, error and time, and which is the cheapest that will do.",
    );
    for evidence in surfaces {
        page = page.section(section(evidence)?);
    }
    let findings: Vec<Finding> =
        surfaces.iter().flat_map(|of| findings(&of.scene, &of.rendered)).collect();
    Ok(page.section(super::findings::table_section(&findings)).section(gates::section(gates)))
}

fn section(evidence: &SurfaceEvidence) -> Result<Section, RenderError> {
    let SurfaceEvidence { scene, rendered } = evidence;
    let method = match rendered.method {
        ReferenceMethod::Full => "the convolution with the whole table under n = ω_o = r_v, f64",
        ReferenceMethod::Integral => "eq. 3 at every pixel, f64",
    };
    let environments: Vec<String> = scene
        .frames
        .iter()
        .map(|f| format!("{} (turned by {:.0}°)", f.environment, f.turn_rad.to_degrees()))
        .collect();
    let [first, second] = rendered.directions_deg;
    let [r, g, b] = rendered.albedo;
    let mut section = Section::new(scene.name.as_str())
        .paragraph(Inline::from(scene.description.clone()))
        .paragraph(format!(
            "Frames from left to right under {}; radiance times {}. Reference: {method}; \
             approximations on {}. The axes of the factors lie along {first:.2}° and {second:.2}° of \
             the table. Of a uniform environment the kernel returns {r:.3}, {g:.3}, {b:.3} in R, G, \
             B. `striae render data/scenes/{}.toml` writes these images and more.",
            environments.join(", "),
            scene.exposure,
            rendered.backend,
            scene.name
        ));
    let names: Vec<&str> = rendered.approximations.iter().map(|a| a.name.as_str()).collect();
    let sheet = surface_comparison(scene.exposure, rendered)?;
    section = section.block(Picture {
        caption: format!(
            "Left, from top to bottom: reference, {}. Right: the error of each relative to the root \
             mean square of the reference, black for 0 to pale for {SURFACE_ERROR} and above.",
            names.join(", ")
        )
        .into(),
        file_stem: format!("surface-{}", scene.name.replace('_', "-")),
        alt: format!("{}: the reference above its approximations, and their errors", scene.name),
        png: sheet.png(scene.exposure.log2())?,
    });
    section = section.block(errors(rendered));
    if let Some(choice) = &rendered.choice {
        let text = match choice {
            Ok(name) => format!("The cheapest within the limits of the scene: `{name}`."),
            Err(why) => why.clone(),
        };
        section = section.block(Block::Notice { level: NoticeLevel::Info, text: text.into() });
    }
    if let Some(figure) = frontier(scene, rendered) {
        section = section.block(figure);
    }
    Ok(section.block(angles(rendered)))
}

fn measured(value: &Measured<f64>) -> Cell {
    match value {
        Measured::Value(value) => Cell::number(*value, 3),
        Measured::NotMeasured(reason) => Cell::missing(reason.clone()),
    }
}

fn errors(rendered: &RenderedSurface) -> PrintedTable {
    let full = match &rendered.times {
        Measured::Value(times) => times.full_ms.clone(),
        Measured::NotMeasured(reason) => Measured::NotMeasured(reason.clone()),
    };
    let mut table = PrintedTable::new(
        "Approximations against the reference, over all pixels and channels. The time is that of \
         the convolution of one frame on the device; the last column is the time of the sum over \
         the whole table over it, from the same run.",
        vec![
            PrintedColumn::code("approximation"),
            PrintedColumn::text("how"),
            PrintedColumn::number("relative RMS", "1"),
            PrintedColumn::number("FLIP", "1"),
            PrintedColumn::number("mean error", "radiance"),
            PrintedColumn::number("time", "ms"),
            PrintedColumn::number("whole table, times slower", "1"),
        ],
    );
    for found in &rendered.approximations {
        let ratio = match (&found.ms, &full) {
            (Measured::Value(own), Measured::Value(full)) => Cell::number(full / own, 3),
            (Measured::NotMeasured(reason), _) | (_, Measured::NotMeasured(reason)) => {
                Cell::missing(reason.clone())
            }
        };
        table.push(vec![
            Cell::text(found.name.clone()),
            Cell::text(found.method.words()),
            Cell::number(found.metrics.relative_rms, 3),
            Cell::number(found.metrics.flip, 3),
            Cell::number(found.metrics.mean, 3),
            measured(&found.ms),
            ratio,
        ]);
    }
    table.push(vec![
        Cell::text("whole table"),
        Cell::text("sum over all cells"),
        Cell::number(0.0, 1),
        Cell::number(0.0, 1),
        Cell::number(0.0, 1),
        measured(&full),
        Cell::number(1.0, 1),
    ]);
    table
}

/// Error against time of those that were timed.
fn frontier(scene: &SurfaceScene, rendered: &RenderedSurface) -> Option<Figure> {
    let timed: Vec<(&SurfaceApproximation, f64)> = rendered
        .approximations
        .iter()
        .filter_map(|found| Some((found, *found.ms.value()?)))
        .collect();
    if timed.is_empty() {
        return None;
    }
    let plot = |title: &str, error: fn(&SurfaceApproximation) -> f64| {
        let points: Vec<(f64, f64)> = timed.iter().map(|(f, ms)| (*ms, error(f))).collect();
        let mut plot = Plot::new(
            title,
            PlotAxis::log("time of the convolution", "ms"),
            PlotAxis::log(title, "1"),
        )
        .series(Series::markers("approximations", points.iter().copied()))
        .with_frontier();
        for ((found, _), (ms, error)) in timed.iter().zip(points) {
            plot = plot.annotate(ms, error, found.name.as_str());
        }
        plot
    };
    Some(Figure::grid(
        format!("surface-{}-frontier", scene.name.replace('_', "-")),
        "Error against time; the staircase joins what no other beats in both.",
        vec![
            plot("relative RMS", |found| found.metrics.relative_rms),
            plot("FLIP", |found| found.metrics.flip),
        ],
        2,
    ))
}

fn angles(rendered: &RenderedSurface) -> PrintedTable {
    let mut table = PrintedTable::new(
        "What n = ω_o = r_v costs in the first frame: the convolution with the whole table against \
         eq. 3 at 24 azimuths per angle of incidence, on a plane.",
        vec![
            PrintedColumn::number("incidence", "°"),
            PrintedColumn::number("relative RMS", "1"),
            PrintedColumn::number("mean over that of eq. 3", "1"),
        ],
    );
    for line in &rendered.by_angle {
        table.push(vec![
            Cell::number(line.angle_deg, 3),
            Cell::number(line.relative_rms, 3),
            Cell::number(line.mean_ratio, 3),
        ]);
    }
    table
}
