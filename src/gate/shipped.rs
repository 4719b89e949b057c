//! Constants as they stand in a file that ships: WGSL, GLSL, HLSL or MSL text.

use std::collections::BTreeMap;

use super::Reached;
use super::evidence::Found;
use crate::effect::Candidate;
use crate::numeric::ulp::ulp_distance_f32;

/// The constants of one file: name to every f32 that it is initialised with.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ShippedConstants {
    file: String,
    values: BTreeMap<String, Vec<f32>>,
}

impl ShippedConstants {
    /// Reads `override a: f32 = 0.5;`, `const a = -0.5f;`, `const float a = 0.5;`,
    /// `static const float a = 0.5f;` and `#define a 0.5`, comments left out. A name initialised
    /// with anything but a decimal number is not seen, and is then reported as missing.
    pub(super) fn read(file: &str, text: &str) -> Self {
        let mut values: BTreeMap<String, Vec<f32>> = BTreeMap::new();
        for line in without_comments(text).split([';', '\n', '{', '}', ',']) {
            if let Some((name, value)) = define(line).or_else(|| initialised(line)) {
                values.entry(name).or_default().push(value);
            }
        }
        Self { file: file.to_owned(), values }
    }

    /// The one value of `name`; or that there is none, or that there are several that differ.
    fn value(&self, name: &str) -> Found<f32> {
        let file = &self.file;
        let Some((first, others)) = self.values.get(name).and_then(|all| all.split_first()) else {
            let known: Vec<&str> = self.values.keys().map(String::as_str).collect();
            let known = known.join(", ");
            return Err(format!("{file}: no `{name} = <number>`; the constants there: {known}"));
        };
        match others.iter().find(|other| other.to_bits() != first.to_bits()) {
            None => Ok(*first),
            Some(other) => Err(format!("{file}: `{name}` has several values: {first} and {other}")),
        }
    }

    /// The largest distance over all constants of `candidate`, in ulp of f32; or why it cannot be
    /// told.
    pub(super) fn drift(&self, candidate: &Candidate) -> Found<Reached> {
        let mut farthest = Reached { value: 0.0, at: BTreeMap::new(), of: None, count: 0 };
        for (parameter, fitted) in candidate.form.parameters().iter().zip(&candidate.constants_f32)
        {
            let name = &parameter.name;
            let there = self.value(name)?;
            let distance = f64::from(ulp_distance_f32(there, *fitted));
            farthest.count += 1;
            if farthest.of.is_none() || distance > farthest.value {
                farthest.value = distance;
                farthest.of = Some(format!("{name} = {there} there, {fitted} fitted"));
            }
        }
        if farthest.count == 0 { Err("the fit has no constants".to_owned()) } else { Ok(farthest) }
    }
}

/// The text with `//` and `/* */` comments replaced by spaces.
fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut kept = String::with_capacity(text.len());
    while let Some(at) = rest.find('/') {
        let (before, comment) = rest.split_at(at);
        kept.push_str(before);
        let end = if comment.starts_with("//") {
            comment.find('\n').unwrap_or(comment.len())
        } else if comment.starts_with("/*") {
            comment.find("*/").map_or(comment.len(), |end| end + 2)
        } else {
            kept.push('/');
            1
        };
        if end > 1 {
            kept.push(' ');
        }
        rest = comment.split_at(end).1;
    }
    kept.push_str(rest);
    kept
}

/// `#define NAME number`.
fn define(line: &str) -> Option<(String, f32)> {
    let mut words = line.trim().strip_prefix("#define")?.split_whitespace();
    let (name, value) = (words.next()?, words.next()?);
    words.next().is_none().then_some(())?;
    Some((name.to_owned(), number(value.trim_matches(['(', ')']))?))
}

/// `… NAME = number` or `… NAME: type = number`.
fn initialised(line: &str) -> Option<(String, f32)> {
    let (declared, value) = line.split_once('=')?;
    let declared = declared.split(':').next()?.trim();
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let start = declared.rfind(|c| !is_name(c)).map_or(0, |at| at + 1);
    let name = declared.get(start..).filter(|name| !name.is_empty())?;
    Some((name.to_owned(), number(value)?))
}

/// A decimal literal with an optional sign and suffix.
fn number(text: &str) -> Option<f32> {
    let text = text.trim().trim_end_matches(['f', 'F', 'h', 'H']);
    let plausible = text.bytes().any(|byte| byte.is_ascii_digit())
        && text.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
    plausible.then(|| text.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_of_every_language_are_seen() {
        let text = "override a: f32 = 0.5; // a = 3.0\nconst b = -2.5e-1f;\n\
            const float c = 1.25, d = .5f; /* c = 2.0; */\nstatic const float e = 3.0F;\n\
            #define g 0.75f\nlet h = a * 2.0; if (a == 1.0) { }";
        let shipped = ShippedConstants::read("s", text);
        for (name, value) in
            [("a", 0.5), ("b", -0.25), ("c", 1.25), ("d", 0.5), ("e", 3.0), ("g", 0.75)]
        {
            assert_eq!(shipped.value(name), Ok(value), "{name}");
        }
        let missing = shipped.value("h").expect_err("it is no number");
        assert!(missing.starts_with("s: no `h = <number>`"), "{missing}");
    }

    #[test]
    fn a_constant_with_two_values_is_refused() {
        let shipped = ShippedConstants::read("s", "const a = 1.0;\nconst a = 2.0;");
        assert_eq!(shipped.value("a"), Err("s: `a` has several values: 1 and 2".to_owned()));
    }

    #[test]
    fn an_unended_comment_hides_the_rest() {
        let shipped = ShippedConstants::read("s", "const a = 1.0; /* const b = 2.0;");
        assert_eq!(shipped.value("a"), Ok(1.0));
        assert!(shipped.value("b").is_err());
    }
}
