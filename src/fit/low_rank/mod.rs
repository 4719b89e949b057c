//! Low-rank factors of two-dimensional kernels (toisoul2017 §4).

mod factors;

pub use factors::{Alignment, ChannelFactors, DirectionalKernel, LowRank};
