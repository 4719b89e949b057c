//! Contact sheets: images beside each other, as figs. 8 and 9 of velinov2018 show them.

use super::compare::error_map::ErrorMap;
use super::error::RenderError;
use super::image::{Channel, Image};
use super::rendered::Rendered;
use crate::measured::srgb::decoded;

/// Pixels between images.
const GAP: usize = 4;
/// Value of the gaps: above what is displayed, so that it shows white at any exposure from 0.01.
const GAP_VALUE: f32 = 100.0;
/// Share of the pixels whose errors may go beyond the scale that the errors are shown on: a few
/// highlights would leave everything else black.
const BEYOND: f64 = 0.005;

/// The reference, with Monte Carlo beside it (black if there is none), and below it each approximation
/// with its error in false colours, all on one scale, which is returned too.
///
/// # Errors
/// [`RenderError::Compare`] if images do not match.
pub fn comparison(rendered: &Rendered, exposure: f64) -> Result<(Image, f64), RenderError> {
    let (found, reference) = (&rendered.approximations, &rendered.reference);
    let pictures: Vec<&Image> = found.iter().map(|a| &a.picture.image).collect();
    let scale = found.iter().map(|a| a.error.covering(BEYOND)).fold(0.0, f64::max);
    let scale = if scale > 0.0 { scale.min(1.0) } else { 1.0 };
    let colour =
        |rgb: [u8; 3]| rgb.map(|byte| (decoded(f64::from(byte) / 255.0) / exposure) as f32);
    let error = |image: &&Image| -> Result<Image, RenderError> {
        let map = ErrorMap::relative(image, reference, Some(scale))?;
        let colours: Vec<[f32; 3]> = map.pixels().into_iter().map(colour).collect();
        Ok(Image::rgb(reference.width, reference.height, &colours))
    };
    let errors = pictures.iter().map(error).collect::<Result<Vec<_>, _>>()?;
    let pixels = reference.width * reference.height;
    let blank = Image::rgb(reference.width, reference.height, &vec![[0.0; 3]; pixels]);
    let noisy = rendered.monte_carlo.as_ref().map_or(&blank, |of| &of.sampled.image);
    let mut images = vec![reference, noisy];
    for (image, error) in pictures.iter().zip(&errors) {
        images.extend([*image, error]);
    }
    Ok((side_by_side(&images, 2), scale))
}

/// The R, G, B of the images in rows of `across`, from left to right and top to bottom, with white
/// gaps. Cells are as large as the largest image.
fn side_by_side(images: &[&Image], across: usize) -> Image {
    let across = across.clamp(1, images.len().max(1));
    let down = images.len().div_ceil(across);
    let cell_width = images.iter().map(|image| image.width).max().unwrap_or(0);
    let cell_height = images.iter().map(|image| image.height).max().unwrap_or(0);
    let width = (across * (cell_width + GAP)).saturating_sub(GAP);
    let height = (down * (cell_height + GAP)).saturating_sub(GAP);
    let channels = ["R", "G", "B"].map(|name| {
        let mut values = vec![GAP_VALUE; width * height];
        for (at, image) in images.iter().enumerate() {
            let Some(channel) = image.channel(name) else { continue };
            let (left, top) =
                ((at % across) * (cell_width + GAP), (at / across) * (cell_height + GAP));
            for (row, pixels) in channel.values.chunks(image.width.max(1)).enumerate() {
                let start = (top + row) * width + left;
                if let Some(place) = values.get_mut(start..start + pixels.len()) {
                    place.copy_from_slice(pixels);
                }
            }
        }
        Channel { name: name.to_owned(), values }
    });
    Image { width, height, channels: channels.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_keep_their_pixels() {
        let image = |value: f32| Image::rgb(2, 1, &[[value; 3], [value + 1.0; 3]]);
        let (a, b, c) = (image(1.0), image(3.0), image(5.0));
        let sheet = side_by_side(&[&a, &b, &c], 2);
        assert_eq!((sheet.width, sheet.height), (2 * 2 + GAP, 2 + GAP));
        let red = &sheet.channels[0].values;
        assert_eq!(red[..2], [1.0, 2.0]);
        assert_eq!(red[2], GAP_VALUE);
        assert_eq!(red[2 + GAP..4 + GAP], [3.0, 4.0]);
        let last = (1 + GAP) * sheet.width;
        assert_eq!(red[last..last + 2], [5.0, 6.0]);
    }
}
