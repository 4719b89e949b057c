//! Forms of a project's own, in its folder `forms/`: listed, evaluated, fitted and gated by their names.

#[allow(dead_code, reason = "other tests use the rest")]
mod project;

use predicates::prelude::*;
use predicates::str::contains;
use project::Project;
use striae::effect::{FormTextError, FormTextFault};
use striae::project::{Project as Opened, ProjectError};
use striae::registry::{Registry, RegistryError};

/// An arc tangent for Si.
const ARC: &str = "\
// approximates: sine_integral
// about: an arc tangent, steeper or flatter
// cites: nobody

override scale: f32 = 1.0;

fn sine_integral(x: f32) -> f32 {
    return atan(scale * x);
}
";

const FITTED: &str = r#"form = "mine/arc"
target = "sine_integral"
[domain]
x = { from = -10, to = 10, count = 401 }
[parameters]
scale = { start = 1.0, lower = 0.1, upper = 10 }
"#;

/// A project with `forms/mine/arc.wgsl`, a spec that fits it and a gate on the fit.
fn with_forms(limit: f64) -> Project {
    let project = Project::new();
    for built_in in ["published", "refit", "lookup"] {
        let spec = project.path(&format!("fits/sine_integral/{built_in}.toml"));
        std::fs::remove_file(spec).expect("written by Project::new");
    }
    project.write("forms/mine/arc.wgsl", ARC);
    project.write("fits/mine/fitted.toml", FITTED);
    let gate = format!(
        "[[gate]]\nsubject = \"mine/fitted\"\nmetric = \"rms\"\nlimit = {limit}\nwhy = \"a test\"\n"
    );
    project.write("fits/gates.toml", gate);
    project
}

#[test]
fn a_form_of_the_project_has_a_name_like_any_other() {
    let project = with_forms(1.0);
    project.write(
        "forms/loose.wgsl",
        "// about: a line\n// cites: nobody\n\nfn loose(x: f32) -> f32 { return x; }\n",
    );
    project
        .striae()
        .args(["list", "forms"])
        .assert()
        .success()
        .stdout(contains("mine/arc").and(contains("own/loose")));
    project.write("points.csv", "x\n1\n");
    project
        .striae()
        .args(["eval", "mine/arc", "--input", "points.csv", "--set", "scale=2"])
        .assert()
        .success()
        .stdout(contains("1,1.1071487177940904"));
    let emit = ["emit", "mine/arc", "--lang", "wgsl"];
    project.striae().args(emit).assert().success().stdout(contains("atan"));
}

#[test]
fn it_is_fitted_and_gated() {
    for (limit, code) in [(1.0, 0), (1e-3, 1)] {
        let project = with_forms(limit);
        let emit = ["emit", "mine/fitted", "--lang", "wgsl"];
        let not_yet = "error: mine/fitted has no result yet: run `striae fit mine/fitted`";
        project.striae().args(emit).assert().code(2).stderr(contains(not_yet));
        project.striae().args(["fit", "mine/fitted"]).assert().success();
        let result: serde_json::Value =
            serde_json::from_str(&project.read("fits/mine/fitted.json")).expect("JSON");
        assert_eq!((&result["form"], &result["status"]), (&"mine/arc".into(), &"converged".into()));
        project.striae().arg("check").assert().code(code).stdout(contains("1 of 1 fits"));
    }
}

#[test]
fn a_text_at_fault_is_told_with_its_place_by_every_verb() {
    let project = with_forms(1.0);
    project.write("forms/mine/bad.wgsl", "// about: a\n// from: b\n");
    project.striae().arg("list").assert().code(2).stderr(contains("bad.wgsl:2: "));
    let opened = Opened::open(project.path("."), Registry::builtin());
    let fault = match opened.expect_err("a fault") {
        ProjectError::Forms(RegistryError::Text(FormTextError { fault, .. })) => fault,
        other => panic!("{other}"),
    };
    assert_eq!(fault, FormTextFault::UnknownKey("from".into()));
}

#[test]
fn a_project_without_forms_gates_or_data_opens_and_its_names_mean_what_they_do_everywhere() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let opened = Opened::open(folder.path(), Registry::builtin()).expect("nothing is required");
    assert_eq!(opened.registry().forms().count(), Registry::builtin().forms().count());
    let subjects = opened.subjects().expect("forms that wait for fits are none");
    assert!(subjects.iter().any(|subject| subject.name == "sine_integral/published"));
}
