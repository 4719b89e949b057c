//! The cells of a table: text, numbers, verdicts, and what was not measured.

use std::collections::BTreeMap;

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::inline::Inline;
use crate::numeric::measured::Measured;

/// One cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// What it says.
    pub value: Value,
    /// Whether it stands out: what the text is about.
    pub subject: bool,
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

/// How a check came out, from what needs no attention to what needs most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Measured, and within the limit.
    Pass,
    /// Within the limit, but close to it or otherwise worth a look.
    Warn,
    /// What it would take to measure it is not here (a device): neither passed nor failed.
    NotMeasured,
    /// Beyond the limit, or not measurable for a reason that has to be mended.
    Fail,
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
        Self { value, subject: false }
    }

    /// Words.
    pub fn text(text: impl Into<Inline>) -> Self {
        Self::new(Value::Text(text.into()))
    }

    /// A number shown with `digits` significant digits; 17 show the fewest that read back the same.
    #[must_use]
    pub fn number(value: f64, digits: usize) -> Self {
        Self::new(Value::Number { value, digits })
    }

    /// A constant in f32: the shortest decimal that reads back the same f32.
    #[must_use]
    pub fn single(value: f32) -> Self {
        Self::number(value.to_string().parse().unwrap_or_else(|_| f64::from(value)), 17)
    }

    /// A count, with all its digits.
    #[must_use]
    pub fn count(count: usize) -> Self {
        Self::number(count as f64, 17)
    }

    /// A measured number shown with `digits` significant digits, or why it was not measured.
    #[must_use]
    pub fn measured(value: &Measured<f64>, digits: usize) -> Self {
        match value {
            Measured::Value(value) => Self::number(*value, digits),
            Measured::NotMeasured(reason) => Self::missing(reason.as_str()),
        }
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

/// A number and its significant digits.
impl From<(f64, usize)> for Cell {
    fn from((value, digits): (f64, usize)) -> Self {
        Self::number(value, digits)
    }
}

/// A count, with all its digits.
impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::count(count)
    }
}

impl From<Verdict> for Cell {
    fn from(verdict: Verdict) -> Self {
        Self::verdict(verdict)
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
        if self.subject {
            map.serialize_entry("highlight", "subject")?;
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
///
/// Zeros at the end of a plain number stand only where digits were cut off behind them, so that
/// `0.05105`, a limit as it was set, stays as it is and 0.0509996 at four digits is `0.05100`. With
/// 17 digits or more it is the shortest decimal that reads back the same.
///
/// ```
/// use striae::document::number;
/// assert_eq!(number(0.0509996, 4), "0.05100");
/// assert_eq!(number(0.5, 4), "0.5");
/// assert_eq!(number(1.234567e-7, 3), "1.23e-7");
/// ```
#[must_use]
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return not_finite(value).to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = digits.clamp(1, 17) - 1;
    let rounded = if decimals < 16 { format!("{value:.decimals$e}") } else { format!("{value:e}") };
    let exponent = rounded.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    if !(-3..6).contains(&exponent) {
        return rounded;
    }
    let places = usize::try_from(i32::try_from(decimals).unwrap_or(16) - exponent).unwrap_or(0);
    let plain = if decimals < 16 { format!("{value:.places$}") } else { format!("{value}") };
    if plain.contains('.') && plain.parse() == Ok(value) {
        plain.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        plain
    }
}

/// A place by its coordinates, as in `x = 3.56, y = 1`, with `digits` significant digits.
#[must_use]
pub fn place(at: &BTreeMap<String, f64>, digits: usize) -> String {
    let coordinates = at.iter().map(|(name, value)| format!("{name} = {}", number(*value, digits)));
    coordinates.collect::<Vec<_>>().join(", ")
}
