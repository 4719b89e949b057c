//! Every band form, with the constants written in its text, in f32 against the reference in every region.

use super::{HARD_CASES, LARGE, LEAN, MEDIUM, REGIONS, sinc_squared_band};
use crate::effect::{Candidate, Points};
use crate::effects::area_light::EFFECT;
use crate::table::Table;

/// Where bands are judged.
fn places() -> impl Iterator<Item = (&'static str, Points)> {
    REGIONS.iter().map(|&(name, points, _)| (name, points)).chain(HARD_CASES.iter().copied())
}

/// Largest relative error in f32, of values that are normal numbers in f32.
fn largest_relative_error(candidate: &Candidate, table: &Table) -> f64 {
    let bands = table.columns[0].values.iter().zip(&table.columns[1].values);
    let values = candidate.values_f32_at(table).expect("a registered form evaluates");
    bands.zip(values).fold(0.0, |worst: f64, ((&x0, &x1), value)| {
        let exact = sinc_squared_band(x0, x1);
        let error = (f64::from(value) / exact - 1.0).abs();
        let judged = exact.abs() > f64::from(f32::MIN_POSITIVE);
        // A NaN is the worst of all and stays so.
        if judged && (error > worst || error.is_nan()) { error } else { worst }
    })
}

#[test]
fn forms_of_striae_are_as_accurate_as_measured() {
    // Measured on lobes, scene bands, narrow bands and hard bands, and rounded up in the third digit.
    let limits = [(LEAN, LEAN_LIMITS), (MEDIUM, MEDIUM_LIMITS), (LARGE, LARGE_LIMITS)];
    let candidates = crate::effects::written(&EFFECT);
    let mut faults = Vec::new();
    for (name, limits) in limits {
        let candidate = candidates.get(name).expect("registered");
        for ((region, points), limit) in places().zip(limits) {
            let error = largest_relative_error(candidate, &points());
            println!("{name} on {region}: {error:.3e}, {:?}", candidate.form.op_count());
            if error.is_nan() || error > limit {
                faults.push(format!("{name} on {region}: {error:e}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:?}");
}

const LEAN_LIMITS: [f64; 4] = [4.94e-4, 8.44e-3, 1.83e-4, 7.15e-3];
const MEDIUM_LIMITS: [f64; 4] = [1.05e-4, 2.26e-4, 1.83e-4, 6.64e-4];
const LARGE_LIMITS: [f64; 4] = [1.79e-6, 1.32e-6, 1.55e-4, 4.90e-4];

#[test]
fn every_form_is_finite_on_finite_bands() {
    let mut bounds = vec![0.0, 1e-45, 1e-38, 1e-20, 1e-3, 1.0, 1e5, 1e7, 1e20, f64::from(f32::MAX)];
    bounds.extend(bounds.clone().iter().map(|x| -x));
    let pairs = bounds.iter().flat_map(|&a| bounds.iter().map(move |&b| (a, b))).collect();
    let table = super::regions::table(pairs, "far bounds");
    let candidates = crate::effects::written(&EFFECT);
    let takes_bounds = |of: &&std::sync::Arc<Candidate>| of.form.input_columns() == ["x0", "x1"];
    let bands: Vec<_> = candidates.iter().filter(takes_bounds).collect();
    assert_eq!(bands.len(), 8);
    for candidate in bands {
        let values = candidate.values_f32_at(&table).expect("a registered form evaluates");
        let bad = values.iter().position(|v| !v.is_finite());
        let at = bad.map(|row| (table.columns[0].values[row], table.columns[1].values[row]));
        assert!(at.is_none(), "{} on {at:?}", candidate.name);
    }
}

#[test]
fn regions_hold_bands_in_f32() {
    let fitted = REGIONS.iter().filter_map(|&(name, _, fitted)| Some((name, fitted?)));
    for (region, points) in places().chain(fitted) {
        let least = match region {
            "lobes" => 12_000,
            "scene bands" => 5990,
            "narrow bands" => 5900,
            _ => 1000,
        };
        let table = points();
        let (x0, x1) = (&table.columns[0].values, &table.columns[1].values);
        assert!(x0.len() >= least, "{region}: {}", x0.len());
        assert!(x0.iter().chain(x1).all(|&x| x == f64::from(x as f32)), "{region}");
        assert!(x0.iter().zip(x1).all(|(a, b)| a != b), "{region}");
    }
}
