//! Properties that a power of an order has, whatever the error of a form.

use super::regions::{hard_cases, table};
use crate::effect::{FormValues, Law};

const ZERO: &[&str] = &["sinusoid_zero_order"];
const FIRST: &[&str] = &["sinusoid_first_order"];

/// Largest value of J_1(a)², at a = 1.8412: DLMF §10.21.
const MOST_IN_FIRST: f64 = 0.338_578_6;

/// Laws of the effect.
pub(super) const LAWS: &[Law] = &[
    Law {
        name: "share",
        description: "a power is a share: largest excess above 1 or below 0 over phases up to a turn, \
                      0 to the bit",
        violation: |form| excess(form, 1.0),
        references: ZERO,
        ..Law::EMPTY
    },
    Law {
        name: "share (one first order)",
        description: "the two first orders share what there is, and J_1^2 is 0.3386 at most: largest \
                      excess over it or below 0 over phases up to a turn. The tolerance is 0.001",
        violation: |form| excess(form, MOST_IN_FIRST),
        tolerance: 0.001,
        references: FIRST,
        known_violations: &[(
            "diffraction/one_first_order",
            "a^2/4 exceeds it from a = 1.16 and 1 from a = 2",
        )],
    },
    Law {
        name: "flat",
        description: "without relief all light is in the mirror: largest |g - 1| for phases up to \
                      1e-4. The tolerance is 0.001",
        violation: |form| without_relief(form, 1.0),
        tolerance: 0.001,
        references: ZERO,
        ..Law::EMPTY
    },
    Law {
        name: "flat (one first order)",
        description: "without relief there is no order: largest g for phases up to 1e-4, 1e-8 at most",
        violation: |form| without_relief(form, 0.0),
        tolerance: 1e-8,
        references: FIRST,
        ..Law::EMPTY
    },
    Law {
        name: "goes out",
        description: "a sinusoid leaves no mirror at the zeros of J_0, 2.4048 and 5.5201: largest g \
                      there. The tolerance is 0.001",
        violation: |form| worst(form, [2.404_825_6, 5.520_078], f64::abs),
        tolerance: 0.001,
        references: ZERO,
        known_violations: &[
            ("diffraction/zero_first_order", "the first order takes nothing off the mirror"),
            ("diffraction/zero_gaussian", "a Gaussian has no zeros"),
        ],
    },
    Law {
        name: "goes out (one first order)",
        description: "a sinusoid has no first order at the zero of J_1, 3.8317: largest g there. The \
                      tolerance is 0.001",
        violation: |form| worst(form, [3.831_706], f64::abs),
        tolerance: 0.001,
        references: FIRST,
        known_violations: &[
            ("diffraction/one_first_order", "a^2/4 grows without bound"),
            ("diffraction/one_damped", "a Gaussian has no zeros"),
        ],
    },
];

fn excess(form: FormValues<'_>, most: f64) -> f64 {
    let turn = (0..=2000).map(|i| std::f32::consts::TAU * i as f32 / 2000.0).map(f64::from);
    worst(form, turn.chain(hard_cases()), |v| (v - most).max(-v).max(0.0))
}

fn without_relief(form: FormValues<'_>, value: f64) -> f64 {
    worst(form, [0.0, 1e-45, 1e-30, 1e-10, 1e-5, 1e-4], |v| (v - value).abs())
}

/// Largest violation over phases; infinite if a value is missing or not a number.
fn worst(
    form: FormValues<'_>,
    phases: impl IntoIterator<Item = f64>,
    violation: impl Fn(f64) -> f64,
) -> f64 {
    let points = table(phases.into_iter().collect(), "laws");
    let found = form(&points);
    if found.len() != points.rows() {
        return f64::INFINITY;
    }
    Law::worst(found.iter().map(|v| if v.is_nan() { f64::NAN } else { violation(f64::from(*v)) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::diffraction::sinusoid_order_power;
    use crate::table::Table;

    #[test]
    fn the_exact_powers_keep_every_law() {
        for law in LAWS {
            let order = u32::from(law.references == FIRST);
            let exact = |points: &Table| -> Vec<f32> {
                let power = |a: &f64| sinusoid_order_power(order, *a).expect("in the domain");
                points.columns[0].values.iter().map(|a| power(a) as f32).collect()
            };
            let violation = (law.violation)(&exact);
            assert!(violation <= law.tolerance, "{}: {violation:e}", law.name);
        }
    }

    #[test]
    fn forms_that_break_them_are_found() {
        for law in LAWS {
            let off = |points: &Table| vec![1.5; points.rows()];
            assert!((law.violation)(&off) > law.tolerance, "{}", law.name);
            assert!((law.violation)(&|_| vec![f32::NAN]) > law.tolerance, "{}", law.name);
            assert!((law.violation)(&|_| Vec::new()) > law.tolerance, "{}", law.name);
        }
    }
}
