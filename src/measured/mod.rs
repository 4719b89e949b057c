//! Measured data: one reader per outside format, and the data sets that come with the crate.
//!
//! [`import`] turns a file of an outside format into a table, a height map or an environment map.
//! [`optical_constants`] and [`spectra`] load what `data/measured/` holds.

mod dispersion;
pub mod environment;
mod environment_file;
mod environment_resized;
mod error;
pub mod height_map;
mod import;
pub mod optical_constants;
pub mod pattern;
mod portable_float_map;
pub mod refractive_index;
mod samples;
pub mod spectra;
pub mod srgb;
mod tabulation;

pub use self::dispersion::Dispersion;
pub use self::environment::{Environment, LatLong, Negative};
pub use self::error::MeasuredError;
pub use self::height_map::HeightMap;
pub use self::import::{Content, Imported, import};
pub(crate) use self::pattern::decoded_png;
pub use self::pattern::{Encoding, Pattern};
