//! The command line from outside: every verb, exit codes, help, JSON.

mod project;

use std::process::Stdio;

use predicates::prelude::*;
use predicates::str::contains;
use project::{GATES, LINE_CSV, LINE_WGSL, Project, striae};
use serde_json::Value;

/// Every verb that `striae --help` lists, itself left out.
fn verbs() -> Vec<String> {
    let help = striae(&std::env::temp_dir()).arg("--help").output().expect("help");
    let text = String::from_utf8(help.stdout).expect("UTF-8");
    let commands = text.split("Commands:").nth(1).expect("a list of commands");
    let names = commands.lines().skip(1).take_while(|line| !line.trim().is_empty());
    let first = |line: &str| line.split_whitespace().next().map(str::to_owned);
    names.filter(|l| l.starts_with("  ") && !l.starts_with("   ")).filter_map(first).collect()
}

fn json(output: &std::process::Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        panic!("{error}\n{}", String::from_utf8_lossy(&output.stdout));
    })
}

#[test]
fn every_verb_has_help_with_an_example() {
    let verbs = verbs();
    for expected in ["list", "fit", "eval", "check", "emit", "import", "doctor", "completions"] {
        assert!(verbs.iter().any(|verb| verb == expected), "{expected} is missing: {verbs:?}");
    }
    for verb in verbs.iter().filter(|verb| *verb != "help") {
        striae(&std::env::temp_dir())
            .args([verb, "--help"])
            .assert()
            .success()
            .stdout(contains("Example").and(contains("--json")));
    }
}

#[test]
fn bad_usage_ends_with_two() {
    let folder = std::env::temp_dir();
    for arguments in [
        vec![],
        vec!["frobnicate"],
        vec!["list", "everything"],
        vec!["eval"],
        vec!["doctor", "--threads", "0"],
        vec!["emit", "x", "--lang", "cobol"],
        vec!["fit", "a", "--all"],
        vec!["fit", "--form", "a.wgsl"],
        vec!["fit", "--start", "a=1"],
    ] {
        striae(&folder).args(&arguments).assert().code(2);
    }
}

#[test]
fn a_project_is_found_from_below_by_option_and_by_variable() {
    let project = Project::new();
    let elsewhere = tempfile::tempdir().expect("a temporary folder");
    let below = project.path("fits/sine_integral");
    striae(&below).args(["list", "fits"]).assert().success().stdout(contains("eq. 29 refitted"));
    striae(elsewhere.path()).args(["list", "fits"]).assert().code(2).stderr(contains("no project"));
    let folder = project.path("");
    striae(elsewhere.path()).args(["list", "gates", "--project"]).arg(&folder).assert().success();
    striae(elsewhere.path())
        .env("STRIAE_PROJECT", &folder)
        .args(["list", "gates"])
        .assert()
        .success()
        .stdout(contains("0.05105"));
    striae(elsewhere.path())
        .args(["list", "fits", "--project", "nowhere"])
        .assert()
        .code(2)
        .stderr(contains("nowhere").and(contains("--project")));
}

#[test]
fn lists_are_tables_or_json() {
    let project = Project::new();
    project.striae().args(["list", "references"]).assert().stdout(contains("sine_integral"));
    for kind in ["effects", "references", "forms", "data", "fits", "gates"] {
        let output = project.striae().args(["list", kind, "--json"]).output().expect("runs");
        assert!(output.status.success() && json(&output).is_array(), "{kind}");
    }
    let all = project.striae().args(["list", "--json"]).output().expect("runs");
    let all = json(&all);
    assert_eq!(all["gates"].as_array().map(Vec::len), Some(2));
    assert_eq!(all["fits"][2]["result"], "not fitted");
}

#[test]
fn a_reference_is_evaluated_to_the_bit_and_other_columns_are_kept() {
    let project = Project::new();
    project.write("p.csv", "# note\nx [1],label\n1,one\n-inf,\"a, b\"\nnan,c\n1e300,d\n-0.0,e\n");
    project
        .striae()
        .args(["eval", "sine_integral", "--input", "p.csv", "--output", "r.csv"])
        .assert()
        .success()
        .stdout("");
    let result = project.read("r.csv");
    let lines: Vec<&str> = result.lines().collect();
    assert_eq!(lines[0], "x [1],label,value");
    assert!(lines[2].starts_with("-inf,\"a, b\",-1.57079632679"), "{result}");
    assert!(lines[3].ends_with(",NaN") && lines[5].ends_with(",-0.0"), "{result}");
    let value: f64 = lines[1].rsplit(',').next().and_then(|v| v.parse().ok()).expect("a number");
    let exact = striae::effects::sine_integral::sine_integral(1.0);
    assert_eq!(value.to_bits(), exact.to_bits());
}

