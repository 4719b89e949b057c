//! What `factor` prints and writes about errors.

use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use crate::document::{Block, Cell, PrintedColumn, PrintedTable, Section, number};
use crate::factor::{Directional, MainDirections, SingularSpectrum};
use crate::table::{Grid, shortest_number};

/// One method at one rank in one channel.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) method: String,
    pub(super) rank: usize,
    pub(super) channel: String,
    /// ‖S − Ŝ‖/‖S‖.
    pub(super) relative_error: f64,
    /// The same after convolution, where there are environments.
    #[serde(rename = "error_after_convolution")]
    pub(super) after_convolution: Option<f64>,
    /// Of all channels together.
    pub(super) ms: f64,
}

/// Kernels along lines, in short.
pub(super) struct Lines {
    pub(super) all: Directional,
    pub(super) half_width: f64,
}

/// Everything there is to say.
pub(super) struct Factored<'a> {
    pub(super) table: &'a Grid,
    pub(super) spectra: Vec<&'a SingularSpectrum>,
    pub(super) directions: Option<&'a MainDirections>,
    pub(super) aligned: bool,
    pub(super) rows: &'a [Row],
    pub(super) lines: Option<Lines>,
    pub(super) folder: &'a Path,
}

impl Factored<'_> {
    /// `errors.csv`.
    pub(super) fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = "method rank channel relative_error error_after_convolution ms";
        writer.write_record(header.split(' '))?;
        for row in self.rows {
            writer.write_record([
                &row.method,
                &row.rank.to_string(),
                &row.channel,
                &shortest_number(row.relative_error),
                &row.after_convolution.map_or(String::new(), shortest_number),
                &number(row.ms, 4),
            ])?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }

    /// For a reader.
    pub(super) fn section(&self) -> Section {
        let (nx, ny) = (self.table.x().count, self.table.y().count);
        let mut section =
            Section::default().paragraph(format!("{nx} × {ny} texels, {}", self.folder.display()));
        if let Some(found) = self.directions {
            let [x, y] = found.angles_rad.map(|angle| number(angle.to_degrees(), 5));
            let [before, _, after] = found.beyond_rank_one.map(|part| number(100.0 * part, 3));
            let done = if self.aligned { "straightened" } else { "not straightened" };
            section = section.paragraph(format!(
                "main directions at {x}° and {y}°, {done}; beyond rank 1 (of the roots): \
                 {before} % before, {after} % after"
            ));
        }
        section
            .block(self.errors())
            .blocks(self.lines.iter().map(|lines| Block::Paragraph(lines.text().into())))
    }

    /// A row per method and rank.
    fn errors(&self) -> PrintedTable {
        let names = || self.table.channels.iter().map(|c| c.name.as_str()).enumerate();
        let seen = self.rows.iter().any(|row| row.after_convolution.is_some());
        let number = |row: Option<&Row>, of: fn(&Row) -> Option<f64>| {
            Cell::number_or(row.and_then(of), 4, "no environment")
        };
        // Rows of the channels of one method at one rank stand together.
        PrintedTable::over("", self.rows.chunks(self.table.channels.len().max(1)))
            .code("method", |rows| rows[0].method.as_str())
            .figures("rank", |rows| rows[0].rank)
            .columns(
                names(),
                |(_, name)| PrintedColumn::figures(format!("error {name}")),
                |rows, (at, _)| number(rows.get(*at), |row| Some(row.relative_error)),
            )
            .columns(
                names().filter(|_| seen),
                |(_, name)| PrintedColumn::figures(format!("convolved {name}")),
                |rows, (at, _)| number(rows.get(*at), |row| row.after_convolution),
            )
            .figures("ms", |rows| rows[0].ms)
            .table()
    }

    /// For a program.
    pub(super) fn json(&self) -> Value {
        let alignment = self.directions.map(|found| {
            json!({
                "angles_deg": found.angles_rad.map(f64::to_degrees),
                "searched_deg": found.searched_rad.map(f64::to_degrees),
                "beyond_rank_one": found.beyond_rank_one,
                "matrix": found.alignment.matrix,
                "applied": self.aligned,
            })
        });
        let lines = self.lines.as_ref().map(|lines| {
            let lost: serde_json::Map<String, Value> =
                lines.all.lost.iter().map(|(name, part)| (name.clone(), json!(part))).collect();
            json!({
                "directions": lines.directions(),
                "half_width": lines.half_width.is_finite().then_some(lines.half_width),
                "lost": lost,
            })
        });
        json!({
            "table": self.table.origin,
            "output": self.folder.display().to_string(),
            "rows": self.rows,
            "spectra": self.spectra,
            "alignment": alignment,
            "directional": lines,
        })
    }
}

impl Lines {
    fn directions(&self) -> Vec<[f64; 2]> {
        self.all.kernels.iter().map(|kernel| kernel.direction).collect()
    }

    fn text(&self) -> String {
        let directions = self.directions().into_iter();
        let angles: Vec<String> =
            directions.map(|[x, y]| format!("{}°", number(y.atan2(x).to_degrees(), 5))).collect();
        let lost = self.all.lost.iter();
        let lost: Vec<String> =
            lost.map(|(name, part)| format!("{name} {} %", number(100.0 * part, 3))).collect();
        format!("lines at {}; energy on no line: {}", angles.join(" and "), lost.join(", "))
    }
}
