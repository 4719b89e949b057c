//! Properties that a form of the band integral should have whatever its error.

use std::f64::consts::{PI, TAU};

use super::REFERENCE;
use super::hard_cases::hard_cases;
use crate::effect::{FormValues, Law, points};
use crate::numeric::statistics::largest;

const REFERENCES: &[&str] = &[REFERENCE.name];

/// What every form of eq. 27 as printed violates for one reason.
const CANCELS: &str =
    "differences of values near pi: an error of 1e-7 to 1e-6 exceeds a far or narrow band";

/// Swapping the bounds changes the sign.
pub(crate) const ANTISYMMETRIC: Law = Law {
    name: "antisymmetric",
    description: "B(x1, x0) = -B(x0, x1) to the bit, so that B(x, x) = 0: largest sum over the hard bands, \
                  their bounds taken as bands of no width among them.",
    violation: antisymmetry,
    references: REFERENCES,
    ..Law::EMPTY
};

/// The integrand is a square.
pub(crate) const POSITIVE: Law = Law {
    name: "positive",
    description: "B > 0 for x0 < x1: share of the hard bands wider than 1e-30 on which it is not.",
    violation: not_positive,
    references: REFERENCES,
    known_violations: &[
        ("area_light/band_printed", CANCELS),
        ("area_light/band_printed_small", CANCELS),
        ("area_light/band_printed_medium", CANCELS),
        ("area_light/band_printed_lean", CANCELS),
        ("area_light/band_printed_large", CANCELS),
    ],
    ..Law::EMPTY
};

/// The integrand is even.
pub(crate) const EVEN: Law = Law {
    name: "even",
    description: "B(-x1, -x0) = B(x0, x1) to the bit: largest difference over the hard bands.",
    violation: unevenness,
    references: REFERENCES,
    ..Law::EMPTY
};

/// A light cut in two gives what it gave whole.
pub(crate) const ADDITIVE: Law = Law {
    name: "additive",
    description: "B(a, b) + B(b, c) = B(a, c): largest relative difference for lobes and half lobes side by \
                  side, to 2000 pi; the seam that a light cut in two would show. The tolerance is the error \
                  asked of lobes; eq. 27 as printed is a difference of one primitive, and its seam is rounding.",
    violation: seam,
    tolerance: 1e-3,
    references: REFERENCES,
    known_violations: &[(
        "area_light/band_lean",
        "beyond one period it is good to 7e-3, not to 1e-3",
    )],
};

/// No light receives more than the whole lobe holds.
pub(crate) const TOTAL: Law = Law {
    name: "total",
    description: "|B| <= 2 pi, the integral over the whole axis: largest excess over bands across 0, to \
                  |x| = 1e5. The tolerance is 1e-3, as that of the lobes.",
    violation: excess_over_total,
    tolerance: 1e-3,
    references: REFERENCES,
    ..Law::EMPTY
};

/// The bounds of the hard bands.
fn bands() -> Vec<Vec<f32>> {
    points::columns_f32(&hard_cases())
}

fn antisymmetry(form: FormValues) -> f64 {
    let mut bands = bands();
    let starts = bands[0].clone();
    bands.iter_mut().for_each(|bounds| bounds.extend(&starts));
    let values = form(&bands);
    bands.reverse();
    let swapped = form(&bands);
    largest(values.iter().zip(&swapped).map(|(a, b)| (f64::from(*a) + f64::from(*b)).abs()))
}

fn unevenness(form: FormValues) -> f64 {
    let mut bands = bands();
    let values = form(&bands);
    bands.reverse();
    bands.iter_mut().flatten().for_each(|x| *x = -*x);
    let mirrored = form(&bands);
    largest(values.iter().zip(&mirrored).map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs()))
}

fn not_positive(form: FormValues) -> f64 {
    let bands = bands();
    let values = form(&bands);
    let wide = |a: f32, b: f32| (f64::from(b) - f64::from(a)).abs() > 1e-30;
    let judged: Vec<f32> = bands[0]
        .iter()
        .zip(&bands[1])
        .zip(&values)
        .filter(|((a, b), _)| wide(**a, **b))
        .map(|((a, b), v)| if a < b { *v } else { -*v })
        .collect();
    let failed = judged.iter().filter(|v| v.is_nan() || **v <= 0.0).count();
    failed as f64 / judged.len() as f64
}

fn seam(form: FormValues) -> f64 {
    let at = |k: u32| (PI * f64::from(k)) as f32;
    let parts = (1..=2000).flat_map(|k| [(k - 1, k, k + 1), (k - 1, k, k + 2)]);
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    for (from, cut, to) in parts {
        a.push(at(from));
        b.push(at(cut));
        c.push(at(to));
    }
    let first = form(&[a.clone(), b.clone()]);
    let second = form(&[b, c.clone()]);
    let whole = form(&[a, c]);
    largest(first.iter().zip(&second).zip(&whole).map(|((p, q), w)| {
        let (parts, whole) = (f64::from(*p) + f64::from(*q), f64::from(*w));
        if parts == whole { 0.0 } else { ((parts - whole) / whole).abs() }
    }))
}

fn excess_over_total(form: FormValues) -> f64 {
    let reach: Vec<f32> =
        (0..2000).map(|i| 1e-3 * 1e8_f64.powf(f64::from(i) / 1999.0)).map(|x| x as f32).collect();
    let negative = reach.iter().map(|x| -x).collect();
    largest(form(&[negative, reach]).iter().map(|v| f64::from(*v).abs() - TAU))
}
