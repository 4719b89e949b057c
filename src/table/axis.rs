use serde::{Deserialize, Serialize};

use super::{TableError, units};

/// One axis of a [`super::Grid`].
///
/// The texel-centre convention, stated here for the whole crate: `from` and `to` are the outer
/// edges of the first and the last texel, and texel `i` of `count` stands for the value at its
/// centre, `from + (i + 1/2)(to − from)/count`. A texture unit with normalised coordinates and
/// clamped edges then samples `(x − from)/(to − from)` without an offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// What the axis measures.
    pub name: String,
    /// Its unit, one of [`units::KNOWN`].
    pub unit: String,
    /// Outer edge of the first texel.
    pub from: f64,
    /// Outer edge of the last texel; may be below `from`.
    pub to: f64,
    /// Number of texels.
    pub count: usize,
}

impl Axis {
    /// An axis of `count` texels between two outer edges.
    pub fn new(
        name: impl Into<String>,
        unit: impl Into<String>,
        [from, to]: [f64; 2],
        count: usize,
    ) -> Self {
        Self { name: name.into(), unit: unit.into(), from, to, count }
    }

    /// Step from texel to texel, below 0 on an axis that falls.
    pub fn step(&self) -> f64 {
        (self.to - self.from) / self.count as f64
    }

    /// The value at `t` texels from the outer edge of the first, which may lie outside the axis.
    pub fn at(&self, t: f64) -> f64 {
        self.from + t * (self.to - self.from) / self.count as f64
    }

    /// The value at the centre of texel `i`, which may lie outside the axis.
    pub fn centre(&self, i: usize) -> f64 {
        self.at(i as f64 + 0.5)
    }

    /// The values at all centres, in order.
    pub fn centres(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.centre(i)).collect()
    }

    /// Position of `value` in texels from the first centre: `i` at the centre of texel `i`.
    pub fn texel(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from) * self.count as f64 - 0.5
    }

    /// The texels with their centres on either side of `value` and the part of the way to the
    /// second; the outermost texel twice between its centre and the edge, `None` beyond.
    pub fn between(&self, value: f64) -> Option<(usize, usize, f64)> {
        let last = self.count.checked_sub(1)?;
        let at = self.texel(value);
        if !(-0.5..=last as f64 + 0.5).contains(&at) {
            return None;
        }
        let at = at.clamp(0.0, last as f64);
        let low = at.floor() as usize;
        Some((low, (low + 1).min(last), at.fract()))
    }

    pub(super) fn check(&self, origin: &str) -> Result<(), TableError> {
        let fault = |reason: String| Err(TableError::malformed(origin, reason));
        if let Some(reason) = super::csv::name_fault(&self.name) {
            return fault(format!("axis {:?}: {reason}", self.name));
        }
        units::require(&self.unit, origin, &self.name)?;
        if !(self.from.is_finite() && self.to.is_finite()) || self.from == self.to {
            let Self { name, from, to, .. } = self;
            return fault(format!("axis {name:?} goes from {from} to {to}, which is no range"));
        }
        if self.count == 0 {
            return fault(format!("axis {:?} has no texels", self.name));
        }
        Ok(())
    }
}
