//! Images made tile by tile: progress shows, and what is finished is kept.
//!
//! A tile is as large as its time allows: each is timed, and the next has twice the pixels if it
//! took less than [`SHORT`], half if more than [`LONG`]; a tile is one dispatch of each kernel, or as
//! many as Monte Carlo has passes. A pixel does not depend on its tile, so neither does an image.

use std::ops::{Range, RangeInclusive};
use std::time::{Duration, Instant};

use super::error::RenderError;
use super::image::{Channel, Image};

/// Pixels of the first tile.
const FIRST_PIXELS: usize = 1024;
/// Pixels of any tile.
const TILE_PIXELS: RangeInclusive<usize> = 16..=65536;
/// A tile that took less is followed by one twice as large.
const SHORT: Duration = Duration::from_millis(100);
/// A tile that took more is followed by one half as large.
const LONG: Duration = Duration::from_millis(200);

/// What happens while a scene is rendered.
#[derive(Debug)]
pub enum Event<'a> {
    /// A tile is finished.
    Tile {
        /// The image.
        name: &'a str,
        /// Pixels that are finished.
        done: usize,
        /// Pixels of the image.
        of: usize,
    },
    /// An image is finished, or cut short: then the rest of it is NaN.
    Image {
        /// Its name.
        name: &'a str,
        /// The image.
        image: &'a Image,
        /// Whether it is whole.
        whole: bool,
    },
}

/// Makes an image of the named channels, `size` its width and height; `tile` returns one column each for a range of pixels,
/// counted row by row.
///
/// # Errors
/// [`RenderError::Interrupted`] with what is finished, from the first error of `tile`.
pub(super) fn image(
    name: &str,
    size: [usize; 2],
    channels: &[&str],
    watch: &mut dyn FnMut(Event<'_>),
    tile: impl FnMut(Range<usize>) -> Result<Vec<Vec<f32>>, RenderError>,
) -> Result<Image, RenderError> {
    in_tiles(name, size, channels, watch, tile, following)
}

/// Pixels of the tile after one of `pixels` that took `time`.
fn following(pixels: usize, time: Duration) -> usize {
    let next = match time {
        time if time < SHORT => 2 * pixels,
        time if time > LONG => pixels / 2,
        _ => pixels,
    };
    next.clamp(*TILE_PIXELS.start(), *TILE_PIXELS.end())
}

/// [`image()`] with another choice of the size of tiles.
fn in_tiles(
    name: &str,
    size: [usize; 2],
    channels: &[&str],
    watch: &mut dyn FnMut(Event<'_>),
    mut tile: impl FnMut(Range<usize>) -> Result<Vec<Vec<f32>>, RenderError>,
    following: impl Fn(usize, Duration) -> usize,
) -> Result<Image, RenderError> {
    let [width, height] = size;
    let total = width * height;
    let blank =
        |name: &&str| Channel { name: (*name).to_owned(), values: Vec::with_capacity(total) };
    let mut image = Image { width, height, channels: channels.iter().map(blank).collect() };
    let (mut start, mut pixels) = (0, FIRST_PIXELS);
    while start < total {
        let end = total.min(start + pixels);
        let begun = Instant::now();
        match tile(start..end) {
            Ok(columns) => {
                for (channel, column) in image.channels.iter_mut().zip(columns) {
                    channel.values.extend(column);
                }
            }
            Err(source) => {
                for channel in &mut image.channels {
                    channel.values.resize(total, f32::NAN);
                }
                watch(Event::Image { name, image: &image, whole: false });
                return Err(RenderError::Interrupted {
                    name: name.to_owned(),
                    finished: start,
                    total,
                    source: Box::new(source),
                });
            }
        }
        pixels = following(pixels, begun.elapsed());
        start = end;
        watch(Event::Tile { name, done: end, of: total });
    }
    Ok(image)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::GpuError;
    use crate::render::view::{Projection, View};

    #[test]
    fn finished_tiles_are_kept_when_the_device_is_lost() {
        let mut kept = None;
        let mut watch = |event: Event<'_>| {
            if let Event::Image { image, whole, .. } = event {
                kept = Some((image.clone(), whole));
            }
        };
        let tile = |pixels: Range<usize>| {
            if pixels.start >= 16384 {
                return Err(GpuError::Lost("unplugged".into()).into());
            }
            Ok(vec![vec![1.0; pixels.len()]; 3])
        };
        let channels = ["R", "G", "B"];
        let error =
            in_tiles("ours", [256, 128], &channels, &mut watch, tile, |pixels, _| pixels).err();
        let text = error.map(|error| error.to_string()).unwrap_or_default();
        assert!(text.starts_with("ours: stopped after 16384 of 32768 pixels"), "{text}");
        assert!(text.contains("the device was lost: unplugged"), "{text}");
        let (image, whole) = kept.expect("what is finished is handed over");
        let red = &image.channels[0].values;
        assert!(!whole && red[16383] == 1.0 && red[16384].is_nan() && red.len() == 32768);
    }

    #[test]
    fn tiles_follow_their_time_within_bounds() {
        let ms = Duration::from_millis;
        assert_eq!(following(1024, ms(3)), 2048);
        assert_eq!(following(1024, ms(150)), 1024);
        assert_eq!(following(1024, ms(900)), 512);
        assert_eq!((following(65536, ms(3)), following(16, ms(900))), (65536, 16));
    }

    #[test]
    fn an_image_does_not_depend_on_its_tiles() -> Result<(), RenderError> {
        let projection = Projection::Equirectangular;
        let view = View { width: 160, height: 80, exposure: 1.0, projection };
        let picture = |following: fn(usize, Duration) -> usize| {
            let tile = |pixels| Ok(view.directions(30.0, pixels).to_vec());
            in_tiles("ours", [160, 80], &["x", "y"], &mut |_| (), tile, following)
        };
        let whole = picture(|_, _| 1 << 20)?;
        assert_eq!(whole.channels[1].values.len(), 12800);
        assert_eq!(whole, picture(|pixels, _| (7 * pixels) % 613 + 1)?);
        Ok(())
    }
}
