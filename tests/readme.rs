//! Numbers of README.md: its tables stand between markers and are made from what is committed.
//!
//! `STRIAE_WRITE_README=1 cargo test --release --test readme` writes them anew.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use striae::document::cell::number;
use striae::project::Project;
use striae::registry::Registry;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[derive(Deserialize)]
struct Tables {
    candidates: Candidates,
}

#[derive(Deserialize)]
struct Candidates {
    /// Targets whose costs are counted.
    counted: Vec<String>,
    /// The adapter whose times come last.
    timed: String,
    group: Vec<Group>,
}

#[derive(Deserialize)]
struct Group {
    title: String,
    baseline: String,
    /// One number per list, the largest over its regions.
    regions: Vec<Vec<String>>,
    rows: Vec<(String, String)>,
}

type Records = Vec<BTreeMap<String, String>>;

/// Rows of a file of tab-separated values, by the names of its first line that is no comment.
fn records(path: &Path) -> Records {
    let text = read(path);
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("a header").split('\t').collect();
    let record = |line: &str| {
        header
            .iter()
            .map(|name| (*name).to_owned())
            .zip(line.split('\t').map(str::to_owned))
            .collect()
    };
    lines.map(record).collect()
}

/// Two significant digits, short.
fn short(value: f64) -> String {
    let text = number(value, 2);
    if value < 0.1 && value > 0.0 && !text.contains('e') { format!("{value:.1e}") } else { text }
}

fn candidates_table() -> String {
    let tables: Tables =
        toml::from_str(&read(&root().join("tests/readme/tables.toml"))).expect("tables.toml");
    let tables = tables.candidates;
    let errors = records(&root().join("reports/accuracy.tsv"));
    let costs = |name: &String| records(&root().join(format!("reports/costs/{name}.tsv")));
    let counted: Vec<Records> = tables.counted.iter().map(costs).collect();
    let timed = costs(&tables.timed);
    let project = Project::at(root(), Registry::builtin());
    let subjects = project.subjects().expect("the project's results");
    let names = tables.counted.join(" | ");
    let rule = "---|".repeat(tables.counted.len());
    let mut lines = vec![
        format!(
            "| approximation | constants | max error, f32 | {names} | time on {} |",
            tables.timed
        ),
        format!("|---|---|---|{rule}---|"),
    ];
    for group in &tables.group {
        let blank = "| ".repeat(tables.counted.len());
        lines.push(format!("| **{}** | | | × `{}` {blank}|", group.title, group.baseline));
        for (name, note) in &group.rows {
            let error = |regions: &Vec<String>| {
                let of = errors.iter().filter(|row| {
                    row["candidate"] == *name
                        && row["precision"] == "f32"
                        && regions.contains(&row["region"])
                });
                let found: Vec<f64> =
                    of.map(|row| row["error"].parse().expect("a number")).collect();
                assert_eq!(found.len(), regions.len(), "{name}: not every region of {regions:?}");
                short(found.into_iter().fold(0.0, f64::max))
            };
            let subject = subjects.iter().find(|subject| subject.name == *name);
            let candidate = subject.and_then(|subject| subject.candidates.first());
            let constants = candidate.expect("a candidate").constants.len();
            let row = |of: &'_ Records| -> BTreeMap<String, String> {
                of.iter().find(|row| row["candidate"] == *name).expect("a cost").clone()
            };
            let ratio = |row: &BTreeMap<String, String>, column: &str| match row[column].as_str() {
                "" => "—".to_owned(),
                ratio => number(ratio.parse().expect("a number"), 2),
            };
            let counted: Vec<String> = counted.iter().map(|of| ratio(&row(of), "ratio")).collect();
            let time = row(&timed);
            let [median, p25, p75] =
                ["ratio", "ratio_p25", "ratio_p75"].map(|column| ratio(&time, column));
            let note = if note.is_empty() { String::new() } else { format!(" ({note})") };
            let errors: Vec<String> = group.regions.iter().map(error).collect();
            let (errors, counted) = (errors.join(" · "), counted.join(" | "));
            let time = format!("{median} ({p25}–{p75})");
            lines.push(format!("| `{name}`{note} | {constants} | {errors} | {counted} | {time} |"));
        }
    }
    lines.join("\n")
}

#[test]
fn the_tables_of_the_readme_are_those_of_what_is_committed() {
    let path = root().join("README.md");
    let text = read(&path);
    let (begin, end) = ("<!-- candidates: tests/readme.rs -->\n", "\n<!-- end of candidates -->");
    let (before, rest) = text.split_once(begin).expect("the marker of the table");
    let (stands, after) = rest.split_once(end).expect("the marker of its end");
    let made = candidates_table();
    if std::env::var_os("STRIAE_WRITE_README").is_some() {
        fs::write(&path, format!("{before}{begin}{made}{end}{after}")).expect("README.md");
        return;
    }
    assert_eq!(stands, made, "README.md is stale: see the head of tests/readme.rs");
}
