//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod area_light;
pub mod diffraction;
pub mod footprint;
pub mod fresnel;
pub mod scratch_response;
pub mod sine_integral;

/// Every form of every effect, as registered.
#[cfg(test)]
fn registered() -> crate::effect::FormLibrary {
    let all: [&crate::effect::Effect; 6] = [
        &sine_integral::EFFECT,
        &fresnel::EFFECT,
        &scratch_response::EFFECT,
        &footprint::EFFECT,
        &area_light::EFFECT,
        &diffraction::EFFECT,
    ];
    crate::effect::FormLibrary::new(&all).expect("the texts of the forms")
}

/// The forms of `effect` whose text gives every constant a value, with those values.
#[cfg(test)]
fn written(effect: &crate::effect::Effect) -> crate::effect::Candidates {
    let forms = registered();
    let written = forms.of(effect.name).filter_map(|form| form.written().ok());
    written.map(std::sync::Arc::new).collect()
}

/// What is found of every claim of `effect`, with the constants of the texts.
#[cfg(test)]
fn found(effect: &crate::effect::Effect) -> Vec<String> {
    let findings = crate::effect::claim::check(effect.claims, &written(effect));
    println!("{findings:#?}");
    assert!(findings.iter().all(|finding| finding.verdict != "not evaluated"));
    let found: Vec<String> = findings.into_iter().map(|finding| finding.found).collect();
    assert!(found.iter().all(|found| !found.contains("NaN")));
    found
}

/// Laws hold for what is `exact`, and find forms that break them or have no values.
#[cfg(test)]
fn assert_laws_bite<'a>(
    laws: impl Iterator<Item = &'a crate::effect::Law>,
    exact: crate::effect::FormValues<'_>,
    broken: crate::effect::FormValues<'_>,
) {
    for law in laws {
        let violation = (law.violation)(exact);
        assert!(violation <= law.tolerance, "{}: {violation:e}", law.name);
        let forms: [crate::effect::FormValues<'_>; 3] =
            [broken, &|_| vec![f32::NAN], &|_| Vec::new()];
        for form in forms {
            assert!((law.violation)(form) > law.tolerance, "{}", law.name);
        }
    }
}

/// Holds every form of `effect`, with the constants of its text, to the list of laws: a known violation
/// that has gone is a fault too.
#[cfg(test)]
fn assert_laws_are_known(effect: &crate::effect::Effect) {
    let mut faults = Vec::new();
    for entry in registered().of(effect.name) {
        let candidate = entry.written().expect("a form with its constants");
        let reference = entry.reference.as_deref().expect("a reference");
        for law in effect.laws {
            if !law.references.is_empty() && !law.references.contains(&reference) {
                continue;
            }
            let violation = (law.violation)(&|points| candidate.values_for_laws(points));
            let known = law.known_violations.iter().any(|(name, _)| *name == entry.name);
            println!("{}: {} {violation:.3e} (known: {known})", entry.name, law.name);
            if (violation <= law.tolerance) == known {
                faults.push(format!("{}: {} {violation:e}, known: {known}", entry.name, law.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use crate::document::plot::Scale;
    use crate::document::{Block, Page, Value};
    use crate::effect::Effect;

    #[test]
    fn exhibits_are_complete() {
        // With the constants of the texts: how many figures each effect shows.
        let figures: [(&Effect, usize); 6] = [
            (&super::sine_integral::EFFECT, 0),
            (&super::fresnel::EFFECT, 0),
            (&super::scratch_response::EFFECT, 10),
            (&super::footprint::EFFECT, 7),
            (&super::area_light::EFFECT, 5),
            (&super::diffraction::EFFECT, 6),
        ];
        figures.par_iter().for_each(|(effect, count)| {
            let candidates = super::written(effect);
            let mut page = Page::new(effect.name, effect.title, effect.description);
            page.sections = (effect.exhibits)(&candidates).expect("exhibits");
            let figures: Vec<_> = page.figures().collect();
            assert_eq!(figures.len(), *count, "{}", effect.name);
            for plot in figures.iter().flat_map(|figure| &figure.plots) {
                for series in &plot.series {
                    let drawn = |y: f64| y.is_finite() && (plot.y.scale != Scale::Log || y > 0.0);
                    let complete = series.points.iter().all(|(x, y)| x.is_finite() && drawn(*y));
                    assert!(
                        complete && !series.points.is_empty(),
                        "{} {}",
                        plot.title,
                        series.name
                    );
                }
            }
            for block in page.sections.iter().flat_map(|section| &section.blocks) {
                let Block::Table(table) = block else { continue };
                for cell in table.rows().iter().flatten() {
                    let complete = match &cell.value {
                        Value::Number { value, .. } => value.is_finite(),
                        value => matches!(value, Value::Text(_)),
                    };
                    assert!(complete, "{:?}: {cell:?}", table.caption);
                }
            }
        });
    }
}
