use super::{Axis, Column, Table, TableError, check_label};

/// A quantity on a [`Grid`].
#[derive(Debug, Clone, PartialEq)]
pub struct GridChannel {
    /// Name of the quantity.
    pub name: String,
    /// Its unit, one of [`super::units::KNOWN`].
    pub unit: String,
    /// One value per texel: the first axis runs fastest, the last slowest.
    pub values: Vec<f32>,
}

impl GridChannel {
    /// A quantity with its values.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, values: Vec<f32>) -> Self {
        Self { name: name.into(), unit: unit.into(), values }
    }
}

/// Quantities on one regular grid of any dimension.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The axes, the one that runs fastest first: in an image left to right, then top to bottom.
    pub axes: Vec<Axis>,
    /// The quantities, in the order of the sidecar.
    pub channels: Vec<GridChannel>,
    /// One line on the origin: file and SHA-256, or the reference that made it.
    pub origin: String,
}

/// How a [`Grid`] continues beyond the centres of its outermost texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// Constant to the outer edge of the texel, 0 beyond.
    Held,
    /// Linear down to 0 where the centre of the next texel would be.
    Fading,
}

/// What a grid has in place of an axis that it lacks.
static POINT: Axis =
    Axis { name: String::new(), unit: String::new(), from: -0.5, to: 0.5, count: 1 };

impl Grid {
    /// A grid that is as [`Grid::check`] asks for.
    ///
    /// # Errors
    /// As [`Grid::check`].
    pub fn new(
        axes: impl Into<Vec<Axis>>,
        channels: Vec<GridChannel>,
        origin: impl Into<String>,
    ) -> Result<Self, TableError> {
        let grid = Self { axes: axes.into(), channels, origin: origin.into() };
        grid.check()?;
        Ok(grid)
    }

    /// The axis that runs fastest: left to right in an image. One texel for a grid without axes.
    pub fn x(&self) -> &Axis {
        self.axes.first().unwrap_or(&POINT)
    }

    /// The second axis: top to bottom in an image. One texel for a grid of fewer axes.
    pub fn y(&self) -> &Axis {
        self.axes.get(1).unwrap_or(&POINT)
    }

    /// Number of texels; the largest number that fits if it is larger still.
    pub fn texels(&self) -> usize {
        self.axes.iter().fold(1, |product, axis| product.saturating_mul(axis.count))
    }

    /// The channel called `name`.
    pub fn channel(&self, name: &str) -> Option<&GridChannel> {
        self.channels.iter().find(|c| c.name == name)
    }

    /// The channel called `name`, which must be there.
    ///
    /// # Errors
    /// [`TableError::Content`], listing the channels that are there.
    pub fn require(&self, name: &str) -> Result<&GridChannel, TableError> {
        let known = self.channels.iter().map(|c| c.name.as_str());
        self.channel(name).ok_or_else(|| TableError::unknown_column(&self.origin, name, known))
    }

    /// The value of channel `name` in a texel, one index per axis; `None` outside the grid.
    pub fn at(&self, name: &str, texel: &[usize]) -> Option<f32> {
        if texel.len() != self.axes.len() {
            return None;
        }
        let index = self.axes.iter().zip(texel).rev().try_fold(0usize, |index, (axis, i)| {
            (*i < axis.count).then_some(index.checked_mul(axis.count)?.checked_add(*i)?)
        })?;
        self.channel(name)?.values.get(index).copied()
    }

    /// The indices of texel number `index`, one per axis.
    pub fn texel(&self, mut index: usize) -> Vec<usize> {
        let mut digit = |axis: &Axis| {
            let i = index % axis.count.max(1);
            index /= axis.count.max(1);
            i
        };
        self.axes.iter().map(&mut digit).collect()
    }

    /// The value of one of its channels at a place, one coordinate per axis (NaN otherwise): linear
    /// between the centres of the texels along every axis.
    pub fn sample(&self, channel: &GridChannel, place: &[f64], edge: Edge) -> f64 {
        if place.len() != self.axes.len() {
            return f64::NAN;
        }
        let on = |(axis, value): (&Axis, &f64)| {
            (-0.5..=axis.count as f64 - 0.5).contains(&axis.texel(*value))
        };
        if edge == Edge::Held && !self.axes.iter().zip(place).all(on) {
            return 0.0;
        }
        interpolated(&channel.values, &self.axes, place, edge, (0, self.texels()))
    }

