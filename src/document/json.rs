//! The report as JSON: the whole model, keys in the order of its fields.
//!
//! Numbers are the shortest that read back exactly; what is not finite is `null` with a reason
//! beside it. A list of numbers stands on one line, everything else is indented, so that a diff
//! shows what moved.

use serde::Serialize;
use serde_json::Value;

use super::{Page, Provenance};

/// The report: `schema`, `provenance`, `pages`.
///
/// # Errors
/// [`serde_json::Error`] if the model cannot be written as JSON, which no finite model provokes.
pub fn report(pages: &[Page], provenance: &Provenance) -> Result<String, serde_json::Error> {
    #[derive(Serialize)]
    struct Report<'a> {
        schema: u32,
        provenance: &'a Provenance,
        pages: &'a [Page],
    }
    let value = serde_json::to_value(Report { schema: 1, provenance, pages })?;
    let mut out = String::new();
    write(&value, 0, &mut out);
    out.push('\n');
    Ok(out)
}

fn write(value: &Value, depth: usize, out: &mut String) {
    match value {
        Value::Array(items) if items.iter().any(|i| i.is_object() || i.is_array()) => {
            enclosed(('[', ']'), items.iter(), depth, out, |item, out| {
                write(item, depth + 1, out);
            });
        }
        Value::Object(fields) if depth > 0 && fields.len() <= 2 && fields.values().all(scalar) => {
            out.push_str(&value.to_string());
        }
        Value::Object(fields) if !fields.is_empty() => {
            enclosed(('{', '}'), fields.iter(), depth, out, |(key, field), out| {
                out.push_str(&Value::from(key.as_str()).to_string());
                out.push_str(": ");
                write(field, depth + 1, out);
            });
        }
        other => out.push_str(&other.to_string()),
    }
}

fn scalar(value: &Value) -> bool {
    !value.is_object() && !value.is_array()
}

/// Items between brackets, one per line.
fn enclosed<T>(
    (open, close): (char, char),
    items: impl Iterator<Item = T>,
    depth: usize,
    out: &mut String,
    mut one: impl FnMut(T, &mut String),
) {
    out.push(open);
    for (index, item) in items.enumerate() {
        out.push_str(if index == 0 { "\n" } else { ",\n" });
        out.push_str(&"  ".repeat(depth + 1));
        one(item, out);
    }
    out.push('\n');
    out.push_str(&"  ".repeat(depth));
    out.push(close);
}
