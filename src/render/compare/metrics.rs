//! Plain errors: mean, RMS, relative RMS, maximum and where.

use super::CompareError;
use crate::render::image::{Channel, Image, ImageError};

/// How a list of numbers differs from a reference, number by number.
///
/// A number that is not finite, on either side, makes all errors NaN: it is counted, never skipped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Mean of the tested numbers.
    pub mean: f64,
    /// Mean of the reference.
    pub reference_mean: f64,
    /// Root of the mean squared error.
    pub rms: f64,
    /// RMS error over the root mean square of the reference: 0 where both vanish, infinite where
    /// only the reference does.
    pub relative_rms: f64,
    /// Largest magnitude of the error.
    pub max: f64,
    /// Where it is first reached; where the first number that is not finite stands, if there is one.
    pub max_at: usize,
    /// Tested numbers that are not finite.
    pub non_finite: usize,
    /// Numbers of the reference that are not finite.
    pub reference_non_finite: usize,
}

impl Difference {
    /// Compares pairs (tested, reference); `None` if there are none.
    pub fn of(pairs: impl IntoIterator<Item = (f64, f64)>) -> Option<Self> {
        let pairs: Vec<(f64, f64)> = pairs.into_iter().collect();
        let n = pairs.len() as f64;
        if pairs.is_empty() {
            return None;
        }
        let sum = |of: fn(f64, f64) -> f64| pairs.iter().map(|(a, b)| of(*a, *b)).sum::<f64>();
        let count = |of: fn(f64, f64) -> bool| pairs.iter().filter(|(a, b)| of(*a, *b)).count();
        let squares = sum(|value, reference| (value - reference).powi(2));
        let reference_squares = sum(|_, reference| reference * reference);
        let relative_rms = if squares == 0.0 { 0.0 } else { (squares / reference_squares).sqrt() };
        let first_non_finite = pairs.iter().position(|(a, b)| !(a.is_finite() && b.is_finite()));
        let errors = pairs.iter().map(|(value, reference)| (value - reference).abs()).enumerate();
        let larger =
            |most: (usize, f64), next: (usize, f64)| if next.1 > most.1 { next } else { most };
        let (max_at, max) = errors.fold((0, -1.0), larger);
        let sound = |value: f64| if first_non_finite.is_some() { f64::NAN } else { value };
        Some(Self {
            mean: sum(|value, _| value) / n,
            reference_mean: sum(|_, reference| reference) / n,
            rms: sound((squares / n).sqrt()),
            relative_rms: sound(relative_rms),
            max: sound(max),
            max_at: first_non_finite.unwrap_or(max_at),
            non_finite: count(|value, _| !value.is_finite()),
            reference_non_finite: count(|_, reference| !reference.is_finite()),
        })
    }
}

/// How an image differs from a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageDifference {
    /// Over all channels together; `max_at` is an index into [`ImageDifference::channels`] times
    /// the number of pixels, plus the pixel: see [`ImageDifference::max_place`].
    pub all: Difference,
    /// Per channel, by name.
    pub channels: Vec<(String, Difference)>,
    width: usize,
    pixels: usize,
}

/// A value of an image.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Column, from 0 at the left.
    pub x: usize,
    /// Row, from 0 at the top.
    pub y: usize,
    /// The channel.
    pub channel: String,
}

impl ImageDifference {
    /// Compares all channels but the standard errors.
    ///
    /// # Errors
    /// As [`matched`].
    pub fn of(test: &Image, reference: &Image) -> Result<Self, CompareError> {
        let matched = matched(test, reference)?;
        let pairs = |(test, reference): (&Channel, &Channel)| {
            let pair = |(a, b): (&f32, &f32)| (f64::from(*a), f64::from(*b));
            test.values.iter().zip(&reference.values).map(pair).collect::<Vec<_>>()
        };
        let lists: Vec<Vec<(f64, f64)>> = matched.iter().map(|channels| pairs(*channels)).collect();
        let channels = matched
            .iter()
            .zip(&lists)
            .filter_map(|((channel, _), list)| {
                Some((channel.name.clone(), Difference::of(list.iter().copied())?))
            })
            .collect();
        let all = Difference::of(lists.into_iter().flatten()).ok_or(CompareError::Channels {
            test: test.names().join(", "),
            reference: reference.names().join(", "),
        })?;
        Ok(Self { all, channels, width: test.width, pixels: test.width * test.height })
    }

    /// Where the largest error of all channels is, or the first value that is not finite.
    pub fn max_place(&self) -> Place {
        let channel = self.channels.get(self.all.max_at / self.pixels);
        let pixel = self.all.max_at % self.pixels;
        Place {
            x: pixel % self.width,
            y: pixel / self.width,
            channel: channel.map(|(name, _)| name.clone()).unwrap_or_default(),
        }
    }

