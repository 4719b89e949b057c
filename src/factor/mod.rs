//! Low-rank factors of two-dimensional kernels (toisoul2017 §4).
//!
//! A diffraction table S(h), seen under an environment, is a convolution (eq. 7), which a shader can
//! afford only in passes of one dimension: S ≈ Σ_m v_m(h_y) h_m(h_x), per channel. What "≈" means
//! decides which factors are best:
//!
//! | function | what is least |
//! |---|---|
//! | [`Decomposition`] | the Frobenius error of each channel: the paper's choice |
//! | [`shared()`] | the same over all channels, with one pair of spatial factors for all |
//! | [`weighted()`] | the error under the factor (1 + ω_i·ω_o)²/4 that a texel is seen with |
//! | [`convolved()`] | the error after the convolution with environments, which is what is seen |
//! | [`nonnegative()`] | the Frobenius error among factors that are not negative |
//!
//! A table whose main directions are not the axes is straightened first ([`main_directions()`],
//! [`aligned`]); one whose orders lie on a few lines is integrated across them ([`directional()`]).
//!
//! # Signs and repeated values
//! A term's sign is free: v_m h_mᵀ = (−v_m)(−h_m)ᵀ. Here the entries of v_m sum to 0 or more; where
//! they cancel, to rounding, the first of the largest entries is positive. In further channels, a
//! term whose v_m lies within 60° of a line with the first channel's points the same way. Singular
//! values within 1e-12 of the largest of each other are taken as repeated, and their vectors chosen
//! from the space that they span, as localised as it allows; values within rounding of 0, and their
//! vectors, are 0.
//!
//! # Numbers
//! All sums run in one order, so results are the same for any number of threads.

mod alignment;
mod convolution_norm;
mod convolved;
mod decomposition;
mod directional;
mod error;
mod files;
mod fourier;
mod illumination;
mod low_rank;
mod main_directions;
mod matrix;
mod methods;
mod nonnegative;
mod shared;
mod terms;
mod weighted;

pub use alignment::{Alignment, aligned};
pub use convolution_norm::{ConvolutionNorm, NormOptions, seen_error};
pub use convolved::{ConvolvedOptions, ConvolvedReport, convolved};
pub use decomposition::{Decomposition, SingularSpectrum};
pub use directional::{Directional, DirectionalKernel, directional};
pub use error::LowRankError;
pub use illumination::Radiance;
pub use low_rank::{ChannelFactors, LowRank};
pub use main_directions::{MainDirections, SearchOptions, main_directions};
pub use methods::Stopping;
pub use nonnegative::nonnegative;
pub use shared::{Shared, shared};
pub use weighted::{Weight, weighted};
