//! Divergent control flow: each lane must come out as if it had run alone.

use crate::{SI, form, value};
use striae::form::{Form, FormError};

/// Evaluates many points together and each alone, and compares both with `reference`.
fn check(source: &str, reference: impl Fn(f64) -> f64) {
    let form = form(source);
    let xs: Vec<f64> = (0..400).map(|i| f64::from((i * 7) % 41) * 0.5 - 4.0).collect();
    let together = form.eval_f64(&[], &[&xs]).expect("evaluates");
    for (&x, &got) in xs.iter().zip(&together[0]) {
        let alone = form.eval_f64(&[], &[&[x]]).expect("evaluates")[0][0];
        assert_eq!(got, alone, "at {x}\n{source}");
        assert_eq!(got, reference(x), "at {x}\n{source}");
    }
}

#[test]
fn published_si_form() {
    let form = Form::parse("si.wgsl", SI, "si").expect("loads");
    let xs: Vec<f64> = (0..2001).map(|i| -10.0 + 0.01 * f64::from(i)).collect();
    let (a, b) = (0.66142739, 0.38272292);
    let values = form.eval_f64(&[a, b], &[&xs]).expect("evaluates");
    for (&x, &value) in xs.iter().zip(&values[0]) {
        let s = if x == 0.0 { 0.0 } else { x.signum() };
        let d = x - s * b;
        let expected = f64::from(std::f32::consts::FRAC_PI_2) * x.tanh() - a * x / (1.0 + d * d)
            + s * (1.0 - x.cos()) / (1.0 + x.abs());
        assert!((value - expected).abs() < 2e-15, "{x}: {value} {expected}");
    }
}

#[test]
fn branches() {
    check(
        "fn f(x: f32) -> f32 {
            if x < 0.0 { return -x; } else if x < 5.0 { if x > 2.0 { return 2.0; } }
            return x * 0.5;
        }",
        |x| {
            if x < 0.0 {
                -x
            } else if x < 5.0 && x > 2.0 {
                2.0
            } else {
                x * 0.5
            }
        },
    );
}

#[test]
fn loops_with_break_continue_and_return() {
    check(
        "fn f(x: f32) -> f32 {
            var sum = 0.0;
            for (var i = 0; i < 12; i++) {
                if f32(i) > x { break; }
                if i == 3 { continue; }
                if i == 9 { return 1000.0 + sum; }
                sum += f32(i);
            }
            return sum;
        }",
        |x| {
            let mut sum = 0.0;
            for i in 0..12 {
                if f64::from(i) > x {
                    break;
                }
                if i == 3 {
                    continue;
                }
                if i == 9 {
                    return 1000.0 + sum;
                }
                sum += f64::from(i);
            }
            sum
        },
    );
}

#[test]
fn continuing_and_break_if() {
    check(
        "fn f(x: f32) -> f32 {
            var i = 0;
            var sum = 0.0;
            loop {
                if i % 2 == 1 { continue; }
                sum += 1.0;
                continuing { i += 1; sum += 0.25; break if f32(i) > x; }
            }
            return sum;
        }",
        |x| {
            let (mut i, mut sum) = (0, 0.0);
            loop {
                if i % 2 == 0 {
                    sum += 1.0;
                }
                i += 1;
                sum += 0.25;
                if f64::from(i) > x {
                    return sum;
                }
            }
        },
    );
}

#[test]
fn nested_loops_and_while() {
    check(
        "fn f(x: f32) -> f32 {
            var n = 0;
            var i = 0;
            while f32(i) < x {
                for (var j = 0; j < 20; j++) {
                    if j > i { break; }
                    if f32(j) > x - 3.0 { continue; }
                    n += 1;
                }
                i += 1;
            }
            return f32(n);
        }",
        |x| {
            let (mut n, mut i) = (0, 0);
            while f64::from(i) < x {
                for j in 0..20 {
                    if j > i {
                        break;
                    }
                    if f64::from(j) > x - 3.0 {
                        continue;
                    }
                    n += 1;
                }
                i += 1;
            }
            f64::from(n)
        },
    );
}

