//! The lookup forms: entries made from the reference, written into `lookup.wgsl`.

use crate::effect::FormText;

use super::reference::sine_integral;

/// Largest |Si″|, with Si″ = cos x / x − sin x / x²: at x = 2.0816, where tan x = 2x / (2 − x²).
const CURVATURE: f64 = 0.4362;

/// Path of the text that the entries are written into.
const PATH: &str = "src/effects/sine_integral/lookup.wgsl";

/// The form `lookup_COUNT`: a table of `count` entries with linear interpolation and an asymptotic
/// tail.
///
/// The last abscissa U makes the two errors equal: h²/8·max|Si″| inside, h = U/(count − 1), and
/// 2/U³, the first term that the tail leaves out. So U⁵ = 16 (count − 1)² / max|Si″|, kept to one
/// decimal.
pub(super) fn text(count: usize) -> FormText {
    let steps = (count - 1) as f64;
    let last = ((16.0 * steps * steps / CURVATURE).powf(0.2) * 10.0).round() / 10.0;
    let step = last / steps;
    let entries: Vec<String> =
        (0..count).map(|i| format!("{:?}", sine_integral(i as f64 * step) as f32)).collect();
    let lines: Vec<String> =
        entries.chunks(8).map(|line| format!("    {},", line.join(", "))).collect();
    let text = include_str!("lookup.wgsl")
        .replace("{{ENTRIES}}", &lines.join("\n"))
        .replace("{{COUNT}}", &count.to_string())
        .replace("{{STEPS}}", &(count - 1).to_string())
        .replace("{{LAST_SEGMENT}}", &(count - 2).to_string())
        .replace("{{LAST}}", &format!("{last:?}"))
        .replace("{{CURVATURE}}", &CURVATURE.to_string())
        .replace("{{STEP_ERROR}}", &format!("{:.1e}", step * step / 8.0 * CURVATURE))
        .replace("{{TAIL_ERROR}}", &format!("{:.1e}", 2.0 / last.powi(3)));
    FormText { name: format!("lookup_{count}"), ..FormText::new(PATH, text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curvature_bounds_the_second_derivative() {
        let largest = (1..4000)
            .map(|i| f64::from(i) * 0.005)
            .map(|x| (x.cos() / x - x.sin() / (x * x)).abs())
            .fold(0.0, f64::max);
        assert!((largest - CURVATURE).abs() < 1e-4, "{largest}");
    }

    #[test]
    fn every_placeholder_is_filled() {
        let FormText { name, text, .. } = text(64);
        assert_eq!(name, "lookup_64");
        assert!(!text.contains("{{") && !text.contains("}}"));
        assert!(text.contains("const LAST: f32 = 10.8;"), "{text}");
    }
}
