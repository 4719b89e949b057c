//! What the paper says of its lobes, beside what a rendered scene shows.

use crate::effect::Finding;
use crate::numeric::measured::Measured;

use super::rendered::{RenderedApproximation, RenderedScene};
use super::scene::Scene;

/// The speed-up that velinov2018 claims.
const CLAIMED_RATIO: f64 = 1000.0;
/// Share of the squared error from which on Si is its cause.
const MOST: f64 = 0.5;

/// The claims about figs. 8 and 9, for a scene with approximations called `published_si` (or
/// `published`, if that differs from `exact_si` in Si alone) and `exact_si`, and about speed, for
/// one called `published`.
pub fn findings(scene: &Scene, rendered: &RenderedScene) -> Vec<Finding> {
    let of = |name: &str| rendered.approximations.iter().find(|a| a.name == name);
    let command = format!("striae render data/scenes/{}.toml", scene.name);
    let mut findings = Vec::new();
    if let (Some(with_si), Some(exact)) =
        (of("published_si").or_else(|| of("published")), of("exact_si"))
    {
        let errors = [with_si, exact].map(|a| a.metrics.relative_rms);
        findings.push(Finding {
            place: format!("velinov2018 figs. 8 and 9, §3.4.1 ({})", scene.name),
            printed: "apart from minor discrepancies due to the approximation of Si, the closed \
                      form closely matches the ground truth"
                .into(),
            found: [of("published").filter(|a| a.name != with_si.name), Some(with_si), Some(exact)]
                .into_iter()
                .flatten()
                .map(figures)
                .collect::<Vec<_>>()
                .join("; "),
            verdict: share_verdict(errors),
            command: command.clone(),
        });
    }
    if let Some(published) = of("published") {
        findings.push(Finding {
            place: format!("velinov2018 abstract and §6 ({})", scene.name),
            printed: "a speed-up of at least three orders of magnitude over Monte Carlo".into(),
            found: speeds(rendered),
            verdict: speed_verdict(published),
            command,
        });
    }
    findings
}

fn figures(a: &RenderedApproximation) -> String {
    let (rms, flip) = (a.metrics.relative_rms, a.metrics.flip);
    format!("{} ({}): relative RMS {rms:.3e}, mean FLIP {flip:.3e}", a.name, a.shaded_by.join(", "))
}

/// From the relative RMS errors with the published Si and with an exact one.
fn share_verdict([with_si, exact]: [f64; 2]) -> String {
    if !(with_si.is_finite() && with_si > 0.0 && exact.is_finite()) {
        return "not measured".into();
    }
    let removed = 1.0 - (exact / with_si) * (exact / with_si);
    let size = format!("relative RMS {with_si:.2e}, {exact:.2e} with an exact Si");
    if removed > MOST {
        format!("holds: {:.0} % of the squared error is that of Si; {size}", 100.0 * removed)
    } else if removed > 0.0 {
        format!("differs: only {:.0} % of the squared error is that of Si; {size}", 100.0 * removed)
    } else {
        format!("differs: an exact Si removes none of the error; {size}")
    }
}

fn speed_verdict(published: &RenderedApproximation) -> String {
    match &published.equal_error {
        Measured::Value(equal) if equal.ratio.is_finite() && equal.samples.is_finite() => {
            speed_words(equal.ratio, equal.samples, published.metrics.relative_rms)
        }
        Measured::Value(_) => "not measured".into(),
        Measured::NotMeasured(reason) => format!("not measured: {reason}"),
    }
}

fn speed_words(ratio: f64, samples: f64, relative_rms: f64) -> String {
    let holds = if ratio >= CLAIMED_RATIO { "holds" } else { "does not hold" };
    let few = if samples < 1.0 { ", extrapolated to less than one sample" } else { "" };
    format!("{holds}: {} times at a relative RMS of {relative_rms:.2e}{few}", short(ratio))
}

fn short(value: f64) -> String {
    if value >= 100.0 { format!("{value:.0}") } else { format!("{value:.2}") }
}

fn speeds(rendered: &RenderedScene) -> String {
    let part = |a: &RenderedApproximation| {
        let equal = a.equal_error.value()?;
        Some(format!(
            "{} {} times at {} samples per pixel",
            a.name,
            short(equal.ratio),
            short(equal.samples)
        ))
    };
    let parts: Vec<String> = rendered.approximations.iter().filter_map(part).collect();
    if parts.is_empty() {
        return format!("no times on {}", rendered.backend);
    }
    format!("Monte Carlo at equal RMS error takes {}, on {}", parts.join("; "), rendered.backend)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_the_numbers() {
        assert!(share_verdict([0.1, 0.05]).starts_with("holds: 75 %"));
        assert!(share_verdict([0.1, 0.09]).starts_with("differs: only 19 %"));
        assert!(share_verdict([0.1, 0.2]).starts_with("differs: an exact Si removes none"));
        for errors in [[0.0, 0.0], [f64::NAN, 0.1], [0.1, f64::NAN], [f64::INFINITY, 0.1]] {
            assert_eq!(share_verdict(errors), "not measured");
        }
        assert!(speed_words(2000.0, 50.0, 0.1).starts_with("holds: 2000 times"));
        assert!(speed_words(20.0, 0.5, 0.1).starts_with("does not hold: 20.00 times"));
        assert!(speed_words(20.0, 0.5, 0.1).ends_with("less than one sample"));
    }
}
