//! Height maps, patterns and environment maps: good files, every refusal with its message, seeded
//! mutations of a good file of each format, and `striae import` from outside.

use std::fmt::Display;
use std::path::{Path, PathBuf};

#[path = "measured_maps/environments.rs"]
mod environments;
#[path = "measured_maps/height_maps.rs"]
mod height_maps;
#[path = "measured_maps/mutations.rs"]
mod mutations;
#[path = "measured_maps/patterns.rs"]
mod patterns;
#[path = "measured_maps/verb.rs"]
mod verb;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A path in the repository.
fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// A file of the larger data outside the repository, or nothing and a word on stderr.
fn outside(name: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("STRIAE_MEASURED")
        .map_or_else(|| repository("../shared/measured"), PathBuf::from);
    let path = folder.join(name);
    if !path.is_file() {
        eprintln!("skipped: {} is not there", path.display());
        return None;
    }
    Some(path)
}

/// Asserts that a result is an error that says each of the things it must.
#[track_caller]
fn assert_refused<T, E: Display>(result: Result<T, E>, parts: &[&str]) {
    let message = result.map_or_else(|e| e.to_string(), |_| panic!("read; expected {parts:?}"));
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}
