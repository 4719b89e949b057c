//! FLIP: the error that an observer sees when two images alternate.
//!
//! LDR-FLIP: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
//! HDR-FLIP: Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images",
//! Eurographics 2021. 0 is no visible difference, 1 the largest.
//!
//! Computed as the authors' evaluator 1.7 does, in f64 where it has f32; the two agree to 3e-6 on
//! every pixel of `tests/oracles/flip.py`.
//!
//! | symbol | here |
//! |---|---|
//! | p, pixels per degree | `pixels_per_degree` |
//! | q_c = 0.7, p_c = 0.4, p_t = 0.95 | exponent and knee of the colour difference |
//! | q_f = 0.5, w = 0.082° | exponent of the feature difference, width of the detector |
//! | ΔE_c, ΔE_f | colour and feature difference; ΔE = ΔE_c^(1 − ΔE_f) |

use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::colour_difference::{ColourDifference, opponent};
use super::convolution::{Plane, feature_kernels, spatial_kernels};
use super::metrics::{REFERENCE, TEST, matched, unusable};
use super::{CompareError, Exposures};
use crate::render::image::Image;

/// Pixels per degree of the standard observer: 0.7 m from a display 0.7 m and 3840 pixels wide,
/// 3840 · π/180.
pub const STANDARD_PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// Pixels per degree that FLIP is defined for here: filters of at least a pixel, at most some
/// thousand pixels wide.
const PIXELS_PER_DEGREE: RangeInclusive<f64> = 1.0..=1000.0;
/// Exposures of LDR-FLIP, in stops.
const EXPOSURES: RangeInclusive<f64> = -100.0..=100.0;
/// Exposures of HDR-FLIP, in stops: what the luminances of f32 images need, and some more.
const HDR_EXPOSURES: RangeInclusive<f64> = -200.0..=200.0;
/// Numbers of exposures of HDR-FLIP.
const HDR_COUNTS: RangeInclusive<f64> = 2.0..=400.0;

/// Exponent of the difference of features.
const FEATURE_EXPONENT: f64 = 0.5;

/// Visible error per pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct FlipMap {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// FLIP of each pixel, in [0, 1], row by row; NaN near pixels that are not finite.
    pub values: Vec<f32>,
    /// Mean over the pixels: the number that is quoted. NaN if any is.
    pub mean: f64,
    /// Negative components of either image, which no display shows: they count as 0.
    pub negative: usize,
}

/// LDR-FLIP of the two images as a display shows them: times 2^`exposure`, clamped to [0, 1].
/// An exposure of 0 is the standard.
///
/// # Errors
/// [`CompareError`]: sizes or channels that differ, no colours; [`CompareError::Setting`] for
/// `pixels_per_degree` outside [1, 1000] or an exposure outside [-100, 100].
pub fn ldr_flip(
    test: &Image,
    reference: &Image,
    exposure: f64,
    pixels_per_degree: f64,
) -> Result<FlipMap, CompareError> {
    setting("exposure in stops", "a number from -100 to 100", EXPOSURES, exposure)?;
    let pair = Pair::of(test, reference, pixels_per_degree)?;
    let gain = exposure.exp2();
    let values = pair.ldr_flip(|component| (component * gain).clamp(0.0, 1.0), pixels_per_degree);
    Ok(pair.map(values))
}

/// HDR-FLIP: the largest LDR-FLIP of each pixel over the exposures, tone-mapped with the ACES curve.
///
/// # Errors
/// As [`ldr_flip`], with exposures within [-200, 200], 2 to 400 of them.
pub fn hdr_flip(
    test: &Image,
    reference: &Image,
    exposures: &Exposures,
    pixels_per_degree: f64,
) -> Result<FlipMap, CompareError> {
    for exposure in [exposures.start, exposures.stop] {
        setting("exposure in stops", "a number from -200 to 200", HDR_EXPOSURES, exposure)?;
    }
    setting("number of exposures", "2 to 400", HDR_COUNTS, exposures.count as f64)?;
    let pair = Pair::of(test, reference, pixels_per_degree)?;
    let mut largest = vec![0.0; pair.width * pair.height];
    for exposure in exposures.stops() {
        let gain = exposure.exp2();
        let shown = |component: f64| super::exposures::aces(component * gain).clamp(0.0, 1.0);
        let values = pair.ldr_flip(shown, pixels_per_degree);
        for (largest, value) in largest.iter_mut().zip(values) {
            // A NaN stays one.
            if value > *largest || value.is_nan() {
                *largest = value;
            }
        }
    }
    Ok(pair.map(largest))
}