#[test]
fn a_domain_error_names_the_row() {
    let project = Project::new();
    project
        .striae()
        .args(["eval", "fresnel_conductor", "-i", "-"])
        .write_stdin("mu,n,k\n0.5,0.2,3\n1.5,0.2,3\n")
        .assert()
        .code(2)
        .stderr(contains("stdin:3").and(contains("mu = 1.5")));
}

#[test]
fn forms_and_fits_are_evaluated_in_every_precision() {
    let project = Project::fitted();
    let eval = |name: &str, more: &[&str]| {
        let mut command = project.striae();
        command.args(["eval", name, "-i", "-"]).args(more).write_stdin("x\n3.56\n");
        let output = command.output().expect("runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        text.lines().nth(1).and_then(|line| line.split(',').nth(1)).expect("a value").to_owned()
    };
    let fitted = eval("sine_integral/refit", &[]);
    let printed = eval(
        "form:sine_integral/published",
        &["--set", "tail=0.66142739", "--set", "offset=0.38272292"],
    );
    assert_ne!(fitted, printed);
    let exact = striae::effects::sine_integral::sine_integral(3.56);
    for value in [&fitted, &printed] {
        let value: f64 = value.parse().expect("a number");
        assert!((value - exact).abs() < 0.0511, "{value} against {exact}");
    }
    let single = eval("sine_integral/published", &["--precision", "f32"]);
    let read: f32 = single.parse().expect("a number");
    assert_eq!(format!("{read:?}"), single, "the shortest f32 that reads back");
}

#[test]
fn a_device_is_used_or_its_absence_is_exit_code_four() {
    let project = Project::fitted();
    let output = project
        .striae()
        .args(["eval", "sine_integral/published", "-i", "-", "--precision", "gpu"])
        .write_stdin("x\n3.5\n")
        .output()
        .expect("runs");
    assert!(matches!(output.status.code(), Some(0 | 4)), "{output:?}");
    // Among adapters the name is at fault; without any, what to install is named.
    let has_adapter = output.status.success();
    let fault = if has_adapter { "no such adapter" } else { "mesa-vulkan-drivers" };
    project
        .striae()
        .env("WGPU_ADAPTER_NAME", "no such adapter")
        .args(["eval", "sine_integral/published", "-i", "-", "--precision", "gpu"])
        .write_stdin("x\n3.5\n")
        .assert()
        .code(4)
        .stderr(contains(fault));
    project
        .striae()
        .env("WGPU_ADAPTER_NAME", "no such adapter")
        .env("STRIAE_REQUIRE_GPU", "1")
        .arg("check")
        .assert()
        .code(4);
}

#[test]
fn specs_are_fitted_and_written_beside_themselves() {
    let project = Project::new();
    project
        .striae()
        .args(["fit", "sine_integral/refit", "sine_integral/published"])
        .assert()
        .success()
        .stdout(contains("converged").and(contains("tail")));
    let result: Value =
        serde_json::from_str(&project.read("fits/sine_integral/refit.json")).expect("JSON");
    assert_eq!(result["status"], "converged");
    let tail = result["parameters"]["tail"]["value"].as_f64().expect("a number");
    assert!((tail - 0.6613).abs() < 2e-3, "{tail}");
    assert!(!project.path("fits/sine_integral/lookup.json").exists(), "not named, not fitted");
}

#[test]
fn results_do_not_depend_on_threads_or_on_being_repeated() {
    let project = Project::fitted();
    let first = project.read("fits/sine_integral/refit.json");
    for threads in ["1", "3"] {
        project.striae().args(["fit", "--all", "--threads", threads]).assert().success();
        assert_eq!(project.read("fits/sine_integral/refit.json"), first, "{threads} threads");
    }
}

#[test]
fn a_form_of_ones_own_is_fitted_to_a_table_of_ones_own() {
    let project = Project::new();
    project.write("line.wgsl", LINE_WGSL);
    project.write("line.csv", LINE_CSV);
    let output = project
        .striae()
        .args(["fit", "--form", "line.wgsl", "--function", "line", "--table", "line.csv"])
        .args(["--output-column", "y", "--start", "a=1,b=0", "--bounds", "a=0:10,b=-5:"])
        .args(["-o", "line.json", "--json"])
        .output()
        .expect("runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = json(&output);
    let written: Value = serde_json::from_str(&project.read("line.json")).expect("JSON");
    assert_eq!(printed[0], written);
    let of = |name: &str, key: &str| written["parameters"][name][key].as_f64().expect("a number");
    // NumPy: polyfit gives 1.989, 1.026, with standard errors 0.02835 and 0.06944.
    assert!((of("a", "value") - 1.989).abs() < 1e-9 && (of("b", "value") - 1.026).abs() < 1e-9);
    assert!((of("a", "stderr") - 0.028349).abs() < 1e-5, "{}", of("a", "stderr"));
}

#[test]
fn a_fit_that_does_not_converge_ends_with_three() {
    let project = Project::new();
    let spec = project::REFIT.to_owned() + "[solver]\nkind = \"nelder_mead\"\nmax_iterations = 1\n";
    project.write("fits/sine_integral/short.toml", spec);
    project
        .striae()
        .args(["fit", "sine_integral/short"])
        .assert()
        .code(3)
        .stdout(contains("limit"));
    let result: Value =
        serde_json::from_str(&project.read("fits/sine_integral/short.json")).expect("JSON");
    assert_eq!(result["status"], "hit_iteration_limit");
}

#[test]
fn gates_pass_in_every_format() {
    let project = Project::fitted();
    project
        .striae()
        .arg("check")
        .assert()
        .success()
        .stdout(contains("2 gates: 2 passed").and(contains("constants reproduce in 3 of 3")));
    let output = project.striae().args(["check", "--format", "json"]).output().expect("runs");
    let check = json(&output);
    assert_eq!(check["gates"][0]["verdict"], "pass");
    let x = check["gates"][0]["measured"]["at"]["x"].as_f64().expect("a place");
    assert!((x.abs() - 3.56).abs() < 0.05, "{x}");
    assert_eq!(check["constants"].as_array().map(Vec::len), Some(3));
    project
        .striae()
        .args(["check", "--format", "junit"])
        .assert()
        .success()
        .stdout(contains("<testsuites").and(contains("failures=\"0\"")));
    project
        .striae()
        .args(["check", "--format", "github"])
        .assert()
        .success()
        .stdout(contains("::notice::2 gates, 0 failed").and(contains("::error").not()));
}

#[test]
fn gates_that_pass_are_listed_on_request_and_coloured_on_request() {
    let project = Project::fitted();
    let check = |arguments: &[&str]| {
        let mut command = project.striae();
        let output = command.arg("check").args(arguments).output().expect("runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let (quiet, all, coloured) =
        (check(&[]), check(&["--all"]), check(&["--all", "--color", "always"]));
    assert!(!quiet.contains("sine_integral/published"), "{quiet}");
    assert!(all.contains("sine_integral/published") && !all.contains('\u{1b}'), "{all}");
    assert!(coloured.contains("\u{1b}["), "{coloured}");
    let last = all.find("2 gates: 2 passed").expect("a line that sums up");
    assert!(all.find("sine_integral/published").is_some_and(|gate| gate < last), "{all}");
}

#[test]
fn a_gate_that_fails_ends_with_one_in_every_format() {
    let project = Project::fitted();
    project.write("fits/gates.toml", GATES.replace("0.05105", "0.05"));
    project
        .striae()
        .arg("check")
        .assert()
        .code(1)
        .stdout(contains("FAIL").and(contains("1 failed")));
    project.striae().args(["check", "--json"]).assert().code(1).stdout(contains("\"fail\""));
    project
        .striae()
        .args(["check", "--format", "junit"])
        .assert()
        .code(1)
        .stdout(contains("<failure").and(contains("failures=\"1\"")));
    project
        .striae()
        .args(["check", "--format", "github"])
        .assert()
        .code(1)
        .stdout(contains("::error file=fits/gates.toml,line=2,"));
}

#[test]
fn results_that_do_not_stand_fail_their_gates() {
    let project = Project::new();
    project.striae().arg("check").assert().code(1).stdout(contains("there is no result"));

    let project = Project::fitted();
    let spec = project.path("fits/sine_integral/refit.toml");
    std::fs::write(&spec, project::REFIT.replace("401", "402")).expect("writable");
    project.striae().arg("check").assert().code(1).stdout(contains("stale"));

    let project = Project::fitted();
    let file = "fits/sine_integral/refit.json";
    project.write(file, project.read(file).replace("\"converged\"", "\"stalled\""));
    project.striae().arg("check").assert().code(1).stdout(contains("refit is stalled"));

    let project = Project::fitted();
    let result: Value = serde_json::from_str(&project.read(file)).expect("JSON");
    let tail = &result["parameters"]["tail"]["f32"];
    let text = project.read(file).replace(&tail.to_string(), "0.6613");
    project.write(file, text);
    project
        .striae()
        .arg("check")
        .assert()
        .code(1)
        .stdout(contains("as committed").and(contains("2 of 3")));
}

#[test]
fn every_gate_is_shown_to_fail_and_one_that_cannot_is_a_defect() {
    let project = Project::fitted();
    project
        .striae()
        .args(["check", "--prove"])
        .assert()
        .success()
        .stdout(contains("every gate can"));
    project.write("fits/gates.toml", GATES.replace("0.0296", "29.6"));
    project
        .striae()
        .args(["check", "--prove"])
        .assert()
        .code(1)
        .stdout(contains("DEFECT").and(contains("cannot fail")).and(contains("no gate guards")));
    let lookup = GATES.replace("sine_integral/refit", "sine_integral/lookup");
    project.write("fits/gates.toml", lookup.replace("0.0296", "0.01"));
    project.striae().args(["check", "--prove"]).assert().success().stdout(contains("output"));
}

#[test]
fn a_shipped_constant_that_drifts_fails_its_gate() {
    let project = Project::fitted();
    let gate = "[[gate]]\nsubject = \"sine_integral/published\"\nmetric = \"drift\"\n\
        shipped = \"shipped.glsl\"\nlimit = 0.5\nwhy = \"what ships is what was printed\"\n";
    project.write("fits/gates.toml", gate);
    let shipped = "const float tail = 0.66142739; const float offset = 0.38272292;";
    project.write("shipped.glsl", shipped);
    project.striae().args(["check", "--prove"]).assert().success();
    project.write("shipped.glsl", shipped.replace("142", "124"));
    project.striae().arg("check").assert().code(1).stdout(contains("tail = 0.66124"));
    project.write("shipped.glsl", "const float tail = 0.66142739;");
    project.striae().arg("check").assert().code(1).stdout(contains("offset"));
}

#[test]
fn a_fit_is_emitted_in_every_language() {
    let project = Project::fitted();
    for (lang, expected) in [
        ("wgsl", "fn sine_integral"),
        ("glsl", "float sine_integral"),
        ("hlsl", "float sine_integral"),
        ("msl", "float sine_integral"),
    ] {
        project
            .striae()
            .args(["emit", "sine_integral/refit", "--lang", lang])
            .assert()
            .success()
            .stdout(
                contains(expected)
                    .and(contains("velinov2018"))
                    .and(contains("Spec sha256"))
                    .and(contains("x = -10 to 10"))
                    .and(contains("at most 0.05"))
                    .and(contains(format!("striae emit sine_integral/refit --lang {lang}"))),
            );
    }
    project
        .striae()
        .args(["emit", "sine_integral/refit", "--lang", "spirv", "-o", "out.spv"])
        .assert()
        .success();
    let words = std::fs::read(project.path("out.spv")).expect("written");
    assert_eq!(words[..4], [3, 2, 0x23, 7], "the magic number of SPIR-V");
    project.striae().args(["emit", "sine_integral", "--lang", "wgsl"]).assert().code(2);
}

#[test]
fn outside_formats_are_imported() {
    let project = Project::new();
    let yaml = "REFERENCES: \"somebody\"\nCOMMENTS: \"\"\nDATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.1 2.2\n        0.5 1.2 2.3\n";
    project.write("metal.yml", yaml);
    project
        .striae()
        .args(["import", "metal.yml", "-o", "metal.csv"])
        .assert()
        .success()
        .stdout(contains("2 rows"));
    assert!(project.read("metal.csv").contains("somebody"));
    project
        .striae()
        .args(["import", "metal.csv", "-o", "again.csv", "--json"])
        .assert()
        .success()
        .stdout(contains("\"rows\": 2"));
    project.striae().args(["import", "fits/gates.toml", "-o", "x.csv"]).assert().code(2);
}

#[test]
fn the_doctor_reports_and_shells_are_completed() {
    let project = Project::new();
    let output = project.striae().args(["doctor", "--json"]).output().expect("runs");
    let lines = json(&output);
    for subject in ["striae", "cores", "project", "gates", "glslangValidator"] {
        let found = lines.as_array().into_iter().flatten().any(|line| line["subject"] == subject);
        assert!(found, "{subject}: {lines}");
    }
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        project.striae().args(["completions", shell]).assert().success().stdout(contains("striae"));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let project = Project::new();
    for verb in ["list", "completions"] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_striae"));
        command.current_dir(project.path("")).arg(verb);
        if verb == "completions" {
            command.arg("bash");
        }
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("ends");
        assert!(output.status.success(), "{verb}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn errors_are_json_where_json_was_asked_for() {
    let output = Project::new().striae().args(["fit", "no/such", "--json"]).output().expect("runs");
    assert_eq!(output.status.code(), Some(2));
    let error: Value = serde_json::from_slice(&output.stderr).expect("JSON on stderr");
    assert!(error["error"][0].as_str().is_some_and(|text| text.contains("no/such")));
}
