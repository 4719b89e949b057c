//! The fit of eq. 29 to Si, 2001 points and two constants, beside SciPy's `least_squares` on the
//! same residuals in the same run. Only the ratio means something.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use striae::effects::sine_integral::sine_integral;
use striae::fit::bounds::Bounds;
use striae::fit::loss::Loss;
use striae::fit::model::{FormModel, Origin};
use striae::fit::problem::Problem;
use striae::fit::solve::{Solution, SolverKind, solve_from};
use striae::form::Form;
use striae::registry::Registry;

/// As in fits/sine_integral/refit.toml.
const START: [f64; 2] = [0.7, 0.4];
const RUNS: usize = 200;

fn fit(form: &Form, inputs: &[Vec<f64>], target: &[f64]) -> Solution {
    let origins = [Origin::Free(0), Origin::Free(1)];
    let model = FormModel::new(form, inputs, &[0], &origins).expect("two constants");
    let factors = vec![1.0; target.len()];
    let bounds = [Bounds::default(); 2];
    let problem = Problem::new(&model, target, factors, Loss::LeastSquares, &bounds, &START);
    solve_from(&problem, SolverKind::Auto, 500).expect("the form has no loop")
}

fn median_ms(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let begin = Instant::now();
            run();
            begin.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

fn main() {
    let entry = Registry::builtin().form("sine_integral/published").expect("the published form");
    let form = entry.load().expect("the published form loads");
    let x: Vec<f64> = (0..2001).map(|i| -10.0 + f64::from(i) / 100.0).collect();
    let target: Vec<f64> = x.iter().map(|x| sine_integral(*x)).collect();
    let inputs = [x];
    let solution = fit(&form, &inputs, &target);
    let ours = median_ms(|| {
        std::hint::black_box(fit(&form, &inputs, &target));
    });
    println!(
        "striae  {ours:.3} ms  {:?}  {:?}, {} evaluations, {}",
        solution.constants, solution.termination, solution.evaluations, solution.solver
    );
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/si_fit_scipy.py");
    let peer = Command::new("python3").arg(script).args(START.map(|s| s.to_string())).output();
    let text = peer.map(|o| String::from_utf8_lossy(&o.stdout).into_owned()).unwrap_or_default();
    match text.split_whitespace().next().and_then(|ms| ms.parse::<f64>().ok()) {
        Some(scipy) => {
            println!("scipy   {}", text.trim());
            println!("ratio   {:.2} (striae / scipy)", ours / scipy);
        }
        None => println!("scipy   not measured: python3 with scipy is not here"),
    }
}
