//! Statistics of a sample of residuals.
//!
//! Sums are compensated, so that they do not depend on how a long sample is ordered to more than
//! the last digit. An empty sample has no statistic: the answer is NaN.

/// Sum with Neumaier's compensation: error of a few ulp of the result whatever the length.
pub fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for value in values {
        let next = total + value;
        // The low bits of the smaller operand are what the addition drops.
        lost += if total.abs() >= value.abs() {
            (total - next) + value
        } else {
            (value - next) + total
        };
        total = next;
    }
    if lost.is_finite() { total + lost } else { total }
}

/// Arithmetic mean; NaN for an empty sample.
pub fn mean(values: &[f64]) -> f64 {
    sum(values.iter().copied()) / values.len() as f64
}

/// Root of the mean square; NaN for an empty sample.
pub fn rms(values: &[f64]) -> f64 {
    (sum(values.iter().map(|v| v * v)) / values.len() as f64).sqrt()
}

/// The value below which `percent` (0 to 100, clamped) of the sample lies, interpolated linearly
/// between order statistics (definition 7 of Hyndman & Fan 1996, NumPy's default). `values` need
/// not be sorted; NaN sorts last. NaN for an empty sample.
pub fn percentile(values: &[f64], percent: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let position = percent.clamp(0.0, 100.0) / 100.0 * last as f64;
    let below = (position.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let fraction = position - below as f64;
    if fraction == 0.0 {
        return sorted[below];
    }
    sorted[below] + fraction * (sorted[above] - sorted[below])
}

/// Error relative in the L2 norm, √(Σ(got − exact)² / Σ exact²), over pairs of got and exact; NaN if
/// every exact value is 0.
pub fn relative_l2(pairs: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let (errors, norms): (Vec<f64>, Vec<f64>) = pairs
        .into_iter()
        .map(|(got, exact)| ((got - exact) * (got - exact), exact * exact))
        .unzip();
    let norm = sum(norms);
    if norm > 0.0 || norm.is_nan() { (sum(errors) / norm).sqrt() } else { f64::NAN }
}

/// The largest of `values`, NaN as soon as one is NaN; 0 of none.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, value| {
        if largest.is_nan() || value.is_nan() { f64::NAN } else { largest.max(value) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sum_keeps_what_plain_addition_loses() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
        assert_eq!(sum([]), 0.0);
        assert_eq!(sum([f64::INFINITY, 1.0]), f64::INFINITY);
    }

    #[test]
    fn a_relative_error_needs_something_to_be_relative_to() {
        assert_eq!(relative_l2([(3.0, 0.0), (4.0, 8.0)]), 0.625);
        assert!(relative_l2([(1.0, 0.0)]).is_nan() && relative_l2([(f64::NAN, 1.0)]).is_nan());
    }

    #[test]
    fn the_largest_keeps_a_nan() {
        assert_eq!(largest([1.0, 3.0, -4.0]), 3.0);
        assert_eq!(largest([]), 0.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
    }

    #[test]
    fn mean_and_rms_of_a_known_sample() {
        assert_eq!(mean(&[1.0, 2.0, 6.0]), 3.0);
        assert_eq!(rms(&[3.0, -3.0, 3.0]), 3.0);
        assert!(mean(&[]).is_nan() && rms(&[]).is_nan());
    }

    #[test]
    fn percentile_interpolates_between_order_statistics() {
        let sample = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(percentile(&sample, 0.0), 1.0);
        assert_eq!(percentile(&sample, 50.0), 2.5);
        assert_eq!(percentile(&sample, 100.0), 4.0);
        assert_eq!(percentile(&[7.0], 95.0), 7.0);
        assert!(percentile(&[], 50.0).is_nan());
    }
}
