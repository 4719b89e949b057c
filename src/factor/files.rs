//! Factors in files.
//!
//! A folder holds `vertical.exr` and `horizontal.exr` (with their axes beside them), one row per
//! term and one channel per channel of the table, in f32, which is what a shader reads; the same
//! in f64 as `vertical.csv` and `horizontal.csv`, columns `R_1`, `R_2` …; and `alignment.toml`.

use std::path::Path;

use super::{Alignment, ChannelFactors, LowRank, LowRankError};
use crate::table::{Axis, Column, Grid, GridChannel, Table, store};

const VERTICAL: &str = "vertical";
const HORIZONTAL: &str = "horizontal";
const ALIGNMENT: &str = "alignment.toml";

impl LowRank {
    /// Writes the files into `folder`, which exists; each whole or not at all.
    ///
    /// # Errors
    /// As [`Grid::write_exr`] and [`Table::write_csv`]; [`LowRankError::Unusable`] for factors whose
    /// channels have different numbers of terms.
    pub fn write(&self, folder: &Path) -> Result<(), LowRankError> {
        for (name, axis, lists) in [
            (VERTICAL, &self.y, (|c| &c.vertical) as fn(&ChannelFactors) -> &Vec<Vec<f64>>),
            (HORIZONTAL, &self.x, |c| &c.horizontal),
        ] {
            let lists: Vec<_> = self.channels.iter().map(|c| (c.name.as_str(), lists(c))).collect();
            side(name, axis, &lists)?.write_exr(folder.join(format!("{name}.exr")))?;
            let notes = [format!("{name} factors, one column per channel and term, largest first")];
            columns(name, axis, &lists).write_csv(folder.join(format!("{name}.csv")), &notes)?;
        }
        let text = self.alignment.to_toml()?;
        store::atomic_write(&folder.join(ALIGNMENT), text.as_bytes())?;
        Ok(())
    }

    /// Reads what [`LowRank::write`] wrote; the factors are those of the EXR files, rounded to f32.
    ///
    /// # Errors
    /// As [`Grid::read_exr`], for a file that is not there among others; [`LowRankError::Unusable`]
    /// if the two sides have other channels or numbers of terms, or the alignment is none.
    pub fn read(folder: &Path) -> Result<Self, LowRankError> {
        let vertical = Grid::read_exr(folder.join(format!("{VERTICAL}.exr")))?;
        let horizontal = Grid::read_exr(folder.join(format!("{HORIZONTAL}.exr")))?;
        let path = folder.join(ALIGNMENT);
        let origin = path.display().to_string();
        let alignment = Alignment::from_toml(&origin, &store::read_text(&path)?)?;
        let fault = |what: String| LowRankError::unusable(folder.display().to_string(), what);
        if vertical.y().count != horizontal.y().count {
            let (v, h) = (vertical.y().count, horizontal.y().count);
            return Err(fault(format!("{v} vertical terms and {h} horizontal ones")));
        }
        if vertical.channels.len() != horizontal.channels.len() {
            let (v, h) = (vertical.channels.len(), horizontal.channels.len());
            return Err(fault(format!(
                "{v} channels of vertical factors and {h} of horizontal ones"
            )));
        }
        let lists = |channel: &GridChannel, length: usize| -> Vec<Vec<f64>> {
            let wide = |list: &[f32]| list.iter().map(|v| f64::from(*v)).collect();
            channel.values.chunks(length).map(wide).collect()
        };
        let mut channels = Vec::with_capacity(vertical.channels.len());
        for channel in &vertical.channels {
            let other = horizontal.channel(&channel.name).ok_or_else(|| {
                fault(format!("no horizontal factors for channel {:?}", channel.name))
            })?;
            channels.push(ChannelFactors {
                name: channel.name.clone(),
                vertical: lists(channel, vertical.x().count),
                horizontal: lists(other, horizontal.x().count),
            });
        }
        let (x, y) = (horizontal.x().clone(), vertical.x().clone());
        Ok(Self { x, y, channels, alignment })
    }
}

/// The terms of every channel on one side.
type Lists<'a> = [(&'a str, &'a Vec<Vec<f64>>)];

/// One side as a table: its axis along x, the term, from 1, along y.
fn side(name: &str, axis: &Axis, lists: &Lists<'_>) -> Result<Grid, LowRankError> {
    let rank = lists.iter().map(|(_, terms)| terms.len()).max().unwrap_or(0);
    let mut channels = Vec::with_capacity(lists.len());
    for (channel, terms) in lists {
        if terms.len() != rank || terms.iter().any(|list| list.len() != axis.count) {
            let what = format!("expected {rank} terms of {} values", axis.count);
            let origin = format!("{name} factors of channel {channel:?}");
            return Err(LowRankError::unusable(origin, what));
        }
        let values = terms.iter().flatten().map(|v| *v as f32).collect();
        channels.push(GridChannel::new(*channel, "1", values));
    }
    let term = Axis::new("term", "1", [0.5, rank as f64 + 0.5], rank);
    Ok(Grid { axes: vec![axis.clone(), term], channels, origin: format!("{name} factors") })
}

fn columns(name: &str, axis: &Axis, lists: &Lists<'_>) -> Table {
    let mut columns = vec![Column::new(&axis.name, &axis.unit, axis.centres())];
    for (channel, terms) in lists {
        let numbered = (1..).zip(*terms);
        columns
            .extend(numbered.map(|(m, l)| Column::new(format!("{channel}_{m}"), "1", l.clone())));
    }
    Table { columns, origin: format!("{name} factors") }
}
