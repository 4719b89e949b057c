//! The affine map that makes a pattern axis-aligned.

use serde::{Deserialize, Serialize};

use super::LowRankError;
use crate::table::{Grid, GridChannel, centres};

/// Determinants below this part of the product of the rows' lengths are 0: the two directions are
/// one.
const PARALLEL: f64 = 1e-6;

/// The affine map that straightens a table about h = 0 (toisoul2017 §4.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// a = matrix · h, rows first. The columns of its inverse are the directions in h along which
    /// the two axes of the factors run.
    pub matrix: [[f64; 2]; 2],
}

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
            let got = format!("{}° and {}°", x_rad.to_degrees(), y_rad.to_degrees());
            return Err(LowRankError::setting("directions", "two that are not parallel", got));
        }
        Ok(Self { matrix: [[d, -b], [-c, a]].map(|row| row.map(|v| v / determinant)) })
    }

    /// a of h.
    pub fn apply(&self, h: [f64; 2]) -> [f64; 2] {
        self.matrix.map(|row| row[0] * h[0] + row[1] * h[1])
    }

    /// The map from a to h. Not finite for a matrix that has no inverse, which nothing here makes or
    /// reads.
    pub fn inverse(&self) -> Self {
        let [[a, b], [c, d]] = self.matrix;
        let determinant = a * d - b * c;
        Self { matrix: [[d, -b], [-c, a]].map(|row| row.map(|v| v / determinant)) }
    }

    /// The directions in h of the x and the y axis, of the length that 1 on the axis has in h.
    pub fn directions(&self) -> [[f64; 2]; 2] {
        let [[a, b], [c, d]] = self.inverse().matrix;
        [[a, c], [b, d]]
    }

    /// Angles in h of the directions of the x and the y axis, rad, in (−π, π].
    pub fn angles_rad(&self) -> [f64; 2] {
        self.directions().map(|[x, y]| y.atan2(x))
    }

    /// As a TOML file.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] for a matrix that TOML cannot write.
    pub fn to_toml(&self) -> Result<String, LowRankError> {
        let directions_deg = Some(self.angles_rad().map(f64::to_degrees));
        let record = Record { matrix: self.matrix, directions_deg };
        toml::to_string(&record)
            .map_err(|error| LowRankError::unusable("alignment", error.to_string()))
    }

    /// From the text of a file, which `origin` names in messages.
    ///
    /// # Errors
    /// [`LowRankError::Unusable`] for another structure, or a matrix without an inverse.
    pub fn from_toml(origin: &str, text: &str) -> Result<Self, LowRankError> {
        let fault = |what: String| LowRankError::unusable(origin, what);
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
/// bicubic and held within the range of the texels around. The axes keep their range and spacing; what the map moves beyond
/// them is cut, and 0 comes in where a point lies outside the table. The identity copies.
///
/// # Errors
/// As [`Grid::check_plane`].
pub fn aligned(table: &Grid, alignment: &Alignment) -> Result<Grid, LowRankError> {
    table.check_plane()?;
    if *alignment == Alignment::identity() {
        return Ok(table.clone());
    }
    let inverse = alignment.inverse();
    let channels = table.channels.iter().map(|channel| {
        let value = |a: [f64; 2]| bicubic(table, channel, inverse.apply(a)) as f32;
        let values = centres(table.x(), table.y()).map(value).collect();
        GridChannel::new(&channel.name, &channel.unit, values)
    });
    Ok(Grid {
        axes: table.axes.clone(),
        channels: channels.collect(),
        origin: format!("{}, aligned", table.origin),
    })
}

/// The value of `channel` at h: Catmull & Rom's cubic through the sixteen texels around, held within
/// their range so that a table that is not negative stays so; 0 beyond the table's outer edges.
pub(super) fn bicubic(table: &Grid, channel: &GridChannel, h: [f64; 2]) -> f64 {
    let (nx, ny) = (table.x().count, table.y().count);
    let (tx, ty) = (table.x().texel(h[0]), table.y().texel(h[1]));
    let on = |t: f64, n: usize| (-0.5..=n as f64 - 0.5).contains(&t);
    if !(on(tx, nx) && on(ty, ny)) {
        return 0.0;
    }
    let (left, top) = (tx.floor(), ty.floor());
    let at = |i: i64, j: i64| {
        let i = i.clamp(0, nx as i64 - 1) as usize;
        let j = j.clamp(0, ny as i64 - 1) as usize;
        channel.values.get(j * nx + i).map_or(0.0, |v| f64::from(*v))
    };
    let (wx, wy) = (catmull_rom(tx - left), catmull_rom(ty - top));
    let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
    for (j, y) in (top as i64 - 1..).zip(wy) {
        for (i, x) in (left as i64 - 1..).zip(wx) {
            let value = at(i, j);
            sum += x * y * value;
            low = value.min(low);
            high = value.max(high);
        }
    }
    sum.clamp(low, high)
}

/// Weights of the texels −1, 0, 1, 2 at `t` in [0, 1).
fn catmull_rom(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (-t + 2.0 * t2 - t3),
        0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
        0.5 * (t + 4.0 * t2 - 3.0 * t3),
        0.5 * (t3 - t2),
    ]
}
