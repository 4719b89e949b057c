//! Sections of a TOML file, read key by key: whatever is wrong is named by file, line and key, with
//! what was expected.

use std::collections::BTreeMap;
use std::rc::Rc;

use toml::Value;
use toml::de::{DeTable, DeValue};

use super::error::RenderError;

/// A file and the lines of its keys.
#[derive(Debug)]
struct Lines {
    path: String,
    /// Line, from 1, of every key by its path, as in `light[0].radius`.
    of: BTreeMap<String, usize>,
}

/// A table of the file from which keys are taken, one by one; what is left in the end is unknown.
#[derive(Debug)]
pub(super) struct Section {
    lines: Rc<Lines>,
    /// Path of the table, empty at the top.
    place: String,
    left: toml::Table,
    asked: Vec<&'static str>,
}

/// What stands under a key, and what is said if it is needed and missing.
#[derive(Debug)]
pub(super) struct Entry<T> {
    /// The value, if it is there.
    pub(super) value: Option<T>,
    missing: RenderError,
}

impl<T> Entry<T> {
    /// The value, which must be there.
    pub(super) fn needed(self) -> Result<T, RenderError> {
        self.value.ok_or(self.missing)
    }

    /// The value, or `default`.
    pub(super) fn or(self, default: T) -> T {
        self.value.unwrap_or(default)
    }
}

impl Section {
    /// The top of the file `path` with the text `text`.
    pub(super) fn parse(path: &str, text: &str) -> Result<Self, RenderError> {
        let syntax = |error: toml::de::Error| RenderError::Toml {
            path: path.to_owned(),
            report: error.to_string().trim_end().to_owned(),
        };
        let spans = DeTable::parse(text).map_err(syntax)?;
        let mut of = BTreeMap::new();
        add_lines(text, "", spans.get_ref(), &mut of);
        let left = toml::from_str(text).map_err(syntax)?;
        let lines = Rc::new(Lines { path: path.to_owned(), of });
        Ok(Self { lines, place: String::new(), left, asked: Vec::new() })
    }

    /// `key` with the path of the section before it.
    fn full(&self, key: &str) -> String {
        match self.place.as_str() {
            "" => key.to_owned(),
            place => format!("{place}.{key}"),
        }
    }

    /// That `key` is wrong, and how; an empty key is the section itself.
    pub(super) fn wrong(&self, key: &str, what: impl Into<String>) -> RenderError {
        let key = if key.is_empty() { self.place.clone() } else { self.full(key) };
        let parent = key.rsplit_once('.').map_or("", |(parent, _)| parent);
        let line = self.lines.of.get(&key).or_else(|| self.lines.of.get(parent));
        let path = match line {
            Some(line) => format!("{}:{line}", self.lines.path),
            None => self.lines.path.clone(),
        };
        RenderError::Value { path, key, what: what.into() }
    }

    fn expected(&self, key: &str, what: &str, got: &Value) -> RenderError {
        let got = match got {
            Value::String(text) => format!("the string \"{text}\""),
            Value::Integer(number) => number.to_string(),
            Value::Float(number) => number.to_string(),
            Value::Boolean(flag) => flag.to_string(),
            Value::Array(list) => format!("an array of {}", list.len()),
            Value::Table(_) => "a table".to_owned(),
            Value::Datetime(_) => "a date".to_owned(),
        };
        self.wrong(key, format!("expected {what}, got {got}"))
    }

    /// Whether `key` is there and not taken yet.
    pub(super) fn has(&self, key: &str) -> bool {
        self.left.contains_key(key)
    }

    /// Whether keys are left.
    pub(super) fn is_left(&self) -> bool {
        !self.left.is_empty()
    }

    fn take<T>(
        &mut self,
        key: &'static str,
        what: &str,
        read: impl FnOnce(&Value) -> Option<T>,
    ) -> Result<Entry<T>, RenderError> {
        self.asked.push(key);
        let missing = self.wrong(key, "is needed here and missing");
        let Some(value) = self.left.remove(key) else { return Ok(Entry { value: None, missing }) };
        let read = read(&value).ok_or_else(|| self.expected(key, what, &value))?;
        Ok(Entry { value: Some(read), missing })
    }

    /// A number in [from, to]; a NaN lies in none.
    pub(super) fn number(
        &mut self,
        key: &'static str,
        [from, to]: [f64; 2],
    ) -> Result<Entry<f64>, RenderError> {
        let what = format!("a number in [{from}, {to}]");
        self.take(key, &what, |value| number(value).filter(|x| (from..=to).contains(x)))
    }

