//! The NIST StRD problems of nonlinear regression: every problem from both starts, with the default
//! solver and nothing told but the start, against the certified parameters and standard errors.

use std::path::{Path, PathBuf};

use striae::fit::outcome::{Outcome, Status};
use striae::fit::spec::{FormChoice, ParameterChoice, Spec, Target, Weighting};
use striae::fit::{Context, FitResult, run_spec};
use striae::registry::Registry;
use striae::table::{Column, Table};

/// Problem, WGSL of its model, and whether NIST fits the logarithm of the response.
const PROBLEMS: [(&str, &str, bool); 17] = [
    ("Chwirut1", include_str!("nist/chwirut.wgsl"), false),
    ("Chwirut2", include_str!("nist/chwirut.wgsl"), false),
    ("DanWood", include_str!("nist/danwood.wgsl"), false),
    ("Gauss1", include_str!("nist/gauss.wgsl"), false),
    ("Gauss2", include_str!("nist/gauss.wgsl"), false),
    ("Kirby2", include_str!("nist/kirby2.wgsl"), false),
    ("Lanczos1", include_str!("nist/lanczos.wgsl"), false),
    ("Lanczos3", include_str!("nist/lanczos.wgsl"), false),
    ("MGH09", include_str!("nist/mgh_nine.wgsl"), false),
    ("MGH17", include_str!("nist/mgh_seventeen.wgsl"), false),
    ("Misra1a", include_str!("nist/misra1a.wgsl"), false),
    ("Misra1b", include_str!("nist/misra1b.wgsl"), false),
    ("Misra1c", include_str!("nist/misra1c.wgsl"), false),
    ("Misra1d", include_str!("nist/misra1d.wgsl"), false),
    ("Nelson", include_str!("nist/nelson.wgsl"), true),
    ("Rat42", include_str!("nist/rat_forty_two.wgsl"), false),
    ("Roszman1", include_str!("nist/roszman1.wgsl"), false),
];

/// A parameter as NIST's file gives it.
struct Certified {
    name: String,
    starts: [f64; 2],
    value: f64,
    deviation: f64,
}

struct Problem {
    table: Table,
    parameters: Vec<Certified>,
}

fn folder() -> PathBuf {
    let measured = std::env::var_os("STRIAE_MEASURED").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/measured"),
        PathBuf::from,
    );
    measured.join("nist_strd_nls")
}

fn read(text: &str, logarithm: bool) -> Problem {
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    let parameters = text
        .lines()
        .filter_map(|line| {
            let (name, rest) = line.split_once('=')?;
            let name = name.trim();
            let digits = name.strip_prefix('b')?;
            let numbers = numbers(rest);
            (digits.parse::<u32>().is_ok() && numbers.len() == 4).then(|| Certified {
                name: name.to_owned(),
                starts: [numbers[0], numbers[1]],
                value: numbers[2],
                deviation: numbers[3],
            })
        })
        .collect();
    let data = &text[text.rfind("\nData:").expect("a data section") + 1..];
    let mut lines = data.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split_whitespace().skip(1).collect();
    let rows: Vec<Vec<f64>> = lines.map(numbers).filter(|row| row.len() == names.len()).collect();
    let column = |(index, name): (usize, &&str)| {
        let mut values: Vec<f64> = rows.iter().map(|row| row[index]).collect();
        if logarithm && *name == "y" {
            values.iter_mut().for_each(|y| *y = y.ln());
        }
        Column::new(*name, "1", values)
    };
    let columns = names.iter().enumerate().map(column).collect();
    Problem { table: Table { columns, origin: "NIST StRD".into() }, parameters }
}

fn fit(name: &str, model: &str, problem: &Problem, start: usize) -> Outcome {
    let mut spec = Spec::ad_hoc(
        name,
        FormChoice::Text {
            origin: format!("{name}.wgsl"),
            source: model.into(),
            function: "model".into(),
        },
        Target::Table {
            label: name.into(),
            table: problem.table.clone(),
            column: "y".into(),
            weight: Weighting::Equal,
        },
    );
    for parameter in &problem.parameters {
        let start = Some(parameter.starts[start]);
        let choice = ParameterChoice::Free { start, lower: None, upper: None };
        spec.parameters.insert(parameter.name.clone(), choice);
    }
    match run_spec(&spec, &Context::new("", Registry::builtin())).unwrap() {
        FitResult::Single(outcome) => *outcome,
        FitResult::Family(_) => unreachable!("the target is a table"),
    }
}

/// Digits to which `value` agrees with `certified`.
fn digits(value: f64, certified: f64) -> f64 {
    -((value - certified) / certified).abs().max(1e-12).log10()
}

#[test]
fn certified_values_are_reached_from_both_starts() {
    let folder = folder();
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return;
    }
    println!(
        "{:<10} {:>5} {:>8} {:>8}  status, iterations, evaluations, solver",
        "problem", "start", "digits", "stderr"
    );
    let (mut runs, mut six) = (0, 0);
    let mut failures = Vec::new();
    for (name, model, logarithm) in PROBLEMS {
        let text = std::fs::read_to_string(folder.join(format!("{name}.dat"))).unwrap();
        let problem = read(&text, logarithm);
        assert!(!problem.parameters.is_empty() && problem.table.rows() > 0, "{name} was not read");
        for start in 0..2 {
            let outcome = fit(name, model, &problem, start);
            let (mut value, mut deviation) = (f64::INFINITY, f64::INFINITY);
            for certified in &problem.parameters {
                let found = &outcome.parameters[&certified.name];
                value = value.min(digits(found.value, certified.value));
                let stderr = found.stderr.unwrap_or(f64::INFINITY);
                deviation = deviation.min(digits(stderr, certified.deviation));
            }
            println!(
                "{name:<10} {:>5} {value:>8.1} {deviation:>8.1}  {:?}, {}, {}, {}",
                start + 1,
                outcome.status,
                outcome.iterations,
                outcome.evaluations,
                outcome.solver
            );
            runs += 1;
            six += u32::from(value >= 6.0);
            if value < 4.0 && outcome.status == Status::Converged {
                failures.push(format!(
                    "{name} from start {}: converged to {value:.1} digits",
                    start + 1
                ));
            }
            // Lanczos1's residuals are 9e-14 beside values of 2.5: rounding the data to f64 alone
            // moves their deviation by 4.3e-4, in whatever precision the fit is done.
            let enough = if name == "Lanczos1" { 3.0 } else { 4.0 };
            if value >= 6.0 && deviation < enough {
                failures.push(format!(
                    "{name} from start {}: stderr to {deviation:.1} digits",
                    start + 1
                ));
            }
        }
    }
    println!("{six} of {runs} runs to 6 digits or more");
    assert!(failures.is_empty(), "{failures:#?}");
    assert!(f64::from(six) >= 0.95 * f64::from(runs), "{six} of {runs}");
}
