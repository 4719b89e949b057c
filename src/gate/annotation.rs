//! Verdicts as GitHub workflow commands, which show up beside the gate's line.

use super::{Judgement, Reproduction, Verdict};

/// One `::error` or `::warning` line per gate that is not plainly passed, a `::notice` where it
/// was not measured, and a closing notice with the counts. `file` is the gate file as the
/// repository names it.
pub fn annotations(file: &str, judgements: &[Judgement], reproductions: &[Reproduction]) -> String {
    let mut text = String::new();
    let mut add = |verdict, place: String, title: String, message: &str| {
        if let Some(level) = level(verdict) {
            let (title, message) = (property(&title), data(message));
            text += &format!("::{level} {place},title={title}::{message}\n");
        }
    };
    for judgement in judgements {
        let (gate, verdict) = (&judgement.gate, judgement.verdict);
        let place = format!("file={},line={}", property(file), gate.line);
        let title = format!("{}: {}", gate.subject, verdict.word());
        add(verdict, place, title, &format!("{}; {}", judgement.summary(), gate.why));
    }
    for constants in reproductions {
        let place = format!("file={}", property(&constants.file));
        add(constants.verdict, place, format!("{}: constants", constants.fit), &constants.detail);
    }
    let failed = judgements.iter().filter(|judgement| judgement.verdict == Verdict::Fail).count();
    text.push_str(&format!("::notice::{} gates, {failed} failed\n", judgements.len()));
    text
}

fn level(verdict: Verdict) -> Option<&'static str> {
    match verdict {
        Verdict::Pass => None,
        Verdict::Warn => Some("warning"),
        Verdict::NotMeasured => Some("notice"),
        Verdict::Fail => Some("error"),
    }
}

/// Text after `::`, where a line break would end the command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Text of a property, where `:` and `,` are separators too.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
