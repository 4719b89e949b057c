//! What toisoul2017 says of its renderings, beside what a rendered scene shows.

use crate::effect::Finding;
use crate::numeric::measured::Measured;

use super::rendered::{RenderedSurface, SurfaceApproximation};
use super::scene::{Factors, Method, SurfaceScene};

/// Frames per second of table 1 by the object that a scene is named after.
const TABLE_ONE: [(&str, &str); 4] = [
    ("phone", "56 and 59 frames per second, composition, kernel 256 (HTC 8X, LG G3)"),
    ("holographic", "50 frames per second, composition, kernel 256"),
    ("tv", "88 frames per second, sum, kernel 256"),
    ("cd", "100 frames per second, 1D, kernel 512"),
];
/// Fig. 5: frames per second at ranks 1, 3, 10 and 21 (§5.3; the caption says 11 in place of 10).
const FIGURE_FIVE: &str = "60, 30, 10 and 5 frames per second at ranks 1, 3, 10 and 21 (§5.3; fig. 5 \
                           says 11), and the rendering does not improve much";
/// A mean FLIP below which two pictures are taken to look alike.
const ALIKE: f64 = 0.02;

/// The claims of table 1 and fig. 5, and of alg. 1, as far as the scene shows them.
pub fn findings(scene: &SurfaceScene, rendered: &RenderedSurface) -> Vec<Finding> {
    let command = format!("striae render data/scenes/{}.toml", scene.name);
    let mut findings = Vec::new();
    let known = TABLE_ONE.iter().find(|(name, _)| scene.name.starts_with(name));
    if let Some((_, printed)) = known {
        findings.push(Finding {
            place: format!("toisoul2017 table 1 ({})", scene.name),
            printed: (*printed).into(),
            found: times(rendered),
            verdict: match &rendered.times {
                Measured::Value(times) => format!("another device: {}", times.device),
                Measured::NotMeasured(reason) => format!("not measured: {reason}"),
            },
            command: command.clone(),
        });
    }
    let ranks: Vec<(&SurfaceApproximation, usize)> = rendered
        .approximations
        .iter()
        .filter_map(|found| match found.method {
            Method::TwoPass { rank, factors: Factors::Svd } | Method::Reconstructed { rank } => {
                Some((found, rank))
            }
            _ => None,
        })
        .collect();
    if let (Some((one, 1)), Some((last, most))) = (ranks.first(), ranks.last()) {
        findings.push(Finding {
            place: format!("toisoul2017 §5.3 and fig. 5 ({})", scene.name),
            printed: format!(
                "{FIGURE_FIVE}, since artefacts are blurred out when convolving with the environment"
            ),
            found: ranks.iter().map(|(found, rank)| by_rank(found, *rank)).collect::<Vec<_>>().join("; "),
            verdict: verdict(one.metrics.flip, last.metrics.flip, *most),
            command: command.clone(),
        });
    }
    let printed = rendered.approximations.iter().filter_map(|found| match found.method {
        Method::Printed { rank } => Some((found, rank)),
        _ => None,
    });
    for (found, rank) in printed {
        let right = ranks.iter().find(|(_, other)| *other == rank);
        findings.push(Finding {
            place: format!("toisoul2017 eq. 10, 11 and alg. 1 ({})", scene.name),
            printed: "each of the two passes sums over the terms".into(),
            found: format!(
                "at rank {rank} relative RMS {:.3} as printed{}",
                found.metrics.relative_rms,
                right.map_or(String::new(), |(right, _)| format!(
                    ", {:.3} with one pair of passes per term",
                    right.metrics.relative_rms
                ))
            ),
            verdict: "does not hold: the product of two sums has rank 1 whatever their terms"
                .into(),
            command: command.clone(),
        });
    }
    findings
}

fn by_rank(found: &SurfaceApproximation, rank: usize) -> String {
    let ms = found.ms.value().map_or(String::new(), |ms| format!(", {ms:.1} ms"));
    let metrics = &found.metrics;
    format!("rank {rank}: relative RMS {:.3}, FLIP {:.4}{ms}", metrics.relative_rms, metrics.flip)
}

fn verdict(one: f64, last: f64, most: usize) -> String {
    if !(one.is_finite() && last.is_finite()) {
        return "not measured".into();
    }
    if one < ALIKE {
        format!("holds here: rank 1 is within a mean FLIP of {one:.4} of the whole table")
    } else {
        format!("does not hold here: mean FLIP {one:.4} at rank 1, {last:.4} at rank {most}")
    }
}

fn times(rendered: &RenderedSurface) -> String {
    let full = match &rendered.times {
        Measured::Value(times) => times.full_ms.value().copied(),
        Measured::NotMeasured(_) => None,
    };
    let one = |found: &SurfaceApproximation| {
        let ms = found.ms.value()?;
        let ratio =
            full.map_or(String::new(), |full| format!(", whole table {:.0} times", full / ms));
        Some(format!("{} ({}): {ms:.2} ms a frame{ratio}", found.name, found.method.words()))
    };
    let lines: Vec<String> = rendered.approximations.iter().filter_map(one).collect();
    if lines.is_empty() { "no times".into() } else { lines.join("; ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_the_numbers() {
        assert!(verdict(0.01, 0.001, 10).starts_with("holds here"));
        assert!(verdict(0.1, 0.001, 10).starts_with("does not hold here"));
        assert_eq!(verdict(f64::NAN, 0.0, 10), "not measured");
    }
}
