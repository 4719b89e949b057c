//! Residual statistics of a form over points.

use std::collections::BTreeMap;

use super::outcome::Residuals;

impl Residuals {
    /// Statistics of `values − target`; `columns` are the inputs called `names`; of several
    /// outputs all rows of the first stand before those of the next.
    ///
    /// Percentiles are by nearest rank, so each is the error of some point. A NaN counts as the
    /// largest error.
    pub fn measure(
        columns: &[Vec<f64>],
        names: &[String],
        values: &[f64],
        target: &[f64],
    ) -> Residuals {
        let errors: Vec<f64> = values.iter().zip(target).map(|(v, t)| v - t).collect();
        let count = errors.len();
        let at = |i: usize| -> BTreeMap<String, f64> {
            // Several outputs stand one after the other.
            let value = |column: &Vec<f64>| {
                column.get(i % column.len().max(1)).copied().unwrap_or(f64::NAN)
            };
            names.iter().cloned().zip(columns.iter().map(value)).collect()
        };
        let mut magnitudes: Vec<f64> = errors.iter().map(|e| e.abs()).collect();
        let worst = argmax(&magnitudes);
        let max_abs = worst.map_or(f64::NAN, |i| magnitudes[i]);
        let relative: Vec<f64> = errors
            .iter()
            .zip(target)
            .map(|(e, t)| if *t == 0.0 { -1.0 } else { (e / t).abs() })
            .collect();
        let worst_relative = argmax(&relative).filter(|i| relative[*i] >= 0.0);
        magnitudes.sort_by(f64::total_cmp);
        let percentile = |p: f64| {
            let rank = (p * count as f64).ceil() as usize;
            magnitudes.get(rank.max(1) - 1).copied().unwrap_or(f64::NAN)
        };
        let scale = if max_abs > 0.0 && max_abs.is_finite() { max_abs } else { 1.0 };
        let squares: f64 = errors.iter().map(|e| (e / scale) * (e / scale)).sum();
        Residuals {
            count,
            rms: scale * (squares / count as f64).sqrt(),
            max_abs,
            max_abs_at: worst.map(at).unwrap_or_default(),
            bias: errors.iter().sum::<f64>() / count as f64,
            p50: percentile(0.5),
            p95: percentile(0.95),
            p99: percentile(0.99),
            max_rel: worst_relative.map(|i| relative[i]),
            max_rel_at: worst_relative.map(at),
        }
    }
}

/// Index of the largest number, the first of equals; a NaN is larger than every number.
fn argmax(numbers: &[f64]) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (i, number) in numbers.iter().enumerate() {
        if best.is_none_or(|(_, b)| !b.is_nan() && (number.is_nan() || *number > b)) {
            best = Some((i, *number));
        }
    }
    best.map(|(i, _)| i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_point_is_named() {
        let names = ["x".to_owned()];
        let columns = [vec![0.0, 1.0, 2.0]];
        let r = Residuals::measure(&columns, &names, &[0.0, 3.0, 4.5], &[0.0, 1.0, 4.0]);
        assert_eq!((r.max_abs, r.max_abs_at["x"], r.p50), (2.0, 1.0, 0.5));
        assert_eq!((r.max_rel, r.max_rel_at.unwrap()["x"]), (Some(2.0), 1.0));
    }

    #[test]
    fn a_nan_is_the_worst() {
        let names = ["x".to_owned()];
        let r = Residuals::measure(&[vec![0.0, 1.0]], &names, &[f64::NAN, 9.0], &[1.0, 1.0]);
        assert!(r.max_abs.is_nan() && r.rms.is_nan() && r.max_abs_at["x"] == 0.0);
    }
}
