//! Scenes: reference and approximations as pictures, how they differ, what they cost, and what papers
//! say of them.

use std::sync::Arc;

use super::gates;
use crate::document::plot::{Plot, PlotAxis};
use crate::document::{
    Block, Cell, Figure, Inline, NoticeLevel, Page, PrintedTable, Raster, Section,
};
use crate::effect::Finding;
use crate::gate::Judgement;
use crate::numeric::measured::Measured;
use crate::render::claims::findings;
use crate::render::image::Image;
use crate::render::scene::{LightShape, Scene};
use crate::render::sheet::comparison;
use crate::render::view::Projection;
use crate::render::{
    PreparedScene, RenderError, Rendered, RenderedApproximation, RenderedMonteCarlo,
};

/// A scene and what was rendered of it.
#[derive(Debug)]
pub struct SceneEvidence {
    /// The scene.
    pub scene: Arc<PreparedScene>,
    /// Its pictures and their errors.
    pub rendered: Rendered,
}

/// The page of all scenes, with the gates on them.
///
/// # Errors
/// If a picture cannot be written as PNG.
pub fn scenes_page(scenes: &[SceneEvidence], gates: &[&Judgement]) -> Result<Page, RenderError> {
    let mut page = Page::new(
        "scenes",
        "Scenes",
        "Lobes of a scratch under area lights and diffractive surfaces under environments: the reference \
         beside the approximations, where they err, what they cost, which is the cheapest that will do, \
         and Monte Carlo at equal error.",
    );
    for evidence in scenes {
        page = page.section(section(&evidence.scene.scene, &evidence.rendered)?);
    }
    let findings: Vec<Finding> =
        scenes.iter().flat_map(|of| findings(&of.scene.scene, &of.rendered)).collect();
    Ok(page.section(super::findings::section(&findings)).section(gates::section(gates)))
}

fn section(scene: &Scene, rendered: &Rendered) -> Result<Section, RenderError> {
    let exposure = scene.view.exposure;
    let section = Section::new(scene.name.as_str())
        .paragraph(Inline::from(scene.description.clone()))
        .paragraph(format!(
            "{}; radiance times {exposure}. Reference: {}; approximations on {}. `striae render \
             data/scenes/{}.toml` writes these images and more.",
            seen(scene),
            rendered.method.words(),
            rendered.backend,
            scene.name
        ));
    let names: Vec<&str> =
        rendered.approximations.iter().map(|found| found.name.as_str()).collect();
    let (sheet, scale) = comparison(rendered, exposure)?;
    let beside = if rendered.monte_carlo.is_some() { ", Monte Carlo beside it" } else { "" };
    let section = section.block(Raster {
        caption: format!(
            "Left, from top to bottom: reference{beside}, {}. Right: the error of each relative to the \
             root mean square of the reference, black for 0 to pale for {scale} and above.",
            names.join(", ")
        )
        .into(),
        file_stem: format!("scene-{}", scene.name.replace('_', "-")),
        alt: format!("{}: the reference above its approximations, and their errors", scene.name),
        png: sheet.png(exposure.log2())?,
    });
    Ok(section.blocks(scene_tables(rendered)))
}

/// What the pixels of a scene show.
fn seen(scene: &Scene) -> String {
    let size = format!("{} × {}", scene.view.width, scene.view.height);
    let environment = |light: &crate::render::scene::Light| match &light.shape {
        LightShape::Environment { map, turn_rad } => {
            Some(format!("{map} (turned by {:.0}°)", turn_rad.to_degrees()))
        }
        _ => None,
    };
    match scene.view.projection {
        Projection::Equirectangular => format!(
            "Equirectangular map of view directions, {size}: azimuth 0 to 2π from left to right, polar \
             angle 0 to π/2 from top to bottom"
        ),
        Projection::Camera(_) => {
            let maps: Vec<String> = scene.lights.iter().filter_map(environment).collect();
            format!("Frames of {size} from left to right under {}", maps.join(", "))
        }
    }
}

/// Errors and times of the approximations, which is the cheapest, Monte Carlo, and what only scenes of
/// the material show.
pub fn scene_tables(rendered: &Rendered) -> Vec<Block> {
    let notice = |level, text: String| Block::Notice { level, text: text.into() };
    let mut blocks: Vec<Block> = vec![errors(rendered).into()];
    blocks.extend(negative(&rendered.reference).map(|text| notice(NoticeLevel::Info, text)));
    if let Measured::NotMeasured(reason) = &rendered.times {
        blocks.push(notice(NoticeLevel::NotMeasured, format!("Times: {reason}")));
    }
    if let Some(choice) = &rendered.choice {
        let cheapest = |name: &String| format!("cheapest within the limits of the scene: {name}");
        let text = choice.as_ref().map_or_else(Clone::clone, cheapest);
        blocks.push(notice(NoticeLevel::Info, text));
    }
    blocks.extend(frontier(rendered).map(Block::Figure));
    blocks.extend(rendered.monte_carlo.as_ref().map(monte_carlo));
    blocks.extend(rendered.details.blocks.iter().cloned());
    blocks
}

