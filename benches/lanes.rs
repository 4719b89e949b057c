//! Speed of the lanes on one core: the published Si form in f64, f32 and with derivatives, beside
//! the same formula in scalar Rust and, where python3 with NumPy is there, in NumPy.
//!
//! Prints ns per evaluation (best of several runs) and the ratios that the project asks for.

use std::hint::black_box;
use std::process::Command;
use std::time::Instant;

use striae::form::lanes::{DualEvaluator, Evaluator};
use striae::form::{Dual, Form};

const SI: &str = include_str!("../tests/forms/si_published.wgsl");
const PARAMETERS: [f64; 2] = [0.66142739, 0.38272292];
const POINTS: usize = 100_000;

fn main() {
    let form = Form::parse("tests/forms/si_published.wgsl", SI, "si").expect("the fixture loads");
    let xs: Vec<f64> = (0..POINTS).map(|i| -10.0 + 20.0 * i as f64 / (POINTS - 1) as f64).collect();
    let singles: Vec<f32> = xs.iter().map(|&x| x as f32).collect();
    let parameters = PARAMETERS.map(|p| p as f32);

    let mut double = Evaluator::<f64>::new(&form);
    let mut values = Vec::new();
    let f64_lanes = best(POINTS, || {
        double.eval_into(&PARAMETERS, &[&xs], &mut values).expect("evaluates");
    });
    let mut single = Evaluator::<f32>::new(&form);
    let mut values = Vec::new();
    let f32_lanes = best(POINTS, || {
        single.eval_into(&parameters, &[&singles], &mut values).expect("evaluates");
    });
    let mut scalar = vec![0.0_f32; POINTS];
    let f32_scalar = best(POINTS, || {
        for (out, &x) in scalar.iter_mut().zip(black_box(&singles)) {
            *out = si_scalar(x, black_box(parameters));
        }
    });
    assert_eq!(values[0], scalar, "the lanes and scalar Rust agree to the bit");

    let fit_points = &xs[..2001];
    let mut evaluator = DualEvaluator::new(&form, &[0, 1]).expect("two parameters");
    let mut dual = Dual { values: Vec::new(), derivatives: Vec::new() };
    let f64_dual = best(fit_points.len(), || {
        evaluator.eval_into(&PARAMETERS, &[fit_points], &mut dual).expect("evaluates");
    });
    let short = best(1, || drop(black_box(form.eval_f32(&parameters, &[&[0.5]]))));

    println!("published Si form, ns per evaluation, one core");
    println!("  f64 lanes               {f64_lanes:8.2}");
    println!("  f64 lanes, d/d(a0, b0)  {f64_dual:8.2}");
    println!("  f32 lanes               {f32_lanes:8.2}");
    println!("  f32 scalar Rust         {f32_scalar:8.2}");
    println!("  eval_f32 of one point   {short:8.2}");
    println!("f32 lanes / scalar Rust   {:8.2}  (asked for: at most 4)", f32_lanes / f32_scalar);
    match numpy() {
        Some(numpy) => {
            println!("  f64 NumPy               {numpy:8.2}");
            println!(
                "NumPy / f64 lanes         {:8.2}  (asked for: at least 1.5)",
                numpy / f64_lanes
            );
        }
        None => println!("NumPy: not measured (python3 with NumPy not found)"),
    }
}

/// Best time of several runs, in ns per evaluation.
fn best(evaluations: usize, mut run: impl FnMut()) -> f64 {
    let once = |run: &mut dyn FnMut()| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    };
    let shortest = (0..30).map(|_| once(&mut run)).fold(f64::INFINITY, f64::min);
    shortest / evaluations as f64 * 1e9
}

/// The formula of the fixture in its order, with the elementary functions of the f32 lanes.
fn si_scalar(x: f32, [a, b]: [f32; 2]) -> f32 {
    let s = if x == 0.0 { x } else { x.signum() };
    let d = x - s * b;
    let e = 1.0 + d * d;
    std::f32::consts::FRAC_PI_2 * core_math::tanhf(x) - a * x / e
        + s * (1.0 - core_math::cosf(x)) / (1.0 + x.abs())
}

fn numpy() -> Option<f64> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers/si_form_numpy.py");
    let output = Command::new("python3").arg(script).output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}
