//! What forms cannot use is refused by name and line.

use striae::form::{Form, FormError, MAX_BRACKET_NESTING, MAX_OPERATORS, MAX_SOURCE_BYTES};

/// Module-scope text, the function's body, what the message must contain, and its line.
const REFUSED: &[(&str, &str, &str, usize)] = &[
    (
        "@group(0) @binding(0) var t: texture_2d<f32>;",
        "return textureLoad(t, vec2(0, 0), 0).x;",
        "textureLoad",
        3,
    ),
    (
        "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;",
        "return textureSampleLevel(t, s, vec2(x), 0.0).x;",
        "texture",
        4,
    ),
    (
        "@group(0) @binding(0) var<storage, read> b: array<f32>;",
        "return b[0];",
        "storage buffer",
        1,
    ),
    ("@group(0) @binding(0) var<uniform> u: vec4<f32>;", "return u.x;", "uniform buffer", 1),
    ("var<workgroup> w: f32;", "return w + x;", "workgroup", 1),
    (
        "fn g(p: ptr<function, f32>) -> f32 { return *p; }",
        "var y = x; return g(&y);",
        "pointer passed to function `g`",
        3,
    ),
    ("", "return dpdx(x);", "derivative", 3),
    ("", "return fwidth(x) + 1.0;", "derivative", 3),
    ("var<workgroup> a: atomic<u32>;", "return f32(atomicAdd(&a, 1u));", "atomic", 3),
    ("", "workgroupBarrier(); return x;", "barrier", 3),
    ("", "return x + f32(subgroupAdd(1u));", "subgroup", 3),
    ("enable f16;", "let h = f16(x); return f32(h);", "f16", 3),
    ("", "let m = mat2x2<f32>(x, 0.0, 0.0, x); return m[0][0];", "mat2x2<f32>", 3),
    ("", "return f32(pack4x8snorm(vec4(x)));", "Pack4x8snorm", 3),
    ("", "if x > 1.0 { discard; } return x;", "discard", 3),
    ("override n: u32;", "return x * f32(n);", "override `n` without a value", 1),
];

#[test]
fn by_name_and_line() {
    for (scope, body, name, line) in REFUSED {
        // The body stands on line 3 when the module scope takes one line.
        let source = format!("{scope}\nfn f(x: f32) -> f32 {{\n{body}\n}}\n");
        match Form::parse("refused.wgsl", &source, "f") {
            Err(error @ FormError::Unsupported { .. }) => {
                let text = error.to_string();
                assert!(text.contains(name), "{body}: {text}");
                let FormError::Unsupported { line: got, origin, .. } = error else { continue };
                assert_eq!((origin.as_str(), got), ("refused.wgsl", *line), "{body}: {text}");
            }
            other => panic!("{body}: {other:?}"),
        }
    }
}

#[test]
fn what_the_function_does_not_reach_does_not_matter() {
    let source = "@group(0) @binding(0) var t: texture_2d<f32>;
        @compute @workgroup_size(1) fn main() { _ = textureLoad(t, vec2(0, 0), 0); }
        fn f(x: f32) -> f32 { return x; }";
    assert!(Form::parse("shader.wgsl", source, "f").is_ok());
}

#[test]
fn signatures() {
    for (signature, name) in [
        ("fn f(x: bool) -> f32 { return 1.0; }", "bool"),
        ("fn f(x: vec2<bool>) -> f32 { return 1.0; }", "vec2<bool"),
        ("enable f16; fn f(x: vec2<f16>) -> f32 { return 1.0; }", "vec2<f16>"),
        ("fn f(x: array<f32, 3>) -> f32 { return 1.0; }", "array<f32, 3>"),
        ("fn f(x: f32) -> i32 { return 1; }", "i32"),
        ("fn f(x: f32) -> vec2<u32> { return vec2(1u); }", "vec2<u32>"),
        ("fn f(x: f32) { }", "returns nothing"),
    ] {
        let error = Form::parse("s.wgsl", signature, "f").expect_err(signature).to_string();
        assert!(error.contains(name) && error.starts_with("s.wgsl:1:"), "{error}");
    }
}

#[test]
fn a_missing_function_lists_the_ones_there_are() {
    let source = "fn beta() -> f32 { return 1.0; } fn alpha() -> f32 { return 1.0; }";
    let error = Form::parse("a.wgsl", source, "gamma").expect_err("there is none").to_string();
    assert!(error.contains("a.wgsl") && error.contains("`gamma`") && error.contains("alpha, beta"));
}

#[test]
fn diagnostics_show_file_line_and_caret() {
    for source in [
        "fn f(x: f32) -> f32 {\n return y;\n}",
        "fn f(x: f32) -> f32 {\n return 1u;\n}",
        "fn f(x: f32 -> f32 {\n}",
    ] {
        let error = Form::parse("dir/broken.wgsl", source, "f").expect_err(source).to_string();
        assert!(error.contains("dir/broken.wgsl:") && error.contains('^'), "{error}");
    }
}

#[test]
fn hostile_sizes() {
    let too_large = |source: &str| {
        let started = std::time::Instant::now();
        let result = Form::parse("big.wgsl", source, "f");
        let took = started.elapsed().as_secs_f64();
        // A bound on hanging, not on speed: machines are shared.
        assert!(took < 60.0, "took {took} s: {}", &source[..source.len().min(200)]);
        assert!(result.is_err());
        assert!(result.expect_err("too large").to_string().contains("big.wgsl"));
    };
    let nested = |n: usize, open: &str, close: &str| {
        format!("fn f(x: f32) -> f32 {{ return {}x{}; }}", open.repeat(n), close.repeat(n))
    };
    too_large(&nested(MAX_BRACKET_NESTING + 1, "(", ")"));
    too_large(&nested(100_000, "(", ")"));
    too_large(&nested(100_000, "-", ""));
    too_large(&nested(100_000, "x+", ""));
    too_large(&nested(100_000, "x\n+", ""));
    too_large(&nested(100_000, "!\n", ""));
    too_large(&nested(MAX_OPERATORS * 2, "x * ", ""));
    too_large(&"a".repeat(MAX_SOURCE_BYTES + 1));
    let chain = "else if x > 1.0 { return 2.0; }\n".repeat(20_000);
    too_large(&format!("fn f(x: f32) -> f32 {{ if x > 0.0 {{ return 1.0; }} {chain} return x; }}"));
    // Calls are inlined: forty functions that call the one before twice are 2⁴⁰ calls.
    let mut doubling = String::from("fn g0_a(x: f32) -> f32 { return x + 1.0; }\n");
    for i in 1..40 {
        let before = i - 1;
        doubling.push_str(&format!(
            "fn g{i}_a(x: f32) -> f32 {{ return g{before}_a(x) * g{before}_a(x + 1.0); }}\n"
        ));
    }
    too_large(&format!("{doubling} fn f(x: f32) -> f32 {{ return g39_a(x); }}"));
    let chain: String = (1..2000)
        .map(|i| format!("fn h{i}_a(x: f32) -> f32 {{ return h{}_a(x); }}\n", i - 1))
        .collect();
    too_large(&format!(
        "fn h0_a(x: f32) -> f32 {{ return x; }}\n{chain} fn f(x: f32) -> f32 {{ return h1999_a(x); }}"
    ));
    too_large("fn f(x: f32) -> f32 { var a: array<f32, 1000000>; return a[u32(x)]; }");
}
