//! Fits with a known answer, and fits that must say what is wrong with them.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use striae::fit::loss::Loss;
use striae::fit::outcome::{Outcome, Status};
use striae::fit::solve::SolverKind;
use striae::fit::spec::{FormChoice, ParameterChoice, Spec, Target, Weighting};
use striae::fit::{Context, FitError, FitResult, run_spec};
use striae::registry::Registry;
use striae::table::{Column, Table};

const DECAY: &str = "override a: f32 = 2.0;\noverride b: f32 = 1.0;\noverride c: f32 = 0.1;\n\
                     fn f(x: f32) -> f32 { return a * exp(-b * x) + c; }";
const TRUTH: [(&str, f64); 3] = [("a", 3.25), ("b", 0.7), ("c", 0.5)];

fn context() -> Context {
    Context::new(env!("CARGO_MANIFEST_DIR"), Registry::builtin())
}

fn spec(source: &str, table: Table) -> Spec {
    let form = FormChoice::Text {
        origin: "test.wgsl".into(),
        source: source.into(),
        function: "f".into(),
    };
    let (label, column, weight) = ("test".into(), "y".into(), Weighting::Uncertainty);
    Spec::ad_hoc("test", form, Target::Table { label, table, column, weight })
}

fn table(x: &[f64], y: impl Fn(f64) -> f64) -> Table {
    let values = x.iter().map(|x| y(*x)).collect();
    let columns = vec![Column::new("x", "1", x.to_vec()), Column::new("y", "1", values)];
    Table { columns, origin: "test".into() }
}

fn grid(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * f64::from(i) / f64::from(count - 1)).collect()
}

fn decay(x: f64) -> f64 {
    3.25 * (-0.7 * x).exp() + 0.5
}

/// Uniform noise in ±`size`, seeded.
fn noisy(x: &[f64], size: f64, seed: u64) -> Table {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut table = table(x, decay);
    table.columns[1].values.iter_mut().for_each(|y| *y += size * random.random_range(-1.0..1.0));
    table
}

fn run(spec: &Spec) -> Outcome {
    match run_spec(spec, &context()).unwrap() {
        FitResult::Single(outcome) => *outcome,
        FitResult::Family(_) => panic!("a table is not a family"),
    }
}

fn refusal(spec: &Spec) -> String {
    run_spec(spec, &context()).expect_err("this must be refused").to_string()
}

fn free(start: f64, lower: Option<f64>, upper: Option<f64>) -> ParameterChoice {
    ParameterChoice::Free { start: Some(start), lower, upper }
}

fn value(outcome: &Outcome, name: &str) -> f64 {
    outcome.parameters[name].value
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = ((found - expected) / expected).abs();
    assert!(error <= tolerance, "{what}: {found} instead of {expected}, off by {error:.1e}");
}

const SMOOTH_SOLVERS: [SolverKind; 5] = [
    SolverKind::Auto,
    SolverKind::GaussNewton,
    SolverKind::TrustRegion,
    SolverKind::LevenbergMarquardt,
    SolverKind::Lbfgs,
];

#[test]
fn every_solver_recovers_constants_without_noise_under_every_loss() {
    let mut spec = spec(DECAY, table(&grid(0.0, 5.0, 60), decay));
    let losses = [Loss::LeastSquares, Loss::Relative, Loss::Huber { scale: 0.1 }, Loss::Minimax];
    for loss in losses {
        for solver in SMOOTH_SOLVERS.into_iter().chain([SolverKind::NelderMead]) {
            (spec.loss, spec.solver) = (loss, solver);
            if solver.objection(loss, 3).is_some() {
                assert!(refusal(&spec).contains("solver.kind"));
                continue;
            }
            let outcome = run(&spec);
            // Measured: 1e-10 with derivatives, 2e-6 for the simplex.
            let tolerance = if solver == SolverKind::NelderMead { 1e-4 } else { 1e-7 };
            let what = format!("{} with {}: {:?}", loss.name(), solver.name(), outcome.status);
            for (name, truth) in TRUTH {
                assert_close(value(&outcome, name), truth, tolerance, &what);
            }
            if solver != SolverKind::NelderMead {
                assert_eq!(outcome.status, Status::Converged, "{what}");
            }
        }
    }
}

