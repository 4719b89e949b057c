//! What papers say of pictures, beside what a rendered scene shows. A scene names its claims and the
//! approximations that they are about; the checks are here.

use super::error::RenderError;
use super::rendered::{Rendered, RenderedApproximation};
use super::scene::{Scene, SceneClaim};
use super::section::Section;
use crate::effect::{ClaimError, Finding, Found};
use crate::numeric::measured::Measured;

/// The speed-up that velinov2018 claims.
const CLAIMED_RATIO: f64 = 1000.0;
/// Share of the squared error from which on Si is its cause.
const MOST: f64 = 0.5;
/// A mean FLIP below which two pictures are taken to look alike.
const ALIKE: f64 = 0.02;

/// What can be checked on a scene.
#[derive(Debug)]
pub struct SceneCheck {
    /// Its name in scenes.
    pub name: &'static str,
    /// Keys under which a scene names the approximations that it looks at; one that may be left out
    /// ends in `?`.
    keys: &'static [&'static str],
    /// Where it is printed and what, unless the scene says it.
    place: &'static str,
    printed: &'static str,
    check: fn(&SceneEvidence<'_>) -> Result<Found, ClaimError>,
}

/// The checks.
///
/// | check | what is checked |
/// |---|---|
/// | `si_error` | that most of the error of `published_si` is gone with `exact_si`, which differs in Si alone; `published` is shown beside them |
/// | `speed_up` | how much longer Monte Carlo takes for the error of `published` |
/// | `frame_rate` | ms a frame beside a printed frame rate |
/// | `rank` | that the first of `ranks`, of rank 1, looks like the reference |
/// | `white_sky` | that the reference is 1 wherever a surface that only redistributes is seen |
/// | `printed_loop` | that `literal`, alg. 1 read literally, errs, beside `passes` of the same rank |
pub static CHECKS: [SceneCheck; 6] = [
    SceneCheck {
        name: "si_error",
        keys: &["published_si", "exact_si", "published?"],
        place: "velinov2018 figs. 8 and 9, §3.4.1",
        printed: "apart from minor discrepancies due to the approximation of Si, the closed form \
                  closely matches the ground truth",
        check: si_error,
    },
    SceneCheck {
        name: "speed_up",
        keys: &["published"],
        place: "velinov2018 abstract and §6",
        printed: "a speed-up of at least three orders of magnitude over Monte Carlo",
        check: speed_up,
    },
    SceneCheck { name: "frame_rate", keys: &[], place: "", printed: "", check: frame_rate },
    SceneCheck {
        name: "rank",
        keys: &["ranks"],
        place: "toisoul2017 §5.3 and fig. 5",
        printed: "60, 30, 10 and 5 frames per second at ranks 1, 3, 10 and 21 (§5.3; fig. 5 says 11), \
                  and the rendering does not improve much, since artefacts are blurred out when \
                  convolving with the environment",
        check: rank,
    },
    SceneCheck {
        name: "white_sky",
        keys: &[],
        place: "toisoul2017 eq. 3",
        printed: "F² G/w² S_d L_i dω_i with one table S_d, whose G makes cos²θ of a mirror",
        check: white_sky,
    },
    SceneCheck {
        name: "printed_loop",
        keys: &["literal", "passes?"],
        place: "toisoul2017 eq. 10, 11 and alg. 1",
        printed: "each of the two passes sums over the terms",
        check: printed_loop,
    },
];

/// A rendered scene, and the claim that is checked on it.
#[derive(Debug)]
struct SceneEvidence<'a> {
    rendered: &'a Rendered,
    claim: &'a SceneClaim,
}

impl<'a> SceneEvidence<'a> {
    /// The approximations under a key, in the order in which the scene names them.
    fn all(&self, key: &str) -> Vec<&'a RenderedApproximation> {
        let names = self.claim.of.get(key).into_iter().flatten();
        let all = &self.rendered.approximations;
        names.filter_map(|name| all.iter().find(|found| found.name == *name)).collect()
    }

    fn one(&self, key: &str) -> Result<&'a RenderedApproximation, ClaimError> {
        let missing = || format!("the scene names no approximation under `{key}`");
        self.all(key).first().copied().ok_or_else(|| ClaimError::new(missing()))
    }
}