#[test]
fn switch_inside_a_loop() {
    check(
        "fn f(x: f32) -> f32 {
            var r = 0.0;
            for (var i = 0; i < 4; i++) {
                switch i32(x) + i {
                    case 0, 1: { r += 10.0; }
                    case 2: { if x > 2.25 { break; } r += 100.0; }
                    case 3: { continue; }
                    case 4: { return r; }
                    default: { r += 1.0; }
                }
                r += 0.5;
            }
            return r;
        }",
        |x| {
            let mut r = 0.0;
            for i in 0..4 {
                match x as i32 + i {
                    0 | 1 => r += 10.0,
                    2 => {
                        if x <= 2.25 {
                            r += 100.0;
                        }
                    }
                    3 => continue,
                    4 => return r,
                    _ => r += 1.0,
                }
                r += 0.5;
            }
            r
        },
    );
}

#[test]
fn calls_return_early_per_lane() {
    check(
        "var<private> calls: i32 = 0;
        fn g(x: f32) -> f32 { calls += 1; if x < 0.0 { return -1.0; } return x * x; }
        fn f(x: f32) -> f32 {
            var s = 0.0;
            for (var i = 0; i < 3; i++) { if g(x - f32(i)) < 0.0 { break; } s += g(x); }
            return s + f32(calls);
        }",
        |x| {
            let (mut s, mut calls) = (0.0, 0.0);
            for i in 0..3 {
                calls += 1.0;
                if x - f64::from(i) < 0.0 {
                    break;
                }
                calls += 1.0;
                s += if x < 0.0 { -1.0 } else { x * x };
            }
            s + calls
        },
    );
}

#[test]
fn short_circuit_and_booleans() {
    check(
        "fn f(x: f32) -> f32 {
            let a = x > 0.0 && x < 3.0;
            let b = x < -2.0 || !(x < 10.0);
            return select(0.0, 1.0, a) + select(0.0, 2.0, b) + select(0.0, 4.0, a != b)
                + select(0.0, 8.0, any(vec2(x, 1.0) > vec2(2.0))) + f32(a | b);
        }",
        |x| {
            let a = x > 0.0 && x < 3.0;
            let b = !(-2.0..10.0).contains(&x);
            let bit = |b: bool, v: f64| if b { v } else { 0.0 };
            bit(a, 1.0) + bit(b, 2.0) + bit(a != b, 4.0) + bit(x > 2.0, 8.0) + bit(a | b, 1.0)
        },
    );
}

#[test]
fn arrays_tables_and_out_of_bounds() {
    check(
        "const TABLE = array<f32, 5>(1.0, 2.0, 4.0, 8.0, 16.0);
        const PAIRS = array<vec2<f32>, 3>(vec2(1.0, 2.0), vec2(3.0, 4.0), vec2(5.0, 6.0));
        fn f(x: f32) -> f32 {
            var a = array<f32, 4>(0.0, 10.0, 20.0, 30.0);
            let i = i32(floor(x));
            a[i] += 0.5;
            var v = vec3(1.0, 2.0, 3.0);
            v[u32(max(x, 0.0)) % 3u] = 7.0;
            return TABLE[i] + a[i] + PAIRS[i].y + v.x + v.y + v.z;
        }",
        |x| {
            let i = x.floor() as i32 as u32 as usize;
            let table = [1.0, 2.0, 4.0, 8.0, 16.0];
            let a = [0.0, 10.0, 20.0, 30.0];
            let pairs = [2.0, 4.0, 6.0];
            let mut v = [1.0, 2.0, 3.0];
            v[x.max(0.0) as usize % 3] = 7.0;
            table[i.min(4)] + (a[i.min(3)] + 0.5) + pairs[i.min(2)] + v[0] + v[1] + v[2]
        },
    );
}

