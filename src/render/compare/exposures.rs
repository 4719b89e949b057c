//! The exposures of HDR-FLIP: from where the brightest pixel is just below the shoulder of the tone
//! curve to where the median is.

use super::CompareError;
use super::metrics::{REFERENCE, unusable};
use crate::render::image::Image;

/// ACES curve as (numerator, denominator), highest power first; the curve's own gain of 0.6
/// included.
const NUMERATOR: [f64; 3] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0];
const DENOMINATOR: [f64; 3] = [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];

/// What the shoulder maps to.
const SHOULDER: f64 = 0.85;

/// Exposures at which HDR-FLIP looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposures {
    /// First exposure, in stops.
    pub start: f64,
    /// Last exposure, in stops.
    pub stop: f64,
    /// How many there are, evenly spaced, both ends among them.
    pub count: usize,
    /// Whether they follow the standard, or come from lit pixels alone.
    pub rule: ExposureRule,
}

/// Where exposures come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExposureRule {
    /// From all pixels of the reference, as its authors' program does: a median of 0 counts as
    /// f32's machine epsilon.
    Standard,
    /// From pixels that are not black: on a dark background the standard looks at exposures at which all
    /// that is lit is white.
    LitPixels,
}

impl ExposureRule {
    /// The name of the rule.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::LitPixels => "lit pixels",
        }
    }
}

impl Exposures {
    /// The exposures for `reference` by `rule`.
    ///
    /// # Errors
    /// [`CompareError::Unusable`] without colours; [`CompareError::Setting`] if no pixel is lit.
    pub fn of(reference: &Image, rule: ExposureRule) -> Result<Self, CompareError> {
        let colours = reference.colours().map_err(|fault| unusable(REFERENCE, &fault))?;
        let luminance = |c: [f32; 3]| {
            let [r, g, b] = c.map(|component| f64::from(component).max(0.0));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let mut luminances: Vec<f64> =
            colours.into_iter().map(luminance).filter(|y| y.is_finite()).collect();
        luminances.sort_by(f64::total_cmp);
        let median = |sorted: &[f64]| sorted.get(sorted.len() / 2).copied().unwrap_or_default();
        let brightest = luminances.last().copied().unwrap_or_default();
        if brightest <= 0.0 {
            return Err(CompareError::Setting {
                what: "brightest luminance of the reference, which sets the exposures of HDR-FLIP",
                expected: "a positive number",
                got: brightest,
            });
        }
        let first = match rule {
            ExposureRule::Standard => 0,
            ExposureRule::LitPixels => luminances.partition_point(|y| *y <= 0.0),
        };
        let middle = median(luminances.get(first..).unwrap_or_default());
        let middle = middle.max(f64::from(f32::EPSILON));
        let shoulder = shoulder();
        let (start, stop) = ((shoulder / brightest).log2(), (shoulder / middle).log2());
        Ok(Self { start, stop, count: (stop - start).ceil().max(2.0) as usize, rule })
    }

    /// The exposures, in stops.
    pub fn stops(&self) -> impl Iterator<Item = f64> + use<> {
        let (start, step) = (self.start, (self.stop - self.start) / (self.count - 1) as f64);
        (0..self.count).map(move |i| start + i as f64 * step)
    }
}

/// The ACES curve of a linear component, not clamped.
pub(super) fn aces(x: f64) -> f64 {
    let horner = |[a, b, c]: [f64; 3]| (a * x + b) * x + c;
    horner(NUMERATOR) / horner(DENOMINATOR)
}

/// The larger component that the ACES curve maps to [`SHOULDER`].
fn shoulder() -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| NUMERATOR[i] - SHOULDER * DENOMINATOR[i]);
    let middle = -0.5 * b / a;
    middle + (middle * middle - c / a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shoulder_maps_to_its_value() {
        assert!((aces(shoulder()) - SHOULDER).abs() < 1e-14);
    }

    #[test]
    fn a_dark_background_counts_unless_it_is_left_out() {
        let image = |colours: &[[f32; 3]]| Image::rgb(colours.len(), 1, colours);
        let of = |colours: &[[f32; 3]], rule| Exposures::of(&image(colours), rule);
        let lit = of(&[[1.0; 3], [4.0; 3], [2.0; 3]], ExposureRule::Standard).expect("lit");
        assert!((lit.stop - lit.start - 1.0).abs() < 1e-12 && lit.count == 2);
        let dark = [[0.0; 3], [0.0; 3], [2.0; 3]];
        // As flip-evaluator 1.7 says of a median of 0.
        let standard = of(&dark, ExposureRule::Standard).expect("one is lit");
        assert!((standard.stop - 24.083_298).abs() < 1e-5, "{standard:?}");
        let lit = of(&dark, ExposureRule::LitPixels).expect("one is lit");
        assert_eq!(lit.stop, lit.start);
        assert!(of(&[[0.0; 3]], ExposureRule::Standard).is_err());
    }
}
