//! Singular value decomposition of a 512 × 512 table of three channels, with signs and repeated
//! values settled, beside NumPy's `linalg.svd` of the same numbers in the same run. Only the ratio
//! means something.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use striae::factor::Decomposition;
use striae::table::{Axis, Grid, GridChannel};

const SIDE: usize = 512;
const RUNS: usize = 9;

/// As in benches/peers/svd_numpy.py.
fn table() -> Grid {
    let axis =
        |name: &str| Axis { name: name.into(), unit: "1".into(), from: -1.0, to: 1.0, count: SIDE };
    let mut state = 1u32;
    let mut channels = Vec::new();
    for (k, name) in ["R", "G", "B"].into_iter().enumerate() {
        let mut values = Vec::with_capacity(SIDE * SIDE);
        for iy in 0..SIDE {
            for ix in 0..SIDE {
                let centre = |i: usize| (i as f64 + 0.5) / SIDE as f64 * 2.0 - 1.0;
                let (x, y, k) = (centre(ix), centre(iy), k as f64);
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let noise = f64::from(state) / 4_294_967_296.0;
                let waves = ((30.0 + k) * (x + 0.2 * y)).cos() * ((25.0 + k) * (y - 0.3 * x)).cos();
                let value = waves.powi(4) * (-4.0 * (x * x + y * y)).exp() + 0.01 * noise;
                values.push(value as f32);
            }
        }
        channels.push(GridChannel { name: name.into(), unit: "1".into(), values });
    }
    Grid { axes: vec![axis("h_x"), axis("h_y")], channels, origin: "lattice with noise".into() }
}

fn main() {
    let table = table();
    let mut times = Vec::with_capacity(RUNS);
    let mut error = 0.0;
    for _ in 0..RUNS {
        let begin = Instant::now();
        let decomposition = Decomposition::of(&table).expect("finite values");
        times.push(begin.elapsed().as_secs_f64() * 1e3);
        error = decomposition.spectra().next().expect("a channel").relative_errors[10];
    }
    times.sort_by(f64::total_cmp);
    let ours = times[RUNS / 2];
    println!("striae  {ours:.3} ms, error at rank 10 {error:.12}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/svd_numpy.py");
    let peer = Command::new("python3").arg(script).arg(RUNS.to_string()).output();
    let text = peer.map(|o| String::from_utf8_lossy(&o.stdout).into_owned()).unwrap_or_default();
    match text.split_whitespace().next().and_then(|ms| ms.parse::<f64>().ok()) {
        Some(numpy) => {
            println!("numpy   {} (ms, error at rank 10)", text.trim());
            println!("ratio   {:.2} (striae / numpy)", ours / numpy);
        }
        None => println!("numpy   not measured: python3 with numpy is not here"),
    }
}
