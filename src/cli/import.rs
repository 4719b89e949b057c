//! `import`: a file of an outside format as a table, a grid or an environment map.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use serde_json::{Map, Value, json};

use super::Ending;
use super::context::Context;
use super::output::line;
use crate::measured::{self, Content, Negative};

const MORE: &str = "\
Formats, to CSV: refractiveindex.info YAML (.yml, .yaml; tabulated n, k and nk, formulas 1 to 9) and
CSV (.csv, read strictly and written in one shape). What the file says of its origin stands as
comments above the table.
To EXR: environment maps in latitude-longitude format (.hdr, .exr; written as halves where they
fit) and height maps (.f32 with a .json sidecar of nx, ny, dx_um, dy_um, heights in nm; .exr with
its sidecar of axes), which get a sidecar of axes.

Examples:
  striae import Johnson.yml -o data/measured/optical_constants/Au_Johnson.csv
  striae import hall.hdr --width 128 -o hall.exr
  striae import grooves.f32 -o grooves.exr";

/// Turn a file of an outside format into a table, a grid or an environment map
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// File to read
    file: PathBuf,
    /// File to write
    #[arg(long, short, value_name = "CSV|EXR")]
    output: PathBuf,
    /// Texels around of an environment map: an even number, half of which are its rows
    #[arg(long, value_name = "N")]
    width: Option<usize>,
    /// Take negative values of an environment map, which lossy packing leaves, as 0
    #[arg(long)]
    negative_as_black: bool,
}

/// Reads, writes, and says what was found.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let negative = if arguments.negative_as_black { Negative::Black } else { Negative::Refused };
    let mut imported = measured::import(&arguments.file, negative)?;
    let is_map = matches!(imported.content, Content::Environment(_));
    if !is_map && (arguments.width.is_some() || arguments.negative_as_black) {
        let (file, what) = (arguments.file.display(), imported.content.name());
        bail!("--width and --negative-as-black are for environment maps, and {file} is {what}");
    }
    if let (Content::Environment(map), Some(width)) = (&imported.content, arguments.width) {
        imported.content = Content::Environment(map.resized(width)?);
    }
    imported.write(&arguments.output)?;
    let output = arguments.output.display().to_string();
    let (facts, text) = described(&imported.content);
    let mut summary = Map::new();
    summary.insert("format".into(), imported.format.into());
    if let Value::Object(facts) = facts {
        summary.extend(facts);
    }
    summary.insert("output".into(), output.clone().into());
    if arguments.negative_as_black {
        imported.notes.iter().for_each(|note| context.output.note(note));
    }
    context.output.sections(&summary, || line(format!("{output}: {text} from {}", imported.format)))
}

/// What was imported, for machines and for people.
fn described(content: &Content) -> (Value, String) {
    match content {
        Content::Table(table) => {
            let column = |c: &crate::table::Column| format!("{} [{}]", c.name, c.unit);
            let columns: Vec<String> = table.columns.iter().map(column).collect();
            let text = format!("{} rows of {}", table.rows(), columns.join(", "));
            (json!({ "rows": table.rows(), "columns": columns }), text)
        }
        Content::HeightMap(map) => {
            let ([x, y], [low, high]) = (map.size_um(), map.range_nm().unwrap_or([f64::NAN; 2]));
            let valid = map.valid_fraction();
            let facts = json!({
                "nx": map.nx,
                "ny": map.ny,
                "dx_um": map.dx_um,
                "dy_um": map.dy_um,
                "lowest_nm": low,
                "highest_nm": high,
                "valid_fraction": valid,
            });
            let text = format!(
                "{} × {} heights over {x:.4} × {y:.4} µm, {low:.4} to {high:.4} nm, {:.2} % valid,",
                map.nx,
                map.ny,
                100.0 * valid
            );
            (facts, text)
        }
        Content::Environment(map) => {
            let (mean, contrast) = (map.mean(), map.contrast());
            let facts = json!({
                "width": map.width,
                "height": map.height,
                "mean": mean,
                "contrast": contrast,
            });
            let [r, g, b] = mean;
            let text = format!(
                "{} × {} texels, mean radiance {r:.4} {g:.4} {b:.4}, largest luminance {contrast:.1} \
                 times the mean,",
                map.width, map.height
            );
            (facts, text)
        }
    }
}
