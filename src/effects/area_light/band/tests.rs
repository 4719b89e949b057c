//! Every band form, with the constants written in its text, in f32 against the reference in every region.

use super::{
    HARD_CASES, LARGE, LEAN, LOBES, MEDIUM, NARROW, REFERENCE, SCENE_BANDS, sinc_squared_band,
};
use crate::effect::{FormEntry, FormLibrary};
use crate::effects::{area_light, sine_integral};
use crate::form::Form;
use crate::table::Table;

fn forms() -> FormLibrary {
    FormLibrary::new(&[&sine_integral::EFFECT, &area_light::EFFECT]).expect("registered")
}

fn load(entry: &FormEntry) -> Form {
    entry.load().unwrap_or_else(|error| panic!("{}: {error}", entry.name))
}

fn in_f32(form: &Form, table: &Table) -> Vec<f32> {
    let constants: Vec<f32> =
        form.parameters().iter().map(|p| p.default.expect("a default") as f32).collect();
    let columns: Vec<Vec<f32>> = ["x0", "x1"]
        .iter()
        .map(|name| table.column(name).expect("a bound").values.iter().map(|&x| x as f32).collect())
        .collect();
    let columns: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
    form.eval_f32(&constants, &columns).expect("a registered form evaluates").remove(0)
}

/// Largest relative error in f32, of values that are normal numbers in f32.
fn largest_relative_error(form: &Form, table: &Table) -> f64 {
    let bands = table.columns[0].values.iter().zip(&table.columns[1].values);
    bands.zip(in_f32(form, table)).fold(0.0, |worst: f64, ((&x0, &x1), value)| {
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
    let forms = forms();
    let mut faults = Vec::new();
    for (name, limits) in limits {
        let form = load(forms.get(name).expect("registered"));
        for (region, limit) in [LOBES, SCENE_BANDS, NARROW, HARD_CASES].iter().zip(limits) {
            let error = largest_relative_error(&form, &(region.points)());
            println!("{name} on {}: {error:.3e}, {:?}", region.name, form.op_count());
            if error.is_nan() || error > limit {
                faults.push(format!("{name} on {}: {error:e}", region.name));
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
    let forms = forms();
    let bands = forms.iter().filter(|form| form.reference.as_deref() == Some(REFERENCE.name));
    assert_eq!(bands.clone().count(), 8);
    for entry in bands {
        let values = in_f32(&load(entry), &table);
        let bad = values.iter().position(|v| !v.is_finite());
        let at = bad.map(|row| (table.columns[0].values[row], table.columns[1].values[row]));
        assert!(at.is_none(), "{} on {at:?}", entry.name);
    }
}

#[test]
fn regions_hold_bands_in_f32() {
    for (region, least) in
        [(LOBES, 12_000), (SCENE_BANDS, 5990), (NARROW, 5900), (HARD_CASES, 1000)]
    {
        for table in
            [Some((region.points)()), region.fitted.map(|fitted| fitted())].into_iter().flatten()
        {
            let (x0, x1) = (&table.columns[0].values, &table.columns[1].values);
            assert!(x0.len() >= least, "{}: {}", region.name, x0.len());
            assert!(x0.iter().chain(x1).all(|&x| x == f64::from(x as f32)), "{}", region.name);
            assert!(x0.iter().zip(x1).all(|(a, b)| a != b), "{}", region.name);
        }
    }
}
