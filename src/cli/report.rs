//! `report`: measures everything and writes the report.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Ending;
use super::check;
use super::context::Context;
use super::output::line;
use super::progress;
use super::studies::{self, Results};
use crate::document::{Colophon, Page};
use crate::gate::{Check, Judgement, SCENES};
use crate::gpu::Device;
use crate::numeric::measured::Measured;
use crate::registry::EFFECTS;
use crate::report::html::{Written, write_site};
use crate::report::pages::{Evidence, effect_page, index_page, scenes_page, surfaces_page};

const MORE: &str = "\
Writes index.html and a page per effect (self-contained, no network), report.json, report.txt and
figures/*.svg, figures/*.png.

Example:
  striae report -o /tmp/report";

/// Measure every effect and write the report
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Folder of the report [default: reports in the project]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Measures, writes, and says where.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let folder = match &arguments.output {
        Some(folder) => folder.clone(),
        None => context.project()?.reports(),
    };
    let device = studies::device()?;
    let check = check::check(context, None, false)?;
    let written = write(&folder, &check, &device, context)?;
    context.output.sections(&serde_json::json!({ "files": written.files }), || {
        line(format!("{} files in {}", written.files.len(), folder.display()))
    })?;
    Ok(Ending::Done)
}

/// Measures every effect and writes the report with the verdicts of `check`.
pub(super) fn write(
    folder: &Path,
    check: &Check,
    device: &Measured<Device>,
    context: &Context,
) -> anyhow::Result<Written> {
    let project = context.project()?;
    let results = Results::read(project)?;
    let bar = progress::bar(context.output, EFFECTS.len() + 1);
    let mut studied = Vec::new();
    for effect in EFFECTS {
        bar.set_message(format!("measuring {}", effect.name));
        studied.push(studies::measure(effect, &results, device, context)?);
        bar.inc(1);
    }
    let (scenes, surfaces) = studies::scenes(device, context)?;
    bar.set_message("writing the report");
    let gates: Vec<&Judgement> = check.gates.iter().collect();
    let of: Vec<Vec<&Judgement>> = studied
        .iter()
        .map(|studied| {
            let prefix = format!("{}/", studied.effect.name);
            gates.iter().copied().filter(|of| of.gate.subject.starts_with(&prefix)).collect()
        })
        .collect();
    let evidence: Vec<Evidence<'_>> = studied
        .iter()
        .zip(&of)
        .map(|(studied, gates)| Evidence {
            effect: studied.effect,
            study: &studied.study,
            costs: &studied.costs,
            families: &studied.families,
            members: &studied.members,
            gates,
            root: project.root(),
        })
        .collect();
    let mut pages = vec![index_page(&evidence, &gates)];
    pages.extend(evidence.iter().map(effect_page).collect::<Result<Vec<Page>, _>>()?);
    let of_scenes = |names: Vec<&str>| -> Vec<&Judgement> {
        let named = |of: &&Judgement| {
            let rest = of.gate.subject.strip_prefix(SCENES).unwrap_or_default();
            names.contains(&rest.split('#').next().unwrap_or_default())
        };
        gates.iter().copied().filter(named).collect()
    };
    if !scenes.is_empty() {
        let names = scenes.iter().map(|of| of.scene.name.as_str()).collect();
        pages.push(scenes_page(&scenes, &of_scenes(names))?);
    }
    if !surfaces.is_empty() {
        let names = surfaces.iter().map(|of| of.scene.name.as_str()).collect();
        pages.push(surfaces_page(&surfaces, &of_scenes(names))?);
    }
    let provenance = Colophon {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        adapter: device.value().map(|device| device.description().to_string()),
        command: "striae report".to_owned(),
        facts: Vec::new(),
    };
    let written = write_site(folder, &pages, &provenance)?;
    bar.finish_and_clear();
    Ok(written)
}
