//! Pictures of errors in false colours.
//!
//! The colours are magma (van der Walt and Smith), whose lightness rises evenly from black to a
//! light yellow: 256 steps, step ⌊255 v + 1/2⌋ for v = error/scale, larger errors in the last
//! colour. Where an error is not finite, the pixel is green, which magma does not have.

use std::path::Path;

use super::colour_map::{MAGMA, NOT_FINITE};
use super::flip::FlipMap;
use super::metrics::matched;
use super::{CompareError, legend};
use crate::render::image::{Channel, Image, ImageError, write_pixels};

/// An error per pixel, and the scale on which it is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMap {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// The errors, row by row, not below 0.
    pub errors: Vec<f64>,
    /// The error that has the last colour.
    pub scale: f64,
}

impl ErrorMap {
    /// Magnitude of the error relative to the reference as a whole: the root mean square over the
    /// channels of each pixel's error, over the root mean square of the reference. The root mean
    /// square of the map is then the relative RMS error of the image. Without a scale it is the
    /// largest error rounded up to 1, 2 or 5 times a power of ten.
    ///
    /// # Errors
    /// [`CompareError`]: sizes or channels that differ, a scale that is not positive.
    pub fn relative(
        test: &Image,
        reference: &Image,
        scale: Option<f64>,
    ) -> Result<Self, CompareError> {
        let matched = matched(test, reference)?;
        let pixels = test.width * test.height;
        let mut squares = vec![0.0; pixels];
        let mut reference_squares = 0.0;
        for (tested, expected) in &matched {
            for ((square, a), b) in squares.iter_mut().zip(&tested.values).zip(&expected.values) {
                let (a, b) = (f64::from(*a), f64::from(*b));
                *square += (a - b) * (a - b);
                if b.is_finite() {
                    reference_squares += b * b;
                }
            }
        }
        let mean = reference_squares / pixels as f64;
        let error = |square: f64| if square == 0.0 { 0.0 } else { (square / mean).sqrt() };
        let errors: Vec<f64> = squares.into_iter().map(error).collect();
        let finite = errors.iter().copied().filter(|error| error.is_finite());
        let scale = scale.unwrap_or_else(|| rounded_up(finite.fold(0.0, f64::max)));
        if !(scale.is_finite() && scale > 0.0) {
            return Err(CompareError::Setting {
                what: "scale of the error map",
                expected: "a positive number",
                got: scale,
            });
        }
        Ok(Self { width: test.width, height: test.height, errors, scale })
    }

    /// FLIP on its own scale, 0 to 1: the standard's picture.
    pub fn of_flip(map: &FlipMap) -> Self {
        let errors = map.values.iter().map(|value| f64::from(*value)).collect();
        Self { width: map.width, height: map.height, errors, scale: 1.0 }
    }

    /// The scale, 1, 2 or 5 times a power of ten, beyond which at most `share` of the finite errors lie.
    pub fn covering(&self, share: f64) -> f64 {
        let mut finite: Vec<f64> = self.errors.iter().copied().filter(|e| e.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let beyond = (share * finite.len() as f64) as usize;
        finite
            .len()
            .checked_sub(1 + beyond)
            .and_then(|at| finite.get(at))
            .map_or(1.0, |e| rounded_up(*e))
    }

    /// The errors as an image of one channel, `error`.
    pub fn image(&self) -> Image {
        let values = self.errors.iter().map(|error| *error as f32).collect();
        let channels = vec![Channel { name: "error".into(), values }];
        Image { width: self.width, height: self.height, channels }
    }

    /// sRGB-encoded false colours, row by row.
    pub fn pixels(&self) -> Vec<[u8; 3]> {
        let colour = |error: &f64| match error / self.scale {
            share if share.is_finite() => MAGMA[(255.0 * share.clamp(0.0, 1.0) + 0.5) as usize],
            _ => NOT_FINITE,
        };
        self.errors.iter().map(colour).collect()
    }

    /// Writes the false colours as a PNG, whole or not at all; with `legend`, a bar of the colours
    /// from 0 to the scale stands under the picture.
    ///
    /// # Errors
    /// [`ImageError::File`] if the file cannot be written.
    pub fn write_png(&self, path: impl AsRef<Path>, legend: bool) -> Result<(), ImageError> {
        let mut pixels = self.pixels();
        let mut height = self.height;
        if legend {
            let strip = legend::strip(self.width, self.scale);
            height += strip.len() / self.width;
            pixels.extend(strip);
        }
        write_pixels(path.as_ref(), self.width, height, &pixels)
    }
}

/// 1, 2 or 5 times a power of ten, the first that is not below `value`; 1 for 0.
fn rounded_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 1.0;
    }
    let power = 10.0_f64.powi(value.log10().floor() as i32);
    let steps = [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * power);
    steps.into_iter().find(|step| *step >= value).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::compare::metrics::ImageDifference;

    #[test]
    fn the_map_has_the_relative_rms_of_the_image() {
        let reference = Image::rgb(2, 1, &[[1.0, 2.0, 3.0], [0.5, 0.0, 4.0]]);
        let test = Image::rgb(2, 1, &[[1.1, 2.0, 2.9], [0.5, 0.3, 4.0]]);
        let map = ErrorMap::relative(&test, &reference, None).expect("they match");
        let rms = (map.errors.iter().map(|e| e * e).sum::<f64>() / 2.0).sqrt();
        let stated = ImageDifference::of(&test, &reference).expect("they match").all.relative_rms;
        assert!((rms - stated).abs() < 1e-12 * stated, "{rms} for {stated}");
        assert_eq!(map.scale, 0.1);
    }

    #[test]
    fn colours_of_the_ends_and_of_nothing() {
        let map =
            ErrorMap { width: 4, height: 1, errors: vec![0.0, 1.0, 7.0, f64::NAN], scale: 1.0 };
        assert_eq!(map.pixels(), [MAGMA[0], MAGMA[255], MAGMA[255], NOT_FINITE]);
    }

    #[test]
    fn scales_are_round() {
        for (value, scale) in [(0.0, 1.0), (0.011, 0.02), (3.0, 5.0), (0.5, 0.5), (6.0, 10.0)] {
            assert_eq!(rounded_up(value), scale);
        }
    }
}
