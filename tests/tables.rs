//! Tables, grids, provenance and measured data: round trips, every refusal, published values, and
//! a thousand seeded mutations of a good file of each format.

use std::path::{Path, PathBuf};

#[path = "tables/csv.rs"]
mod csv;
#[path = "tables/data_sets.rs"]
mod data_sets;
#[path = "tables/exr.rs"]
mod exr;
#[path = "tables/grids.rs"]
mod grids;
#[path = "tables/mutations.rs"]
mod mutations;
#[path = "tables/records.rs"]
mod records;

/// A path in the repository.
fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Asserts that a message says each of the things it must.
#[track_caller]
fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}