    /// Column and row of the pixel with index `at` ([`Difference::max_at`] of one channel).
    pub fn pixel(&self, at: usize) -> (usize, usize) {
        (at % self.width, at / self.width)
    }
}

/// The quantities of two images in pairs (test, reference), in the order of the reference.
///
/// # Errors
/// [`CompareError`]: an image that is not whole, different sizes, different channels; standard
/// errors may be in either image, both or none.
pub fn matched<'a>(
    test: &'a Image,
    reference: &'a Image,
) -> Result<Vec<(&'a Channel, &'a Channel)>, CompareError> {
    test.check().map_err(|fault| unusable(TEST, &fault))?;
    reference.check().map_err(|fault| unusable(REFERENCE, &fault))?;
    if (test.width, test.height) != (reference.width, reference.height) {
        return Err(CompareError::Size {
            test: (test.width, test.height),
            reference: (reference.width, reference.height),
        });
    }
    let pairs: Vec<_> = reference
        .quantities()
        .filter_map(|channel| Some((test.channel(&channel.name)?, channel)))
        .collect();
    let same = pairs.len() == reference.quantities().count()
        && pairs.len() == test.quantities().count()
        && !pairs.is_empty();
    if !same {
        let names = |image: &Image| {
            image.quantities().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ")
        };
        return Err(CompareError::Channels { test: names(test), reference: names(reference) });
    }
    Ok(pairs)
}

/// Names of the two images in messages.
pub(super) const TEST: &str = "test image";
pub(super) const REFERENCE: &str = "reference";

/// That one of the images cannot be used.
pub(super) fn unusable(which: &str, fault: &ImageError) -> CompareError {
    CompareError::Unusable(format!("the {which}: {fault}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(values: &[f32]) -> Image {
        Image {
            width: 2,
            height: values.len() / 2,
            channels: vec![Channel { name: "Y".into(), values: values.to_vec() }],
        }
    }

    #[test]
    fn errors_of_four_numbers() {
        let pairs = [(1.0, 1.0), (2.0, 1.0), (0.0, 2.0), (3.0, 3.0)];
        let difference = Difference::of(pairs).expect("there are pairs");
        assert_eq!((difference.mean, difference.reference_mean), (1.5, 1.75));
        assert_eq!(difference.rms, (5.0_f64 / 4.0).sqrt());
        assert_eq!(difference.relative_rms, (5.0_f64 / 15.0).sqrt());
        assert_eq!((difference.max, difference.max_at), (2.0, 2));
    }

    #[test]
    fn what_is_not_finite_fails_and_is_named() {
        let test = image(&[1.0, 1.0, f32::NAN, 1.0]);
        let difference = ImageDifference::of(&test, &image(&[1.0; 4])).expect("same size");
        assert!(difference.all.rms.is_nan() && difference.all.max.is_nan());
        assert!(difference.all.relative_rms.is_nan() && difference.all.mean.is_nan());
        assert_eq!((difference.all.non_finite, difference.all.reference_non_finite), (1, 0));
        assert_eq!(difference.max_place(), Place { x: 0, y: 1, channel: "Y".into() });
        // Also where both have the same infinity, whose difference would be NaN and be lost.
        let infinite = [(f64::INFINITY, f64::INFINITY), (1.0, 1.0)];
        assert!(Difference::of(infinite).expect("pairs").max.is_nan());
    }

    #[test]
    fn relative_to_nothing() {
        let relative = |pair| Difference::of([pair]).expect("a pair").relative_rms;
        assert_eq!(relative((0.0, 0.0)), 0.0);
        assert_eq!(relative((1.0, 0.0)), f64::INFINITY);
        assert!(Difference::of([]).is_none());
    }

    #[test]
    fn sizes_and_channels_must_match() {
        let refused = ImageDifference::of(&image(&[1.0; 4]), &image(&[1.0; 6]));
        assert!(matches!(refused, Err(CompareError::Size { test: (2, 2), reference: (2, 3) })));
        let mut other = image(&[1.0; 4]);
        other.channels[0].name = "Z".into();
        let refused = ImageDifference::of(&image(&[1.0; 4]), &other);
        assert!(matches!(refused, Err(CompareError::Channels { .. })));
        // Standard errors in one of them are no difference.
        let mut noisy = image(&[1.0; 4]);
        noisy.channels.push(Channel { name: "stderr.Y".into(), values: vec![0.1; 4] });
        assert_eq!(ImageDifference::of(&noisy, &image(&[1.0; 4])).expect("same").all.rms, 0.0);
    }
}
