//! Properties that a power of an order has, whatever the error of a form.

use super::regions::{hard_cases, table};
use crate::effect::{FormValues, Law, Violation};

/// Largest value of J_1(a)², at a = 1.8412: DLMF §10.21.
const MOST_IN_FIRST: f64 = 0.338_578_6;

/// Laws of the effect, by name.
pub(super) const LAWS: &[(&str, Violation)] = &[
    ("share", |form| excess(form, 1.0)),
    ("share (one first order)", |form| excess(form, MOST_IN_FIRST)),
    ("flat", |form| without_relief(form, 1.0)),
    ("flat (one first order)", |form| without_relief(form, 0.0)),
    ("goes out", |form| worst(form, [2.404_825_6, 5.520_078], f64::abs)),
    ("goes out (one first order)", |form| worst(form, [3.831_706], f64::abs)),
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
    use super::super::EFFECT;
    use crate::effects::assert_laws_bite;
    use crate::effects::diffraction::sinusoid_order_power;
    use crate::table::Table;

    #[test]
    fn the_exact_powers_keep_every_law_and_others_are_found() {
        for order in [0, 1] {
            let exact = |points: &Table| -> Vec<f32> {
                let power = |a: &f64| sinusoid_order_power(order, *a).expect("in the domain");
                points.columns[0].values.iter().map(|a| power(a) as f32).collect()
            };
            let reference = ["sinusoid_zero_order", "sinusoid_first_order"][order as usize];
            let laws = EFFECT.laws.iter().filter(|law| law.references == [reference]);
            assert_laws_bite(laws, &exact, &|points| vec![1.5; points.rows()]);
        }
    }
}
