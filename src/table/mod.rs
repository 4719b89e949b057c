//! Tables: columns with a name and a unit each, optional uncertainty, and a provenance.
//!
//! [`Table`] is the common shape of everything that is fitted to, compared with or written out:
//! columns of numbers, read from CSV ([`Table::read_csv`]). [`Grid`] is the regular
//! one, of any dimension, kept as EXR with a sidecar for its axes. [`provenance::Provenance`] says
//! where the files of a data set come from. Units are a closed list ([`units`]).

mod axis;
mod csv;
mod error;
mod exr;
mod grid;
pub mod provenance;
pub mod store;
pub mod units;

pub use self::axis::Axis;
pub use self::csv::{ReadOptions, shortest_number};
pub use self::error::TableError;
pub use self::exr::{MAX_PIXEL_BYTES, sidecar_path};
pub(crate) use self::exr::{decode as decode_exr, encode as encode_exr, halves, singles};
pub use self::grid::{Edge, Grid, GridChannel, centres};

/// A column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name, without the unit.
    pub name: String,
    /// Unit as written in the header's brackets; `1` for a pure number.
    pub unit: String,
    /// The numbers, one per row.
    pub values: Vec<f64>,
    /// Standard uncertainty of each value, same unit, where the file gives one.
    pub uncertainty: Option<Vec<f64>>,
}

impl Column {
    /// A column without uncertainty.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), unit: unit.into(), values, uncertainty: None }
    }

    /// The values and their uncertainty in another unit of the same dimension.
    ///
    /// # Errors
    /// [`TableError::Content`] naming `origin`: a unit that is not known, or of another dimension.
    pub fn in_unit(&self, unit: &str, origin: &str) -> Result<Self, TableError> {
        let factor = units::conversion(&self.unit, unit, origin, &self.name)?;
        let scaled = |values: &[f64]| values.iter().map(|v| v * factor).collect::<Vec<_>>();
        Ok(Self {
            name: self.name.clone(),
            unit: unit.into(),
            values: scaled(&self.values),
            uncertainty: self.uncertainty.as_deref().map(scaled),
        })
    }
}

/// Columns of one length, and where they came from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The columns, in the order of the file.
    pub columns: Vec<Column>,
    /// One line on the origin: file and SHA-256, or the reference that made it.
    pub origin: String,
}

impl Table {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// The column called `name`.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// The names of the columns, in order.
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|c| c.name.as_str()).collect()
    }

    /// The column called `name`, which must be there.
    ///
    /// # Errors
    /// [`TableError::Content`], listing the columns that are there.
    pub fn require(&self, name: &str) -> Result<&Column, TableError> {
        let unknown = || TableError::unknown_column(&self.origin, name, self.names());
        self.column(name).ok_or_else(unknown)
    }

    /// The values of the column called `name`, in `unit`.
    ///
    /// # Errors
    /// [`TableError::Content`] if it is not there, or its unit does not convert into `unit`.
    pub fn values_in(&self, name: &str, unit: &str) -> Result<Vec<f64>, TableError> {
        Ok(self.require(name)?.in_unit(unit, &self.origin)?.values)
    }

    /// Checks what reading guarantees, for a table made in memory: at least one column, distinct
    /// names that a header can hold, known units, one length, uncertainties that are not negative.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), TableError> {
        if self.columns.is_empty() {
            return Err(TableError::content(&self.origin, "no columns"));
        }
        for (i, column) in self.columns.iter().enumerate() {
            self.check_column(i, column)?;
        }
        Ok(())
    }

    fn check_column(&self, i: usize, column: &Column) -> Result<(), TableError> {
        let origin = &self.origin;
        let before = self.columns.iter().take(i).map(|c| c.name.as_str());
        check_label(origin, &column.name, &column.unit, before)?;
        let length = |name: &str, got: usize| match self.rows() {
            expected if got == expected => Ok(()),
            expected => Err(TableError::length(origin, name, expected, got)),
        };
        length(&column.name, column.values.len())?;
        let Some(uncertainty) = &column.uncertainty else { return Ok(()) };
        length(&format!("u({})", column.name), uncertainty.len())?;
        match uncertainty.iter().position(|u| *u < 0.0) {
            Some(row) => {
                let (place, got) = (format!("{origin}:{}", row + 2), uncertainty[row]);
                Err(TableError::negative(place, row + 1, &column.name, got))
            }
            None => Ok(()),
        }
    }
}

/// Checks the name and the unit of a column or channel of `origin`, which stands after those called
/// `before`.
fn check_label<'a>(
    origin: &str,
    name: &str,
    unit: &str,
    before: impl ExactSizeIterator<Item = &'a str>,
) -> Result<(), TableError> {
    if let Some(reason) = csv::name_fault(name) {
        return Err(csv::header_error(origin, 1, before.len() + 1, name, reason));
    }
    if before.into_iter().any(|other| other == name) {
        return Err(csv::duplicate_error(origin, 1, name));
    }
    units::require(unit, origin, name)?;
    Ok(())
}
