//! Quantities tabulated over the wavelength: linear between their nodes, and read from the blocks of a
//! refractiveindex.info record, in which wavelengths are µm.

use super::MeasuredError;

/// A quantity at increasing wavelengths, nm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tabulation {
    pub(super) wavelength_nm: Vec<f64>,
    pub(super) values: Vec<f64>,
}

impl Tabulation {
    pub(super) fn at(&self, wavelength_nm: f64) -> Option<f64> {
        linear(&self.wavelength_nm, &self.values, wavelength_nm)
    }
}

/// Reads the rows of a `tabulated …` block: `quantities` numbers after the wavelength in µm.
/// Returns one tabulation per quantity and the number of rows merged into another: rows are sorted
/// by wavelength, and those at one wavelength, which some records have, are averaged.
pub(super) fn parse(
    origin: &str,
    first_line: u64,
    text: &str,
    quantities: usize,
) -> Result<(Vec<Tabulation>, usize), MeasuredError> {
    let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
    for (line, row) in (first_line..).zip(text.lines()) {
        if row.trim().is_empty() {
            continue;
        }
        let fault =
            |reason: String| MeasuredError::Malformed { origin: origin.into(), line, reason };
        let cells: Vec<&str> = row.split_whitespace().collect();
        let [wavelength, values @ ..] = cells.as_slice() else { continue };
        if values.len() != quantities {
            let (expected, got) = (quantities + 1, cells.len());
            return Err(fault(format!("expected {expected} numbers in a row, got {got}")));
        }
        let wavelength_nm = micrometres_as_nm(wavelength).map_err(&fault)?;
        let values: Result<Vec<f64>, String> = values.iter().map(|cell| number(cell)).collect();
        rows.push((wavelength_nm, values.map_err(&fault)?));
    }
    if rows.is_empty() {
        let reason = "a tabulated block without rows".into();
        return Err(MeasuredError::Malformed { origin: origin.into(), line: first_line, reason });
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = rows.len();
    let mut tabulations =
        vec![Tabulation { wavelength_nm: Vec::new(), values: Vec::new() }; quantities];
    for group in rows.chunk_by(|a, b| a.0 == b.0) {
        for (i, tabulation) in tabulations.iter_mut().enumerate() {
            let sum: f64 = group.iter().filter_map(|(_, values)| values.get(i)).sum();
            tabulation.wavelength_nm.extend(group.first().map(|(wavelength, _)| wavelength));
            tabulation.values.push(sum / group.len() as f64);
        }
    }
    let kept = tabulations.first().map_or(0, |t| t.values.len());
    Ok((tabulations, count - kept))
}

/// A finite number.
pub(super) fn number(cell: &str) -> Result<f64, String> {
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(format!("expected a finite number, got {value}")),
        Err(_) => Err(format!("expected a number, got {cell:?}")),
    }
}

/// A positive wavelength written in µm, in nm: the decimal point moves before the text becomes
/// binary, so that `0.1879` is 187.9 and not 187.90000000000001.
pub(super) fn micrometres_as_nm(cell: &str) -> Result<f64, String> {
    let (mantissa, exponent) = cell.split_once(['e', 'E']).unwrap_or((cell, "0"));
    let shifted = exponent.parse::<i32>().ok().and_then(|e| e.checked_add(3));
    let wavelength = match shifted {
        Some(e) => number(&format!("{mantissa}e{e}")),
        None => Err(String::new()),
    };
    match wavelength {
        Ok(value) if value > 0.0 => Ok(value),
        _ => Err(format!("expected a positive wavelength in µm, got {cell:?}")),
    }
}

/// Value at `x` of the piecewise linear curve through (`xs`, `ys`).
///
/// `xs` increases; `xs` and `ys` have one length. Exact at the nodes. `None` outside the nodes, for
/// a NaN, and where there are no nodes.
pub(super) fn linear(xs: &[f64], ys: &[f64], x: f64) -> Option<f64> {
    let above = xs.partition_point(|node| *node < x);
    let (x1, y1) = (*xs.get(above)?, *ys.get(above)?);
    if x1 == x {
        return Some(y1);
    }
    let below = above.checked_sub(1)?;
    let (x0, y0) = (*xs.get(below)?, *ys.get(below)?);
    let t = (x - x0) / (x1 - x0);
    t.is_finite().then_some(y0 + t * (y1 - y0))
}

/// First and last of increasing wavelengths; NaN of none.
pub(super) fn ends(wavelengths_nm: &[f64]) -> (f64, f64) {
    let end = |wavelength: Option<&f64>| wavelength.copied().unwrap_or(f64::NAN);
    (end(wavelengths_nm.first()), end(wavelengths_nm.last()))
}

#[cfg(test)]
mod tests {
    use super::linear;

    #[test]
    fn is_exact_at_nodes_and_none_outside() {
        let (xs, ys) = ([1.0, 2.0, 4.0], [10.0, 20.0, 0.0]);
        for (x, y) in xs.iter().zip(ys) {
            assert_eq!(linear(&xs, &ys, *x), Some(y));
        }
        assert_eq!(linear(&xs, &ys, 3.0), Some(10.0));
        for x in [0.99, 4.01, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(linear(&xs, &ys, x), None);
        }
        assert_eq!(linear(&[], &[], 1.0), None);
    }
}