/// Whether `got` lies in its range; a NaN does not.
fn setting(
    what: &'static str,
    expected: &'static str,
    range: RangeInclusive<f64>,
    got: f64,
) -> Result<(), CompareError> {
    if range.contains(&got) { Ok(()) } else { Err(CompareError::Setting { what, expected, got }) }
}

/// Two images of one size.
struct Pair {
    width: usize,
    height: usize,
    test: Vec<[f64; 3]>,
    reference: Vec<[f64; 3]>,
    negative: usize,
}

impl Pair {
    fn of(test: &Image, reference: &Image, pixels_per_degree: f64) -> Result<Self, CompareError> {
        let expected = "a number from 1 to 1000";
        setting("pixels per degree", expected, PIXELS_PER_DEGREE, pixels_per_degree)?;
        matched(test, reference)?;
        let mut negative = 0;
        let mut components = |which, image: &Image| -> Result<Vec<[f64; 3]>, CompareError> {
            let mut component = |value: f32| {
                negative += usize::from(value < 0.0);
                if value.is_finite() { f64::from(value.max(0.0)) } else { f64::NAN }
            };
            let colours = image.colours().map_err(|fault| unusable(which, &fault))?;
            Ok(colours.into_iter().map(|colour| colour.map(&mut component)).collect())
        };
        let (test_colours, expected) = (components(TEST, test)?, components(REFERENCE, reference)?);
        let (width, height) = (test.width, test.height);
        Ok(Self { width, height, test: test_colours, reference: expected, negative })
    }

    fn map(&self, values: Vec<f64>) -> FlipMap {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        FlipMap {
            width: self.width,
            height: self.height,
            values: values.into_iter().map(|value| value as f32).collect(),
            mean,
            negative: self.negative,
        }
    }

    /// LDR-FLIP per pixel of what `shown` makes of every component: linear sRGB in [0, 1].
    fn ldr_flip(&self, shown: impl Fn(f64) -> f64 + Sync, pixels_per_degree: f64) -> Vec<f64> {
        let seen = |colours: &[[f64; 3]]| self.seen(colours, &shown, pixels_per_degree);
        let (test, reference) = (seen(&self.test), seen(&self.reference));
        let colour_difference = ColourDifference::new();
        (0..self.width * self.height)
            .into_par_iter()
            .map(|at| {
                let colour = colour_difference.of(test.colour(at), reference.colour(at));
                let edge = (test.edge.values[at] - reference.edge.values[at]).abs();
                let point = (test.point.values[at] - reference.point.values[at]).abs();
                let strongest = if edge > point { edge } else { point };
                let feature =
                    core_math::pow(strongest * std::f64::consts::FRAC_1_SQRT_2, FEATURE_EXPONENT);
                if colour.is_nan() || feature.is_nan() {
                    return f64::NAN;
                }
                core_math::pow(colour, 1.0 - feature)
            })
            .collect()
    }

    fn seen(
        &self,
        colours: &[[f64; 3]],
        shown: &(impl Fn(f64) -> f64 + Sync),
        pixels_per_degree: f64,
    ) -> Seen {
        let opponent: Vec<[f64; 3]> =
            colours.par_iter().map(|colour| opponent(colour.map(shown))).collect();
        let plane = |component: &(dyn Fn(&[f64; 3]) -> f64 + Sync)| Plane {
            width: self.width,
            height: self.height,
            values: opponent.iter().map(component).collect(),
        };
        let spatial = spatial_kernels(pixels_per_degree);
        let blurred =
            |plane: &Plane, kernel: &[f64]| plane.along_rows(kernel).along_columns(kernel);
        let (blue_yellow, [first, second]) = (plane(&|c| c[2]), &spatial.blue_yellow);
        let blue_yellow = blurred(&blue_yellow, first).plus(&blurred(&blue_yellow, second));

        let feature = feature_kernels(pixels_per_degree);
        let grey = plane(&|c| (c[0] + 16.0) / 116.0);
        let smooth = grey.along_rows(&feature.gaussian);
        let across = |kernel: &[f64]| grey.along_rows(kernel).along_columns(&feature.gaussian);
        Seen {
            luminance: blurred(&plane(&|c| c[0]), &spatial.luminance),
            red_green: blurred(&plane(&|c| c[1]), &spatial.red_green),
            blue_yellow,
            edge: across(&feature.first).length(&smooth.along_columns(&feature.first)),
            point: across(&feature.second).length(&smooth.along_columns(&feature.second)),
        }
    }
}

/// What an observer makes of one image.
struct Seen {
    luminance: Plane,
    red_green: Plane,
    blue_yellow: Plane,
    edge: Plane,
    point: Plane,
}

impl Seen {
    fn colour(&self, at: usize) -> [f64; 3] {
        [self.luminance.values[at], self.red_green.values[at], self.blue_yellow.values[at]]
    }
}
