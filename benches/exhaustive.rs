//! The largest error of the accurate forms of Si over every f32 from 0 to 1e4, no point left out.
//!
//! The positive side suffices, since the forms are odd to the bit (a law of the effect). About a
//! minute on two cores.

use rayon::prelude::*;
use striae::effect::Candidate;
use striae::effects::sine_integral::sine_integral;
use striae::project::Project;
use striae::registry::Registry;

/// Arguments per piece of work.
const PIECE: u32 = 1 << 16;

fn main() {
    let project = Project::at(env!("CARGO_MANIFEST_DIR"), Registry::builtin());
    let names = ["auxiliary_large", "auxiliary_lean"];
    let candidate = |name: &&str| {
        project.candidate(&format!("sine_integral/{name}")).expect("a committed result")
    };
    let forms: Vec<Candidate> = names.iter().map(candidate).collect();
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

fn worst(form: &Candidate, x: &[f32], truth: &[f64]) -> (f64, f32) {
    let values = form.values_f32(&[x]).expect("a value everywhere");
    values.iter().zip(truth).zip(x).fold((0.0, 0.0), |worst, ((value, truth), x)| {
        let error = (f64::from(*value) - truth).abs();
        if error > worst.0 || error.is_nan() { (error, *x) } else { worst }
    })
}
