//! Properties that a form of the band integral should have whatever its error.

use std::f64::consts::{PI, TAU};

use super::REFERENCE;
use super::hard_cases::hard_cases;
use super::regions::table;
use crate::effect::{FormValues, Law};
use crate::numeric::statistics::largest;
use crate::table::Table;

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

/// The bands with their bounds swapped.
fn swapped(bands: &Table) -> Table {
    let mut swapped = bands.clone();
    for (column, other) in swapped.columns.iter_mut().zip(bands.columns.iter().rev()) {
        column.values.clone_from(&other.values);
    }
    swapped
}

fn antisymmetry(form: FormValues) -> f64 {
    let mut bands = hard_cases();
    let starts = bands.columns[0].values.clone();
    bands.columns.iter_mut().for_each(|bounds| bounds.values.extend(&starts));
    let (values, swapped) = (form(&bands), form(&swapped(&bands)));
    largest(values.iter().zip(&swapped).map(|(a, b)| (f64::from(*a) + f64::from(*b)).abs()))
}

fn unevenness(form: FormValues) -> f64 {
    let bands = hard_cases();
    let mut mirrored = swapped(&bands);
    mirrored.columns.iter_mut().flat_map(|bounds| &mut bounds.values).for_each(|x| *x = -*x);
    let (values, mirrored) = (form(&bands), form(&mirrored));
    largest(values.iter().zip(&mirrored).map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs()))
}

fn not_positive(form: FormValues) -> f64 {
    let bands = hard_cases();
    let bounds = bands.columns[0].values.iter().zip(&bands.columns[1].values);
    let judged: Vec<f32> = bounds
        .zip(form(&bands))
        .filter(|((a, b), _)| (*b - *a).abs() > 1e-30)
        .map(|((a, b), value)| if a < b { value } else { -value })
        .collect();
    let failed = judged.iter().filter(|v| v.is_nan() || **v <= 0.0).count();
    failed as f64 / judged.len() as f64
}

fn seam(form: FormValues) -> f64 {
    let at = |k: u32| PI * f64::from(k);
    let parts: Vec<[f64; 3]> = (1..=2000)
        .flat_map(|k| [[k - 1, k, k + 1], [k - 1, k, k + 2]])
        .map(|ends| ends.map(at))
        .collect();
    let between = |from: usize, to: usize| {
        form(&table(parts.iter().map(|ends| (ends[from], ends[to])).collect(), "seams"))
    };
    let (first, second, whole) = (between(0, 1), between(1, 2), between(0, 2));
    largest(first.iter().zip(&second).zip(&whole).map(|((p, q), w)| {
        let (parts, whole) = (f64::from(*p) + f64::from(*q), f64::from(*w));
        if parts == whole { 0.0 } else { ((parts - whole) / whole).abs() }
    }))
}

fn excess_over_total(form: FormValues) -> f64 {
    let reach = (0..2000).map(|i| 1e-3 * 1e8_f64.powf(f64::from(i) / 1999.0));
    let bands = table(reach.map(|x| (-x, x)).collect(), "across 0");
    largest(form(&bands).iter().map(|v| f64::from(*v).abs() - TAU))
}
