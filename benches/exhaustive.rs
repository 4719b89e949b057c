//! The largest error of the accurate forms of Si over every f32 from 0 to 1e4, no point left out.
//!
//! The positive side suffices, since the forms are odd to the bit (a law of the effect). About a
//! minute on two cores.

use std::path::Path;

use rayon::prelude::*;
use striae::effects::sine_integral::sine_integral;
use striae::fit::FitResult;
use striae::validate::accuracy::Shipped;

/// Arguments per piece of work.
const PIECE: u32 = 1 << 16;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let names = ["auxiliary_large", "auxiliary_lean"];
    let forms: Vec<Shipped> = names
        .iter()
        .map(|name| {
            let path = root.join("fits/sine_integral").join(format!("{name}.json"));
            let result = FitResult::read(&path).expect("a committed result");
            Shipped::of(&result.outcomes()[0], root).expect("a form")
        })
        .collect();
    let (first, last) = (0, 1e4_f32.to_bits());
    let starts: Vec<u32> = (first..=last).step_by(PIECE as usize).collect();
    let worst = starts
        .par_iter()
        .map(|start| {
            let x: Vec<f32> = (*start..=last.min(start + PIECE - 1)).map(f32::from_bits).collect();
            let truth: Vec<f64> = x.iter().map(|x| sine_integral(f64::from(*x))).collect();
            forms.iter().map(|form| worst(form, &x, &truth)).collect::<Vec<_>>()
        })
        .reduce(
            || vec![(0.0, 0.0); forms.len()],
            |a, b| a.into_iter().zip(b).map(|(a, b)| if b.0 > a.0 { b } else { a }).collect(),
        );
    println!("every f32 from 0 to 1e4: {} arguments", last - first + 1);
    for (name, (error, x)) in names.iter().zip(worst) {
        println!("  {name:<16} max |error| {error:.3e} at x = {x:e}");
    }
}

fn worst(form: &Shipped, x: &[f32], truth: &[f64]) -> (f64, f32) {
    let values = form.form.eval_f32(&form.constants_f32, &[x]).expect("a value everywhere");
    values[0].iter().zip(truth).zip(x).fold((0.0, 0.0), |worst, ((value, truth), x)| {
        let error = (f64::from(*value) - truth).abs();
        if error > worst.0 || error.is_nan() { (error, *x) } else { worst }
    })
}
