use super::{Axis, TableError, units};

/// A quantity on a [`Grid`].
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name of the quantity.
    pub name: String,
    /// Its unit, one of [`units::KNOWN`].
    pub unit: String,
    /// One value per texel, rows of constant y one after the other, x running fastest.
    pub values: Vec<f32>,
}

/// Quantities on one regular two-dimensional grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The axis that runs fastest: left to right in an image.
    pub x: Axis,
    /// The other axis: top to bottom in an image.
    pub y: Axis,
    /// The quantities, in the order of the sidecar.
    pub channels: Vec<Channel>,
    /// One line on the origin: file and SHA-256, or the reference that made it.
    pub origin: String,
}

impl Grid {
    /// The channel called `name`.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|c| c.name == name)
    }

    /// The channel called `name`, which must be there.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`], listing the channels that are there.
    pub fn require(&self, name: &str) -> Result<&Channel, TableError> {
        self.channel(name).ok_or_else(|| TableError::UnknownColumn {
            origin: self.origin.clone(),
            name: name.into(),
            known: self.channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", "),
        })
    }

    /// The value of channel `name` in texel (`ix`, `iy`); `None` outside the grid.
    pub fn at(&self, name: &str, ix: usize, iy: usize) -> Option<f32> {
        if ix >= self.x.count {
            return None;
        }
        let index = iy.checked_mul(self.x.count)?.checked_add(ix)?;
        self.channel(name)?.values.get(index).copied()
    }

    /// Checks what reading guarantees, for a grid made in memory: axes with a range and texels,
    /// distinct channel names, known units, one finite value per texel.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), TableError> {
        let origin = &self.origin;
        self.x.check(origin)?;
        self.y.check(origin)?;
        if self.channels.is_empty() {
            return Err(TableError::Empty { origin: origin.clone(), what: "no channels" });
        }
        for (i, channel) in self.channels.iter().enumerate() {
            self.check_channel(i, channel)?;
        }
        Ok(())
    }

    fn check_channel(&self, i: usize, channel: &Channel) -> Result<(), TableError> {
        let origin = self.origin.clone();
        let name = channel.name.clone();
        if let Some(reason) = super::csv::name_fault(&name) {
            return Err(TableError::Header {
                origin,
                line: 1,
                position: i + 1,
                header: name,
                reason,
            });
        }
        if self.channels.iter().take(i).any(|other| other.name == name) {
            return Err(TableError::DuplicateColumn { origin, line: 1, name });
        }
        units::require(&channel.unit, &origin, &name)?;
        let (expected, got) = (self.x.count.saturating_mul(self.y.count), channel.values.len());
        if got != expected {
            return Err(TableError::Length { origin, column: name, expected, got });
        }
        match channel.values.iter().position(|v| !v.is_finite()) {
            Some(index) => Err(TableError::NonFinite {
                origin,
                row: format!("texel ({}, {})", index % self.x.count, index / self.x.count),
                column: name,
                got: channel.values.get(index).map_or(f64::NAN, |v| f64::from(*v)),
            }),
            None => Ok(()),
        }
    }
}
