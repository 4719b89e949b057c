//! Integer arguments: exact whatever their size, refused where they are not whole or out of range.

use striae::form::{Form, FormError, Input, ScalarType};

use crate::form;

/// A hash of two integers, its 32 bits as two halves that f32 holds.
const HASH: &str = "
fn f(seed: u32, step: vec2<i32>) -> vec2<f32> {
    let bits = (seed ^ u32(step.x * step.y)) * 747796405u + 2891336453u;
    return vec2<f32>(f32(bits >> 16u), f32(bits & 0xffffu));
}";

fn hash(seed: u32, x: i32, y: i32) -> [f32; 2] {
    let bits = (seed ^ x.wrapping_mul(y) as u32).wrapping_mul(747_796_405);
    let bits = bits.wrapping_add(2_891_336_453);
    [(bits >> 16) as f32, (bits & 0xffff) as f32]
}

#[test]
fn they_are_exact_in_every_lane() {
    let form = form(HASH);
    assert_eq!(form.input_columns(), ["seed", "step_x", "step_y"]);
    assert_eq!(form.input_types(), [ScalarType::U32, ScalarType::I32, ScalarType::I32]);
    assert_eq!((form.arguments()[1].scalar, form.arguments()[1].components), (ScalarType::I32, 2));
    let seeds: Vec<u32> = (0..300).map(|i| u32::MAX - i * 14_316_557).collect();
    let xs: Vec<i32> = (0..300).map(|i| i32::MIN + i * 7_158_278).collect();
    let ys: Vec<i32> = (0..300).map(|i| 150 - i).collect();
    let of = |i: usize| hash(seeds[i], xs[i], ys[i]);
    let inputs = [Input::from(&seeds), Input::from(&xs), Input::from(&ys)];
    let single = form.eval_f32_inputs(&[], &inputs).expect("evaluates");
    let wide = [
        seeds.iter().map(|&v| v.into()).collect::<Vec<f64>>(),
        xs.iter().map(|&v| v.into()).collect(),
        ys.iter().map(|&v| v.into()).collect(),
    ];
    let doubles = [&wide[0][..], &wide[1], &wide[2]];
    let double = form.eval_f64(&[], &doubles).expect("evaluates");
    let dual = form.eval_dual(&[], &[], &doubles).expect("evaluates");
    // f64 columns hold integers exactly for f32 lanes too.
    let columns = [Input::from(&wide[0]), Input::from(&wide[1]), inputs[2]];
    assert_eq!(single, form.eval_f32_inputs(&[], &columns).expect("evaluates"));
    for i in 0..300 {
        let [high, low] = of(i);
        assert_eq!([single[0][i], single[1][i]], [high, low], "{i}");
        let exact = [high, low].map(f64::from);
        assert_eq!([double[0][i], double[1][i]], exact, "{i}");
        assert_eq!([dual.values[0][i], dual.values[1][i]], exact, "{i}");
    }
    // Small integers may come as f32.
    let small = form.eval_f32(&[], &[&[5.0], &[-3.0], &[7.0]]).expect("evaluates");
    assert_eq!([small[0][0], small[1][0]], hash(5, -3, 7));
}

#[test]
fn derivatives_pass_them_by() {
    let source = "override a: f32 = 2.0;\nfn f(n: i32, x: f32) -> f32 { return f32(n) * a * x; }";
    let dual =
        form(source).eval_dual(&[2.0], &[0], &[&[-3.0, 4.0], &[0.5, 0.25]]).expect("evaluates");
    assert_eq!(dual.values, [[-3.0, 2.0]]);
    assert_eq!(dual.derivatives, [[[-1.5, 1.0]]]);
}

#[test]
fn an_f32_argument_takes_any_column_rounded() {
    let form = form("fn f(x: f32) -> f32 { return x; }");
    let third = 1.0 / 3.0_f64;
    let value = |input: Input<'_>| form.eval_f32_inputs(&[], &[input]).expect("evaluates")[0][0];
    assert_eq!(value(Input::F64(&[third])), third as f32);
    assert_eq!(value(Input::U32(&[u32::MAX])), 4_294_967_296.0);
    assert_eq!(value(Input::I32(&[-7])), -7.0);
}

#[test]
fn what_is_not_whole_or_out_of_range_is_refused() {
    let form = Form::parse("hash.wgsl", HASH, "f").expect("loads");
    let refused = |columns: [&[f64]; 3]| match form.eval_f64(&[], &columns) {
        Err(error @ FormError::Input { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert_eq!(
        refused([&[0.0, 1.0], &[0.0, -0.0], &[0.0, 0.5]]),
        "hash.wgsl: function `f`: argument `step_y`, row 1: expected a whole number from \
         -2147483648 to 2147483647, got 0.5"
    );
    for (seed, got) in
        [(-1.0, "got -1"), (4_294_967_296.0, "got 4294967296"), (f64::NAN, "got NaN")]
    {
        let text = refused([&[seed], &[0.0], &[0.0]]);
        let expected = "argument `seed`, row 0: expected a whole number from 0 to 4294967295, ";
        assert!(text.contains(expected) && text.ends_with(got), "{text}");
    }
    let far = vec![0.0; 200];
    let mut step = far.clone();
    step[150] = 2_147_483_648.0;
    let text = refused([&far, &step, &far]);
    assert!(
        text.contains("argument `step_x`, row 150") && text.ends_with("got 2147483648"),
        "{text}"
    );
    let negative =
        form.eval_f32_inputs(&[], &[Input::I32(&[-1]), Input::I32(&[0]), Input::I32(&[0])]);
    assert!(matches!(negative, Err(FormError::Input { row: 0, got: -1.0, .. })), "{negative:?}");
}
