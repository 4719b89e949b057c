//! Effects: one physical thing each, with its reference, its forms, its hard cases and its laws.

pub mod area_light;
pub mod diffraction;
pub mod footprint;
pub mod fresnel;
pub mod scratch_response;
pub mod sine_integral;

/// The forms of `effect` whose text gives every constant a value, with those values.
#[cfg(test)]
fn written(effect: &crate::effect::Effect) -> crate::effect::Candidates {
    use std::sync::Arc;

    use crate::effect::FormLibrary;

    let all = [
        &sine_integral::EFFECT,
        &fresnel::EFFECT,
        &scratch_response::EFFECT,
        &footprint::EFFECT,
        &area_light::EFFECT,
        &diffraction::EFFECT,
    ];
    let forms = FormLibrary::new(&all).expect("the texts of the forms");
    forms.of(effect.name).filter_map(|form| form.written().ok().map(Arc::new)).collect()
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use crate::document::plot::Scale;
    use crate::document::{Block, Page, Value};
    use crate::effect::Effect;

    /// With the constants of the texts: how many figures each effect shows.
    const FIGURES: [(&Effect, usize); 6] = [
        (&super::sine_integral::EFFECT, 0),
        (&super::fresnel::EFFECT, 0),
        (&super::scratch_response::EFFECT, 10),
        (&super::footprint::EFFECT, 7),
        (&super::area_light::EFFECT, 5),
        (&super::diffraction::EFFECT, 6),
    ];

    #[test]
    fn exhibits_are_complete() {
        FIGURES.par_iter().for_each(|(effect, count)| {
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
