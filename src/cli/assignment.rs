//! `name=value` and `name=lower:upper` on the command line.

/// Reads `a=1`.
pub(super) fn number(text: &str) -> Result<(String, f64), String> {
    let (name, value) = split(text, "name=value")?;
    Ok((name, finite(value)?))
}

/// A name with a lower and an upper bound, either of which may be missing.
pub(super) type Bounds = (String, Option<f64>, Option<f64>);

/// Reads `a=0:10`, `a=0:` or `a=:10`.
pub(super) fn bounds(text: &str) -> Result<Bounds, String> {
    let expected = "name=lower:upper";
    let (name, value) = split(text, expected)?;
    let (lower, upper) =
        value.split_once(':').ok_or_else(|| format!("expected {expected}, got `{text}`"))?;
    let end = |text: &str| -> Result<Option<f64>, String> {
        if text.trim().is_empty() { Ok(None) } else { finite(text).map(Some) }
    };
    Ok((name, end(lower)?, end(upper)?))
}

fn split<'a>(text: &'a str, expected: &str) -> Result<(String, &'a str), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value)),
        _ => Err(format!("expected {expected}, got `{text}`")),
    }
}

fn finite(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| format!("expected a finite number, got `{}`", text.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments_read() {
        assert_eq!(number(" a = -1e-3"), Ok(("a".to_owned(), -1e-3)));
        assert_eq!(bounds("a=0:10"), Ok(("a".to_owned(), Some(0.0), Some(10.0))));
        assert_eq!(bounds("a=:10"), Ok(("a".to_owned(), None, Some(10.0))));
        for text in ["a", "=1", "a=", "a=nan", "a=inf", "a=1x"] {
            assert!(number(text).is_err(), "{text}");
        }
        assert!(bounds("a=1").is_err());
    }
}
