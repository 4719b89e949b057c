//! Every built-in function on f32, in f64 and f32 lanes, against scalar Rust.

use core_math as cm;

use crate::{close, form};

type Reference64 = fn(f64, f64, f64) -> f64;
type Reference32 = fn(f32, f32, f32) -> f32;

/// A WGSL expression of x, y, z and the same in Rust.
struct Case(&'static str, Reference64, Reference32);

fn minimum<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}
fn maximum<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

const CASES: &[Case] = &[
    Case("x + y * z", |x, y, z| x + y * z, |x, y, z| x + y * z),
    Case("x / y - z", |x, y, z| x / y - z, |x, y, z| x / y - z),
    Case("x % y", |x, y, _| x % y, |x, y, _| x % y),
    Case("-x", |x, _, _| -x, |x, _, _| -x),
    Case("abs(x)", |x, _, _| x.abs(), |x, _, _| x.abs()),
    Case("min(x, y)", |x, y, _| minimum(x, y), |x, y, _| minimum(x, y)),
    Case("max(x, y)", |x, y, _| maximum(x, y), |x, y, _| maximum(x, y)),
    Case("clamp(x, -0.5, 0.75)", |x, _, _| x.clamp(-0.5, 0.75), |x, _, _| x.clamp(-0.5, 0.75)),
    Case(
        "saturate(x)",
        |x, _, _| minimum(maximum(x, 0.0), 1.0),
        |x, _, _| minimum(maximum(x, 0.0), 1.0),
    ),
    Case(
        "sign(x)",
        |x, _, _| if x == 0.0 { x } else { x.signum() },
        |x, _, _| {
            if x == 0.0 { x } else { x.signum() }
        },
    ),
    Case("floor(x)", |x, _, _| x.floor(), |x, _, _| x.floor()),
    Case("ceil(x)", |x, _, _| x.ceil(), |x, _, _| x.ceil()),
    Case("round(x)", |x, _, _| x.round_ties_even(), |x, _, _| x.round_ties_even()),
    Case("trunc(x)", |x, _, _| x.trunc(), |x, _, _| x.trunc()),
    Case("fract(x)", |x, _, _| x - x.floor(), |x, _, _| x - x.floor()),
    Case("modf(x).fract", |x, _, _| x - x.trunc(), |x, _, _| x - x.trunc()),
    Case("modf(x).whole", |x, _, _| x.trunc(), |x, _, _| x.trunc()),
    Case("step(x, y)", |x, y, _| f64::from(x <= y), |x, y, _| f32::from(x <= y)),
    Case("mix(x, y, z)", |x, y, z| x * (1.0 - z) + y * z, |x, y, z| x * (1.0 - z) + y * z),
    Case(
        "smoothstep(-1.0, 2.0, x)",
        |x, _, _| {
            let t = ((x + 1.0) / 3.0).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        },
        |x, _, _| {
            let t = ((x + 1.0) / 3.0).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        },
    ),
    Case("fma(x, y, z)", |x, y, z| x.mul_add(y, z), |x, y, z| x.mul_add(y, z)),
    Case(
        "degrees(x)",
        |x, _, _| x.to_degrees(),
        |x, _, _| x * (180.0 / std::f64::consts::PI) as f32,
    ),
    Case(
        "radians(x)",
        |x, _, _| x.to_radians(),
        |x, _, _| x * (std::f64::consts::PI / 180.0) as f32,
    ),
    Case("sqrt(abs(x))", |x, _, _| x.abs().sqrt(), |x, _, _| x.abs().sqrt()),
    Case("inverseSqrt(abs(x))", |x, _, _| cm::rsqrt(x.abs()), |x, _, _| cm::rsqrtf(x.abs())),
    Case("sin(x)", |x, _, _| cm::sin(x), |x, _, _| cm::sinf(x)),
    Case("cos(x)", |x, _, _| cm::cos(x), |x, _, _| cm::cosf(x)),
    Case("tan(x)", |x, _, _| cm::tan(x), |x, _, _| cm::tanf(x)),
    Case("asin(x)", |x, _, _| cm::asin(x), |x, _, _| cm::asinf(x)),
    Case("acos(x)", |x, _, _| cm::acos(x), |x, _, _| cm::acosf(x)),
    Case("atan(x)", |x, _, _| cm::atan(x), |x, _, _| cm::atanf(x)),
    Case("atan2(x, y)", |x, y, _| cm::atan2(x, y), |x, y, _| cm::atan2f(x, y)),
    Case("sinh(x)", |x, _, _| cm::sinh(x), |x, _, _| cm::sinhf(x)),
    Case("cosh(x)", |x, _, _| cm::cosh(x), |x, _, _| cm::coshf(x)),
    Case("tanh(x)", |x, _, _| cm::tanh(x), |x, _, _| cm::tanhf(x)),
    Case("asinh(x)", |x, _, _| cm::asinh(x), |x, _, _| cm::asinhf(x)),
    Case(
        "acosh(abs(x) + 1.0)",
        |x, _, _| cm::acosh(x.abs() + 1.0),
        |x, _, _| cm::acoshf(x.abs() + 1.0),
    ),
    Case("atanh(x)", |x, _, _| cm::atanh(x), |x, _, _| cm::atanhf(x)),
    Case("exp(x)", |x, _, _| cm::exp(x), |x, _, _| cm::expf(x)),
    Case("exp2(x)", |x, _, _| cm::exp2(x), |x, _, _| cm::exp2f(x)),
    Case("log(x)", |x, _, _| cm::log(x), |x, _, _| cm::logf(x)),
    Case("log2(x)", |x, _, _| cm::log2(x), |x, _, _| cm::log2f(x)),
    Case("pow(abs(x), y)", |x, y, _| cm::pow(x.abs(), y), |x, y, _| cm::powf(x.abs(), y)),
    Case(
        "select(x, y, z < 0.5)",
        |x, y, z| if z < 0.5 { y } else { x },
        |x, y, z| {
            if z < 0.5 { y } else { x }
        },
    ),
    Case(
        "dot(vec3(x, y, z), vec3(y, z, x))",
        |x, y, z| x * y + y * z + z * x,
        |x, y, z| x * y + y * z + z * x,
    ),
    Case("length(vec2(x, y))", |x, y, _| (x * x + y * y).sqrt(), |x, y, _| (x * x + y * y).sqrt()),
    Case("length(x)", |x, _, _| x.abs(), |x, _, _| x.abs()),
    Case(
        "distance(vec2(x, y), vec2(y, z))",
        |x, y, z| ((x - y) * (x - y) + (y - z) * (y - z)).sqrt(),
        |x, y, z| ((x - y) * (x - y) + (y - z) * (y - z)).sqrt(),
    ),
    Case(
        "normalize(vec3(x, y, z)).y",
        |x, y, z| y / (x * x + y * y + z * z).sqrt(),
        |x, y, z| y / (x * x + y * y + z * z).sqrt(),
    ),
    Case("cross(vec3(x, y, z), vec3(z, x, y)).x", |x, y, z| y * y - z * x, |x, y, z| y * y - z * x),
    Case("cross(vec3(x, y, z), vec3(z, x, y)).y", |x, y, z| z * z - x * y, |x, y, z| z * z - x * y),
    Case("cross(vec3(x, y, z), vec3(z, x, y)).z", |x, y, z| x * x - y * z, |x, y, z| x * x - y * z),
    Case(
        "reflect(vec2(x, y), vec2(0.6, 0.8)).y",
        |x, y, _| {
            let (a, b) = (f64::from(0.6_f32), f64::from(0.8_f32));
            y - 2.0 * (a * x + b * y) * b
        },
        |x, y, _| y - 2.0 * (0.6 * x + 0.8 * y) * 0.8,
    ),
    Case(
        "refract(vec2(x, y), vec2(0.0, 1.0), z).y",
        |x, y, z| {
            let d = 0.0 * x + 1.0 * y;
            let k = 1.0 - z * z * (1.0 - d * d);
            if k < 0.0 { 0.0 } else { z * y - (z * d + k.sqrt()) * 1.0 }
        },
        |x, y, z| {
            let d = 0.0 * x + 1.0 * y;
            let k = 1.0 - z * z * (1.0 - d * d);
            if k < 0.0 { 0.0 } else { z * y - (z * d + k.sqrt()) * 1.0 }
        },
    ),
    Case(
        "faceForward(vec2(x, y), vec2(y, z), vec2(1.0, 1.0)).x",
        |x, y, z| if y + z < 0.0 { x } else { -x },
        |x, y, z| if y + z < 0.0 { x } else { -x },
    ),
    Case("ldexp(x, 3)", |x, _, _| x * 8.0, |x, _, _| x * 8.0),
    Case(
        "ldexp(x, -130)",
        |x, _, _| x * 2f64.powi(-130),
        |x, _, _| (f64::from(x) * 2f64.powi(-130)) as f32,
    ),
    Case(
        "ldexp(frexp(x).fract, frexp(x).exp) + f32(frexp(x).exp)",
        |x, _, _| x + f64::from(exponent(x)),
        |x, _, _| x + exponent(f64::from(x)) as f32,
    ),
    Case(
        "f32(i32(x)) + f32(u32(y))",
        |x, y, _| f64::from(x as i32) + f64::from(y as u32),
        |x, y, _| (x as i32) as f32 + (y as u32) as f32,
    ),
    Case(
        "bitcast<f32>(bitcast<u32>(x) ^ 0x80000000u)",
        |x, _, _| f64::from(-(x as f32)),
        |x, _, _| -x,
    ),
];