#[test]
fn structs_swizzles_and_vectors() {
    check(
        "struct Pair { first: vec2<f32>, second: f32 }
        fn make(x: f32) -> Pair { var p: Pair; p.first = vec2(x, 2.0 * x); p.second = 3.0; return p; }
        fn f(x: f32) -> f32 {
            var p = make(x);
            p.first.y += 1.0;
            var grid: array<array<f32, 2>, 2>;
            grid[1][0] = p.first.yx.x;
            grid[u32(x > 0.0)][1] = 5.0;
            let v = vec4(p.first, p.second, 1.0).wzyx;
            return v.x + v.y * 10.0 + v.z * 100.0 + grid[1][0] + grid[1][1] * 1000.0;
        }",
        |x| {
            let y = 2.0 * x + 1.0;
            1.0 + 30.0 + y * 100.0 + y + if x > 0.0 { 5000.0 } else { 0.0 }
        },
    );
}

#[test]
fn vector_arguments_and_results() {
    let form = form("fn f(p: vec2<f32>, s: f32) -> vec3<f32> { return vec3(p * s, p.x + p.y); }");
    assert_eq!(form.input_columns(), ["p_x", "p_y", "s"]);
    assert_eq!(form.output_columns(), ["value_x", "value_y", "value_z"]);
    let out = form.eval_f64(&[], &[&[1.0, 2.0], &[3.0, 4.0], &[10.0, 100.0]]).expect("evaluates");
    assert_eq!(out, [vec![10.0, 200.0], vec![30.0, 400.0], vec![4.0, 6.0]]);
}

#[test]
fn a_form_without_inputs_has_one_point() {
    let form = form("override a: f32; fn f() -> f32 { return a * 2.0; }");
    assert_eq!(form.eval_f64(&[4.0], &[]).expect("evaluates"), [[8.0]]);
    assert_eq!(form.eval_f64(&[4.0], &[]).expect("evaluates")[0].len(), 1);
}

#[test]
fn wrong_shapes_are_errors() {
    let form = form("override a: f32; fn f(x: f32, y: f32) -> f32 { return a * x * y; }");
    let shape = |result: Result<_, FormError>| matches!(result, Err(FormError::Shape { .. }));
    assert!(shape(form.eval_f64(&[], &[&[1.0], &[1.0]]).map(drop)));
    assert!(shape(form.eval_f64(&[1.0], &[&[1.0]]).map(drop)));
    assert!(shape(form.eval_f64(&[1.0], &[&[1.0], &[1.0, 2.0]]).map(drop)));
    assert!(shape(form.eval_dual(&[1.0], &[1], &[&[1.0], &[1.0]]).map(drop)));
    assert!(shape(form.eval_dual(&[1.0], &[0, 0], &[&[1.0], &[1.0]]).map(drop)));
    assert_eq!(form.eval_f64(&[1.0], &[&[], &[]]).expect("no points"), [Vec::<f64>::new()]);
}

#[test]
fn loops_that_do_not_end_are_errors() {
    let endless = [
        "fn f(x: f32) -> f32 {\n var i = 0;\n loop {\n i += 1;\n if f32(i) < -x { break; }\n }\n return f32(i);\n}",
        "fn f(x: f32) -> f32 {\n var s = x;\n for (var i = 0; i < 60000; i++) {\n for (var j = 0; j < 60000; j++) {\n s = sin(s); } }\n return s;\n}",
    ];
    for source in endless {
        let started = std::time::Instant::now();
        match form(source).eval_f32(&[], &[&[1.0; 500]]) {
            Err(FormError::Unbounded { line, .. }) => assert!((3..=4).contains(&line), "{line}"),
            other => panic!("{other:?}"),
        }
        // A bound on hanging, not on speed: machines are shared.
        assert!(started.elapsed().as_secs_f64() < 60.0);
    }
    // A loop that ends, if late, is no error.
    assert_eq!(
        value(
            "fn f(x: f32) -> f32 { var i = 0; while f32(i) < x { i++; } return f32(i); }",
            60000.0
        ),
        60000.0
    );
}
