//! The tutorial's commands, run as printed.
//!
//! Every fenced `sh` block of `data/tutorial/README.md` is run line by line in a copy of the
//! folder. A line is expected to exit with 0, unless a comment `# exits with N` ends it. A fenced
//! `text` block after it lists words that the output must hold.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;

fn tutorial() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data/tutorial")
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a writable folder");
    for entry in fs::read_dir(from).expect("the tutorial") {
        let path = entry.expect("a folder entry").path();
        let target = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).expect("a writable folder");
        }
    }
}

/// A command of the text and the exit code that it announces.
struct Step {
    arguments: Vec<String>,
    code: i32,
    line: String,
    /// Lines of the `text` block behind it.
    shown: Vec<String>,
}

fn steps(text: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut fence: Option<&str> = None;
    for line in text.lines() {
        if let Some(language) = line.strip_prefix("```") {
            fence = if fence.is_some() { None } else { Some(language) };
            continue;
        }
        match fence {
            Some("sh") if line.starts_with("striae ") => {
                let (command, comment) = line.split_once(" # ").unwrap_or((line, ""));
                let code = comment
                    .strip_prefix("exits with ")
                    .map_or(0, |code| code.trim().parse().expect("an exit code"));
                let arguments =
                    command.split_whitespace().skip(1).map(|word| word.replace('\'', "")).collect();
                steps.push(Step { arguments, code, line: line.to_owned(), shown: Vec::new() });
            }
            Some("text") => {
                let step = steps.last_mut().expect("output follows a command");
                step.shown.push(line.to_owned());
            }
            _ => {}
        }
    }
    steps
}

#[test]
fn every_command_of_the_tutorial_does_what_it_says() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let copied = folder.path().join("tutorial");
    copy(&tutorial(), &copied);
    let text = fs::read_to_string(tutorial().join("README.md")).expect("the tutorial's text");
    let steps = steps(&text);
    assert!(steps.len() >= 8, "only {} commands were found", steps.len());
    assert!(steps.iter().any(|step| step.code == 1), "no command shows a gate failing");
    for step in &steps {
        let output = Command::cargo_bin("striae")
            .expect("the binary")
            .current_dir(&copied)
            .env_remove("STRIAE_PROJECT")
            .env_remove("STRIAE_REQUIRE_GPU")
            .args(&step.arguments)
            .output()
            .expect("the binary runs");
        let printed = format!(
            "{}{}",
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        );
        assert_eq!(output.status.code(), Some(step.code), "{}\n{printed}", step.line);
        for line in &step.shown {
            for word in line.split_whitespace().filter(|word| *word != "…") {
                assert!(printed.contains(word), "{}: `{word}` is not in\n{printed}", step.line);
            }
        }
    }
}