    /// A row per texel: a column per axis, then one per channel.
    pub fn to_table(&self) -> Table {
        let mut columns = Vec::with_capacity(self.axes.len() + self.channels.len());
        let mut below = 1;
        for axis in &self.axes {
            let centre = |index: usize| axis.centre(index / below % axis.count.max(1));
            let centres = (0..self.texels()).map(centre).collect();
            columns.push(Column::new(&axis.name, &axis.unit, centres));
            below *= axis.count.max(1);
        }
        columns.extend(self.channels.iter().map(|channel| {
            let values = channel.values.iter().map(|v| f64::from(*v)).collect();
            Column::new(&channel.name, &channel.unit, values)
        }));
        Table { columns, origin: self.origin.clone() }
    }

    /// As [`Grid::check`], for what takes two axes and no other number.
    ///
    /// # Errors
    /// [`TableError::Content`] for another number of axes, and as [`Grid::check`].
    pub fn check_plane(&self) -> Result<(), TableError> {
        if self.axes.len() != 2 {
            let reason = format!("{} axes, expected 2", self.axes.len());
            return Err(TableError::content(&self.origin, reason));
        }
        self.check()
    }

    /// Checks what reading guarantees, for a grid made in memory: axes with a range and texels,
    /// distinct channel names, known units, one finite value per texel.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), TableError> {
        let origin = &self.origin;
        if self.axes.is_empty() {
            return Err(TableError::content(origin, "no axes"));
        }
        self.axes.iter().try_for_each(|axis| axis.check(origin))?;
        if self.channels.is_empty() {
            return Err(TableError::content(origin, "no channels"));
        }
        for (i, channel) in self.channels.iter().enumerate() {
            self.check_channel(i, channel)?;
        }
        Ok(())
    }

    fn check_channel(&self, i: usize, channel: &GridChannel) -> Result<(), TableError> {
        let before = self.channels.iter().take(i).map(|c| c.name.as_str());
        check_label(&self.origin, &channel.name, &channel.unit, before)?;
        let (expected, got) = (self.texels(), channel.values.len());
        if got != expected {
            return Err(TableError::length(&self.origin, &channel.name, expected, got));
        }
        match channel.values.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            Some((index, &value)) => {
                let texel: Vec<String> = self.texel(index).iter().map(usize::to_string).collect();
                let row = format!("texel ({})", texel.join(", "));
                Err(TableError::non_finite(&self.origin, &row, &channel.name, value.into()))
            }
            None => Ok(()),
        }
    }
}

/// The centres of the texels of a plane, x running fastest.
pub fn centres(x: &Axis, y: &Axis) -> impl Iterator<Item = [f64; 2]> + use<> {
    let (xs, ys) = (x.centres(), y.centres());
    ys.into_iter().flat_map(move |y| xs.clone().into_iter().map(move |x| [x, y]))
}

/// Linear along the last of `axes` between what the others give: `begin` is the first texel of the
/// part of the grid that they span, `count` the number of its texels.
fn interpolated(
    values: &[f32],
    axes: &[Axis],
    place: &[f64],
    edge: Edge,
    (begin, count): (usize, usize),
) -> f64 {
    let (Some((axis, axes)), Some((value, place))) = (axes.split_last(), place.split_last()) else {
        return values.get(begin).map_or(0.0, |value| f64::from(*value));
    };
    let (stride, last) = (count / axis.count.max(1), axis.count as i64 - 1);
    let slice = |i: i64| {
        if edge == Edge::Fading && !(0..=last).contains(&i) {
            return 0.0;
        }
        let begin = begin + i.clamp(0, last.max(0)) as usize * stride;
        interpolated(values, axes, place, edge, (begin, stride))
    };
    let t = axis.texel(*value);
    let part = t - t.floor();
    let low = t.floor() as i64;
    slice(low) * (1.0 - part) + slice(low.saturating_add(1)) * part
}
