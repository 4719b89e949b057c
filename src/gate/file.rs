//! Reads `fits/gates.toml`.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::{Domain, Gate, Metric, Precision, SCENES};
use crate::counted::GpuTarget;

/// Why a gate file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum GateFileError {
    /// The file cannot be read.
    #[error("{file}: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The text is no TOML, a key is missing, unknown or of the wrong type, or a value makes no sense.
    #[error("{file}:{line}: {place}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// `gate 3, key limit`, as far as known.
        place: String,
        /// What is wrong, and what was expected.
        message: String,
    },
    /// There is nothing to hold to.
    #[error("{file}: holds no gate; an empty list would pass anything")]
    Empty {
        /// The file.
        file: String,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFile {
    #[serde(default)]
    gate: Vec<RawGate>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGate {
    subject: Spanned<String>,
    metric: Spanned<String>,
    precision: Option<Spanned<String>>,
    domain: Option<Spanned<String>>,
    limit: Spanned<f64>,
    measured: Option<Spanned<f64>>,
    warn: Option<Spanned<f64>>,
    shipped: Option<Spanned<PathBuf>>,
    relative_to: Option<Spanned<String>>,
    target: Option<Spanned<String>>,
    why: Spanned<String>,
}

/// Reads a gate file.
///
/// # Errors
/// [`GateFileError`] names the file, the line, the gate by its position and the key.
pub fn read(file: &Path) -> Result<Vec<Gate>, GateFileError> {
    let shown = file.display().to_string();
    match std::fs::read_to_string(file) {
        Ok(text) => parse(&shown, &text),
        Err(source) => Err(GateFileError::Unreadable { file: shown, source }),
    }
}

/// Reads the text of a gate file; `file` names it in errors.
///
/// # Errors
/// [`GateFileError`], as for [`read`].
pub fn parse(file: &str, text: &str) -> Result<Vec<Gate>, GateFileError> {
    let raw: RawFile = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        GateFileError::Syntax {
            file: file.to_owned(),
            line: line_at(text, at),
            place: place_at(text, at),
            message: error.message().to_owned(),
        }
    })?;
    if raw.gate.is_empty() {
        return Err(GateFileError::Empty { file: file.to_owned() });
    }
    let gates = raw.gate.into_iter().enumerate();
    gates.map(|(place, raw)| Reading { file, text, index: place + 1 }.gate(raw)).collect()
}

/// The gate being read, for errors.
struct Reading<'a> {
    file: &'a str,
    text: &'a str,
    index: usize,
}

impl Reading<'_> {
    fn gate(&self, raw: RawGate) -> Result<Gate, GateFileError> {
        let line = line_at(self.text, raw.subject.span().start);
        let subject = self.filled("subject", raw.subject)?;
        let why = self.filled("why", raw.why)?;
        let metric = self.named("metric", &raw.metric, &Metric::ALL)?;
        let precisions = [Precision::F64, Precision::F32, Precision::Device]
            .map(|precision| (precision.to_string(), precision));
        let precision = match &raw.precision {
            Some(name) => self.named("precision", name, &precisions)?,
            None => Precision::default(),
        };
        let domain = raw.domain.as_ref().map(|text| {
            Domain::parse(text.get_ref())
                .map_err(|error| self.wrong("domain", text, error.to_string()))
        });
        let domain = domain.transpose()?;
        let limit = *raw.limit.get_ref();
        let message = format!("expected a finite number > 0, got {limit}");
        self.ensure(limit.is_finite() && limit > 0.0, "limit", &raw.limit, message)?;
        let range = match metric {
            Metric::Chi2P => format!("from the limit {limit} to 1"),
            _ => format!("from 0 to the limit {limit}"),
        };
        for (key, number) in [("measured", &raw.measured), ("warn", &raw.warn)] {
            let Some(number) = number else { continue };
            let got = *number.get_ref();
            let message = format!("expected a number {range}, got {got}");
            let within = got >= 0.0 && got.is_finite() && !metric.worse(got, limit);
            self.ensure(within, key, number, message)?;
        }
        let drift = metric == Metric::Drift;
        let of_pictures = subject.starts_with(SCENES);
        if let Some(domain) = &raw.domain {
            let message = "drift compares constants, over no domain";
            self.ensure(!drift, "domain", domain, message)?;
            let message = "a scene is judged over all of its pixels";
            self.ensure(!of_pictures, "domain", domain, message)?;
        }
        let pictured = [Metric::RelL2, Metric::Rms, Metric::MaxAbs, Metric::Bias, Metric::Flip];
        let message = format!("a scene has rel_l2, rms, max_abs, bias and flip, got {metric}");
        self.ensure(!of_pictures || pictured.contains(&metric), "metric", &raw.metric, message)?;
        let message = "flip is a metric of scenes, `scenes/name#approximation`";
        self.ensure(of_pictures || metric != Metric::Flip, "metric", &raw.metric, message)?;
        if let Some(text) = &raw.precision {
            let message = "a picture is made in f32 or on the device";
            self.ensure(!of_pictures || precision != Precision::F64, "precision", text, message)?;
        }
        let message = "drift needs `shipped = \"file\"` beside it";
        self.ensure(!drift || raw.shipped.is_some(), "metric", &raw.metric, message)?;
        if let Some(shipped) = &raw.shipped {
            let message = format!("is for the metric drift only, not for {metric}");
            self.ensure(drift, "shipped", shipped, message)?;
        }
        let cost = metric == Metric::Cost;
        let message =
            "cost needs `relative_to = \"effect/name\"` and `target = \"rdna2\"` beside it";
        let beside = raw.relative_to.is_some() && raw.target.is_some();
        self.ensure(!cost || beside, "metric", &raw.metric, message)?;
        for (key, text) in [("relative_to", &raw.relative_to), ("target", &raw.target)] {
            let Some(text) = text else { continue };
            let message = format!("is for the metric cost only, not for {metric}");
            self.ensure(cost, key, text, message)?;
        }
        for (key, text) in [("domain", &raw.domain), ("precision", &raw.precision)] {
            let Some(text) = text else { continue };
            self.ensure(!cost, key, text, "a cost is counted, of no points and in no precision")?;
        }
        let targets = GpuTarget::ALL.map(|target| (target.name(), target));
        let target = raw.target.as_ref().map(|name| self.named("target", name, &targets));
        Ok(Gate {
            index: self.index,
            line,
            subject,
            metric,
            precision,
            domain,
            limit,
            measured: raw.measured.map(Spanned::into_inner),
            warn: raw.warn.map(Spanned::into_inner),
            shipped: raw.shipped.map(Spanned::into_inner),
            relative_to: raw.relative_to.map(Spanned::into_inner),
            target: target.transpose()?,
            why,
        })
    }

    fn filled(&self, key: &str, text: Spanned<String>) -> Result<String, GateFileError> {
        self.ensure(!text.get_ref().trim().is_empty(), key, &text, "is empty")?;
        Ok(text.into_inner())
    }

    fn named<N: AsRef<str>, T: Copy>(
        &self,
        key: &str,
        name: &Spanned<String>,
        known: &[(N, T)],
    ) -> Result<T, GateFileError> {
        let found = known.iter().find(|(known, _)| known.as_ref() == name.get_ref());
        found.map(|(_, value)| *value).ok_or_else(|| {
            let names: Vec<&str> = known.iter().map(|(name, _)| name.as_ref()).collect();
            let mut message = format!("expected {}, got `{}`", names.join(" | "), name.get_ref());
            if key == "metric" {
                message += "; the limit is the largest value that passes, of chi2_p the smallest";
            }
            self.wrong(key, name, message)
        })
    }

    fn ensure<T>(
        &self,
        good: bool,
        key: &str,
        at: &Spanned<T>,
        message: impl Into<String>,
    ) -> Result<(), GateFileError> {
        if good { Ok(()) } else { Err(self.wrong(key, at, message)) }
    }

    fn wrong<T>(&self, key: &str, at: &Spanned<T>, message: impl Into<String>) -> GateFileError {
        GateFileError::Syntax {
            file: self.file.to_owned(),
            line: line_at(self.text, at.span().start),
            place: format!("gate {}, key {key}", self.index),
            message: message.into(),
        }
    }
}

