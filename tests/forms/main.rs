//! Forms: what loads and what is refused, what the lanes compute, and what is emitted.

mod builtins;
mod control_flow;
mod derivatives;
mod emitted;
mod integers;
mod mutations;
mod overrides;
mod refused;
mod tables;
mod vectors;

use std::io::Write;
use std::process::Command;

use striae::form::Form;

/// The published Si form, velinov2018 eq. 29.
const SI: &str = include_str!("si_published.wgsl");

/// Function `f` of `source`; the diagnostic as a panic if it does not load.
fn form(source: &str) -> Form {
    match Form::parse("test.wgsl", source, "f") {
        Ok(form) => form,
        Err(error) => panic!("{error}"),
    }
}

/// `f(x)` in f64, of a form without parameters and with one output.
fn value(source: &str, x: f64) -> f64 {
    form(source).eval_f64(&[], &[&[x]]).expect("evaluates")[0][0]
}

/// Two values as far apart as `ulps` units in the last place, or both NaN.
fn close(a: f64, b: f64, ulps: f64) -> bool {
    a == b
        || (a.is_nan() && b.is_nan())
        || (a - b).abs() <= ulps * f64::EPSILON * a.abs().max(b.abs())
}

/// Runs a validator over `bytes`; prints a notice where it is not installed.
fn external(program: &str, arguments: &[&str], bytes: &[u8], suffix: &str) {
    let mut file = tempfile::Builder::new().suffix(suffix).tempfile().expect("a temporary file");
    file.write_all(bytes).expect("writes");
    match Command::new(program).args(arguments).arg(file.path()).output() {
        Ok(output) => assert!(
            output.status.success(),
            "{program}: {}{}\n{}",
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr),
            String::from_utf8_lossy(bytes)
        ),
        Err(error) => println!("skipped: {program}: {error}"),
    }
}