/// Reads the claims of a scene with approximations of these names.
pub(super) fn read(top: &mut Section, names: &[&str]) -> Result<Vec<SceneClaim>, RenderError> {
    top.sections("claim")?.into_iter().map(|section| claim(section, names)).collect()
}

fn claim(mut section: Section, names: &[&str]) -> Result<SceneClaim, RenderError> {
    let checks = CHECKS.each_ref().map(|check| (check.name, check));
    let check = section.named("check", &checks)?.needed()?;
    let place = section.text("place")?.value;
    let printed = section.text("printed")?.value;
    let of = section.names()?;
    let is_missing = |what: &Option<String>| check.place.is_empty() && what.is_none();
    let said = [("place", is_missing(&place)), ("printed", is_missing(&printed))];
    let needed = check.keys.iter().filter(|key| !key.ends_with('?'));
    let named = needed.map(|key| (*key, of.get(*key).is_none_or(Vec::is_empty)));
    if let Some((key, _)) = said.into_iter().chain(named).find(|(_, is_missing)| *is_missing) {
        return Err(section.wrong(key, "is needed here and missing"));
    }
    for (key, of) in &of {
        if !check.keys.iter().any(|known| known.trim_end_matches('?') == key) {
            let known = check.keys.join(", ");
            let what = format!("unknown field `{key}`; of this check there are: {known}");
            return Err(section.wrong(key, what));
        }
        if let Some(stray) = of.iter().find(|name| !names.contains(&name.as_str())) {
            return Err(section.wrong(key, format!("there is no approximation `{stray}`")));
        }
    }
    Ok(SceneClaim { check: check.name, place, printed, of })
}

/// The claims that `scene` names, with what was found.
pub fn findings(scene: &Scene, rendered: &Rendered) -> Vec<Finding> {
    let command = format!("striae render data/scenes/{}.toml", scene.name);
    let of = |claim: &SceneClaim| {
        let own = CHECKS.iter().find(|own| own.name == claim.check)?;
        let place = claim.place.as_deref().unwrap_or(own.place);
        let printed = claim.printed.as_deref().unwrap_or(own.printed);
        let found = (own.check)(&SceneEvidence { rendered, claim });
        Some(Finding::of(format!("{place} ({})", scene.name), printed, command.as_str(), found))
    };
    scene.claims.iter().filter_map(of).collect()
}

