//! Pictures and lines that `factor` writes.

use std::path::Path;

use crate::factor::Directional;
use crate::render::image::{Channel, Image};
use crate::table::{Column, Grid, Table};

/// Part of the texels that a picture may clip.
const CLIPPED: f64 = 0.005;

/// Writes a table as PNG, R, G and B if it has them, else its first channel as grey; at `exposure`,
/// in stops, or one that shows all but the brightest 0.5 % of the texels. Returns the exposure.
pub(super) fn picture(table: &Grid, path: &Path, exposure: Option<f64>) -> anyhow::Result<f64> {
    let colours: Vec<_> = ["R", "G", "B"].iter().filter_map(|name| table.channel(name)).collect();
    let shown = if colours.len() == 3 { colours } else { table.channels.iter().take(1).collect() };
    let exposure = exposure.unwrap_or_else(|| {
        let mut values: Vec<f32> = shown.iter().flat_map(|c| c.values.iter().copied()).collect();
        values.sort_by(f32::total_cmp);
        let at = ((1.0 - CLIPPED) * (values.len() as f64 - 1.0)) as usize;
        let bright = values.get(at).copied().unwrap_or(1.0);
        let white = if bright > 0.0 { bright } else { values.last().copied().unwrap_or(1.0) };
        if white > 0.0 { -f64::from(white).log2() } else { 0.0 }
    });
    let channel =
        |c: &&crate::table::GridChannel| Channel { name: c.name.clone(), values: c.values.clone() };
    let image = Image {
        width: table.x().count,
        height: table.y().count,
        channels: shown.iter().map(channel).collect(),
    };
    image.write_png(path, exposure)?;
    Ok(exposure)
}

/// Writes `line_1.csv` and so on: position along the line and one column per channel.
pub(super) fn write_lines(lines: &Directional, folder: &Path) -> anyhow::Result<()> {
    for (index, kernel) in lines.kernels.iter().enumerate() {
        let axis = &kernel.axis;
        let mut columns = vec![Column::new(axis.name.clone(), axis.unit.clone(), axis.centres())];
        for (name, values) in &kernel.channels {
            columns.push(Column::new(name.clone(), "1", values.clone()));
        }
        let [x, y] = kernel.direction;
        let notes = [format!("kernel along ({x}, {y}) in h, integrated across")];
        let table = Table { columns, origin: format!("line {}", index + 1) };
        table.write_csv(folder.join(format!("line_{}.csv", index + 1)), &notes)?;
    }
    Ok(())
}
