//! Every form, with the constants written in its text, against the reference in every region, and
//! against the laws. The gates hold the fitted constants; this holds what is written.

use super::EFFECT;
use crate::effect::{Candidate, Region};
use crate::effects::{found, written};

/// Largest error in f32 over each region, and where.
fn errors(candidate: &Candidate) -> Vec<(f64, f64)> {
    let over = |region: &Region| {
        let points = (region.points)();
        let values = candidate.values_f32_at(&points).expect("a registered form evaluates");
        let x = points.columns[0].values.iter();
        x.zip(values).fold((0.0, f64::NAN), |worst: (f64, f64), (&x, v)| {
            let error = (f64::from(v) - super::sine_integral(x)).abs();
            // A NaN is the worst of all and stays so.
            if error > worst.0 || error.is_nan() { (error, x) } else { worst }
        })
    };
    EFFECT.regions.iter().chain(EFFECT.hard_cases).map(over).collect()
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
    let candidates = written(&EFFECT);
    assert_eq!(limits.len(), candidates.iter().count());
    let mut faults = Vec::new();
    for (name, limits) in limits {
        let candidate = candidates.get(name).expect("registered");
        let errors = errors(candidate);
        println!("{name}: {errors:?} {:?}", candidate.form.op_count());
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

#[test]
fn laws_hold_or_are_known_not_to() {
    crate::effects::assert_laws_are_known(&EFFECT);
}

#[test]
fn forms_are_finite_at_the_ends() {
    for candidate in written(&EFFECT).iter() {
        let ends = [0.0, -0.0, f32::MAX, -f32::MAX, 1e20];
        let values = candidate.values_f32(&[&ends]).expect("a registered form evaluates");
        assert!(values.iter().all(|v| v.is_finite()), "{}: {values:?}", candidate.name);
        assert_eq!(values[0], 0.0, "{}", candidate.name);
    }
}

#[test]
fn findings_agree_with_the_derivations() {
    let found = found(&EFFECT);
    assert!(found[1].contains("0.05098 at x = ±3.56, RMS 0.02937"), "{}", found[1]);
    assert!(found[2].contains("0.339/x") && found[2].contains("0.0245"), "{}", found[2]);
    assert!(found[3].contains("-18.4 % at n = 1, -30.7 % at n = 5, -33.7 % at n = 100"));
    assert!(found[4].contains("-54.1 % at n = 1, -94.6 % at n = 20"), "{}", found[4]);
}
