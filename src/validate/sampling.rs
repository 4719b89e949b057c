//! Points at which forms are judged: never the fitted ones, always with the edges among them.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::table::{Column, Table};

/// A box in the space of a form's arguments, as written in a gate: `x = -10:10; mu = 0:1`.
#[derive(Debug, Clone, PartialEq)]
pub struct ArgumentBox {
    /// One interval per argument, in the order written.
    pub intervals: Vec<Interval>,
}

/// A closed interval of one argument.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// Name of the argument.
    pub argument: String,
    /// Lower end.
    pub from: f64,
    /// Upper end, above `from`.
    pub to: f64,
}

/// Why a domain's text is not one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "domain `{text}`: expected `name = from:to` with finite from < to, `;` between arguments; {found}"
)]
pub struct DomainSyntax {
    text: String,
    found: String,
}

impl ArgumentBox {
    /// Parses `name = from:to; name = from:to`.
    ///
    /// # Errors
    /// [`DomainSyntax`] for anything else, an argument named twice, or ends that are not finite
    /// and increasing.
    pub fn parse(text: &str) -> Result<Self, DomainSyntax> {
        let fault = |found: String| DomainSyntax { text: text.to_owned(), found };
        let mut intervals: Vec<Interval> = Vec::new();
        for part in text.split(';') {
            let (argument, range) = part
                .split_once('=')
                .ok_or_else(|| fault(format!("`{}` has no `=`", part.trim())))?;
            let (from, to) = range
                .split_once(':')
                .ok_or_else(|| fault(format!("`{}` has no `:`", range.trim())))?;
            let end = |word: &str| {
                let number = word.trim().parse().ok().filter(|value: &f64| value.is_finite());
                number.ok_or_else(|| fault(format!("`{}` is not a finite number", word.trim())))
            };
            let (argument, from, to) = (argument.trim().to_owned(), end(from)?, end(to)?);
            if argument.is_empty() {
                return Err(fault("an argument has no name".into()));
            }
            if from >= to {
                return Err(fault(format!("{from} is not below {to}")));
            }
            if intervals.iter().any(|interval| interval.argument == argument) {
                return Err(fault(format!("`{argument}` stands there twice")));
            }
            intervals.push(Interval { argument, from, to });
        }
        Ok(Self { intervals })
    }
}

/// Cells of the offset grid in one dimension: a prime, so that cell centres do not fall on the
/// round numbers of which fitted grids are made.
const CELLS: usize = 8191;
/// Seeded random points beside the grid.
const RANDOM_POINTS: usize = 4096;
/// Seed of the judged points: another one than any fit uses.
const SEED: u64 = 0x005e_ed0f_9a7e;

/// Points that cover `domain`: cell centres of an offset grid (one argument) or seeded random
/// points (several), the ends or corners with their f32 neighbours inside, and `hard_cases` that
/// fall into the domain. Every coordinate is an f32 number, so that a form in f32 and a reference
/// in f64 see the same point.
///
/// The columns come in the order of `domain`; `hard_cases` needs a column of each name to add any.
pub fn points(domain: &ArgumentBox, hard_cases: &[Table]) -> Table {
    let intervals = &domain.intervals;
    let dimensions = intervals.len();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for corner in 0..1_usize << dimensions.min(12) {
        let upper = |axis: usize| corner >> axis & 1 == 1;
        let end = |(axis, of): (usize, &Interval)| if upper(axis) { of.to } else { of.from };
        rows.push(intervals.iter().enumerate().map(end).collect());
    }
    if let [Interval { from, to, .. }] = intervals[..] {
        let width = (to - from) / CELLS as f64;
        rows.extend((0..CELLS).map(|cell| vec![from + (cell as f64 + 0.5) * width]));
        rows.push(vec![f64::from((from as f32).next_up())]);
        rows.push(vec![f64::from((to as f32).next_down())]);
    }
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let draws = if dimensions == 1 { RANDOM_POINTS } else { CELLS + RANDOM_POINTS };
    for _ in 0..draws {
        rows.push(intervals.iter().map(|of| random.random_range(of.from..=of.to)).collect());
    }
    rows.extend(hard_cases.iter().flat_map(|table| rows_inside(table, domain)));
    let column = |(axis, of): (usize, &Interval)| {
        Column::new(&of.argument, "1", rows.iter().map(|row| inside(row[axis], of)).collect())
    };
    Table {
        columns: intervals.iter().enumerate().map(column).collect(),
        origin: "validation points".into(),
    }
}

/// The f32 number nearest to `value` that lies inside the interval.
fn inside(value: f64, interval: &Interval) -> f64 {
    let nearest = value as f32;
    let held = if f64::from(nearest) < interval.from {
        nearest.next_up()
    } else if f64::from(nearest) > interval.to {
        nearest.next_down()
    } else {
        nearest
    };
    f64::from(held)
}

fn rows_inside(table: &Table, domain: &ArgumentBox) -> Vec<Vec<f64>> {
    let column = |of: &Interval| Some(&table.column(&of.argument)?.values);
    let Some(columns) = domain.intervals.iter().map(column).collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let inside = |row: &Vec<f64>| {
        row.iter().zip(&domain.intervals).all(|(value, of)| (of.from..=of.to).contains(value))
    };
    let rows = (0..table.rows()).map(|row| columns.iter().map(|column| column[row]).collect());
    rows.filter(inside).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_domain_reads_back() {
        let domain = ArgumentBox::parse("x = -10:10; mu = 0:1").expect("well formed");
        assert_eq!(domain.intervals.len(), 2);
        assert_eq!(domain.intervals[1], Interval { argument: "mu".into(), from: 0.0, to: 1.0 });
    }

    #[test]
    fn malformed_domains_are_refused() {
        for text in
            ["", "x", "x = 1", "x = 1:1", "x = 2:1", "x = a:b", "x = 0:inf", "= 0:1", "x=0:1;x=0:2"]
        {
            assert!(ArgumentBox::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn points_stay_inside_and_are_f32_numbers() {
        let domain = ArgumentBox::parse("x = 0.1:0.7").expect("well formed");
        let table = points(&domain, &[]);
        assert!(table.rows() > CELLS);
        for value in &table.columns[0].values {
            assert!((0.1..=0.7).contains(value), "{value}");
            assert_eq!(f64::from(*value as f32), *value);
        }
    }

    #[test]
    fn hard_cases_outside_the_domain_are_left_out() {
        let hard =
            Table { columns: vec![Column::new("x", "1", vec![0.25, 5.0])], origin: String::new() };
        let domain = ArgumentBox::parse("x = 0:1").expect("well formed");
        let with = points(&domain, std::slice::from_ref(&hard));
        assert_eq!(with.rows(), points(&domain, &[]).rows() + 1);
        assert_eq!(with.columns[0].values.last(), Some(&0.25));
    }
}
