//! What a run prints: results on stdout, notes and progress on stderr.

use std::io::{self, IsTerminal, Write};

use clap::{ColorChoice, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::Ending;
use crate::document::text::{self, Layout};
use crate::document::{Inline, Section};

/// Where results and notes go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Output {
    /// Whether JSON was asked for.
    pub(super) json: bool,
    quiet: bool,
    layout: Layout,
}

impl Output {
    /// `json` replaces sections; `quiet` silences notes. Without a choice of its own, colour is for
    /// terminals, unless `NO_COLOR` is set (no-color.org).
    pub(super) fn new(json: bool, quiet: bool, colour: ColorChoice) -> Self {
        let terminal = io::stdout().is_terminal();
        let colour = match colour {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => {
                terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
            }
        };
        let width = if terminal { comfy_table::Table::new().width() } else { None };
        let layout = match width {
            Some(width) => Layout::terminal(width, colour),
            None => Layout { colour, ..Layout::default() },
        };
        Self { json, quiet, layout }
    }

    /// A progress bar over `steps` steps on stderr; hidden where nobody looks at it.
    pub(super) fn bar(self, steps: usize) -> ProgressBar {
        if self.quiet || !io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(steps as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
            bar.set_style(style);
        }
        bar
    }

    /// Prints `value` as JSON if that was asked for, else the sections that `sections` makes, with which
    /// a verb is done.
    pub(super) fn sections<T: Serialize>(
        self,
        value: &T,
        sections: impl FnOnce() -> Vec<Section>,
    ) -> anyhow::Result<Ending> {
        self.result(value, || text::sections(&sections(), self.layout))?;
        Ok(Ending::Done)
    }

    /// Prints `value` as JSON if that was asked for, else the text that `text` makes.
    pub(super) fn result<T: Serialize>(
        self,
        value: &T,
        text: impl FnOnce() -> String,
    ) -> io::Result<()> {
        if self.json {
            let json = serde_json::to_string_pretty(value).map_err(io::Error::other)?;
            to_stdout(&format!("{json}\n"))
        } else {
            to_stdout(&text())
        }
    }

    /// A remark on stderr.
    pub(super) fn note(self, text: &str) {
        if !self.quiet {
            to_stderr(text);
        }
    }
}

/// The name of a choice on the command line.
pub(super) fn name<V: ValueEnum>(choice: V) -> String {
    choice.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// A section of one paragraph, for what is said in a line.
pub(super) fn line(text: impl Into<Inline>) -> Vec<Section> {
    vec![Section::default().paragraph(text)]
}

/// Writes to stdout. A reader that has gone away is no error: the run goes on and ends as it would.
pub(super) fn to_stdout(text: &str) -> io::Result<()> {
    bytes_to_stdout(text.as_bytes())
}

/// The same for what is no text.
pub(super) fn bytes_to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

/// Writes a line to stderr; nothing can be done where that fails.
pub(super) fn to_stderr(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}
