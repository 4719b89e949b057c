//! A progress bar on stderr, where there is a terminal.

use indicatif::{ProgressBar, ProgressStyle};

use super::output::Output;

/// A bar over `steps` steps; hidden where nobody looks at it.
pub(super) fn bar(output: Output, steps: usize) -> ProgressBar {
    if !output.shows_progress() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}
