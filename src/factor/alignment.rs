//! The affine map that makes a pattern axis-aligned.

use serde::{Deserialize, Serialize};

use super::resampling::{Interpolation, sample};
use super::{Alignment, LowRankError};
use crate::table::{Channel, Grid};

/// Determinants below this part of the product of the rows' lengths are 0: the two directions are
/// one.
const PARALLEL: f64 = 1e-6;

/// How an alignment stands in a file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    /// a = matrix · h, rows first.
    matrix: [[f64; 2]; 2],
    /// The directions in h of the two axes; only for the reader of the file.
    #[serde(default)]
    directions_deg: Option<[f64; 2]>,
}

impl Alignment {
    /// No change: a = h.
    pub fn identity() -> Self {
        Self { matrix: [[1.0, 0.0], [0.0, 1.0]] }
    }

    /// The map that brings the direction of angle `x_rad` in h (from +h_x towards +h_y) to the x
    /// axis and that of `y_rad` to the y axis, lengths along both kept.
    ///
    /// # Errors
    /// [`LowRankError::Setting`] if the two are one line or not finite.
    pub fn of_directions(x_rad: f64, y_rad: f64) -> Result<Self, LowRankError> {
        let [a, c] = [x_rad.cos(), x_rad.sin()];
        let [b, d] = [y_rad.cos(), y_rad.sin()];
        let determinant = a * d - b * c;
        if determinant.is_nan() || determinant.abs() <= PARALLEL {
            return Err(LowRankError::Setting {
                name: "directions",
                expected: "two that are not parallel".into(),
                got: format!("{}° and {}°", x_rad.to_degrees(), y_rad.to_degrees()),
            });
        }
        Ok(Self { matrix: [[d, -b], [-c, a]].map(|row| row.map(|v| v / determinant)) })
    }

    /// a of h.
    pub fn apply(&self, h: [f64; 2]) -> [f64; 2] {
        self.matrix.map(|row| row[0] * h[0] + row[1] * h[1])
    }

    /// The matrix from a to h; its columns are the directions in h of the two axes. Not finite for a
    /// matrix that has no inverse, which nothing here makes or reads.
    pub fn inverse(&self) -> [[f64; 2]; 2] {
        let [[a, b], [c, d]] = self.matrix;
        let determinant = a * d - b * c;
        [[d, -b], [-c, a]].map(|row| row.map(|v| v / determinant))
    }

    /// Angles in h of the directions of the x and the y axis, rad, in (−π, π].
    pub fn angles_rad(&self) -> [f64; 2] {
        let [[a, b], [c, d]] = self.inverse();
        [c.atan2(a), d.atan2(b)]
    }

    /// As a TOML file.
    ///
    /// # Errors
    /// [`LowRankError::Mismatch`] for a matrix that TOML cannot write.
    pub fn to_toml(&self) -> Result<String, LowRankError> {
        let directions_deg = Some(self.angles_rad().map(f64::to_degrees));
        let record = Record { matrix: self.matrix, directions_deg };
        toml::to_string(&record)
            .map_err(|e| LowRankError::Mismatch { origin: "alignment".into(), what: e.to_string() })
    }

    /// From the text of a file, which `origin` names in messages.
    ///
    /// # Errors
    /// [`LowRankError::Mismatch`] for another structure, or a matrix without an inverse.
    pub fn from_toml(origin: &str, text: &str) -> Result<Self, LowRankError> {
        let fault = |what: String| LowRankError::Mismatch { origin: origin.into(), what };
        let record: Record =
            toml::from_str(text).map_err(|e| fault(e.to_string().trim_end().to_owned()))?;
        let [[a, b], [c, d]] = record.matrix;
        let determinant = (a * d - b * c).abs();
        let usual = a.hypot(b) * c.hypot(d);
        if !(usual.is_finite() && determinant > PARALLEL * usual) {
            return Err(fault("the matrix has no inverse".into()));
        }
        Ok(Self { matrix: record.matrix })
    }
}

/// A table in aligned coordinates: the value at a is the table's at h with a = `alignment` · h,
/// bicubic ([`Interpolation`]). The axes keep their range and spacing; what the map moves beyond
/// them is cut, and 0 comes in where a point lies outside the table. The identity copies.
///
/// # Errors
/// As [`Grid::check`].
pub fn aligned(table: &Grid, alignment: &Alignment) -> Result<Grid, LowRankError> {
    table.check()?;
    if *alignment == Alignment::identity() {
        return Ok(table.clone());
    }
    let inverse = alignment.inverse();
    let (xs, ys) = (table.x.centres(), table.y.centres());
    let channels = table.channels.iter().map(|channel| {
        let value = |ax: f64, ay: f64| {
            let [hx, hy] = inverse.map(|row| row[0] * ax + row[1] * ay);
            sample(table, channel, [hx, hy], Interpolation::Bicubic) as f32
        };
        Channel {
            name: channel.name.clone(),
            unit: channel.unit.clone(),
            values: ys.iter().flat_map(|ay| xs.iter().map(move |ax| value(*ax, *ay))).collect(),
        }
    });
    Ok(Grid {
        x: table.x.clone(),
        y: table.y.clone(),
        channels: channels.collect(),
        origin: format!("{}, aligned", table.origin),
    })
}

/// What resampling alone costs: ‖S″ − S‖/‖S‖ over all channels, S″ the table aligned and brought
/// back, over the part of the disc |h| ≤ half the smaller side that stays on the table both ways.
/// Two resamplings: one costs about √½ of it.
///
/// # Errors
/// As [`aligned`].
pub fn resampling_error(table: &Grid, alignment: &Alignment) -> Result<f64, LowRankError> {
    let there = aligned(table, alignment)?;
    let back = aligned(&there, &Alignment { matrix: alignment.inverse() })?;
    let half = |axis: &crate::table::Axis| axis.from.abs().min(axis.to.abs());
    let radius = half(&table.x).min(half(&table.y));
    let (xs, ys) = (table.x.centres(), table.y.centres());
    let inside = |hx: f64, hy: f64| {
        let [ax, ay] = alignment.apply([hx, hy]);
        hx.hypot(hy) <= radius && ax.hypot(ay) <= radius
    };
    let mask: Vec<bool> =
        ys.iter().flat_map(|hy| xs.iter().map(move |hx| inside(*hx, *hy))).collect();
    let (mut error, mut whole) = (0.0, 0.0);
    for (was, is) in table.channels.iter().zip(&back.channels) {
        for ((a, b), kept) in was.values.iter().zip(&is.values).zip(&mask) {
            if *kept {
                error += (f64::from(*a) - f64::from(*b)).powi(2);
                whole += f64::from(*a).powi(2);
            }
        }
    }
    Ok(if whole == 0.0 { 0.0 } else { (error / whole).sqrt() })
}