    /// `N` numbers in [from, to].
    pub(super) fn numbers<const N: usize>(
        &mut self,
        key: &'static str,
        [from, to]: [f64; 2],
    ) -> Result<Entry<[f64; N]>, RenderError> {
        let whole = self.take(key, &format!("{N} numbers in [{from}, {to}]"), |value| {
            let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
            <[f64; N]>::try_from(numbers?).ok()
        })?;
        if let Some(bad) = whole.value.iter().flatten().find(|x| !(from..=to).contains(*x)) {
            return Err(self.wrong(key, format!("expected numbers in [{from}, {to}], got {bad}")));
        }
        Ok(whole)
    }

    /// A list of points in space, any numbers.
    pub(super) fn points(
        &mut self,
        key: &'static str,
    ) -> Result<Entry<Vec<[f64; 3]>>, RenderError> {
        self.take(key, "an array of points, three numbers each", |value| {
            let point = |value: &Value| {
                let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
                <[f64; 3]>::try_from(numbers?).ok()
            };
            value.as_array()?.iter().map(point).collect()
        })
    }

    /// One number or three in [from, to], as three.
    pub(super) fn colour(
        &mut self,
        key: &'static str,
        range: [f64; 2],
    ) -> Result<Entry<[f64; 3]>, RenderError> {
        match self.left.get(key) {
            Some(Value::Array(list)) if list.len() != 3 => {
                Err(self.wrong(key, "expected one number or three (R, G, B)"))
            }
            Some(Value::Array(_)) => self.numbers(key, range),
            _ => {
                let Entry { value, missing } = self.number(key, range)?;
                Ok(Entry { value: value.map(|one| [one; 3]), missing })
            }
        }
    }

    /// A whole number in [from, to].
    pub(super) fn count(
        &mut self,
        key: &'static str,
        [from, to]: [u64; 2],
    ) -> Result<Entry<u64>, RenderError> {
        self.take(key, &format!("a whole number in [{from}, {to}]"), |value| {
            let count = u64::try_from(value.as_integer()?).ok()?;
            (from..=to).contains(&count).then_some(count)
        })
    }

    /// Text.
    pub(super) fn text(&mut self, key: &'static str) -> Result<Entry<String>, RenderError> {
        self.take(key, "text in quotes", |value| value.as_str().map(str::to_owned))
    }

    /// Texts.
    pub(super) fn texts(&mut self, key: &'static str) -> Result<Entry<Vec<String>>, RenderError> {
        self.take(key, "texts in quotes, in brackets", |value| {
            let texts = value.as_array()?.iter();
            texts.map(|text| text.as_str().map(str::to_owned)).collect()
        })
    }

    /// `true` or `false`.
    pub(super) fn flag(&mut self, key: &'static str) -> Result<Entry<bool>, RenderError> {
        self.take(key, "true or false", Value::as_bool)
    }