fn line_at(text: &str, byte: usize) -> usize {
    1 + text.bytes().take(byte).filter(|byte| *byte == b'\n').count()
}

/// `gate 3, key limit` for a place in the text: the headers before it, and the key on its line.
fn place_at(text: &str, byte: usize) -> String {
    let line = line_at(text, byte);
    let lines = || text.lines().take(line);
    let headers = lines().filter(|line| line.trim_start().starts_with("[[gate]]")).count();
    let key = lines().last().and_then(|line| line.split_once('=')).map(|(key, _)| key.trim());
    match (headers, key) {
        (0, _) => "before the first gate".to_owned(),
        (gate, None) => format!("gate {gate}"),
        (gate, Some(key)) => format!("gate {gate}, key {key}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "[[gate]]\nsubject = \"sine_integral/published\"\nmetric = \"max_abs\"\n\
        domain = \"x = -10:10\"\nlimit = 0.05105\nwarn = 0.0510\nwhy = \"velinov2018 eq. 29\"\n";

    #[test]
    fn a_good_file_reads() {
        let gates = parse("gates.toml", GOOD).expect("good");
        assert_eq!(gates.len(), 1);
        assert_eq!((gates[0].index, gates[0].line), (1, 2));
        assert_eq!(gates[0].precision, Precision::F32);
    }

    #[test]
    fn an_empty_list_is_no_pass() {
        assert!(matches!(parse("g", ""), Err(GateFileError::Empty { .. })));
        assert!(matches!(parse("g", "gate = []"), Err(GateFileError::Empty { .. })));
    }

    #[test]
    fn errors_name_gate_and_key() {
        let cases = [
            ("limit = 0.05105", "limit = nan", "gate 2, key limit"),
            ("limit = 0.05105", "limit = 0.0", "gate 2, key limit"),
            ("limit = 0.05105", "limit = \"a\"", "gate 2, key limit"),
            ("limit = 0.05105", "limt = 1.0", "gate 2, key limt"),
            ("limit = 0.05105\n", "", "gate 2"),
            ("warn = 0.0510", "warn = 1.0", "gate 2, key warn"),
            ("warn = 0.0510", "measured = 1.0", "gate 2, key measured"),
            ("\"max_abs\"", "\"max\"", "gate 2, key metric"),
            ("\"max_abs\"", "\"drift\"", "gate 2, key domain"),
            ("\"max_abs\"", "\"cost\"", "gate 2, key metric"),
            ("limit =", "target = \"rdna2\"\nlimit =", "gate 2, key target"),
            ("\"velinov2018 eq. 29\"", "\" \"", "gate 2, key why"),
            ("x = -10:10", "x = 10:10", "gate 2, key domain"),
        ];
        for (from, to, place) in cases {
            let text = format!("{GOOD}{}", GOOD.replace(from, to));
            let error = parse("gates.toml", &text).expect_err(to).to_string();
            assert!(error.starts_with("gates.toml:"), "{error}");
            assert!(error.contains(place), "{to}: {error}");
        }
    }
}
