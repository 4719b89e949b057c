//! Emitted text compiles in its language, carries the header, and keeps the constants' bits.

use std::collections::BTreeMap;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use striae::form::emit::{Emitted, Language, emit};
use striae::form::{Form, FormError};

use crate::{SI, external};

const LOOPS: &str = include_str!("loops.wgsl");

/// Derived overrides, a private variable, names that other languages reserve, unreached items.
const AWKWARD: &str = "
override a: f32 = 0.1;
@id(3) override b: f32 = 0.3;
override derived: f32 = a * b + exp(a);
override count: u32 = 3u;
const UNREACHED: f32 = 5.0;
const REACHED: f32 = 0.7;
var<private> state: f32 = 1.0;
fn unreached(x: f32) -> f32 { return x * UNREACHED; }
fn texture(input: vec3<f32>) -> f32 { state += input.z; return dot(input, vec3(a, b, REACHED)) * state; }
fn f(x: f32, float: vec2<f32>) -> vec2<f32> {
    var sum = derived;
    for (var i = 0u; i < count; i++) { sum += texture(vec3(float, x)); }
    return vec2(sum, fract(x) + 2.0 * a);
}";

/// Constant arrays: a table, pairs, and an array of arrays.
const TABLES: &str = "
const TABLE = array<f32, 5>(1.0, 2.0, 4.0, 8.0, 16.0);
const PAIRS = array<vec2<f32>, 2>(vec2(1.0, 2.0), vec2(3.0, 4.0));
const GRID = array<array<f32, 2>, 2>(array<f32, 2>(1.0, 2.0), array<f32, 2>(3.0, 4.0));
override scale: f32 = 2.0;
fn f(x: f32) -> f32 {
    let i = u32(abs(x));
    return TABLE[i] + PAIRS[i].y * GRID[i][i % 2u] * scale;
}";

fn text(form: &Form, values: &[(&str, f32)], language: Language) -> String {
    let values = values.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
    match emit(form, &values, language, "fitted to a table\nmax error 1e-6").expect("emits") {
        Emitted::Text(text) => text,
        Emitted::Binary(_) => panic!("{language:?} is text"),
    }
}

fn forms() -> Vec<Form> {
    let parse = |source, function| Form::parse("e.wgsl", source, function).expect("loads");
    vec![parse(SI, "si"), parse(LOOPS, "f"), parse(AWKWARD, "f"), parse(TABLES, "f")]
}

#[test]
fn wgsl_reads_back_to_the_same_bits() {
    let settings: [&[(&str, f32)]; 4] = [
        &[("a_zero", 0.661_427_4), ("b_zero", 1.0e-7 / 3.0)],
        &[("gain", -f32::MIN_POSITIVE / 8.0)],
        &[("a", 1.0 / 3.0), ("b", -1.0e-30)],
        &[("scale", 0.1)],
    ];
    let xs: Vec<f32> = (0..300).map(|i| -7.0 + 0.047 * i as f32).collect();
    for (form, values) in forms().iter().zip(settings) {
        let wgsl = text(form, values, Language::Wgsl);
        assert!(wgsl.starts_with("// fitted to a table\n// max error 1e-6\n"), "{wgsl}");
        assert!(!wgsl.contains("unreached") && !wgsl.contains("UNREACHED"), "{wgsl}");
        assert!(!wgsl.contains("override") && !wgsl.contains("@compute"), "{wgsl}");
        for (name, _) in values {
            assert!(wgsl.contains(&format!("const {name}: f32 = ")), "{name} in\n{wgsl}");
        }
        let again = Form::parse("emitted.wgsl", &wgsl, form.function()).expect("parses again");
        assert!(again.parameters().is_empty());
        let parameters: Vec<f32> = form
            .parameters()
            .iter()
            .map(|p| {
                values
                    .iter()
                    .find(|v| v.0 == p.name)
                    .map_or_else(|| p.default.expect("set") as f32, |v| v.1)
            })
            .collect();
        let inputs = vec![&xs[..]; form.input_columns().len()];
        let before = form.eval_f32(&parameters, &inputs).expect("evaluates");
        let after = again.eval_f32(&[], &inputs).expect("evaluates");
        for (before, after) in before.iter().flatten().zip(after.iter().flatten()) {
            assert_eq!(before.to_bits(), after.to_bits(), "{wgsl}");
        }
    }
}

#[test]
fn spirv_validates() {
    for form in forms() {
        let emitted = emit(&form, &BTreeMap::new(), Language::Spirv, "").expect("emits");
        let module = naga::front::spv::parse_u8_slice(
            emitted.as_bytes(),
            &naga::front::spv::Options::default(),
        )
        .expect("naga reads it");
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .expect("valid");
        external("spirv-val", &[], emitted.as_bytes(), ".spv");
    }
}

#[test]
fn glsl_compiles() {
    for form in forms() {
        let glsl = text(&form, &[], Language::Glsl);
        assert!(glsl.starts_with("#version 450"), "{glsl}");
        external("glslangValidator", &["-S", "comp"], glsl.as_bytes(), ".comp");
    }
}

#[test]
fn hlsl_compiles() {
    for form in forms() {
        let mut hlsl = text(&form, &[], Language::Hlsl);
        hlsl.push_str("\n[numthreads(1, 1, 1)] void main() {}\n");
        external(
            "glslangValidator",
            &["-D", "-S", "comp", "-e", "main", "-V", "-o", "/dev/null"],
            hlsl.as_bytes(),
            ".hlsl",
        );
    }
}

#[test]
fn msl_is_written() {
    for form in forms() {
        let msl = text(&form, &[], Language::Msl);
        assert!(msl.contains("metal") && msl.starts_with("// fitted"), "{msl}");
        assert!(!msl.contains("kernel"), "{msl}");
    }
}

#[test]
fn bad_values_are_refused() {
    let form = Form::parse("e.wgsl", SI, "si").expect("loads");
    let refused = |name: &str, value: f32| {
        let values = BTreeMap::from([(name.to_owned(), value)]);
        let error = emit(&form, &values, Language::Wgsl, "").expect_err("refused");
        assert!(
            matches!(error, FormError::Emit { .. }) && error.to_string().contains(name),
            "{error}"
        );
    };
    refused("a_zero", f32::NAN);
    refused("b_zero", f32::INFINITY);
    refused("c_zero", 1.0);
    let unset =
        Form::parse("e.wgsl", "override a: f32; fn f() -> f32 { return a; }", "f").expect("loads");
    assert!(emit(&unset, &BTreeMap::new(), Language::Wgsl, "").is_err());
}
