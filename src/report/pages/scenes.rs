//! Scenes: reference and approximations as pictures, how they differ, what they cost.

use super::gates;
use crate::document::{
    Block, Cell, Inline, NoticeLevel, Page, Picture, PrintedColumn, PrintedTable, Section,
};
use crate::effect::Finding;
use crate::gate::Judgement;
use crate::numeric::measured::Measured;
use crate::render::findings::findings;
use crate::render::scene::ReferenceMethod;
use crate::render::sheet::comparison;
use crate::render::{RenderError, RenderedScene, Scene};

/// A scene and what was rendered of it.
#[derive(Debug)]
pub struct SceneEvidence {
    /// The scene.
    pub scene: Scene,
    /// Its pictures and their errors.
    pub rendered: RenderedScene,
}

/// The page of all scenes, with the gates on them.
///
/// # Errors
/// If a picture cannot be written as PNG.
pub fn scenes_page(scenes: &[SceneEvidence], gates: &[&Judgement]) -> Result<Page, RenderError> {
    let mut page = Page::new(
        "scenes",
        "Scenes",
        "Lobes of a scratch under area lights: the semi-analytic reference beside the published \
         form and ours, where they err, what they cost, and Monte Carlo at equal error.",
    );
    for evidence in scenes {
        page = page.section(section(evidence)?);
    }
    let findings: Vec<Finding> =
        scenes.iter().flat_map(|of| findings(&of.scene, &of.rendered)).collect();
    Ok(page.section(super::findings::table_section(&findings)).section(gates::section(gates)))
}

fn section(evidence: &SceneEvidence) -> Result<Section, RenderError> {
    let SceneEvidence { scene, rendered } = evidence;
    let view = &scene.view;
    let method = match rendered.method {
        ReferenceMethod::Quadrature => "quadrature (semi-analytic, f64)",
        ReferenceMethod::MonteCarlo => "Monte Carlo",
    };
    let mut section = Section::new(scene.name.as_str())
        .paragraph(Inline::from(scene.description.clone()))
        .paragraph(format!(
            "Equirectangular map of view directions, {} × {}: azimuth 0 to 2π from left to right, \
             polar angle 0 to π/2 from top to bottom; radiance times {}. Reference by {method}; \
             approximations on {}. `striae render data/scenes/{}.toml` writes these images and more.",
            view.width, view.height, view.exposure, rendered.backend, scene.name
        ));
    let names: Vec<&str> =
        rendered.approximations.iter().map(|found| found.name.as_str()).collect();
    let (sheet, scale) = comparison(scene, rendered)?;
    let caption = format!(
        "Above, from left to right: reference, {0}. Below: {1}, then the error of each \
         ({0}) relative to the root mean square of the reference, black for 0 to pale for {scale}.",
        names.join(", "),
        if rendered.monte_carlo.is_some() { "Monte Carlo" } else { "nothing" },
    );
    section = section.block(Picture {
        caption: caption.into(),
        file_stem: format!("scene-{}", scene.name.replace('_', "-")),
        alt: format!("{}: the reference beside its approximations, and their errors", scene.name),
        png: sheet.png(view.exposure.log2())?,
    });
    section = section.block(errors(evidence));
    Ok(section.block(monte_carlo(rendered)))
}

fn errors(evidence: &SceneEvidence) -> PrintedTable {
    let SceneEvidence { scene, rendered } = evidence;
    let pixels = (scene.view.width * scene.view.height) as f64;
    let mut table = PrintedTable::new(
        "Approximations against the reference, over all pixels and channels. The time is that of the \
         kernels on the device for the whole image. Monte Carlo at equal error: its time over that \
         of the approximation when its RMS error is the same.",
        vec![
            PrintedColumn::code("approximation"),
            PrintedColumn::code("shaded by"),
            PrintedColumn::number("relative RMS", "1"),
            PrintedColumn::number("FLIP", "1"),
            PrintedColumn::number("max |error|", "radiance"),
            PrintedColumn::text("where (x, y, channel)"),
            PrintedColumn::number("time", "ms"),
            PrintedColumn::number("samples at equal error", "1"),
            PrintedColumn::number("Monte Carlo, times slower", "1"),
        ],
    );
    for found in &rendered.approximations {
        let (metrics, at) = (&found.metrics, &found.metrics.at);
        let measured = |value: Measured<f64>| match value {
            Measured::Value(value) => Cell::number(value, 3),
            Measured::NotMeasured(reason) => Cell::missing(reason),
        };
        table.push(vec![
            Cell::text(found.name.clone()),
            Cell::text(found.shaded_by.join(", ")),
            Cell::number(metrics.relative_rms, 3),
            Cell::number(metrics.flip, 3),
            Cell::number(metrics.max, 3),
            Cell::text(format!("{}, {}, {}", at.x, at.y, at.channel)),
            measured(found.pixel_ns.map(|ns| ns * pixels * 1e-6)),
            measured(found.equal_error.map(|equal| equal.samples)),
            measured(found.equal_error.map(|equal| equal.ratio)),
        ]);
    }
    table
}

fn monte_carlo(rendered: &RenderedScene) -> Block {
    let law = match &rendered.convergence {
        Measured::Value(law) => law,
        Measured::NotMeasured(reason) => {
            let text = format!("Monte Carlo at equal error: {reason}").into();
            return Block::Notice { level: NoticeLevel::NotMeasured, text };
        }
    };
    let mut table = PrintedTable::new(
        "Monte Carlo over the lights against the semi-analytic reference: its error at two numbers \
         of samples, the exponent between them (−1/2 by theory), and a z-test of the larger run \
         against its own standard error.",
        vec![
            PrintedColumn::number("samples", "1"),
            PrintedColumn::number("RMS", "radiance"),
            PrintedColumn::number("samples", "1"),
            PrintedColumn::number("RMS", "radiance"),
            PrintedColumn::number("exponent", "1"),
            PrintedColumn::number("cells tested", "1"),
            PrintedColumn::number("worst z", "1"),
            PrintedColumn::number("p, corrected", "1"),
        ],
    );
    let test = rendered.monte_carlo_metrics.as_ref().and_then(|metrics| metrics.z_test.as_ref());
    let tested = |value: Option<f64>| Cell::number_or(value, 3, "no standard error");
    table.push(vec![
        Cell::count(law.samples[0] as usize),
        Cell::number(law.rms[0], 3),
        Cell::count(law.samples[1] as usize),
        Cell::number(law.rms[1], 3),
        Cell::number(law.exponent, 3),
        test.map_or_else(|| tested(None), |test| Cell::count(test.cells)),
        tested(test.map(|test| test.worst_z)),
        tested(test.map(|test| test.p)),
    ]);
    table.into()
}
