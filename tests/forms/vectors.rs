//! Vector-valued results: every component at once, on lanes, with derivatives, and emitted.

use std::collections::BTreeMap;

use striae::form::Form;
use striae::form::emit::{Language, emit};

use crate::form;

/// Components that share `a`, `b` alone, and neither; the second is reached through a branch.
const SOURCE: &str = "
override a: f32 = 2.0;
override b: f32 = 3.0;
fn f(p: vec2<f32>) -> vec4<f32> {
    var v = vec4<f32>(a * p.x, a * b, p.x + p.y, b * b);
    if p.y > 1.0 { v = vec4<f32>(v.yx, v.w * p.y, 1.0); }
    return v;
}";

#[test]
fn components_are_columns_with_derivatives_of_their_own() {
    let form = form(SOURCE);
    assert_eq!(form.output_columns(), ["value_x", "value_y", "value_z", "value_w"]);
    let inputs: [&[f64]; 2] = [&[5.0, 7.0], &[0.5, 4.0]];
    let dual = form.eval_dual(&[2.0, 3.0], &[0, 1], &inputs).expect("evaluates");
    assert_eq!(dual.values, [[10.0, 6.0], [6.0, 14.0], [5.5, 36.0], [9.0, 1.0]]);
    assert_eq!(dual.values, form.eval_f64(&[2.0, 3.0], &inputs).expect("evaluates"));
    let by_a = [[5.0, 3.0], [3.0, 7.0], [0.0, 0.0], [0.0, 0.0]];
    let by_b = [[0.0, 2.0], [2.0, 0.0], [0.0, 24.0], [6.0, 0.0]];
    for (component, derivatives) in dual.derivatives.iter().enumerate() {
        assert_eq!(*derivatives, [by_a[component], by_b[component]], "{component}");
    }
}

#[test]
fn they_are_emitted_whole() {
    let form = form(SOURCE);
    for (language, signature) in [
        (Language::Wgsl, "fn f(p: vec2<f32>) -> vec4<f32>"),
        (Language::Glsl, "vec4 f(vec2 p)"),
        (Language::Hlsl, "float4 f(float2 p)"),
        (Language::Msl, "metal::float4 f("),
    ] {
        let emitted = emit(&form, &BTreeMap::new(), language, "").expect("emits");
        let text = String::from_utf8_lossy(emitted.as_bytes()).into_owned();
        assert!(text.contains(signature), "{text}");
        if language == Language::Wgsl {
            let again = Form::parse("again.wgsl", &text, "f").expect("parses again");
            let inputs: [&[f32]; 2] = [&[5.0, 7.0], &[0.5, 4.0]];
            let before = form.eval_f32(&[2.0, 3.0], &inputs).expect("evaluates");
            assert_eq!(again.eval_f32(&[], &inputs).expect("evaluates"), before);
        }
    }
}
