//! Fewer points with the same look: of every stretch its first, lowest, highest and last point.

/// Of every run of consecutive points in the same pixel column, `width` pixels wide, the first,
/// lowest, highest and last, in their order.
pub(crate) fn by_column(points: &[(f64, f64)], width: f64) -> Vec<(f64, f64)> {
    let column = |p: &(f64, f64)| (p.0 / width).floor();
    let mut kept = Vec::new();
    for run in points.chunk_by(|a, b| column(a) == column(b)) {
        keep(run, &mut kept);
    }
    kept
}

/// At most `limit` of the points (4 or more), from runs of equal length. Points that are not
/// finite in y count as neither lowest nor highest.
pub(super) fn by_index(points: &[(f64, f64)], limit: usize) -> Vec<(f64, f64)> {
    if points.len() <= limit {
        return points.to_vec();
    }
    let runs = (limit / 4).max(1);
    let mut kept = Vec::with_capacity(limit);
    for run in points.chunks(points.len().div_ceil(runs)) {
        keep(run, &mut kept);
    }
    kept
}

fn keep(run: &[(f64, f64)], kept: &mut Vec<(f64, f64)>) {
    if run.len() <= 4 {
        kept.extend_from_slice(run);
        return;
    }
    let by_y = |a: &(usize, &(f64, f64)), b: &(usize, &(f64, f64))| a.1.1.total_cmp(&b.1.1);
    let finite = || run.iter().enumerate().filter(|(_, p)| p.1.is_finite());
    let lowest = finite().min_by(by_y).map(|(index, _)| index);
    let highest = finite().max_by(by_y).map(|(index, _)| index);
    let mut indices = vec![0, run.len() - 1];
    indices.extend(lowest);
    indices.extend(highest);
    indices.sort_unstable();
    indices.dedup();
    kept.extend(indices.into_iter().filter_map(|index| run.get(index)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extrema_and_ends_survive() {
        let points: Vec<_> = (0..10_000)
            .map(|i| (f64::from(i) * 0.05, if i == 4321 { 9.0 } else { f64::from(i % 7) }))
            .collect();
        for kept in [by_column(&points, 1.0), by_index(&points, 512)] {
            assert!(kept.len() <= 2004, "{}", kept.len());
            assert_eq!(kept.first(), points.first());
            assert_eq!(kept.last(), points.last());
            assert!(kept.contains(&(4321.0 * 0.05, 9.0)));
        }
        assert!(by_index(&points, 512).len() <= 512);
    }
}