    /// One of some names, and what it stands for.
    pub(super) fn named<T: Copy>(
        &mut self,
        key: &'static str,
        names: &[(&str, T)],
    ) -> Result<Entry<T>, RenderError> {
        let list: Vec<String> = names.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let known = match list.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => list.join(""),
        };
        self.take(key, &known, |value| {
            let got = value.as_str()?;
            names.iter().find(|(name, _)| *name == got).map(|(_, meaning)| *meaning)
        })
    }

    /// The table called `key`.
    pub(super) fn section(&mut self, key: &'static str) -> Result<Entry<Self>, RenderError> {
        let what = format!("a table [{}]", self.full(key));
        let table = self.take(key, &what, |value| value.as_table().cloned())?;
        let value = table.value.map(|left| self.below(self.full(key), left));
        Ok(Entry { value, missing: table.missing })
    }

    /// The tables of the array called `key`, none without it.
    pub(super) fn sections(&mut self, key: &'static str) -> Result<Vec<Self>, RenderError> {
        let tables = self.take(key, &format!("tables [[{key}]]"), |value| {
            value
                .as_array()?
                .iter()
                .map(|table| table.as_table().cloned())
                .collect::<Option<Vec<_>>>()
        })?;
        let numbered = tables.or(Vec::new()).into_iter().enumerate();
        Ok(numbered
            .map(|(at, left)| self.below(format!("{}[{at}]", self.full(key)), left))
            .collect())
    }

    fn below(&self, place: String, left: toml::Table) -> Self {
        Self { lines: Rc::clone(&self.lines), place, left, asked: Vec::new() }
    }

    /// The tables in it by name, whatever their names are.
    pub(super) fn by_name(&mut self) -> Result<Vec<(String, Self)>, RenderError> {
        let entries = std::mem::take(&mut self.left).into_iter();
        entries
            .map(|(name, value)| match value {
                Value::Table(left) => Ok((name.clone(), self.below(self.full(&name), left))),
                other => {
                    Err(self.expected(&name, &format!("a table [{}]", self.full(&name)), &other))
                }
            })
            .collect()
    }

    /// What is left as text, `key` and value, whatever the keys are.
    pub(super) fn settings(&mut self) -> Result<Vec<(String, String)>, RenderError> {
        let entries = std::mem::take(&mut self.left).into_iter();
        entries
            .map(|(key, value)| {
                let text = match &value {
                    Value::String(text) => text.clone(),
                    Value::Integer(number) => number.to_string(),
                    Value::Float(number) => number.to_string(),
                    Value::Boolean(flag) => flag.to_string(),
                    other => {
                        let what = "text, a number or a truth value";
                        return Err(self.expected(&key, what, other));
                    }
                };
                Ok((key, text))
            })
            .collect()
    }

    /// What is left as names, one or several each, by key.
    pub(super) fn names(&mut self) -> Result<BTreeMap<String, Vec<String>>, RenderError> {
        let entries = std::mem::take(&mut self.left).into_iter();
        entries
            .map(|(key, value)| {
                let list = match &value {
                    Value::Array(list) => list.clone(),
                    one => vec![one.clone()],
                };
                let names = list.iter().map(|name| name.as_str().map(str::to_owned)).collect();
                let expected = || self.expected(&key, "a name, or an array of names", &value);
                Ok((key.clone(), Option::<Vec<String>>::ok_or_else(names, expected)?))
            })
            .collect()
    }

    /// That no more than `keys` is left, so that a stray key is named before the one whose place it
    /// has taken. `elsewhere`: keys that mean something, but not beside `kind`.
    pub(super) fn only(
        &self,
        keys: &[&str],
        elsewhere: &[&str],
        kind: &str,
    ) -> Result<(), RenderError> {
        let mut left = self.left.keys().map(String::as_str);
        let Some(key) = left.find(|key| !keys.contains(key)) else { return Ok(()) };
        if elsewhere.contains(&key) {
            return Err(self.wrong(key, format!("means nothing with {kind}")));
        }
        let known: Vec<&str> = self.asked.iter().chain(keys).copied().collect();
        let known = known.join(", ");
        Err(self.wrong(key, format!("unknown field `{key}`; there are: {known}")))
    }

    /// That nothing is left, as [`Self::only`] says it.
    pub(super) fn done(self, elsewhere: &[&str], kind: &str) -> Result<(), RenderError> {
        self.only(&[], elsewhere, kind)
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|number| number as f64))
}

/// Adds the lines of the keys of `table`, which stands at `place`.
fn add_lines(text: &str, place: &str, table: &DeTable<'_>, lines: &mut BTreeMap<String, usize>) {
    for (key, value) in table {
        let name = key.get_ref();
        let path = if place.is_empty() { name.to_string() } else { format!("{place}.{name}") };
        lines.insert(path.clone(), line_at(text, key.span().start));
        match value.get_ref() {
            DeValue::Table(table) => add_lines(text, &path, table, lines),
            DeValue::Array(list) => {
                for (at, entry) in list.iter().enumerate() {
                    if let DeValue::Table(table) = entry.get_ref() {
                        let path = format!("{path}[{at}]");
                        lines.insert(path.clone(), line_at(text, entry.span().start));
                        add_lines(text, &path, table, lines);
                    }
                }
            }
            _ => {}
        }
    }
}

/// Line of a byte, from 1.
fn line_at(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|byte| *byte == b'\n').count() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a = 1\n[view]\nwidth = \"wide\"\nheight = 3\n\n[[light]]\nradius = 1\n\
                        [[light]]\nradius = true\nmap = 3\n";

    fn said<T: std::fmt::Debug>(result: Result<T, RenderError>) -> String {
        result.map_or_else(|error| error.to_string(), |value| format!("{value:?}"))
    }

    #[test]
    fn what_is_wrong_is_named_by_line_and_key() {
        let mut top = Section::parse("s.toml", TEXT).expect("it is TOML");
        let mut view = top.section("view").and_then(Entry::needed).expect("a table");
        assert_eq!(
            said(view.count("width", [1, 9])),
            "s.toml:3: view.width: expected a whole number in [1, 9], got the string \"wide\""
        );
        assert_eq!(
            said(view.done(&["height"], "kind = \"x\"")),
            "s.toml:4: view.height: means nothing with kind = \"x\""
        );
        let mut lights = top.sections("light").expect("tables");
        assert_eq!(
            said(lights[1].number("radius", [0.0, 2.0])),
            "s.toml:9: light[1].radius: expected a number in [0, 2], got true"
        );
        assert_eq!(
            said(lights[0].number("size", [0.0, 1.0]).and_then(Entry::needed)),
            "s.toml:6: light[0].size: is needed here and missing"
        );
        assert_eq!(
            said(lights.remove(1).done(&[], "")),
            "s.toml:10: light[1].map: unknown field `map`; there are: radius"
        );
        assert_eq!(said(top.section("a")), "s.toml:1: a: expected a table [a], got 1");
    }
}
