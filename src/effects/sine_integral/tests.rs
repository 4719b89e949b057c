//! Every form, with the constants written in its text, against the reference in every region, and
//! against the laws. The gates hold the fitted constants; this holds what is written.

use super::EFFECT;
use crate::effect::claim::check;
use crate::effect::{FormEntry, FormLibrary};
use crate::form::Form;

fn in_f32(form: &Form, columns: &[Vec<f32>]) -> Vec<f32> {
    let constants: Vec<f32> =
        form.parameters().iter().map(|p| p.default.expect("a default") as f32).collect();
    let columns: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
    form.eval_f32(&constants, &columns).expect("a registered form evaluates").remove(0)
}

fn load(entry: &FormEntry) -> Form {
    entry.load().unwrap_or_else(|error| panic!("{}: {error}", entry.name))
}

/// Largest error in f32 over each region, and where.
fn errors(form: &Form) -> Vec<(f64, f32)> {
    let region = |points: fn() -> crate::table::Table| {
        let x: Vec<f32> = points().columns[0].values.iter().map(|&x| x as f32).collect();
        let values = in_f32(form, std::slice::from_ref(&x));
        x.iter().zip(values).fold((0.0, f32::NAN), |worst: (f64, f32), (&x, v)| {
            let error = (f64::from(v) - super::sine_integral(f64::from(x))).abs();
            // A NaN is the worst of all and stays so.
            if error > worst.0 || error.is_nan() { (error, x) } else { worst }
        })
    };
    EFFECT
        .regions
        .iter()
        .map(|r| region(r.points))
        .chain([region(EFFECT.hard_cases[0].points)])
        .collect()
}

#[test]
fn forms_are_as_accurate_as_measured() {
    // Measured over [-10, 10], [10, 1e4], scene and hard cases, and rounded up in the third digit.
    let limits = [
        ("sine_integral/published", [5.10e-2, 2.46e-2, 5.10e-2, 5.10e-2]),
        ("sine_integral/auxiliary_small", [5.91e-3, 2.47e-3, 5.91e-3, 5.71e-3]),
        ("sine_integral/auxiliary_medium", [1.13e-4, 1.26e-4, 1.26e-4, 1.12e-4]),
        ("sine_integral/auxiliary_lean", [5.52e-7, 4.41e-7, 4.88e-7, 3.99e-7]),
        ("sine_integral/auxiliary_large", [2.43e-7, 1.87e-7, 2.11e-7, 2.43e-7]),
        ("sine_integral/lookup_64", [1.61e-3, 9.43e-4, 1.60e-3, 1.43e-3]),
        ("sine_integral/lookup_256", [3.00e-4, 2.89e-4, 3.00e-4, 2.89e-4]),
        ("sine_integral/lookup_1024", [5.66e-5, 4.81e-5, 5.65e-5, 4.80e-5]),
    ];
    let forms = FormLibrary::new(&[&EFFECT]).expect("registered");
    assert_eq!(limits.len(), forms.iter().count());
    let mut faults = Vec::new();
    for (name, limits) in limits {
        let entry = forms.get(name).expect("registered");
        let form = load(entry);
        let errors = errors(&form);
        println!("{name}: {errors:?} {:?}", form.op_count());
        faults.extend(
            errors
                .iter()
                .zip(limits)
                .filter(|((error, _), limit)| error.is_nan() || error > limit)
                .map(|((error, x), limit)| format!("{name}: {error:e} at {x} is above {limit:e}")),
        );
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The law list says of every form whether it holds: a known violation that has gone is a fault too.
#[test]
fn laws_hold_or_are_known_not_to() {
    let mut faults = Vec::new();
    for entry in FormLibrary::new(&[&EFFECT]).expect("registered").iter() {
        let candidate = entry.written().expect("a form with its constants");
        for law in EFFECT.laws {
            let violation = (law.violation)(&|points| candidate.values_for_laws(points));
            let known = law.known_violations.iter().any(|(name, _)| *name == entry.name);
            println!("{}: {} {violation:.3e} (known: {known})", entry.name, law.name);
            if (violation <= law.tolerance) == known {
                faults.push(format!("{}: {} {violation:e}, known: {known}", entry.name, law.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn forms_are_finite_at_the_ends() {
    for entry in FormLibrary::new(&[&EFFECT]).expect("registered").iter() {
        let values = in_f32(&load(entry), &[vec![0.0, -0.0, f32::MAX, -f32::MAX, 1e20]]);
        assert!(values.iter().all(|v| v.is_finite()), "{}: {values:?}", entry.name);
        assert_eq!(values[0], 0.0, "{}", entry.name);
    }
}

#[test]
fn findings_agree_with_the_derivations() {
    let findings = check(EFFECT.claims, &crate::effects::written(&EFFECT));
    let found: Vec<&str> = findings.iter().map(|f| f.found.as_str()).collect();
    println!("{found:#?}");
    assert!(found[1].contains("0.05098 at x = ±3.56, RMS 0.02937"), "{}", found[1]);
    assert!(found[2].contains("0.339/x") && found[2].contains("0.0245"), "{}", found[2]);
    assert!(found[3].contains("-18.4 % at n = 1, -30.7 % at n = 5, -33.7 % at n = 100"));
    assert!(found[4].contains("-54.1 % at n = 1, -94.6 % at n = 20"), "{}", found[4]);
}
