//! Bad input, end to end: nothing panics, nothing hangs, and the message names file and place.

mod project;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use project::{GATES, LINE_CSV, LINE_WGSL, PUBLISHED, Project, REFIT};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use striae::fit::Spec;
use striae::gate;

/// Runs the binary: exit code 2, every part in the message, and no panic.
#[track_caller]
fn refused(project: &Project, arguments: &[&str], parts: &[&str]) {
    let output =
        project.striae().args(arguments).timeout(Duration::from_secs(60)).output().expect("runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.starts_with("error: ") && !message.contains("panicked"), "{message}");
    for part in parts {
        assert!(message.contains(part), "{arguments:?}: `{part}` is not in: {message}");
    }
}

/// `fit` of the line to the table, both as given.
#[track_caller]
fn line_refused(wgsl: &str, csv: &str, more: &[&str], parts: &[&str]) {
    let project = Project::new();
    project.write("line.wgsl", wgsl);
    project.write("line.csv", csv);
    let mut arguments = vec![
        "fit",
        "--form",
        "line.wgsl",
        "--function",
        "line",
        "--table",
        "line.csv",
        "--output-column",
        "y",
        "-o",
        "line.json",
        "--start",
        "a=1",
    ];
    arguments.extend(more);
    refused(&project, &arguments, parts);
    assert!(!project.path("line.json").exists(), "nothing is written");
}

/// A spec in place of the refit's.
#[track_caller]
fn spec_refused(text: &str, parts: &[&str]) {
    let project = Project::new();
    project.write("fits/sine_integral/refit.toml", text);
    refused(&project, &["fit", "sine_integral/refit"], parts);
}

/// A gate file.
#[track_caller]
fn gates_refused(text: &str, parts: &[&str]) {
    let project = Project::new();
    project.write("fits/gates.toml", text);
    refused(&project, &["check"], parts);
}

#[test]
fn malformed_tables() {
    let file = "line.csv";
    for (csv, part) in [
        ("", file),
        ("x,y\n", file),
        ("x [1],y [1]\n0,1\n1\n", file),
        ("x [1],y [1]\n0,1,2\n", file),
        ("x [1],y [1]\n0,one\n1,2\n2,3\n", "line.csv:2"),
        ("x [1],y [1]\n0,\n1,2\n2,3\n", "line.csv:2"),
        ("x [1],y [1]\n0,1\n1,NaN\n2,3\n", file),
        ("x [1],y [1]\n0,1\n1,inf\n2,3\n", file),
        ("x [1],y [1]\n,1\n,2\n,3\n", file),
        ("x [1],x [1],y [1]\n0,0,1\n1,1,2\n2,2,3\n", "\"x\" appears twice"),
        ("z [1],y [1]\n0,1\n1,2\n2,3\n", "x"),
        ("x [1],z [1]\n0,1\n1,2\n2,3\n", "y"),
        ("x [furlong],y [1]\n0,1\n1,2\n2,3\n", "furlong"),
        ("x [1,y [1]\n0,1\n1,2\n2,3\n", file),
        ("x [1],y [1]\n\"0,1\n1,2\n", file),
    ] {
        line_refused(LINE_WGSL, csv, &[], &[part]);
    }
}

#[test]
fn too_few_rows_and_a_singular_problem() {
    line_refused(LINE_WGSL, "x [1],y [1]\n0,1\n", &[], &["line.csv"]);
    // Two constants of which only the sum matters: the fit ends, and says that it is singular.
    let project = Project::new();
    project.write("sum.wgsl", "override a: f32 = 1.0;\noverride b: f32 = 1.0;\nfn sum(x: f32) -> f32 { return (a + b) * x; }\n");
    project.write("line.csv", LINE_CSV);
    let output = project
        .striae()
        .args(["fit", "--form", "sum.wgsl", "--function", "sum", "--table", "line.csv"])
        .args(["--output-column", "y", "-o", "sum.json"])
        .output()
        .expect("runs");
    assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
    let result = project.read("sum.json");
    assert!(result.contains("\"singular\"") && !result.contains("NaN"), "{result}");
}

#[test]
fn malformed_forms() {
    for (wgsl, part) in [
        ("fn line(x: f32) -> f32 { return x", "line.wgsl"),
        ("fn other(x: f32) -> f32 { return x; }", "no function `line`"),
        ("fn line(x: f32) -> f32 { return z; }", "line.wgsl:1"),
        ("override a: f32 = 1.0;\nfn line(x: f32) -> f32 { return dpdx(x) * a; }", "line.wgsl:2"),
        (
            "override a: f32 = 1.0;\nfn line(x: f32) -> f32 { var i = 0.0; loop { i += a; } return i; }",
            "line.wgsl",
        ),
        ("\0\u{1}\u{2}", "line.wgsl"),
    ] {
        line_refused(wgsl, LINE_CSV, &[], &[part]);
    }
}

#[test]
fn parameters_and_bounds_that_do_not_go_together() {
    line_refused(LINE_WGSL, LINE_CSV, &["--start", "c=1"], &["c"]);
    line_refused(LINE_WGSL, LINE_CSV, &["--bounds", "a=2:3"], &["a", "lower bound 2"]);
    line_refused(LINE_WGSL, LINE_CSV, &["--bounds", "b=1:1"], &["b"]);
    line_refused(LINE_WGSL, LINE_CSV, &["--bounds", "b=nan:1"], &["b=nan:1"]);
    line_refused(LINE_WGSL, LINE_CSV, &["--weight", "w"], &["w"]);
    line_refused(
        "override a: f32;\noverride q: f32;\nfn line(x: f32) -> f32 { return a * x + q; }\n",
        LINE_CSV,
        &[],
        &["q"],
    );
    spec_refused(&REFIT.replace("offset =", "ofset ="), &["refit.toml", "ofset"]);
    spec_refused(&REFIT.replace("start = 0.7", "start = 2.5"), &["refit.toml", "tail", "2.5"]);
    spec_refused(&REFIT.replace("upper = 2", "upper = 0"), &["refit.toml", "tail", "width"]);
}

#[test]
fn malformed_specs() {
    let name = "refit.toml";
    spec_refused("form = ", &[name, "1"]);
    spec_refused(&REFIT.replace("from = -10, to = 10", "from = 1, to = 1"), &[name, "width"]);
    spec_refused(&REFIT.replace("to = 10", "to = inf"), &[name, "finite"]);
    spec_refused(&REFIT.replace("count = 401", "count = 1"), &[name, "count"]);
    spec_refused(&REFIT.replace("count = 401", "count = \"many\""), &[name]);
    spec_refused(&REFIT.replace("[domain]", "[domian]"), &[name, "domian"]);
    spec_refused(
        &REFIT.replace("target = \"sine_integral\"", "target = \"cosine\""),
        &["cosine", "sine_integral"],
    );
    spec_refused(
        &REFIT.replace("sine_integral/published", "sine_integral/none"),
        &["sine_integral/none"],
    );
    spec_refused(&REFIT.replace("x = {", "y = {"), &[name, "y"]);
    spec_refused(&(REFIT.to_owned() + "[loss]\nkind = \"kindest\"\n"), &[name, "kindest"]);
    refused(&Project::new(), &["fit", "--spec", "absent.toml"], &["absent.toml"]);
}

#[test]
fn malformed_gates() {
    let file = "gates.toml";
    gates_refused("", &[file, "no gate"]);
    gates_refused("[[gate]", &[file, ":1"]);
    gates_refused(&GATES.replace("0.0296", "nan"), &[file, ":11", "gate 2, key limit"]);
    gates_refused(&GATES.replace("\"rms\"", "\"rsm\""), &[file, "gate 2, key metric", "rsm"]);
    gates_refused(&GATES.replace("limit = 0.0296", "limt = 0.0296"), &[file, "gate 2", "limt"]);
    gates_refused(&GATES.replace("integral/refit", "integral/absent"), &[file, "gate 2", "absent"]);
    let project = Project::fitted();
    project.write("fits/gates.toml", GATES.replace("x = -10:10", "y = -10:10"));
    refused(&project, &["check"], &[file, "gate 1", "`y`"]);
    project.write("fits/gates.toml", GATES.replace("x = -10:10", "nowhere"));
    refused(&project, &["check"], &[file, "gate 1", "nowhere", "scene"]);
}

#[test]
fn malformed_outside_files() {
    let project = Project::new();
    for (name, text) in [
        ("a.yml", "DATA: [\n"),
        ("b.yml", "REFERENCES: x\n"),
        ("c.yml", "REFERENCES: x\nDATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.1\n"),
        ("d.yml", "REFERENCES: x\nDATA:\n  - type: tabulated nk\n    data: |\n        0.4 nan 1\n"),
        (
            "e.yml",
            "REFERENCES: x\nDATA:\n  - type: formula 12\n    coefficients: 1 2\n    range: 1 2\n",
        ),
        ("f.csv", "x [parsec],y [1]\n1,2\n"),
    ] {
        project.write(name, text);
        refused(&project, &["import", name, "-o", "out.csv"], &[name]);
    }
    refused(&project, &["import", "absent.yml", "-o", "out.csv"], &["absent.yml"]);
    assert!(!project.path("out.csv").exists());
}

#[test]
fn malformed_points() {
    let project = Project::new();
    for (text, part) in [
        ("", "points.csv"),
        ("x\n", "no rows"),
        ("y\n1\n", "no column `x`"),
        ("x,x\n1,2\n", "twice"),
        ("x,value\n1,2\n", "`value`"),
        ("x\n1\none\n", "points.csv:3"),
        ("x,y\n1,\n,2\n", "points.csv:3"),
        ("x [deg]\n1\n", "deg"),
        ("x,y\n1\n", "points.csv"),
    ] {
        project.write("points.csv", text);
        refused(&project, &["eval", "sine_integral", "--input", "points.csv"], &[part]);
    }
    project.write("points.csv", [0x78, 0x0a, 0xff, 0xfe]);
    refused(&project, &["eval", "sine_integral", "--input", "points.csv"], &["points.csv"]);
    refused(&project, &["eval", "sine_integral", "--input", "absent.csv"], &["absent.csv"]);
    refused(&project, &["eval", "no_such_name", "--input", "points.csv"], &["no_such_name"]);
}

#[test]
fn outputs_that_cannot_be_written() {
    // A path below a file cannot be made by anybody, not even by root.
    let project = Project::fitted();
    project.write("file", "");
    project.write("p.csv", "x\n1\n");
    project.write("line.csv", LINE_CSV);
    let beyond = "file/out";
    refused(&project, &["fit", "sine_integral/refit", "-o", beyond], &[beyond]);
    refused(&project, &["eval", "sine_integral", "-i", "p.csv", "-o", beyond], &[beyond]);
    refused(&project, &["import", "line.csv", "-o", beyond], &[beyond]);
    refused(&project, &["emit", "sine_integral/refit", "--lang", "wgsl", "-o", beyond], &[beyond]);
}

#[test]
fn results_that_do_not_read() {
    let project = Project::fitted();
    let good = project.read("fits/sine_integral/refit.json");
    let half = good[..good.len() / 2].to_owned();
    for text in [String::new(), half, good.replace("\"schema\": 1", "\"schema\": 7"), "[]".into()] {
        project.write("fits/sine_integral/refit.json", text);
        refused(&project, &["check"], &["refit.json"]);
        refused(&project, &["emit", "sine_integral/refit", "--lang", "glsl"], &["refit.json"]);
    }
}

/// Kills `fit --all` at many moments. Every result is then the old one or the new one, whole.
#[test]
fn a_kill_in_the_middle_leaves_results_whole() {
    let project = Project::new();
    let names: Vec<String> = (0..24).map(|i| format!("fits/sine_integral/many_{i:02}")).collect();
    for name in &names {
        project.write(&format!("{name}.toml"), REFIT.replace("count = 401", "count = 4001"));
    }
    let started = Instant::now();
    project.striae().args(["fit", "--all"]).assert().success();
    let whole_run = started.elapsed();
    let read = || -> BTreeMap<String, String> {
        names.iter().map(|name| (name.clone(), project.read(&format!("{name}.json")))).collect()
    };
    let new = read();
    let old: BTreeMap<String, String> = new
        .iter()
        .map(|(name, text)| (name.clone(), text.replace("\"schema\": 1", "\"schema\": 1 ")))
        .collect();
    let mut interrupted = 0;
    for step in 1..=16 {
        for (name, text) in &old {
            project.write(&format!("{name}.json"), text);
        }
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_striae"));
        command.current_dir(project.path("")).args(["fit", "--all"]);
        let mut child = command.stdout(std::process::Stdio::null()).spawn().expect("runs");
        std::thread::sleep(whole_run * step / 16);
        child.kill().expect("was started here");
        child.wait().expect("ends");
        let now = read();
        for (name, text) in &now {
            let whole = *text == old[name] || *text == new[name];
            assert!(whole, "{name} is neither the old result nor the new one:\n{text}");
        }
        let replaced = now.iter().filter(|(name, text)| **text == new[*name]).count();
        interrupted += usize::from(replaced > 0 && replaced < names.len());
    }
    println!("{interrupted} of 16 kills fell between the first and the last result");
}

/// One small change somewhere in a text.
fn mutated(text: &str, random: &mut ChaCha8Rng) -> String {
    const PIECES: [&str; 12] =
        ["=", "[", "]", "\"", "nan", "-inf", "1e999", "{", "}", "\n", "\u{fffd}", "[[gate]]\n"];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..random.random_range(1..4) {
        let at = random.random_range(0..bytes.len().max(1));
        let end = (at + random.random_range(1..20)).min(bytes.len());
        match random.random_range(0..5) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at.min(end)..end)),
            2 => {
                let piece = PIECES[random.random_range(0..PIECES.len())];
                drop(bytes.splice(at.min(bytes.len())..at.min(bytes.len()), piece.bytes()));
            }
            3 => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte = random.random_range(b' '..=b'~');
                }
            }
            _ => {
                let copy = bytes[at.min(end)..end].to_vec();
                bytes.extend(copy);
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn a_thousand_mutations_of_gates_and_specs() {
    let mut random = ChaCha8Rng::seed_from_u64(0x6a7e5);
    let (mut refused, mut accepted) = (0, 0);
    for round in 0..1000 {
        let message = if round % 2 == 0 {
            gate::parse("some/gates.toml", &mutated(GATES, &mut random))
                .err()
                .map(|error| error.to_string())
        } else {
            let text = if round % 4 == 1 { REFIT } else { PUBLISHED };
            Spec::parse("some/spec.toml", "some/spec", &mutated(text, &mut random))
                .err()
                .map(|error| error.to_string())
        };
        match message {
            Some(message) => {
                refused += 1;
                assert!(message.starts_with("some/"), "round {round}: no file in: {message}");
            }
            None => accepted += 1,
        }
    }
    assert!(refused > 400 && accepted > 20, "{refused} refused, {accepted} accepted");
}
