//! Costs counted in machine code: the same on every run, near what is known, and never a number where
//! nothing was counted. Without Mesa's RADV the tests say so and judge what is left.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use predicates::str::contains;
use serde_json::Value;
use striae::counted::{CountedCost, Counter, GpuTarget};
use striae::form::{DataTable, Form};
use striae::numeric::measured::Measured;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn striae(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("striae").expect("the binary of this package");
    command.current_dir(folder).env_remove("STRIAE_PROJECT").env_remove("STRIAE_REQUIRE_GPU");
    command
}

fn counter() -> Counter {
    Counter::with_program(env!("CARGO_BIN_EXE_striae"))
}

fn counted(target: GpuTarget, form: &Form) -> Measured<CountedCost> {
    counter().costs(&[target], &[(form, &[])]).swap_remove(0).swap_remove(0)
}

/// Whether RADV is there; says so if it is not.
fn radv() -> bool {
    let form = Form::parse("f.wgsl", "fn f(x: f32) -> f32 { return x * x; }", "f").expect("a form");
    match counted(GpuTarget::Rdna2, &form) {
        Measured::Value(_) => true,
        Measured::NotMeasured(reason) => {
            println!("skipped: {reason}");
            false
        }
    }
}

fn bench(folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let output = striae(folder).arg("bench").args(arguments).output().expect("a run");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

#[test]
fn a_counted_target_is_the_same_to_the_byte() {
    let arguments = ["sine_integral/auxiliary_*", "--target", "rdna2", "--json"];
    let (once, again) = (bench(&root(), &arguments), bench(&root(), &arguments));
    assert_eq!(String::from_utf8_lossy(&once), String::from_utf8_lossy(&again));
    let lines: Value = serde_json::from_slice(&once).expect("JSON");
    let lines = lines.as_array().expect("a list");
    assert_eq!(lines.len(), 4);
    for line in lines {
        assert!(line["name"].is_string() && line["error"].is_number(), "{line}");
        assert_ne!(line["cost"].is_number(), line["not_measured"].is_string(), "{line}");
    }
}

/// Eq. 29 costs 52.0 on RDNA2 and 183 on GCN4 with Mesa 22.3.6, counted in GLSL by another program.
#[test]
fn eq_29_costs_what_is_known() {
    if !radv() {
        return;
    }
    for (target, known) in [("rdna2", 52.0), ("gcn4", 183.0)] {
        let arguments = ["sine_integral/published", "--target", target, "--json"];
        let lines: Value = serde_json::from_slice(&bench(&root(), &arguments)).expect("JSON");
        let line = &lines[0];
        let cost = line["cost"].as_f64().expect("a cost");
        assert!((cost / known - 1.0).abs() < 0.15, "{line}");
        // A tangent hyperbolic, a cosine and divisions.
        assert!(line["quarter_rate"].as_f64() >= Some(4.0), "{line}");
        assert!(line["latency"].as_f64() > line["instructions"].as_f64(), "{line}");
        assert_eq!(line["ratio"].as_f64(), Some(1.0), "{line}");
    }
}

#[test]
fn vectors_integers_and_tables_are_counted() {
    if !radv() {
        return;
    }
    let form = |text: &str| Form::parse("f.wgsl", text, "f").expect("a form");
    let table = vec![DataTable::new("t", [1.0, 2.0, 3.0, 5.0])];
    let text = "@group(1) @binding(0) var<storage, read> t: array<f32>;\n\
        fn f(x: f32) -> f32 { return t[u32(abs(x)) & 3u] * x; }";
    let forms = [
        form("fn f(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> { return cross(a, b); }"),
        form("fn f(a: vec2<i32>, n: u32) -> f32 { return f32(a.x * a.y) + f32(n >> 3u); }"),
        Form::parse_with("f.wgsl", text, "f", table).expect("a form"),
    ];
    for form in &forms {
        for target in [GpuTarget::Rdna2, GpuTarget::Rdna3, GpuTarget::Gcn4] {
            let cost = counted(target, form);
            assert!(cost.value().is_some_and(|cost| cost.cost > 0.0), "{target}: {cost:?}");
        }
    }
}

#[test]
fn what_is_not_counted_has_a_reason() {
    let text = "fn f(x: f32) -> f32 { var y = x; for (var i = 0; f32(i) < x; i++) \
        { y = sin(y); } return y; }";
    let form = Form::parse("f.wgsl", text, "f").expect("a form");
    assert!(matches!(counted(GpuTarget::Rdna2, &form), Measured::NotMeasured(_)));
    let other = Counter::with_program("/bin/true");
    let plain =
        Form::parse("f.wgsl", "fn f(x: f32) -> f32 { return x * x; }", "f").expect("a form");
    let costs = other.costs(&[GpuTarget::Gcn4], &[(&plain, &[])]);
    assert!(matches!(&costs[0][0], Measured::NotMeasured(reason) if !reason.is_empty()));
}

#[test]
fn a_target_that_is_none_gets_the_nearest_names() {
    let arguments = ["bench", "sine_integral", "--target", "rdna4"];
    striae(&root()).args(arguments).assert().code(2).stderr(contains("rdna2, rdna3"));
    let arguments = ["bench", "sine_integral/auxiliary_*x", "--target", "rdna2"];
    striae(&root()).args(arguments).assert().code(2).stderr(contains("the nearest"));
}
