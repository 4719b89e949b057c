//! Error per side lobe and per half lobe, as printed and by the forms of striae.

use super::lobe_errors::{Part, relative_errors};
use super::{LARGE, LEAN, MEDIUM, PRINTED, PRINTED_LARGE};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{Candidates, ClaimError, Exhibit};
use crate::effects::area_light::TEXTS;

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
    let shown = || SHOWN.map(|(_, shown)| (shown.to_owned(), "1".to_owned()));
    let section = Exhibit::of(TEXTS, "side_lobes", &[])
        .figure(curves(candidates, Part::Whole)?)
        .figure(curves(candidates, Part::FirstHalf)?)
        .wider_table(shown(), rows(candidates, Part::Whole)?)
        .wider_table(shown(), rows(candidates, Part::FirstHalf)?)
        .wider_table(shown(), rows(candidates, Part::SecondHalf)?)
        .section();
    Ok(vec![section])
}

fn curves(candidates: &Candidates, part: Part) -> Result<Vec<Series>, ClaimError> {
    // A logarithmic axis has no place for n = 0: it is in the tables.
    let orders: Vec<u32> = (1..=1000).collect();
    let curve = |(name, shown): (&str, &str)| {
        let errors = relative_errors(candidates.get(name)?, part, &orders)?;
        // An error of exactly 0 has no logarithm; half an ulp of f32 stands for it.
        let drawn = errors.into_iter().map(|error| error.abs().max(3e-8));
        let points = orders.iter().map(|&n| f64::from(n)).zip(drawn);
        Ok(match shown {
            "as printed" => Series::line(shown, points).strong(),
            "eq. 27, exact Si" => Series::dashed(shown, points),
            _ => Series::line(shown, points),
        })
    };
    SHOWN.into_iter().map(curve).collect()
}

fn rows(candidates: &Candidates, part: Part) -> Result<Vec<Vec<Cell>>, ClaimError> {
    let mut rows: Vec<_> = ORDERS.iter().map(|&n| vec![f64::from(n).into()]).collect();
    for (name, _) in SHOWN {
        let errors = relative_errors(candidates.get(name)?, part, &ORDERS)?;
        rows.iter_mut().zip(errors).for_each(|(row, error)| row.push(error.into()));
    }
    Ok(rows)
}
