//! How wide text is, without a font: an upper estimate, from the advance widths of DejaVu Sans,
//! the widest of the usual sans-serif faces.

/// Width of `text` at `size` pixels, in pixels, rounded up.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let ems: f64 = text.chars().map(em).sum();
    (ems * size).ceil()
}

/// Advance of a character as a fraction of the size.
fn em(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | 'I' => 0.34,
        't' | 'f' | 'r' | '-' | '(' | ')' | '[' | ']' | '/' | '·' => 0.41,
        'm' | 'M' | 'W' | '%' | '@' => 0.97,
        'w' | 'G' | 'O' | 'Q' | 'N' | 'H' | 'U' | 'D' | '+' | '=' | '<' | '>' | '−' | '≤' | '≥'
        | '×' | '±' | '→' | '~' => 0.84,
        'A'..='Z' => 0.69,
        '0'..='9' | 'a'..='z' => 0.64,
        c if c.is_ascii() => 0.66,
        _ => 1.0,
    }
}

/// `text`, cut with an ellipsis to fit `room` pixels.
pub(super) fn fitted(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut kept = String::new();
    for c in text.chars() {
        kept.push(c);
        if width(&kept, size) + size > room {
            kept.pop();
            break;
        }
    }
    kept.push('…');
    kept
}
