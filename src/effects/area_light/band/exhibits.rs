//! Error per side lobe and per half lobe, as printed and by the forms of striae.

use super::lobe_errors::{BandForm, Part};
use super::{LARGE, LEAN, MEDIUM, PRINTED, PRINTED_LARGE};
use crate::effect::FittedConstants;
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitError, ExhibitPlot, ExhibitSeries, ExhibitTable,
    Stroke,
};
use crate::form::FormError;

/// Orders in the tables.
const ORDERS: [u32; 8] = [0, 1, 2, 5, 10, 20, 100, 1000];
/// Forms shown, with how they are named and drawn.
const SHOWN: [(&str, &str, Stroke); 5] = [
    (PRINTED, "as printed", Stroke::Strong),
    (PRINTED_LARGE, "eq. 27, exact Si", Stroke::Dashed),
    (LEAN, "lean", Stroke::Line),
    (MEDIUM, "medium", Stroke::Line),
    (LARGE, "large", Stroke::Line),
];

/// What the band integral shows beyond its fits.
///
/// # Errors
/// If a registered form cannot be evaluated.
pub(crate) fn exhibits(fitted: &FittedConstants) -> Result<Vec<Exhibit>, ExhibitError> {
    let shown = || -> Result<Exhibit, FormError> {
        Ok(Exhibit {
            title: "Energy of side lobes".into(),
            text: vec![
                "Relative error of the energy of the lobe kWq in [2 pi n, 2 pi (n + 1)], of its first half and of \
                 its second, in f32 with bounds rounded to f32, against the reference at the same bounds."
                    .into(),
                "Eq. 29 takes light from every side lobe. With Si exact to f32 eq. 27 still subtracts two values \
                 near pi, and its error grows as the square of n. The forms of striae subtract nothing within a \
                 period."
                    .into(),
            ],
            plots: vec![
                plot("band-lobes", "Whole lobes", Part::Whole, fitted)?,
                plot("band-half-lobes", "First halves of lobes", Part::FirstHalf, fitted)?,
            ],
            tables: vec![
                table("Whole lobes: relative error", Part::Whole, fitted)?,
                table("First halves of lobes: relative error", Part::FirstHalf, fitted)?,
                table("Second halves of lobes: relative error", Part::SecondHalf, fitted)?,
            ],
        })
    };
    shown().map(|exhibit| vec![exhibit]).map_err(|error| ExhibitError(error.to_string()))
}

fn plot(
    stem: &'static str,
    title: &str,
    part: Part,
    fitted: &FittedConstants,
) -> Result<ExhibitPlot, FormError> {
    // A logarithmic axis has no place for n = 0: it is in the tables.
    let orders: Vec<u32> = (1..=1000).collect();
    let mut series = Vec::new();
    for (entry, name, stroke) in SHOWN {
        let errors = BandForm::load(entry, fitted)?.relative_errors(part, &orders)?;
        // An error of exactly 0 has no logarithm; half an ulp of f32 stands for it.
        let drawn = |error: f64| error.abs().max(3e-8);
        let points = orders.iter().zip(errors).map(|(&n, e)| (f64::from(n), drawn(e))).collect();
        series.push(ExhibitSeries { name: name.into(), points, stroke });
    }
    Ok(ExhibitPlot {
        stem,
        title: title.into(),
        caption: "Magnitude of the relative error against the order of the lobe.".into(),
        x: ExhibitAxis { label: "order n of the lobe", unit: "1", log: true },
        y: ExhibitAxis { label: "|relative error|", unit: "1", log: true },
        series,
    })
}

fn table(caption: &str, part: Part, fitted: &FittedConstants) -> Result<ExhibitTable, FormError> {
    let mut columns = vec![("n".to_owned(), "1")];
    let mut rows: Vec<Vec<ExhibitCell>> =
        ORDERS.iter().map(|&n| vec![ExhibitCell::Number(f64::from(n))]).collect();
    for (entry, name, _) in SHOWN {
        columns.push((name.to_owned(), "1"));
        let errors = BandForm::load(entry, fitted)?.relative_errors(part, &ORDERS)?;
        rows.iter_mut().zip(errors).for_each(|(row, e)| row.push(ExhibitCell::Number(e)));
    }
    Ok(ExhibitTable { caption: caption.into(), columns, rows })
}
