//! The cells of a table: text, numbers, verdicts, and what was not measured.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::inline::Inline;

/// One cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// What it says.
    pub value: Value,
    /// Whether it stands out, and as what.
    pub highlight: Option<Highlight>,
}

/// What a cell says.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Words.
    Text(Inline),
    /// A number, shown with `digits` significant digits and kept whole in the JSON.
    Number {
        /// The number; if it is not finite the cell says so.
        value: f64,
        /// Significant digits shown, 1 to 17.
        digits: usize,
    },
    /// Not measured, with the reason.
    Missing {
        /// Why.
        reason: String,
    },
    /// A verdict, and what it is about if the word alone does not say it.
    Verdict {
        /// The verdict.
        verdict: Verdict,
        /// The word shown in place of the verdict's own, as in `holds`.
        label: Option<String>,
    },
    /// A link.
    Link {
        /// What is shown.
        text: String,
        /// Where it leads.
        href: String,
    },
}

/// Why a cell stands out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Highlight {
    /// The best of its column.
    Best,
    /// The worst of its column.
    Worst,
    /// The one that the text is about.
    Subject,
}

impl Highlight {
    /// One word, for class names and plain text.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Best => "best",
            Self::Worst => "worst",
            Self::Subject => "subject",
        }
    }
}

/// How something came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within its limit.
    Pass,
    /// Within its limit, but close.
    Warn,
    /// Beyond its limit.
    Fail,
    /// Nothing to judge.
    NotMeasured,
}

impl Verdict {
    /// In words.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warn",
            Self::Fail => "fail",
            Self::NotMeasured => "not measured",
        }
    }

    /// The word shown: `label` in place of the verdict's own, except that what was not measured
    /// always says so.
    #[must_use]
    pub fn shown(self, label: Option<&str>) -> String {
        match (self, label) {
            (Self::NotMeasured, Some(label)) if label != self.word() => {
                format!("{}: {label}", self.word())
            }
            (Self::NotMeasured, _) | (_, None) => self.word().to_owned(),
            (_, Some(label)) => label.to_owned(),
        }
    }
}

impl Cell {
    fn new(value: Value) -> Self {
        Self { value, highlight: None }
    }

    /// Words.
    pub fn text(text: impl Into<Inline>) -> Self {
        Self::new(Value::Text(text.into()))
    }

    /// A number shown with `digits` significant digits.
    #[must_use]
    pub fn number(value: f64, digits: usize) -> Self {
        Self::new(Value::Number { value, digits })
    }

    /// A number, or why there is none.
    pub fn number_or(value: Option<f64>, digits: usize, reason: impl Into<String>) -> Self {
        value.map_or_else(|| Self::missing(reason), |value| Self::number(value, digits))
    }

    /// Not measured, and why.
    pub fn missing(reason: impl Into<String>) -> Self {
        Self::new(Value::Missing { reason: reason.into() })
    }

    /// A verdict.
    #[must_use]
    pub fn verdict(verdict: Verdict) -> Self {
        Self::new(Value::Verdict { verdict, label: None })
    }

    /// A verdict with a word of its own, as in `holds` or `differs`.
    pub fn verdict_as(verdict: Verdict, label: impl Into<String>) -> Self {
        Self::new(Value::Verdict { verdict, label: Some(label.into()) })
    }

    /// A link.
    pub fn link(text: impl Into<String>, href: impl Into<String>) -> Self {
        Self::new(Value::Link { text: text.into(), href: href.into() })
    }

    /// The cell, standing out.
    #[must_use]
    pub fn highlighted(mut self, highlight: Highlight) -> Self {
        self.highlight = Some(highlight);
        self
    }

    /// The cell as plain text.
    #[must_use]
    pub fn to_plain(&self) -> String {
        match &self.value {
            Value::Text(text) => text.to_plain(),
            Value::Number { value, digits } => number(*value, *digits),
            Value::Missing { reason } => format!("not measured: {reason}"),
            Value::Verdict { verdict, label } => verdict.shown(label.as_deref()),
            Value::Link { text, href } if text == href => text.clone(),
            Value::Link { text, href } => format!("{text} ({href})"),
        }
    }
}

impl From<&str> for Cell {
    fn from(words: &str) -> Self {
        Self::text(words)
    }
}

impl From<String> for Cell {
    fn from(words: String) -> Self {
        Self::text(words)
    }
}

/// Three significant digits: what an error or an energy is worth.
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::number(value, 3)
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        match &self.value {
            Value::Text(text) => map.serialize_entry("text", text)?,
            Value::Number { value, .. } if value.is_finite() => {
                map.serialize_entry("number", value)?;
            }
            Value::Number { value, .. } => {
                map.serialize_entry("number", &None::<f64>)?;
                map.serialize_entry("reason", not_finite(*value))?;
            }
            Value::Missing { reason } => map.serialize_entry("not_measured", reason)?,
            Value::Verdict { verdict, label } => {
                map.serialize_entry("verdict", verdict)?;
                if let Some(label) = label {
                    map.serialize_entry("label", label)?;
                }
            }
            Value::Link { text, href } => {
                map.serialize_entry("text", text)?;
                map.serialize_entry("href", href)?;
            }
        }
        if let Some(highlight) = self.highlight {
            map.serialize_entry("highlight", &highlight)?;
        }
        map.end()
    }
}

/// What a number that is not finite is called.
#[must_use]
pub fn not_finite(value: f64) -> &'static str {
    if value.is_nan() {
        "not a number"
    } else if value > 0.0 {
        "+infinity"
    } else {
        "-infinity"
    }
}

/// `value` with `digits` significant digits: plain from 1e-3 to 1e6, with an exponent beyond.
#[must_use]
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return not_finite(value).to_owned();
    }
    let decimals = digits.clamp(1, 17) - 1;
    if value == 0.0 {
        return "0".to_owned();
    }
    let rounded = format!("{value:.decimals$e}");
    let exponent = rounded.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    if !(-3..6).contains(&exponent) {
        return rounded;
    }
    let places = usize::try_from(i32::try_from(decimals).unwrap_or(16) - exponent).unwrap_or(0);
    format!("{value:.places$}")
}
