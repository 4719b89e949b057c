//! How plots are drawn as SVG.
//!
//! [`draw`] lays out the plots of a figure with one legend under
//! them, outside every plot area, and draws them with plotters. Colours are the Okabe–Ito palette,
//! shifted in lightness to stand out on light and on dark grounds; dashes and marker shapes repeat
//! the distinction, so colour is never the only cue. Same input, same bytes.

mod draw;
mod frame;
mod frontier;
mod ink;
mod labels;
mod legend;
mod lettering;
mod panel;
mod scale;
mod series;
mod surface;

pub use draw::{Drawing, draw};
pub use frame::Rect;
pub use frontier::frontier;
pub use ink::dark_rules;
