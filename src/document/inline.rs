//! Running text with a little markup.

use serde::Serialize;

/// Running text with inline markup: `` `code` `` and `[text](address)`, nothing else.
///
/// Markup that does not close is text.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
#[serde(transparent)]
pub struct Inline(String);

/// A piece of an [`Inline`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Span<'a> {
    /// Text.
    Plain(&'a str),
    /// Code: an identifier, a command, a number as a program prints it.
    Code(&'a str),
    /// A link.
    Link {
        /// What is shown.
        text: &'a str,
        /// Where it leads.
        href: &'a str,
    },
}

impl Inline {
    /// The pieces, in order.
    #[must_use]
    pub fn spans(&self) -> Vec<Span<'_>> {
        let mut spans = Vec::new();
        let mut rest = self.0.as_str();
        let mut plain = 0;
        while let Some(found) = rest.get(plain..).and_then(|tail| tail.find(['`', '['])) {
            let start = plain + found;
            let (before, from) = rest.split_at(start);
            if let Some((span, length)) = marked(from) {
                if !before.is_empty() {
                    spans.push(Span::Plain(before));
                }
                spans.push(span);
                rest = from.get(length..).unwrap_or_default();
                plain = 0;
            } else {
                plain = start + 1;
            }
        }
        if !rest.is_empty() {
            spans.push(Span::Plain(rest));
        }
        spans
    }

    /// The text without markup; a link keeps its address in parentheses.
    #[must_use]
    pub fn to_plain(&self) -> String {
        self.spans()
            .iter()
            .map(|span| match span {
                Span::Plain(text) | Span::Code(text) => (*text).to_owned(),
                Span::Link { text, href } if text == href => (*text).to_owned(),
                Span::Link { text, href } => format!("{text} ({href})"),
            })
            .collect()
    }
}

/// The marked piece that `from` starts with, and its length in bytes.
fn marked(from: &str) -> Option<(Span<'_>, usize)> {
    if let Some(body) = from.strip_prefix('`') {
        let end = body.find('`')?;
        return Some((Span::Code(body.get(..end)?), end + 2));
    }
    let body = from.strip_prefix('[')?;
    let close = body.find(']')?;
    let address = body.get(close + 1..)?.strip_prefix('(')?;
    let end = address.find(')')?;
    let span = Span::Link { text: body.get(..close)?, href: address.get(..end)? };
    Some((span, close + end + 4))
}

impl From<&str> for Inline {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<String> for Inline {
    fn from(text: String) -> Self {
        Self(text)
    }
}