#[test]
fn a_perfect_fit_has_no_standard_error() {
    let outcome = run(&spec(DECAY, table(&grid(0.0, 5.0, 60), decay)));
    let reason = outcome.parameters["a"].why_no_stderr.as_deref().unwrap_or_default();
    assert!(reason.contains("no noise"), "{reason}");
}

#[test]
fn brent_fits_one_constant() {
    let mut spec = spec(DECAY, noisy(&grid(0.0, 5.0, 60), 0.01, 3));
    spec.solver = SolverKind::Brent;
    assert!(refusal(&spec).contains("brent expects 1 free parameter, got 3"));
    spec.parameters.insert("a".into(), ParameterChoice::Fixed(3.25));
    spec.parameters.insert("c".into(), ParameterChoice::Fixed(0.5));
    let outcome = run(&spec);
    assert_eq!(outcome.status, Status::Converged);
    spec.solver = SolverKind::LevenbergMarquardt;
    assert_close(value(&outcome, "b"), value(&run(&spec), "b"), 1e-7, "b");
}

#[test]
fn solvers_agree_on_noisy_data_and_cover_the_truth() {
    let mut spec = spec(DECAY, noisy(&grid(0.0, 5.0, 200), 0.05, 7));
    for loss in [Loss::LeastSquares, Loss::Relative, Loss::Huber { scale: 0.02 }] {
        spec.loss = loss;
        spec.solver = SolverKind::Auto;
        let best = run(&spec);
        for solver in SMOOTH_SOLVERS {
            spec.solver = solver;
            let outcome = run(&spec);
            let what = format!("{} with {}", loss.name(), solver.name());
            assert_eq!(outcome.status, Status::Converged, "{what}");
            for (name, truth) in TRUTH {
                assert_close(value(&outcome, name), value(&best, name), 1e-6, &what);
                if let Some(stderr) = outcome.parameters[name].stderr {
                    let off = (value(&outcome, name) - truth).abs() / stderr;
                    assert!(off < 4.0, "{what}: {name} is {off:.1} standard errors off");
                }
            }
        }
    }
}

#[test]
fn uncertainties_weigh_and_columns_may_replace_them() {
    let x = grid(0.0, 5.0, 80);
    let mut table = noisy(&x, 0.02, 11);
    // The second half is wrong, and says so.
    table.columns[1].values[40..].iter_mut().for_each(|y| *y += 0.3);
    let uncertainty: Vec<f64> = (0..80).map(|i| if i < 40 { 0.01 } else { 1e3 }).collect();
    let weights = uncertainty.iter().map(|u| 1.0 / (u * u)).collect();
    let mut plain = spec(DECAY, table.clone());
    table.columns[1].uncertainty = Some(uncertainty);
    table.columns.push(Column::new("w", "1", weights));
    let weighted = run(&spec(DECAY, table.clone()));
    let mut by_column = spec(DECAY, table.clone());
    if let Target::Table { weight, .. } = &mut by_column.target {
        *weight = Weighting::Column("w".into());
    }
    let by_column = run(&by_column);
    assert!((value(&weighted, "a") - 3.25).abs() < 0.1);
    assert_eq!(value(&weighted, "a"), value(&by_column, "a"));
    assert!((value(&run(&plain), "c") - 0.5).abs() > 0.2);
    if let Target::Table { weight, .. } = &mut plain.target {
        *weight = Weighting::Column("w".into());
    }
    assert!(refusal(&plain).contains("no column `w`"));
    table.columns[2].values[4] = -1.0;
    let mut negative = spec(DECAY, table);
    if let Target::Table { weight, .. } = &mut negative.target {
        *weight = Weighting::Column("w".into());
    }
    assert!(refusal(&negative).contains("row 5"), "{}", refusal(&negative));
}

