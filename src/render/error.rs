//! Why a scene could not be read or rendered.

use crate::effect::DomainError;
use crate::factor::LowRankError;
use crate::form::FormError;
use crate::gpu::GpuError;
use crate::measured::MeasuredError;

use super::compare::CompareError;
use super::image::{Image, ImageError};

/// What went wrong; every message names the file, and the key where there is one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The scene could not be read.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The scene is not TOML, or has a key or a type that a scene has not.
    #[error("{path}: {report}")]
    Toml {
        /// The file.
        path: String,
        /// Line, column and excerpt.
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
    /// A form that cannot shade a light of this kind.
    #[error("{name}: cannot shade a {kind}: {what}")]
    Unsuited {
        /// The fit or form.
        name: String,
        /// `sphere` or `polygon`.
        kind: &'static str,
        /// Expected and got.
        what: String,
    },
    /// An approximation that the scene has not.
    #[error("the scene has no approximation {at}")]
    NoApproximation {
        /// Its place, from 0.
        at: usize,
    },
    /// A form does not load or evaluate.
    #[error(transparent)]
    Form(#[from] FormError),
    /// Spectra do not load, or do not cover the wavelengths.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A diffraction table that cannot be factorised as asked.
    #[error(transparent)]
    LowRank(#[from] LowRankError),
    /// A diffraction table that cannot be made or used.
    #[error("{0}")]
    Simulation(String),
    /// Images that cannot be compared.
    #[error(transparent)]
    Compare(Box<CompareError>),
    /// An image cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The device fails before an image is begun.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The reference has no value somewhere.
    #[error("reference at view direction ({}, {}): {source}", view[0], view[1])]
    Reference {
        /// Direction cosines of the view in the frame of the scratch.
        view: [f64; 2],
        /// Argument, domain and value.
        source: DomainError,
    },
    /// An image was cut short; what is finished is kept in it, the rest is NaN.
    #[error("{name}: stopped after {finished} of {total} pixels: {source}")]
    Interrupted {
        /// The image.
        name: String,
        /// Pixels that are finished, row by row from the top.
        finished: usize,
        /// Pixels of the image.
        total: usize,
        /// The image so far.
        partial: Box<Image>,
        /// Why.
        source: Box<RenderError>,
    },
}

impl From<CompareError> for RenderError {
    fn from(error: CompareError) -> Self {
        Self::Compare(Box::new(error))
    }
}
