//! Why a scene could not be read or rendered.

use crate::factor::LowRankError;
use crate::form::FormError;
use crate::gpu::GpuError;
use crate::measured::MeasuredError;

use super::compare::CompareError;
use super::image::ImageError;

/// What went wrong; every message names the file, and the key where there is one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The scene cannot be read, or is not TOML.
    #[error("{path}: {report}")]
    Toml {
        /// The file.
        path: String,
        /// What the system said, or line, column and excerpt.
        report: String,
    },
    /// A value in the scene makes no sense.
    #[error("{path}: {key}: {what}")]
    Value {
        /// The file, and the line where it is known.
        path: String,
        /// The key, as in `light[0].radius`.
        key: String,
        /// Expected and got.
        what: String,
    },
    /// A form that does not shade a light, a table that cannot be made, an approximation that is not
    /// there, a reference that has no value somewhere: its name, expected and got.
    #[error("{0}")]
    Unusable(String),
    /// A form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// Spectra do not load, or do not cover the wavelengths.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A diffraction table that cannot be factorised as asked.
    #[error(transparent)]
    LowRank(#[from] LowRankError),
    /// Images that cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// An image cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The device fails before an image is begun.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// An image was cut short; what is finished was handed over, the rest is NaN.
    #[error("{name}: stopped after {finished} of {total} pixels: {source}")]
    Interrupted {
        /// The image.
        name: String,
        /// Pixels that are finished, row by row from the top.
        finished: usize,
        /// Pixels of the image.
        total: usize,
        /// Why.
        source: Box<RenderError>,
    },
}

impl RenderError {
    /// An approximation at a place, from 0, that the scene has not.
    pub(super) fn no_approximation(at: usize) -> Self {
        Self::Unusable(format!("the scene has no approximation {at}"))
    }
}
