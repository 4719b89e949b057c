//! Error per side lobe and per half lobe, as printed and by the forms of striae.

use super::lobe_errors::{Part, relative_errors};
use super::{LARGE, LEAN, MEDIUM, PRINTED, PRINTED_LARGE};
use crate::document::plot::{Axis, Plot, Series};
use crate::document::{Figure, Section, Table};
use crate::effect::{Candidates, ClaimError};

/// Orders in the tables.
const ORDERS: [u32; 8] = [0, 1, 2, 5, 10, 20, 100, 1000];
/// Candidates shown, and how they are called.
const SHOWN: [(&str, &str); 5] = [
    (PRINTED, "as printed"),
    (PRINTED_LARGE, "eq. 27, exact Si"),
    (LEAN, "lean"),
    (MEDIUM, "medium"),
    (LARGE, "large"),
];

/// What the band integral shows beyond its fits.
pub(crate) fn exhibits(candidates: &Candidates) -> Result<Vec<Section>, ClaimError> {
    let figure = |stem, title, part| figure(candidates, stem, title, part);
    let table = |caption, part| table(candidates, caption, part);
    let section = Section::new("Energy of side lobes")
        .paragraph(
            "Relative error of the energy of the lobe kWq in [2 pi n, 2 pi (n + 1)], of its first half and of \
             its second, in f32 with bounds rounded to f32, against the reference at the same bounds.",
        )
        .paragraph(
            "Eq. 29 takes light from every side lobe. With Si exact to f32 eq. 27 still subtracts two values \
             near pi, and its error grows as the square of n. The forms of striae subtract nothing within a \
             period.",
        )
        .block(figure("band-lobes", "Whole lobes", Part::Whole)?)
        .block(figure("band-half-lobes", "First halves of lobes", Part::FirstHalf)?)
        .block(table("Whole lobes: relative error", Part::Whole)?)
        .block(table("First halves of lobes: relative error", Part::FirstHalf)?)
        .block(table("Second halves of lobes: relative error", Part::SecondHalf)?);
    Ok(vec![section])
}

fn figure(
    candidates: &Candidates,
    stem: &str,
    title: &str,
    part: Part,
) -> Result<Figure, ClaimError> {
    // A logarithmic axis has no place for n = 0: it is in the tables.
    let orders: Vec<u32> = (1..=1000).collect();
    let (x, y) = (Axis::log("order n of the lobe", "1"), Axis::log("|relative error|", "1"));
    let mut plot = Plot::new(title, x, y);
    for (name, shown) in SHOWN {
        let errors = relative_errors(candidates.get(name)?, part, &orders)?;
        // An error of exactly 0 has no logarithm; half an ulp of f32 stands for it.
        let drawn = errors.into_iter().map(|error| error.abs().max(3e-8));
        let points = orders.iter().map(|&n| f64::from(n)).zip(drawn);
        plot = plot.series(match shown {
            "as printed" => Series::line(shown, points).strong(),
            "eq. 27, exact Si" => Series::dashed(shown, points),
            _ => Series::line(shown, points),
        });
    }
    let caption = "Magnitude of the relative error against the order of the lobe.";
    Ok(Figure::new(stem, caption, plot))
}

fn table(candidates: &Candidates, caption: &str, part: Part) -> Result<Table, ClaimError> {
    let columns = [("n", "1")].into_iter().chain(SHOWN.map(|(_, shown)| (shown, "1")));
    let mut rows: Vec<_> = ORDERS.iter().map(|&n| vec![f64::from(n).into()]).collect();
    for (name, _) in SHOWN {
        let errors = relative_errors(candidates.get(name)?, part, &ORDERS)?;
        rows.iter_mut().zip(errors).for_each(|(row, error)| row.push(error.into()));
    }
    Ok(Table::of_rows(caption, columns, rows))
}
