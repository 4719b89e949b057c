//! `import`: a file of an outside format as a table.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::Ending;
use super::context::Context;
use crate::measured;

const MORE: &str = "\
Formats: refractiveindex.info YAML (.yml, .yaml; tabulated n, k and nk, formulas 1 to 9) and CSV
(.csv, read strictly and written in one shape). What the file says of its origin stands as comments
above the table.

Example:
  striae import Johnson.yml -o data/measured/optical_constants/Au_Johnson.csv";

/// Turn a file of an outside format into a table
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// File to read
    file: PathBuf,
    /// Table to write
    #[arg(long, short, value_name = "CSV")]
    output: PathBuf,
}

/// Reads, writes, and says what was found.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let imported = measured::import(&arguments.file)?;
    imported.write_csv(&arguments.output)?;
    let (table, output) = (&imported.table, arguments.output.display());
    let columns: Vec<String> =
        table.columns.iter().map(|column| format!("{} [{}]", column.name, column.unit)).collect();
    let summary = json!({
        "format": imported.format,
        "rows": table.rows(),
        "columns": columns,
        "output": output.to_string(),
    });
    context.output.result(&summary, || {
        let (format, rows) = (imported.format, table.rows());
        format!("{output}: {rows} rows of {} from {format}\n", columns.join(", "))
    })?;
    Ok(Ending::Done)
}
