//! Every form, with the constants written in its text, at the hard points; the paper's numbers.

use super::EFFECT;
use crate::effect::FormLibrary;
use crate::effect::claim::check;
use crate::form::Form;

fn in_f32(form: &Form, columns: &[Vec<f32>]) -> Vec<f32> {
    let constants: Vec<f32> =
        form.parameters().iter().map(|p| p.default.expect("a default") as f32).collect();
    let columns: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
    form.eval_f32(&constants, &columns).expect("a registered form evaluates").remove(0)
}

#[test]
fn forms_are_finite_and_not_negative_at_every_hard_point() {
    let mut judged = 0;
    let forms = FormLibrary::new(&[&EFFECT]).expect("registered");
    for entry in forms.iter() {
        let form = entry.load().expect("a form");
        for region in EFFECT.hard_cases {
            let table = (region.points)();
            let columns: Option<Vec<Vec<f32>>> = form
                .input_columns()
                .iter()
                .map(|name| Some(table.column(name)?.values.iter().map(|v| *v as f32).collect()))
                .collect();
            let Some(columns) = columns else { continue };
            judged += 1;
            for (row, value) in in_f32(&form, &columns).into_iter().enumerate() {
                let at: Vec<f32> = columns.iter().map(|column| column[row]).collect();
                assert!(value.is_finite() && value >= 0.0, "{} {at:?}: {value}", entry.name);
            }
        }
    }
    assert_eq!(judged, forms.iter().count());
}

#[test]
fn findings_agree_with_the_derivations() {
    let findings = check(EFFECT.claims, &crate::effects::written(&EFFECT));
    let found: Vec<&str> = findings.iter().map(|f| f.found.as_str()).collect();
    println!("{found:#?}");
    assert!(findings.iter().all(|f| f.verdict != "not evaluated"));
    // velinov2018 eq. 16 with and without π, circles of 0.1, 1 and 1.4σ.
    assert!(found[0].contains("0.676 and 0.018 at 0.1σ"), "{}", found[0]);
}
