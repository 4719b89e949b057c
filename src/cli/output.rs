//! What a run prints: results on stdout, notes and progress on stderr.

use std::io::{self, IsTerminal, Write};

use comfy_table::{ContentArrangement, LineStyle, Table, TableStyle};
use serde::Serialize;

/// A rule under the header and nothing else, so that a table can be read, searched and pasted.
const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// Where results and notes go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Output {
    json: bool,
    quiet: bool,
}

impl Output {
    /// `json` replaces tables; `quiet` silences notes.
    pub(super) fn new(json: bool, quiet: bool) -> Self {
        Self { json, quiet }
    }

    /// Whether JSON was asked for.
    pub(super) fn json(self) -> bool {
        self.json
    }

    /// Whether a progress bar has someone to look at it.
    pub(super) fn shows_progress(self) -> bool {
        !self.quiet && io::stderr().is_terminal()
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

/// A table of text for a terminal or a file, with a newline at the end.
pub(super) fn table<H: AsRef<str>>(header: &[H], rows: Vec<Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_style(STYLE);
    table.set_header(header.iter().map(|h| h.as_ref().to_owned()));
    if io::stdout().is_terminal() {
        table.set_content_arrangement(ContentArrangement::Dynamic);
    }
    for row in rows {
        table.add_row(row);
    }
    let mut text = String::new();
    for line in table.to_string().lines() {
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// `value` with `digits` significant digits, as short as it can be read: `0.05098`, `1.2e-7`.
pub(super) fn significant(value: f64, digits: usize) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        format!("{value}")
    } else if (1e-3..1e6).contains(&magnitude) {
        let decimals = digits as i32 - 1 - magnitude.log10().floor() as i32;
        let text = format!("{value:.*}", decimals.max(0) as usize);
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    } else {
        format!("{value:.*e}", digits.saturating_sub(1))
    }
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
