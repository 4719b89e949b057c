//! `render`: a scene, by the reference and by each approximation.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::{Args, ValueEnum};
use indicatif::ProgressBar;
use serde::Serialize;

use super::Ending;
use super::context::Context;
use crate::document::Section;
use crate::gpu::{self, Device, NoDevice};
use crate::numeric::measured::Measured;
use crate::render::image::Image;
use crate::render::scene::{FIGURES, SHEET};
use crate::render::sheet::comparison;
use crate::render::view::View;
use crate::render::{Backend, Event, PreparedScene, Rendered, Scene, render};
use crate::report::pages::scene_tables;
use crate::table::store::atomic_write;

const MORE: &str = "\
Writes into DIR: reference, monte_carlo where the scene asks for it, one image per approximation
(NAME.exr linear f32, NAME.png exposed), where it errs (NAME.error.png, relative to the root mean
square of the reference, with its scale, and NAME.error.exr), all of them beside each other
(sheet.png: reference and approximations in the order of the scene; right, Monte Carlo and the
errors), and scene.json.

Exit code 1 if an approximation is over the budget of the scene.

Example:
  striae render data/scenes/lobe_sphere.toml -o lobe_sphere";

/// Render a scene: reference, approximations, errors
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// The scene
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Folder to write to, made if it is not there [default: the scene's name]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Where the forms run [default: the GPU if there is one]
    #[arg(long, value_enum)]
    backend: Option<BackendName>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BackendName {
    /// On the device; exit code 4 if there is none
    Gpu,
    /// On f32 lanes
    Cpu,
}

/// Renders, writes and prints.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let mut scene = Scene::read(&arguments.scene)?;
    if let (Some(options), Some(seed)) = (&mut scene.monte_carlo, context.seed) {
        options.seed = seed;
    }
    let project = context.project()?;
    let device = device(arguments.backend, context)?;
    let backend = device.as_ref().map_or(Backend::Lanes, Backend::Device);
    let prepared = PreparedScene::new(scene, project)?;
    let scene = &prepared.scene;
    let folder = arguments.output.clone().unwrap_or_else(|| PathBuf::from(&scene.name));
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;

    let (exposure, bar) = (scene.view.exposure, context.output.bar(0));
    let mut keeper = Keeper { folder: &folder, exposure, bar, failed: None };
    let rendered = render(&prepared, backend, &mut |event| keeper.see(event));
    keeper.bar.finish_and_clear();
    keeper.failed.map_or(Ok(()), Err)?;
    let rendered = rendered.with_context(|| {
        format!("{}: what is finished is kept in {}", scene.name, folder.display())
    })?;
    write_comparison(&rendered, exposure, &folder)?;
    let summary = Summary::new(scene, &rendered);
    let json = serde_json::to_string_pretty(&summary)?;
    atomic_write(&folder.join(format!("{FIGURES}.json")), format!("{json}\n").as_bytes())?;
    context.output.sections(&summary, || vec![section(scene, &rendered)])?;
    let mut over = rendered.approximations.iter().flat_map(|found| &found.over_budget).peekable();
    let within = over.peek().is_none();
    over.for_each(|line| context.output.note(line));
    Ok(if within { Ending::Done } else { Ending::GateFailed })
}

/// What is printed.
fn section(scene: &Scene, rendered: &Rendered) -> Section {
    let View { width, height, .. } = scene.view;
    let frames = match scene.frames() {
        1 => "One frame".to_owned(),
        frames => format!("{frames} frames"),
    };
    let text = format!(
        "{frames} of {width} × {height}. Reference: {}; approximations on {}.",
        rendered.method.words(),
        rendered.backend
    );
    Section::new(scene.name.as_str()).paragraph(text).blocks(scene_tables(rendered))
}

/// The device, or none where the lanes are to be used.
fn device(wanted: Option<BackendName>, context: &Context) -> Result<Option<Device>, NoDevice> {
    match wanted {
        Some(BackendName::Cpu) => Ok(None),
        Some(BackendName::Gpu) => Device::open().map(Some),
        None => match Device::open() {
            Ok(device) => Ok(Some(device)),
            Err(error) if gpu::required() => Err(error),
            Err(error) => {
                context.output.note(&format!("note: rendering on CPU lanes: {error}"));
                Ok(None)
            }
        },
    }
}

/// What goes to `scene.json`.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    description: &'a str,
    width: usize,
    height: usize,
    exposure: f64,
    frames: Vec<&'a str>,
    #[serde(flatten)]
    rendered: &'a Rendered,
    timings: Measured<PerPixel>,
}

/// ns per pixel of the view.
#[derive(Debug, Serialize)]
struct PerPixel {
    device: String,
    approximations_ns: Vec<Measured<f64>>,
    sample_ns: Measured<f64>,
}

impl<'a> Summary<'a> {
    fn new(scene: &'a Scene, rendered: &'a Rendered) -> Self {
        let per_pixel = |ms: &Measured<f64>| ms.map(|ms| ms * 1e6 / scene.view.pixels() as f64);
        Self {
            description: &scene.description,
            width: scene.view.width,
            height: scene.view.height,
            exposure: scene.view.exposure,
            frames: scene.environments().collect(),
            timings: rendered.times.map(|times| PerPixel {
                device: times.device.clone(),
                approximations_ns: times.approximations_ms.iter().map(per_pixel).collect(),
                sample_ns: per_pixel(&times.sample_ms),
            }),
            rendered,
        }
    }
}

/// Writes images as they are finished and moves the progress bar.
struct Keeper<'a> {
    folder: &'a Path,
    exposure: f64,
    bar: ProgressBar,
    /// The first error of writing, if there was one.
    failed: Option<anyhow::Error>,
}

impl Keeper<'_> {
    fn see(&mut self, event: Event<'_>) {
        match event {
            Event::Tile { name, done, of } => {
                self.bar.set_length(of as u64);
                self.bar.set_position(done as u64);
                self.bar.set_message(name.to_owned());
            }
            Event::Image { name, image, whole } => {
                let name = if whole { name.to_owned() } else { format!("{name}.partial") };
                let written = self.write(&name, image);
                if self.failed.is_none() {
                    self.failed = written.err();
                }
            }
        }
    }

    fn write(&self, name: &str, image: &Image) -> anyhow::Result<()> {
        image.write_exr(self.folder.join(format!("{name}.exr")))?;
        image.write_png(self.folder.join(format!("{name}.png")), self.exposure.log2())?;
        Ok(())
    }
}

/// Error maps, and the contact sheet.
fn write_comparison(rendered: &Rendered, exposure: f64, folder: &Path) -> anyhow::Result<()> {
    for approximation in &rendered.approximations {
        let file = |extension| folder.join(format!("{}.error.{extension}", approximation.name));
        approximation.error.write_png(file("png"), true)?;
        approximation.error.image().write_exr(file("exr"))?;
    }
    let (sheet, _) = comparison(rendered, exposure)?;
    sheet.write_png(folder.join(format!("{SHEET}.png")), exposure.log2())?;
    Ok(())
}
