//! Which overrides are parameters, and how derived ones follow them.

use striae::form::lanes::Evaluator;

use crate::form;

#[test]
fn reached_overrides_are_the_parameters() {
    let form = form(
        "override unused: f32 = 1.0;
        @id(7) override scale: f32 = 2.0;
        override steps: u32 = 3u;
        override twice: f32 = scale * 2.0 + shift;
        override shift: f32;
        override flag: bool = true;
        fn g(x: f32) -> f32 { return x * twice; }
        fn f(x: f32) -> f32 { var y = 0.0; for (var i = 0u; i < steps; i++) { y += g(x); } if flag { y += 1.0; } return y; }",
    );
    let parameters: Vec<_> =
        form.parameters().iter().map(|p| (p.name.as_str(), p.default)).collect();
    assert_eq!(parameters, [("scale", Some(2.0)), ("shift", None)]);
    let dual = form.eval_dual(&[5.0, 0.5], &[0, 1], &[&[1.0, 2.0]]).expect("evaluates");
    assert_eq!(dual.values, [[32.5, 64.0]]);
    assert_eq!(dual.derivatives, [[[6.0, 12.0], [3.0, 6.0]]]);
    let only = form.eval_dual(&[5.0, 0.5], &[1], &[&[1.0, 2.0]]).expect("evaluates");
    assert_eq!(only.derivatives, [[[3.0, 6.0]]]);
}

#[test]
fn defaults_are_the_f32_of_the_text() {
    let form = form("override a: f32 = 0.1; fn f() -> f32 { return a; }");
    assert_eq!(form.parameters()[0].default, Some(f64::from(0.1_f32)));
}

#[test]
fn the_same_function_twice_with_different_evaluators() {
    let form = form("override a: f32; fn f(x: f32) -> f32 { return a * x; }");
    let mut evaluator = Evaluator::<f64>::new(&form);
    let mut values = Vec::new();
    let xs: Vec<f64> = (0..1000).map(f64::from).collect();
    for (a, count) in [(2.0, 1000), (3.0, 7), (4.0, 129)] {
        evaluator.eval_into(&[a], &[&xs[..count]], &mut values).expect("evaluates");
        assert_eq!(values[0], xs[..count].iter().map(|x| a * x).collect::<Vec<_>>());
    }
}