#[test]
fn starts_on_bounds_reach_an_optimum_inside() {
    let mut spec = spec(DECAY, table(&grid(0.0, 5.0, 60), decay));
    spec.parameters.insert("a".into(), free(0.0, Some(0.0), Some(10.0)));
    spec.parameters.insert("b".into(), free(0.0, Some(0.0), None));
    spec.parameters.insert("c".into(), free(2.0, None, Some(2.0)));
    for solver in SMOOTH_SOLVERS {
        spec.solver = solver;
        let outcome = run(&spec);
        // Levenberg-Marquardt alone runs off to where the decay is over at the second point.
        if solver == SolverKind::LevenbergMarquardt {
            assert_eq!(outcome.status, Status::Stalled);
            continue;
        }
        assert_eq!(outcome.status, Status::Converged, "{}", solver.name());
        for (name, truth) in TRUTH {
            assert_close(value(&outcome, name), truth, 1e-7, solver.name());
        }
    }
}

#[test]
fn an_optimum_beyond_a_bound_ends_on_it_and_says_so() {
    let mut spec = spec(DECAY, noisy(&grid(0.0, 5.0, 60), 0.01, 5));
    spec.parameters.insert("b".into(), free(0.3, Some(0.0), Some(0.5)));
    for solver in SMOOTH_SOLVERS {
        spec.solver = solver;
        let outcome = run(&spec);
        assert_eq!(outcome.status, Status::AtBound, "{}", solver.name());
        let bounded = &outcome.parameters["b"];
        assert_eq!((bounded.value, bounded.f32), (0.5, 0.5), "{}", solver.name());
        assert_eq!(bounded.why_no_stderr.as_deref(), Some("on its bound"));
        assert!(outcome.parameters["a"].stderr.is_some());
        assert_eq!(outcome.correlation_order, ["a", "c"]);
    }
    // The others are where they are if that constant is fixed.
    let pinned = run(&spec);
    spec.parameters.insert("b".into(), ParameterChoice::Fixed(0.5));
    assert_close(value(&pinned, "a"), value(&run(&spec), "a"), 1e-7, "a");
}

#[test]
fn fixed_and_tied_constants_do_as_they_are_told() {
    let source = "override a: f32 = 1.0;\noverride b: f32;\noverride c: f32 = 0.2;\n\
                  fn f(x: f32) -> f32 { return a * exp(-b * x) + c; }";
    let target = |x: f64| 0.9 * (-0.9 * x).exp() + 0.25;
    let mut spec = spec(source, table(&grid(0.0, 4.0, 40), target));
    spec.parameters.insert("b".into(), ParameterChoice::Tied("a".into()));
    spec.parameters.insert("c".into(), ParameterChoice::Fixed(0.25));
    let outcome = run(&spec);
    assert_close(value(&outcome, "a"), 0.9, 1e-9, "a");
    assert_eq!(value(&outcome, "b"), value(&outcome, "a"));
    assert_eq!(outcome.parameters["b"].role, "tied to a");
    assert_eq!(outcome.parameters["b"].f32, outcome.parameters["a"].f32);
    assert_eq!((value(&outcome, "c"), outcome.parameters["c"].role.as_str()), (0.25, "fixed"));
    spec.parameters.insert("b".into(), ParameterChoice::Tied("d".into()));
    assert!(refusal(&spec).contains("no other override `d`"));
}

