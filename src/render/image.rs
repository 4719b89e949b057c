//! Images: named channels of f32 over one grid of pixels.

/// An image. Rows from top to bottom, pixels from left to right; a pixel's centre is half a pixel
/// from its edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// The channels, each of `width · height` values.
    pub channels: Vec<Channel>,
}

/// A channel of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// `R`, `G`, `B`, or `stderr.R` and so on for the standard error of a channel.
    pub name: String,
    /// The values, row by row; linear, not clamped.
    pub values: Vec<f32>,
}

impl Image {
    /// An image of linear sRGB colours, row by row.
    pub fn rgb(width: usize, height: usize, colours: &[[f32; 3]]) -> Self {
        let channel = |(at, name): (usize, &str)| Channel {
            name: name.to_owned(),
            values: colours.iter().map(|colour| colour[at]).collect(),
        };
        Self {
            width,
            height,
            channels: ["R", "G", "B"].into_iter().enumerate().map(channel).collect(),
        }
    }

    /// The channel called `name`.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }
}
