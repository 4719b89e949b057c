//! Derivatives by the parameters against central differences.

use crate::form;

/// Bodies of `f(x)` with parameters a, b and c near (0.7, 1.3, 0.4).
const BODIES: &[&str] = &[
    "return a * x + b * b - c / a;",
    "return a + x;",
    "return x - b * x * a;",
    "return exp(a * x) + exp2(b * x) + log(a + x * x) + log2(b + x * x);",
    "return sin(a * x) + cos(b * x) + tan(c * x);",
    "return sinh(a * x) + cosh(b * x) + tanh(c * x);",
    "return asin(a * 0.3) + acos(b * 0.3) + atan(c * x) + atan2(a * x, b) + atan2(b, x);",
    "return asinh(a * x) + acosh(1.0 + b * b) + atanh(c * 0.5);",
    "return sqrt(a * a + x * x) + inverseSqrt(b + x * x) + pow(a + x * x, b) + pow(b, x);",
    "return abs(a * x) + min(a * x, b) + max(a * x, c) + clamp(a * x, c, b) + saturate(a * x);",
    "return mix(a, b, x) + smoothstep(c, b, a * x) + step(c, a * x) * a + fract(a * x) + a * sign(x);",
    "return fma(a, x, b) + degrees(a) + radians(b) + fma(x, b, a * c);",
    "return floor(a * x) * b + round(x * b) * c + trunc(c * x) + ceil(a);",
    "return (a * x + 3.0) % b + modf(a * x).fract + modf(b * x).whole * c;",
    "return ldexp(a * x, 3) + frexp(a + x * x).fract + c * f32(frexp(a).exp);",
    "return select(a * x, b * x, x > 0.3) + length(vec2(a, x)) + distance(vec2(a, b), vec2(x, c));",
    "return dot(vec3(a, b, c), vec3(x, c, a)) + normalize(vec3(a, b, x)).y + cross(vec3(a, x, b), vec3(c, b, x)).z;",
    "return reflect(vec2(a, x), normalize(vec2(b, c))).x + refract(normalize(vec2(a, -1.0)), vec2(0.0, 1.0), c).y;",
    "return faceForward(vec2(a, b), vec2(c, x), vec2(1.0, 0.1)).y;",
    "if x < 0.1 { return a * x; } var s = b; if a * x > 0.5 { s *= a; } else { s += c; } return s;",
    "var s = a; for (var i = 0; i < 6; i++) { if f32(i) > 3.0 * x { break; } if i == 2 { continue; } s = s * b + c * x; } return s;",
    "var t = array<f32, 3>(a, b, c); let i = u32(abs(x) * 3.0); t[i] *= x; return t[0] + 2.0 * t[1] + 3.0 * t[(i + 1u) % 3u];",
    "var v = vec3(a, 1.0, x); v[u32(abs(x) * 3.0)] = b * c; return v.x * v.y + v.z;",
    "switch i32(x * 3.0) { case 0: { return a * a; } case 1: { return b * x; } default: { return c; } }",
    "let k = a * 2.0 + helper(b); return helper(k * x) * helper(c);",
    "return bitcast<f32>(bitcast<u32>(a)) + b;",
    "return derived * x + tanh(derived);",
];

fn source(body: &str) -> String {
    format!(
        "override a: f32; override b: f32; override c: f32;
        override derived: f32 = a * b + 2.0 * c;
        fn helper(v: f32) -> f32 {{ if v > 1.0 {{ return v * v; }} return 0.5 * v; }}
        fn f(x: f32) -> f32 {{ {body} return a * 0.0 + b * 0.0 + c * 0.0 + derived * 0.0; }}"
    )
}

#[test]
fn against_central_differences() {
    let xs: Vec<f64> = (0..200).map(|i| -1.03 + 0.0107 * f64::from(i)).collect();
    let p = [0.7134, 1.3171, 0.4093];
    for body in BODIES {
        // naga refuses code after a return that always happens: then the body stands alone.
        let ends = body.starts_with("return");
        let text = if ends {
            source(body).replace("return a * 0.0 + b * 0.0 + c * 0.0 + derived * 0.0;", "")
        } else {
            source(body).replace(" return a * 0.0 + b * 0.0 + c * 0.0 + derived * 0.0;", "")
        };
        let form = form(&text);
        let names: Vec<&str> = form.parameters().iter().map(|q| q.name.as_str()).collect();
        let at: Vec<f64> = names.iter().map(|n| p[(n.as_bytes()[0] - b'a') as usize]).collect();
        let free: Vec<usize> = (0..at.len()).collect();
        let dual = form.eval_dual(&at, &free, &[&xs]).expect("evaluates");
        assert_eq!(dual.values, form.eval_f64(&at, &[&xs]).expect("evaluates"));
        for k in free {
            let h = 1e-6;
            let shifted = |d: f64| {
                let mut q = at.clone();
                q[k] += d;
                form.eval_f64(&q, &[&xs]).expect("evaluates").remove(0)
            };
            let (up, down) = (shifted(h), shifted(-h));
            for i in 0..xs.len() {
                let mut difference = (up[i] - down[i]) / (2.0 * h);
                if body.contains("bitcast") && names[k] == "a" {
                    difference = 0.0;
                }
                let got = dual.derivatives[0][k][i];
                let scale = 1.0 + difference.abs() + dual.values[0][i].abs();
                assert!(
                    (got - difference).abs() < 2e-8 * scale,
                    "d/d{} at x = {}: {got}, difference {difference}\n{body}",
                    names[k],
                    xs[i]
                );
            }
        }
    }
}

#[test]
fn zero_tangents_beside_infinite_partials() {
    let form = form(
        "override a: f32; override b: f32; fn f(x: f32) -> f32 { return sqrt(x * a) + pow(x, b) + a; }",
    );
    let dual = form.eval_dual(&[1.0, 2.0], &[0, 1], &[&[0.0]]).expect("evaluates");
    assert_eq!(dual.derivatives, [[[1.0], [0.0]]]);
}

#[test]
fn many_free_parameters() {
    let names: Vec<String> = (0..70).map(|i| format!("p{i}_q")).collect();
    let overrides: String = names.iter().map(|n| format!("override {n}: f32;\n")).collect();
    let sum = names.iter().enumerate().map(|(i, n)| format!("{n} * {i}.0")).collect::<Vec<_>>();
    let form =
        form(&format!("{overrides} fn f(x: f32) -> f32 {{ return x * ({}); }}", sum.join("\n + ")));
    let free: Vec<usize> = (0..70).rev().collect();
    let dual = form.eval_dual(&[1.0; 70], &free, &[&[2.0]]).expect("evaluates");
    for (k, &parameter) in free.iter().enumerate() {
        assert_eq!(dual.derivatives[0][k][0], 2.0 * parameter as f64);
    }
}