/// Errors of the best approximations to exp on [−1, 1]: of degree 3 5.5284e-3 (Powell 1981, §1), of
/// type (2, 2) 8.69e-5 (Trefethen, Approximation Theory and Approximation Practice, ch. 24). By
/// the alternation theorem the errors reach their maximum one time more than there are constants,
/// and an approximation that does so is the best one.
#[test]
fn minimax_equioscillates_on_the_exponential() {
    let cubic = "override a: f32 = 1.0;\noverride b: f32 = 1.0;\noverride c: f32 = 0.5;\n\
                 override d: f32 = 0.2;\n\
                 fn f(x: f32) -> f32 { return a + x * (b + x * (c + x * d)); }";
    let rational = "override a: f32 = 1.0;\noverride b: f32 = 0.5;\noverride c: f32 = 0.1;\n\
                    override d: f32 = -0.5;\noverride e: f32 = 0.1;\n\
                    fn f(x: f32) -> f32 {\n\
                    return (a + x * (b + x * c)) / (1.0 + x * (d + x * e)); }";
    for (source, constants, error) in [(cubic, 4, 5.5284e-3), (rational, 5, 8.69e-5)] {
        let mut spec = spec(source, table(&grid(-1.0, 1.0, 1001), f64::exp));
        spec.loss = Loss::Minimax;
        let outcome = run(&spec);
        assert_eq!(outcome.status, Status::Converged);
        assert_eq!(outcome.equioscillations, Some(constants + 1));
        assert_close(outcome.residuals.max_abs, error, 1e-3, "largest error");
        assert!(outcome.parameters["a"].why_no_stderr.is_some());
    }
}

#[test]
fn a_constant_without_effect_is_singular() {
    let useless = "override a: f32 = 1.0;\noverride b: f32 = 1.0;\n\
                   fn f(x: f32) -> f32 { return a * x + 0.0 * b; }";
    let doubled = "override a: f32 = 1.0;\noverride b: f32 = 1.0;\n\
                   fn f(x: f32) -> f32 { return (a + b) * x; }";
    for source in [useless, doubled] {
        let mut spec =
            spec(source, table(&grid(0.0, 1.0, 20), |x| 3.0 * x + 0.1 * (9.0 * x).sin()));
        for solver in SMOOTH_SOLVERS.into_iter().chain([SolverKind::NelderMead]) {
            spec.solver = solver;
            let outcome = run(&spec);
            assert_eq!(outcome.status, Status::Singular, "{}", solver.name());
            assert_eq!((outcome.condition, &outcome.correlation), (None, &None));
            let reason = outcome.parameters["a"].why_no_stderr.as_deref();
            assert_eq!(reason, Some("the Jacobian is singular"));
        }
    }
}

#[test]
fn what_is_not_finite_never_converges() {
    let source = "override a: f32 = -1.0;\nfn f(x: f32) -> f32 { return sqrt(a * x); }";
    let spec = spec(source, table(&grid(0.5, 1.0, 20), f64::sqrt));
    let outcome = run(&spec);
    assert_eq!(outcome.status, Status::NonFinite);
    assert!(outcome.starts[0].cost.is_none() && outcome.residuals.rms.is_nan());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.json");
    FitResult::Single(Box::new(outcome)).write(&path).unwrap();
    assert!(FitResult::read(&path).unwrap().outcomes()[0].residuals.rms.is_nan());
}

#[test]
fn a_budget_that_is_too_small_is_reported() {
    let mut spec = spec(DECAY, noisy(&grid(0.0, 5.0, 60), 0.01, 5));
    spec.parameters.insert("b".into(), free(9.0, None, None));
    for solver in SMOOTH_SOLVERS {
        (spec.solver, spec.max_iterations) = (solver, 2);
        assert_eq!(run(&spec).status, Status::HitIterationLimit, "{}", solver.name());
    }
}