/// What of the reference FLIP cannot see: light outside the gamut of linear sRGB.
fn negative(reference: &Image) -> Option<String> {
    let values = reference.channels.iter().flat_map(|channel| &channel.values);
    let (count, below, lowest) = values.fold((0, 0, 0.0_f32), |(count, below, lowest), value| {
        (count + 1, below + usize::from(*value < 0.0), lowest.min(*value))
    });
    (below > 0).then(|| {
        format!(
            "{below} of {count} values of the reference are below 0, the lowest {lowest:.3}: colours \
             outside the gamut of linear sRGB. FLIP takes them as 0; RMS and means do not"
        )
    })
}

fn errors(rendered: &Rendered) -> PrintedTable {
    let table = PrintedTable::over(
        "Approximations against the reference, over all pixels and channels.",
        &rendered.approximations,
    )
    .code("approximation", |found| found.name.as_str())
    .code("shaded by", |found| found.method.words())
    .number("relative RMS", "1", |found| (found.metrics.relative_rms, 4))
    .number("FLIP", "1", |found| (found.metrics.flip, 4))
    .number("mean error", "radiance", |found| found.metrics.mean)
    .number("max |error|", "radiance", |found| (found.metrics.max, 4))
    .text("where", |found| {
        let ((x, y), channel) = (found.metrics.at, &found.metrics.channel);
        format!("{x}, {y} {channel}")
    });
    let Measured::Value(times) = &rendered.times else { return table.table() };
    let mut table = table.number("a frame", "ms", |found| Cell::measured(&found.frame_ms, 3));
    if times.full_ms.value().is_some() {
        table =
            table.number("in full, times slower", "1", |found| Cell::measured(&found.full_over, 3));
    }
    if rendered.monte_carlo.is_some() {
        table = table
            .number("samples at equal error", "1", |found| {
                Cell::measured(&found.equal_error.map(|equal| equal.samples), 3)
            })
            .number("Monte Carlo, times slower", "1", |found| {
                Cell::measured(&found.equal_error.map(|equal| equal.ratio), 3)
            });
    }
    table.table()
}

/// Error against time of those that were timed.
fn frontier(rendered: &Rendered) -> Option<Figure> {
    let timed: Vec<(&RenderedApproximation, f64)> = rendered
        .approximations
        .iter()
        .filter_map(|found| Some((found, *found.frame_ms.value()?)))
        .collect();
    if timed.len() < 2 {
        return None;
    }
    let plot = |title: &str, error: fn(&RenderedApproximation) -> f64| {
        let points = timed.iter().map(|(of, ms)| (of.name.as_str(), *ms, error(of)));
        let points: Vec<(&str, f64, f64)> = points.collect();
        Plot::new(title, PlotAxis::log("time of a frame", "ms"), PlotAxis::log(title, "1"))
            .with_labelled("approximations", &points)
    };
    Some(Figure::grid(
        format!("scene-{}-frontier", rendered.name.replace('_', "-")),
        "Error against time; the staircase joins what no other beats in both.",
        vec![
            plot("relative RMS", |found| found.metrics.relative_rms),
            plot("FLIP", |found| found.metrics.flip),
        ],
        2,
    ))
}

fn monte_carlo(of: &RenderedMonteCarlo) -> Block {
    let law = match &of.convergence {
        Measured::Value(law) => law,
        Measured::NotMeasured(reason) => {
            let text = format!("Monte Carlo at equal error: {reason}").into();
            return Block::Notice { level: NoticeLevel::NotMeasured, text };
        }
    };
    let test = of.metrics.as_ref().and_then(|metrics| metrics.z_test.as_ref());
    let tested = |value: Option<f64>| Cell::number_or(value, 3, "no standard error");
    PrintedTable::of_rows(
        "Monte Carlo against the reference: its error at two numbers of samples, the exponent between \
         them (−1/2 by theory), and a z-test of the larger run against its own standard error.",
        [
            ("samples", "1"),
            ("RMS", "radiance"),
            ("samples", "1"),
            ("RMS", "radiance"),
            ("exponent", "1"),
            ("cells tested", "1"),
            ("worst z", "1"),
            ("p, corrected", "1"),
        ],
        [vec![
            Cell::count(law.samples[0] as usize),
            Cell::number(law.rms[0], 4),
            Cell::count(law.samples[1] as usize),
            Cell::number(law.rms[1], 4),
            Cell::number(law.exponent, 3),
            test.map_or_else(|| tested(None), |test| Cell::count(test.cells)),
            tested(test.map(|test| test.worst_z)),
            tested(test.map(|test| test.p)),
        ]],
    )
    .into()
}
