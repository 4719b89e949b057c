//! What a factorisation gives: separable kernels, aligned or not, and kernels along lines.

use crate::table::Axis;

/// A kernel as a sum of products: K(a) = Σ_m vertical\[m\](a_y) · horizontal\[m\](a_x), with
/// a = [`Alignment::matrix`] · h.
#[derive(Debug, Clone, PartialEq)]
pub struct LowRank {
    /// Axis of the horizontal factors, in aligned coordinates.
    pub x: Axis,
    /// Axis of the vertical factors, in aligned coordinates.
    pub y: Axis,
    /// One per channel of the table, in its order.
    pub channels: Vec<ChannelFactors>,
    /// From h to the coordinates of the axes.
    pub alignment: Alignment,
}

/// The factors of one channel, largest first.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelFactors {
    /// Name of the channel.
    pub name: String,
    /// `vertical[m][iy]`: one list of `y.count` values per term.
    pub vertical: Vec<Vec<f64>>,
    /// `horizontal[m][ix]`: one list of `x.count` values per term.
    pub horizontal: Vec<Vec<f64>>,
}

/// The affine map that straightens a table about h = 0 (toisoul2017 §4.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// a = matrix · h, rows first. The columns of its inverse are the directions in h along which
    /// the two axes of the factors run.
    pub matrix: [[f64; 2]; 2],
}

/// A kernel along a line through h = 0, integrated across it: K(h) ≈ line(h·d) δ(h·e), e ⟂ d.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionalKernel {
    /// Unit vector d in h.
    pub direction: [f64; 2],
    /// Axis along the line, in the length of h.
    pub axis: Axis,
    /// Name and one value per texel of `axis`, per channel of the table: the table integrated
    /// across the line, so that Σ line · Δs is the energy of the line.
    pub channels: Vec<(String, Vec<f64>)>,
}
