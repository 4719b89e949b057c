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
    /// The value at the centre of texel `i`, which may lie outside the axis.
    pub fn centre(&self, i: usize) -> f64 {
        self.from + (i as f64 + 0.5) * (self.to - self.from) / self.count as f64
    }

    /// The values at all centres, in order.
    pub fn centres(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.centre(i)).collect()
    }

    /// Position of `value` in texels from the first centre: `i` at the centre of texel `i`.
    pub fn texel(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from) * self.count as f64 - 0.5
    }

    pub(super) fn check(&self, origin: &str) -> Result<(), TableError> {
        let fault = |reason: String| TableError::Malformed { origin: origin.into(), reason };
        if let Some(reason) = super::csv::name_fault(&self.name) {
            return Err(fault(format!("axis {:?}: {reason}", self.name)));
        }
        units::require(&self.unit, origin, &self.name)?;
        if !(self.from.is_finite() && self.to.is_finite()) || self.from == self.to {
            let (from, to) = (self.from, self.to);
            let name = &self.name;
            return Err(fault(format!(
                "axis {name:?} goes from {from} to {to}, which is no range"
            )));
        }
        if self.count == 0 {
            return Err(fault(format!("axis {:?} has no texels", self.name)));
        }
        Ok(())
    }
}
