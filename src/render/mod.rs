//! Rendering: scenes, reference and approximations of them as images, and how images compare.

pub mod image;
