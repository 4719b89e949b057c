//! Factors in files.
//!
//! A folder holds `vertical.exr` and `horizontal.exr` (with their axes beside them), one row per
//! term and one channel per channel of the table, in f32, which is what a shader reads; the same
//! in f64 as `vertical.csv` and `horizontal.csv`, columns `R_1`, `R_2` …; and `alignment.toml`.

use std::path::Path;

use super::{Alignment, ChannelFactors, LowRank, LowRankError};
use crate::table::{Axis, Channel, Column, Grid, Table, store};

const VERTICAL: &str = "vertical";
const HORIZONTAL: &str = "horizontal";
const ALIGNMENT: &str = "alignment.toml";

impl LowRank {
    /// Writes the files into `folder`, which exists; each whole or not at all.
    ///
    /// # Errors
    /// As [`Grid::write_exr`] and [`Table::write_csv`]; [`LowRankError::Mismatch`] for factors whose
    /// channels have different numbers of terms.
    pub fn write(&self, folder: &Path) -> Result<(), LowRankError> {
        for (name, axis) in [(VERTICAL, &self.y), (HORIZONTAL, &self.x)] {
            let side = self.side(name, axis)?;
            side.write_exr(folder.join(format!("{name}.exr")))?;
            let notes = [format!("{name} factors, one column per channel and term, largest first")];
            self.columns(name, axis).write_csv(folder.join(format!("{name}.csv")), &notes)?;
        }
        let text = self.alignment.to_toml()?;
        store::atomic_write(&folder.join(ALIGNMENT), text.as_bytes())?;
        Ok(())
    }

    /// Reads what [`LowRank::write`] wrote; the factors are those of the EXR files, rounded to f32.
    ///
    /// # Errors
    /// As [`Grid::read_exr`], for a file that is not there among others; [`LowRankError::Mismatch`]
    /// if the two sides have other channels or numbers of terms, or the alignment is none.
    pub fn read(folder: &Path) -> Result<Self, LowRankError> {
        let vertical = Grid::read_exr(folder.join(format!("{VERTICAL}.exr")))?;
        let horizontal = Grid::read_exr(folder.join(format!("{HORIZONTAL}.exr")))?;
        let path = folder.join(ALIGNMENT);
        let origin = path.display().to_string();
        let text = store::read(&path)?;
        let alignment = Alignment::from_toml(&origin, store::text(&origin, &text)?)?;
        let fault =
            |what: String| LowRankError::Mismatch { origin: folder.display().to_string(), what };
        if vertical.y.count != horizontal.y.count {
            let (v, h) = (vertical.y.count, horizontal.y.count);
            return Err(fault(format!("{v} vertical terms and {h} horizontal ones")));
        }
        if vertical.channels.len() != horizontal.channels.len() {
            let (v, h) = (vertical.channels.len(), horizontal.channels.len());
            return Err(fault(format!(
                "{v} channels of vertical factors and {h} of horizontal ones"
            )));
        }
        let lists = |channel: &Channel, length: usize| -> Vec<Vec<f64>> {
            channel
                .values
                .chunks(length)
                .map(|c| c.iter().map(|v| f64::from(*v)).collect())
                .collect()
        };
        let mut channels = Vec::with_capacity(vertical.channels.len());
        for channel in &vertical.channels {
            let other = horizontal.channel(&channel.name).ok_or_else(|| {
                fault(format!("no horizontal factors for channel {:?}", channel.name))
            })?;
            channels.push(ChannelFactors {
                name: channel.name.clone(),
                vertical: lists(channel, vertical.x.count),
                horizontal: lists(other, horizontal.x.count),
            });
        }
        Ok(Self { x: horizontal.x, y: vertical.x, channels, alignment })
    }

    /// One side as a table: its axis along x, the term, from 1, along y.
    fn side(&self, name: &str, axis: &Axis) -> Result<Grid, LowRankError> {
        let rank = self.rank();
        let lists = |factors: &ChannelFactors| match name {
            VERTICAL => factors.vertical.clone(),
            _ => factors.horizontal.clone(),
        };
        let mut channels = Vec::with_capacity(self.channels.len());
        for factors in &self.channels {
            let lists = lists(factors);
            if lists.len() != rank || lists.iter().any(|list| list.len() != axis.count) {
                return Err(LowRankError::Mismatch {
                    origin: format!("{name} factors of channel {:?}", factors.name),
                    what: format!("expected {rank} terms of {} values", axis.count),
                });
            }
            channels.push(Channel {
                name: factors.name.clone(),
                unit: "1".into(),
                values: lists.iter().flatten().map(|v| *v as f32).collect(),
            });
        }
        let term = Axis {
            name: "term".into(),
            unit: "1".into(),
            from: 0.5,
            to: rank as f64 + 0.5,
            count: rank,
        };
        Ok(Grid { x: axis.clone(), y: term, channels, origin: format!("{name} factors") })
    }

    fn columns(&self, name: &str, axis: &Axis) -> Table {
        let mut columns = vec![Column::new(axis.name.clone(), axis.unit.clone(), axis.centres())];
        for factors in &self.channels {
            let lists = if name == VERTICAL { &factors.vertical } else { &factors.horizontal };
            for (m, list) in lists.iter().enumerate() {
                let name = format!("{}_{}", factors.name, m + 1);
                columns.push(Column::new(name, "1", list.clone()));
            }
        }
        Table { columns, origin: format!("{name} factors") }
    }
}