#[test]
fn bad_tables_are_refused_by_row_and_column() {
    let mut broken = table(&grid(0.0, 1.0, 20), decay);
    broken.columns[1].values[6] = f64::NAN;
    let message = refusal(&spec(DECAY, broken.clone()));
    assert!(message.contains("row 7, column `target`") && message.contains("NaN"), "{message}");
    broken.columns[1].values[6] = 1.0;
    broken.columns[0].values[2] = f64::INFINITY;
    let message = refusal(&spec(DECAY, broken));
    assert!(message.contains("row 3, column `x`"), "{message}");
    let message = refusal(&spec(DECAY, table(&[0.0, 1.0], decay)));
    assert!(message.contains("3 free parameters") && message.contains("got 2"), "{message}");
    let mut relative = spec(DECAY, table(&grid(-1.0, 1.0, 21), |x| x));
    relative.loss = Loss::Relative;
    assert!(refusal(&relative).contains("row 11"), "{}", refusal(&relative));
    let mut unknown = table(&grid(0.0, 1.0, 20), decay);
    unknown.columns[0].name = "t".into();
    assert!(refusal(&spec(DECAY, unknown)).contains("there is no column `x`; it has t, y"));
}

#[test]
fn as_many_rows_as_constants_leave_no_standard_error() {
    let outcome = run(&spec(DECAY, table(&[0.0, 1.0, 3.0], decay)));
    assert_eq!(outcome.status, Status::Converged);
    let reason = outcome.parameters["a"].why_no_stderr.as_deref().unwrap_or_default();
    assert!(reason.contains("no degrees of freedom"), "{reason}");
}

/// The search may only improve on rounding each constant to the nearest f32.
#[test]
fn shipped_constants_are_no_worse_than_nearest_ones() {
    let source = "override a: f32 = 1.0;\noverride b: f32 = 1.0;\noverride c: f32 = 0.5;\n\
                  override d: f32 = 0.2;\noverride e: f32 = 0.04;\noverride g: f32 = 0.01;\n\
                  fn f(x: f32) -> f32 {\n\
                  return a + x * (b + x * (c + x * (d + x * (e + x * g)))); }";
    let x: Vec<f64> = grid(-0.5, 0.5, 401).iter().map(|x| f64::from(*x as f32)).collect();
    let spec = spec(source, table(&x, f64::exp));
    let outcome = run(&spec);
    let form = striae::form::Form::parse("test.wgsl", source, "f").unwrap();
    let nearest: Vec<f32> =
        form.parameters().iter().map(|p| outcome.parameters[&p.name].value as f32).collect();
    let single: Vec<f32> = x.iter().map(|x| *x as f32).collect();
    let values = form.eval_f32(&nearest, &[&single]).unwrap();
    let square = |(v, x): (&f32, &f64)| (f64::from(*v) - x.exp()).powi(2);
    let rms = (values[0].iter().zip(&x).map(square).sum::<f64>() / 401.0).sqrt();
    println!("nearest {rms:.4e}, shipped {:.4e}", outcome.residuals_f32.rms);
    assert!(outcome.residuals_f32.rms <= rms);
}

#[test]
fn results_are_the_same_for_every_number_of_threads() {
    let mut spec = spec(DECAY, noisy(&grid(0.0, 5.0, 60), 0.05, 13));
    spec.parameters.insert("a".into(), free(1.0, Some(0.0), Some(20.0)));
    spec.multi_start = 9;
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run_spec(&spec, &context()).unwrap().to_json().unwrap())
    };
    let one = with(1);
    assert_eq!(one, with(4));
    assert_eq!(one, with(1));
    assert_eq!(one.matches("\"cost\"").count(), 9);
}

