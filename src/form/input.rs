//! Inputs as columns, and the types of the scalars that they feed.

use std::ops::Range;

use naga::{Scalar, TypeInner};

use super::lanes::Real;

/// Type of the scalars of an argument or of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScalarType {
    /// `f32`.
    F32,
    /// `i32`.
    I32,
    /// `u32`.
    U32,
}

impl ScalarType {
    /// As WGSL writes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::I32 => "i32",
            Self::U32 => "u32",
        }
    }

    /// What an argument of this type takes, for messages.
    pub(crate) fn numbers(self) -> &'static str {
        match self {
            Self::F32 => "a number",
            Self::I32 => "a whole number from -2147483648 to 2147483647",
            Self::U32 => "a whole number from 0 to 4294967295",
        }
    }

    /// `f32`, or `vec3<f32>` for three components.
    pub(crate) fn wgsl(self, components: usize) -> String {
        match components {
            1 => self.name().to_owned(),
            _ => format!("vec{components}<{}>", self.name()),
        }
    }

    /// Type and number of components of a scalar or a vector, if it is made of one of the three.
    pub(super) fn of(inner: &TypeInner) -> Option<(Self, usize)> {
        let (size, scalar) = inner.vector_size_and_scalar()?;
        let components = size.map_or(1, |size| size as usize);
        match scalar {
            Scalar::F32 => Some((Self::F32, components)),
            Scalar::I32 => Some((Self::I32, components)),
            Scalar::U32 => Some((Self::U32, components)),
            _ => None,
        }
    }

    /// The 32 bits that hold `value`; `None` for what an integer type does not hold exactly.
    pub(crate) fn word(self, value: f64) -> Option<u32> {
        // The casts saturate and take NaN to 0, so that only what fits comes back as it was.
        match self {
            Self::F32 => Some((value as f32).to_bits()),
            Self::I32 => (f64::from(value as i32) == value).then_some(value as i32 as u32),
            Self::U32 => (f64::from(value as u32) == value).then_some(value as u32),
        }
    }
}

/// One scalar input of a form at many points.
///
/// An f32 argument takes each number rounded to the arithmetic of the evaluation. An i32 or u32
/// argument takes whole numbers of its range, exactly; others are an error. f64 holds every
/// argument exactly, f32 only integers up to 2^24.
#[derive(Debug, Clone, Copy)]
pub enum Input<'a> {
    /// Numbers in f32.
    F32(&'a [f32]),
    /// Numbers in f64.
    F64(&'a [f64]),
    /// Signed integers.
    I32(&'a [i32]),
    /// Unsigned integers.
    U32(&'a [u32]),
}

impl Input<'_> {
    /// Number of rows.
    pub fn len(self) -> usize {
        match self {
            Self::F32(column) => column.len(),
            Self::F64(column) => column.len(),
            Self::I32(column) => column.len(),
            Self::U32(column) => column.len(),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The number of a row; f64 holds all of them exactly.
    pub(crate) fn at(self, row: usize) -> f64 {
        match self {
            Self::F32(column) => column[row].into(),
            Self::F64(column) => column[row],
            Self::I32(column) => column[row].into(),
            Self::U32(column) => column[row].into(),
        }
    }

    /// Writes the numbers of `rows` to lanes.
    pub(super) fn fill<R: Real>(self, rows: Range<usize>, lanes: &mut [R]) {
        fn convert<R: Real>(lanes: &mut [R], column: &[impl Copy + Into<f64>]) {
            let pairs = lanes.iter_mut().zip(column);
            pairs.for_each(|(lane, &value)| *lane = R::from_f64(value.into()));
        }
        match self {
            Self::F32(column) => convert(lanes, &column[rows]),
            Self::F64(column) => convert(lanes, &column[rows]),
            Self::I32(column) => convert(lanes, &column[rows]),
            Self::U32(column) => convert(lanes, &column[rows]),
        }
    }
}

/// Columns of slices and of vectors.
macro_rules! from {
    ($($number:ty => $column:ident),*) => {$(
        impl<'a> From<&'a [$number]> for Input<'a> {
            fn from(column: &'a [$number]) -> Self {
                Self::$column(column)
            }
        }
        impl<'a> From<&'a Vec<$number>> for Input<'a> {
            fn from(column: &'a Vec<$number>) -> Self {
                Self::$column(column)
            }
        }
    )*};
}

from!(f32 => F32, f64 => F64, i32 => I32, u32 => U32);
