//! `simulate`: a table from the physics of an effect.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::Args;
use serde_json::json;

use super::Ending;
use super::context::Context;
use crate::document::{self, Block, Section, number};
use crate::effect::simulator::{Settings, Simulator};
use crate::measured::spectra::Spectra;
use crate::render::image::Image;
use crate::table::Grid;

const MORE: &str = "\
`striae simulate NAME --help-settings` lists the settings with their units and defaults.

The table is written as EXR, with its axes in FILE.exr.axes.toml, or as CSV with a row per texel.
The picture shows the largest channel of each texel over four decades below the largest texel, in
the colour of the texel; what is printed says how bright white is.

Examples:
  striae simulate diffraction -o disc.exr --png disc.png
  striae simulate diffraction --set surface=phone --set size=513 -o phone.exr
  striae simulate diffraction --set heightmap=stamper.f32 --set illuminant=a -o stamper.exr
  striae simulate diffraction --set pattern=pattern.png --set wavelength_nm=532 \\
    --set pattern_extent=0.3 -o pattern.exr";

/// Decades below the brightest texel that the picture shows.
const DECADES: f64 = 4.0;

/// Make a table from the physics of an effect
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Simulator
    name: String,
    /// Setting; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Table to write, .exr or .csv
    #[arg(long, short, value_name = "FILE", required_unless_present = "help_settings")]
    output: Option<PathBuf>,
    /// Picture of the table to write
    #[arg(long, value_name = "PNG")]
    png: Option<PathBuf>,
    /// List the settings and stop
    #[arg(long)]
    help_settings: bool,
}

/// Simulates, writes and prints.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let project = context.project_or_here();
    let Some((_, simulator)) = project.registry().simulator(&arguments.name) else {
        let known: Vec<&str> = project.registry().simulators().map(|s| s.name).collect();
        bail!("no simulator is called `{}`; there are: {}", arguments.name, known.join(", "));
    };
    if arguments.help_settings {
        return list_settings(simulator, context);
    }
    let Some(output) = &arguments.output else { bail!("--output is missing") };
    let write: fn(&Grid, &Path) -> anyhow::Result<()> = match extension(output).as_str() {
        "exr" => |grid, path| Ok(grid.write_exr(path)?),
        "csv" => |grid, path| Ok(grid.to_table().write_csv(path, &[])?),
        _ => bail!("{}: expected a name that ends in .exr or .csv", output.display()),
    };
    if let Some(png) = &arguments.png
        && extension(png) != "png"
    {
        bail!("{}: expected a name that ends in .png", png.display());
    }
    let mut assignments = arguments.set.clone();
    let seeded = assignments.iter().any(|text| text.trim_start().starts_with("seed"));
    if let Some(seed) = context.seed.filter(|_| !seeded) {
        assignments.push(format!("seed={seed}"));
    }
    let settings = Settings::parse(simulator.parameters, &assignments)?;
    let mut simulation = (simulator.run)(&settings, &Spectra::built_in()?)?;
    write(&simulation.grid, output)?;
    if let Some(png) = &arguments.png {
        let (picture, white) = picture(&simulation.grid);
        picture.write_png(png, 0.0)?;
        simulation.notes.push(format!(
            "{}: white is {} sr^-1, black {DECADES} decades below",
            png.display(),
            number(white, 3)
        ));
    }
    let result = json!({
        "output": output,
        "origin": simulation.grid.origin,
        "notes": simulation.notes,
        "tables": simulation.tables,
    });
    context.output.sections(&result, || {
        let notes = simulation.notes.iter().map(|note| Block::Paragraph(note.as_str().into()));
        let tables = simulation.tables.iter().cloned();
        vec![Section::default().blocks(notes).blocks(tables)]
    })
}

fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

fn list_settings(simulator: &Simulator, context: &Context) -> anyhow::Result<Ending> {
    context.output.sections(&simulator.parameters, || {
        let table = document::PrintedTable::over("", simulator.parameters)
            .text("setting", |of| of.name)
            .text("unit", |of| of.unit)
            .text("default", |of| of.default)
            .text("description", |of| of.description);
        vec![Section::default().block(table)]
    })
}

/// The table in false brightness, and the value that is white.
fn picture(grid: &Grid) -> (Image, f64) {
    let channels: Vec<&[f32]> = grid.channels.iter().map(|c| c.values.as_slice()).collect();
    let texel = |i: usize| -> [f64; 3] {
        let at = |channel: &[f32]| channel.get(i).map_or(0.0, |v| f64::from(*v));
        match channels.as_slice() {
            [r, g, b] if grid.channel("R").is_some() => [at(r), at(g), at(b)],
            all => [all.iter().map(|c| at(c)).sum::<f64>() / all.len().max(1) as f64; 3],
        }
    };
    let texels = grid.texels();
    let brightness = |colour: [f64; 3]| colour.into_iter().fold(0.0, f64::max);
    let white = (0..texels).map(|i| brightness(texel(i))).fold(f64::MIN_POSITIVE, f64::max);
    let shown = |i: usize| {
        let colour = texel(i);
        let largest = brightness(colour).max(f64::MIN_POSITIVE);
        let grey = (1.0 + (largest / white).log10() / DECADES).max(0.0);
        // Equal ratios in equal steps of the encoded value.
        colour.map(|c| (c.max(0.0) / largest * grey.powf(2.2)) as f32)
    };
    let colours: Vec<[f32; 3]> = (0..texels).map(shown).collect();
    (Image::rgb(grid.x().count, grid.y().count, &colours), white)
}
