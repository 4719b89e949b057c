//! Errors of a form on lobes and half lobes, in f32 at bounds rounded to f32: what the findings and the
//! exhibit are made of.

use std::f64::consts::{PI, TAU};

use super::sinc_squared_band;
use crate::effect::FittedConstants;
use crate::effect::fitted_form::FittedForm;
use crate::effects;
use crate::form::FormError;

/// Which part of the lobe [2πn, 2π(n + 1)].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// All of it.
    Whole,
    /// Up to its crest.
    FirstHalf,
    /// From its crest on.
    SecondHalf,
}

impl Part {
    /// Its bounds for the lobe `n`, rounded to f32.
    fn bounds(self, n: u32) -> (f32, f32) {
        let start = TAU * f64::from(n);
        let (from, to) = match self {
            Self::Whole => (start, start + TAU),
            Self::FirstHalf => (start, start + PI),
            Self::SecondHalf => (start + PI, start + TAU),
        };
        (from as f32, to as f32)
    }
}

/// A form with the constants that it ships with.
#[derive(Debug)]
pub(super) struct BandForm(FittedForm);

impl BandForm {
    /// The form `name` with the constants of the fit of its name, or those in its text where there is
    /// none.
    pub(super) fn load(name: &str, fitted: &FittedConstants) -> Result<Self, FormError> {
        FittedForm::new(effects::form(name)?, name, fitted).map(Self)
    }

    /// Values in f32 on bands.
    pub(super) fn values(&self, bands: &[(f32, f32)]) -> Result<Vec<f32>, FormError> {
        let starts: Vec<f32> = bands.iter().map(|band| band.0).collect();
        let ends: Vec<f32> = bands.iter().map(|band| band.1).collect();
        self.0.single(&[&starts, &ends])
    }

    /// Relative errors on a part of the lobes `orders`.
    pub(super) fn relative_errors(
        &self,
        part: Part,
        orders: &[u32],
    ) -> Result<Vec<f64>, FormError> {
        let bands: Vec<(f32, f32)> = orders.iter().map(|&n| part.bounds(n)).collect();
        let values = self.values(&bands)?;
        let exact = |band: &(f32, f32)| sinc_squared_band(f64::from(band.0), f64::from(band.1));
        Ok(bands.iter().zip(values).map(|(band, v)| f64::from(v) / exact(band) - 1.0).collect())
    }

    /// Largest |relative error| over lobes and half lobes n = 0 … `last`, with its part and order.
    pub(super) fn worst(&self, last: u32) -> Result<(f64, Part, u32), FormError> {
        let orders: Vec<u32> = (0..=last).collect();
        let mut worst = (0.0, Part::Whole, 0);
        for part in [Part::Whole, Part::FirstHalf, Part::SecondHalf] {
            for (error, &n) in self.relative_errors(part, &orders)?.iter().zip(&orders) {
                if error.abs() > worst.0 || error.is_nan() {
                    worst = (error.abs(), part, n);
                }
            }
        }
        Ok(worst)
    }
}