#[test]
fn results_read_back_as_they_were_written() {
    let result = run_spec(&spec(DECAY, noisy(&grid(0.0, 5.0, 60), 0.05, 13)), &context()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.json");
    result.write(&path).unwrap();
    assert_eq!(FitResult::read(&path).unwrap(), result);
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    let error = FitResult::read(&path).unwrap_err();
    assert!(matches!(error, FitError::Result { .. }) && error.to_string().contains("r.json"));
    std::fs::write(&path, text.replace("\"schema\": 1", "\"schema\": 2")).unwrap();
    assert!(matches!(FitResult::read(&path), Err(FitError::Schema { got: 2, .. })));
}

const SPEC: &str = r#"form = "sine_integral/published"
target = "sine_integral"

[domain]
x = { from = -10.0, to = 10.0, count = 2001 }

[parameters]
tail = { start = 0.7, lower = 0.0, upper = 2.0 }
offset = { start = 0.4 }
"#;

#[test]
fn bad_specs_are_refused_with_file_line_and_key() {
    let message = |from: &str, to: &str| {
        let text = SPEC.replacen(from, to, 1);
        assert_ne!(text, SPEC);
        Spec::parse("f.toml", "e/f", &text)
            .and_then(|spec| run_spec(&spec, &context()))
            .expect_err(to)
            .to_string()
    };
    for (from, to, expected) in [
        ("lower = 0.0", "lower = 0.9", "f.toml:8: parameters.tail.start: 0.7 is below"),
        ("upper = 2.0", "upper = 0.0", "f.toml:8: parameters.tail: expected lower < upper"),
        ("to = 10.0", "to = -10.0", "f.toml:5: domain.x: expected from < to"),
        ("count = 2001", "count = 1", "f.toml:5: domain.x: expected count"),
        ("offset =", "other =", "f.toml:9: parameters.other: "),
        ("x = {", "y = {", "f.toml:5: domain.y: "),
        ("start = 0.4", "start = 0.4, fixed = 1.0", "f.toml:9: parameters.offset: "),
        ("start = 0.4", "tied = \"offset\"", "f.toml:9: parameters.offset.tied: "),
        ("start = 0.4", "begin = 0.4", "unknown field `begin`"),
        ("form =", "from =", "unknown field `from`"),
        ("integral\"\n\n", "integral\"\nfamily = \"f\"\n\n", "f.toml:2: target: "),
        ("target = \"sine", "target = \"cosine", "no reference called `cosine_integral`"),
        ("published", "unheard", "no form called `sine_integral/unheard`"),
        ("[parameters]", "[loss]\nkind = \"huber\"\n[parameters]", "f.toml:8: loss.kind: "),
        ("[domain]", "[domain", "f.toml"),
    ] {
        let message = message(from, to);
        assert!(message.contains(expected), "{to}: {message}");
    }
}

/// The optimum over 401 points, published in no paper but found by two other implementations.
#[test]
fn the_published_form_is_refitted_from_its_spec() {
    let spec = Spec::parse("f.toml", "e/f", &SPEC.replace("2001", "401")).unwrap();
    let outcome = run(&spec);
    assert_eq!(outcome.status, Status::Converged);
    assert_close(value(&outcome, "tail"), 0.66143279, 1e-6, "tail");
    assert_close(value(&outcome, "offset"), 0.38251042, 1e-6, "offset");
    assert!(outcome.parameters["tail"].why_no_stderr.is_some());
    assert!(outcome.correlation.is_some() && outcome.condition.is_some());
}

/// Residuals of 1e-4 and less, in forms that cancel: rounding hides the cost of the last digits, and
/// the gradient still shows the optimum. Only the edge tint has bounds that a metal may reach.
#[test]
fn every_member_of_a_family_ends_at_an_optimum() {
    let context = context();
    for (name, bounded) in [("gulbrandsen", true), ("gulbrandsen_exact", true), ("rational", false)]
    {
        let spec = Spec::read(&context.root.join(format!("fits/fresnel/{name}.toml"))).unwrap();
        let result = run_spec(&spec, &context).unwrap();
        for outcome in result.outcomes() {
            let on_bound = bounded
                && outcome.status == Status::AtBound
                && [0.0, 1.0].contains(&value(outcome, "g"));
            let at_optimum = outcome.status == Status::Converged || on_bound;
            assert!(at_optimum, "{}: {:?}", outcome.name, outcome.status);
        }
    }
}