fn exponent(x: f64) -> i32 {
    if x == 0.0 { 0 } else { x.abs().log2().floor() as i32 + 1 }
}

/// Functions whose f64 kernels are within a stated error instead of correctly rounded.
fn tolerance_ulps(expression: &str) -> f64 {
    if expression.starts_with("length(vec") || expression.starts_with("inverseSqrt") {
        2.0
    } else {
        4.0
    }
}

fn points() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let mut xs: Vec<f64> = (0..701).map(|i| f64::from(-3.5 + 0.01 * i as f32)).collect();
    xs.extend([
        0.0, -0.0, 0.5, 1.5, 2.5, -0.5, 1.0, -1.0, 1e-20, -1e-5, 40.0, -40.0, 1e4, 3e8, -1e6,
    ]);
    let ys = xs.iter().map(|x| f64::from((1.25 * (x * 7.3).sin() + 0.1) as f32)).collect();
    let zs = xs.iter().map(|x| f64::from((0.5 + 0.7 * (x * 3.1).cos()) as f32)).collect();
    (xs, ys, zs)
}

#[test]
fn against_scalar_rust() {
    let (xs, ys, zs) = points();
    let single = |values: &[f64]| values.iter().map(|&v| v as f32).collect::<Vec<f32>>();
    let (x32, y32, z32) = (single(&xs), single(&ys), single(&zs));
    let mut failures = Vec::new();
    for Case(expression, reference64, reference32) in CASES {
        let form = form(&format!("fn f(x: f32, y: f32, z: f32) -> f32 {{ return {expression}; }}"));
        let doubles = form.eval_f64(&[], &[&xs, &ys, &zs]).expect("evaluates");
        let singles = form.eval_f32(&[], &[&x32, &y32, &z32]).expect("evaluates");
        for at in 0..xs.len() {
            let (got, expected) = (doubles[0][at], reference64(xs[at], ys[at], zs[at]));
            if !close(got, expected, tolerance_ulps(expression)) {
                failures.push(format!("{expression} at {} f64: {got} not {expected}", xs[at]));
            }
            let (got, expected) = (singles[0][at], reference32(x32[at], y32[at], z32[at]));
            if got.to_bits() != expected.to_bits() && !(got.is_nan() && expected.is_nan()) {
                failures.push(format!("{expression} at {} f32: {got} not {expected}", xs[at]));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} failures:\n{}",
        failures.len(),
        failures[..failures.len().min(20)].join("\n")
    );
}

#[test]
fn nan_is_not_hidden() {
    for expression in [
        "min(x, 1.0)",
        "max(1.0, x)",
        "clamp(x, 0.0, 1.0)",
        "saturate(x)",
        "sign(x)",
        "mix(x, 1.0, 0.0)",
    ] {
        let form = form(&format!("fn f(x: f32) -> f32 {{ return {expression}; }}"));
        assert!(
            form.eval_f64(&[], &[&[f64::NAN]]).expect("evaluates")[0][0].is_nan(),
            "{expression}"
        );
        assert!(
            form.eval_f32(&[], &[&[f32::NAN]]).expect("evaluates")[0][0].is_nan(),
            "{expression}"
        );
    }
    let pow = form("fn f(x: f32) -> f32 { return pow(x, 2.0); }");
    assert!(pow.eval_f64(&[], &[&[-2.0]]).expect("evaluates")[0][0].is_nan());
}

#[test]
fn integers_and_bits() {
    let cases: &[(&str, i64)] = &[
        ("n / (n - 37)", 37),
        ("n % (n - 37)", 0),
        ("-n / 5", -7),
        ("-n % 5", -2),
        ("(n - 37 - 2147483647 - 1) / (36 - n)", i64::from(i32::MIN)),
        ("n << 3u", 296),
        ("-n >> 2u", -10),
        ("i32(countOneBits(n))", 3),
        ("i32(countLeadingZeros(n))", 26),
        ("i32(countTrailingZeros(n << 2u))", 2),
        ("firstLeadingBit(n)", 5),
        ("firstLeadingBit(-n)", 5),
        ("firstTrailingBit(n)", 0),
        ("firstTrailingBit(n - n)", -1),
        ("reverseBits(n)", i64::from(37_i32.reverse_bits())),
        ("extractBits(n, 2u, 4u)", -7),
        ("insertBits(n, 3, 1u, 2u)", 39),
        ("abs(-n)", 37),
        ("sign(-n)", -1),
        ("min(n, 5) + max(n, 50) + clamp(n, 40, 60)", 95),
        ("(n & 12) | (n ^ 5)", 36),
        ("~n", -38),
        ("dot(vec2(n, 2), vec2(3, n))", 185),
        ("select(1, 2, n > 3)", 2),
        ("i32(u32(n) / 5u)", 7),
        ("i32(1e20 * f32(n))", 2_147_483_520),
        ("i32(-1e20 * f32(n))", i64::from(i32::MIN)),
        ("i32(f32(n) * 0.1)", 3),
        ("i32(n == 37) + i32(bool(n))", 2),
    ];
    for (expression, expected) in cases {
        let source = format!(
            "fn f(x: f32) -> f32 {{ let n = i32(x); let r: i32 = {expression}; return f32(r / 65536) * 65536.0 + f32(r % 65536); }}"
        );
        let form = form(&source);
        assert_eq!(
            form.eval_f64(&[], &[&[37.0]]).expect("evaluates")[0][0],
            *expected as f64,
            "{expression}"
        );
    }
}

#[test]
fn quantize_to_f16() {
    let form = form("fn f(x: f32) -> f32 { return quantizeToF16(x); }");
    let cases = [
        (1.0, 1.0),
        (1.0 + 1.0 / 2048.0, 1.0),
        (1.0 + 3.0 / 2048.0, 1.0 + 2.0 / 1024.0),
        (65504.0, 65504.0),
        (-65520.0, f32::NEG_INFINITY),
        (3e-8, 2f32.powi(-25) * 2.0),
        (2e-8, 0.0),
        (0.1, 0.099_975_586),
        (1e-5, 1.001_358e-5),
    ];
    for (x, expected) in cases {
        let got = form.eval_f32(&[], &[&[x]]).expect("evaluates")[0][0];
        assert_eq!(got, expected, "{x}");
    }
}
