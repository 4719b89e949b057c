//! How plots are drawn as SVG.
//!
//! [`draw`] lays out the plots of a figure with one legend under
//! them, outside every plot area, and writes the elements. Colours are the Okabe–Ito palette,
//! shifted in lightness to stand out on light and on dark grounds; dashes and marker shapes repeat
//! the distinction, so colour is never the only cue. Same input, same bytes.

mod canvas;
mod draw;
mod frame;
mod frontier;
mod labels;
mod legend;
mod lettering;
mod panel;
mod scale;
mod series;

pub use canvas::dark_rules;
pub use draw::{Drawing, draw};
pub use frame::Rect;
pub use frontier::frontier;