fn si_error(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let (with_si, exact) = (of.one("published_si")?, of.one("exact_si")?);
    let mut shown = of.all("published");
    shown.retain(|published| published.name != with_si.name);
    shown.extend([with_si, exact]);
    let figures = |a: &RenderedApproximation| {
        let (rms, flip) = (a.metrics.relative_rms, a.metrics.flip);
        format!("{} ({}): relative RMS {rms:.3e}, mean FLIP {flip:.3e}", a.name, a.method.words())
    };
    let found = shown.into_iter().map(figures).collect::<Vec<_>>().join("; ");
    Ok(Found::new(found, share_verdict([with_si, exact].map(|a| a.metrics.relative_rms))))
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

fn speed_up(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let published = of.one("published")?;
    let verdict = match &published.equal_error {
        Measured::Value(equal) if equal.ratio.is_finite() && equal.samples.is_finite() => {
            speed_words(equal.ratio, equal.samples, published.metrics.relative_rms)
        }
        Measured::Value(_) => "not measured".into(),
        Measured::NotMeasured(reason) => format!("not measured: {reason}"),
    };
    Ok(Found::new(speeds(of.rendered), verdict))
}

fn speed_words(ratio: f64, samples: f64, relative_rms: f64) -> String {
    let holds = if ratio >= CLAIMED_RATIO { "holds" } else { "does not hold" };
    let few = if samples < 1.0 { ", extrapolated to less than one sample" } else { "" };
    format!("{holds}: {} times at a relative RMS of {relative_rms:.2e}{few}", short(ratio))
}

fn short(value: f64) -> String {
    if value >= 100.0 { format!("{value:.0}") } else { format!("{value:.2}") }
}

fn speeds(rendered: &Rendered) -> String {
    let part = |a: &RenderedApproximation| {
        let equal = a.equal_error.value()?;
        let (times, samples) = (short(equal.ratio), short(equal.samples));
        Some(format!("{} {times} times at {samples} samples per pixel", a.name))
    };
    let parts: Vec<String> = rendered.approximations.iter().filter_map(part).collect();
    if parts.is_empty() {
        return format!("no times on {}", rendered.backend);
    }
    format!(
        "in this scene, of ours, Monte Carlo at equal RMS error takes {}, on {}",
        parts.join("; "),
        rendered.backend
    )
}

fn frame_rate(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let one = |found: &RenderedApproximation| {
        let ms = found.frame_ms.value()?;
        let ratio = found.full_over.value();
        let ratio = ratio.map_or(String::new(), |ratio| format!(", whole table {ratio:.0} times"));
        Some(format!("{} ({}): {ms:.2} ms a frame{ratio}", found.name, found.method.words()))
    };
    let lines: Vec<String> = of.rendered.approximations.iter().filter_map(one).collect();
    let found = if lines.is_empty() { "no times".into() } else { lines.join("; ") };
    let verdict = match &of.rendered.times {
        Measured::Value(times) => format!("another device: {}", times.device),
        Measured::NotMeasured(reason) => format!("not measured: {reason}"),
    };
    Ok(Found::new(found, verdict))
}

fn white_sky(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let values = of.rendered.reference.channels.iter().flat_map(|channel| &channel.values);
    // Nothing is met where it is exactly 0.
    let seen = values.filter(|value| **value != 0.0);
    let (low, high) =
        seen.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
    let found = format!("the reference, which conserves, lies between {low:.6} and {high:.6}");
    let conserves = low > 1.0 - 1e-3 && high < 1.0 + 1e-3;
    Ok(Found::new(found, if conserves { "differs: all comes back" } else { "does not hold" }))
}

fn rank(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let ranks = of.all("ranks");
    let ([first, ..], [.., last]) = (ranks.as_slice(), ranks.as_slice()) else {
        return Err(ClaimError::new("the scene names no approximations under `ranks`"));
    };
    let by_rank = |found: &&RenderedApproximation| {
        let ms = found.frame_ms.value().map_or(String::new(), |ms| format!(", {ms:.1} ms"));
        let (rms, flip) = (found.metrics.relative_rms, found.metrics.flip);
        format!("rank {}: relative RMS {rms:.3}, FLIP {flip:.4}{ms}", terms(found))
    };
    let found = ranks.iter().map(by_rank).collect::<Vec<_>>().join("; ");
    let errors = [first, last].map(|found| found.metrics.flip);
    Ok(Found::new(found, rank_verdict(errors, [terms(first), terms(last)])))
}

fn terms(found: &RenderedApproximation) -> usize {
    found.method.rank().unwrap_or(1)
}

/// From the mean FLIP of two ranks.
fn rank_verdict([one, last]: [f64; 2], [rank, most]: [usize; 2]) -> String {
    if !(one.is_finite() && last.is_finite()) {
        return "not measured".into();
    }
    if one < ALIKE {
        format!("holds here: rank {rank} is within a mean FLIP of {one:.4} of the whole table")
    } else {
        format!("does not hold here: mean FLIP {one:.4} at rank {rank}, {last:.4} at rank {most}")
    }
}

fn printed_loop(of: &SceneEvidence<'_>) -> Result<Found, ClaimError> {
    let literal = of.one("literal")?;
    let beside = of.all("passes").first().map_or(String::new(), |passes| {
        format!(", {:.3} with one pair of passes per term", passes.metrics.relative_rms)
    });
    let (rank, rms) = (terms(literal), literal.metrics.relative_rms);
    Ok(Found::new(
        format!("at rank {rank} relative RMS {rms:.3} as printed{beside}"),
        "does not hold: the product of two sums has rank 1 whatever their terms",
    ))
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
        assert!(rank_verdict([0.01, 0.001], [1, 10]).starts_with("holds here"));
        assert!(rank_verdict([0.1, 0.001], [1, 10]).starts_with("does not hold here"));
        assert_eq!(rank_verdict([f64::NAN, 0.0], [1, 10]), "not measured");
    }
}
