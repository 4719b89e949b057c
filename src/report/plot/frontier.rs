//! The frontier of cost and error: what no other point beats in both.

/// The points that no other beats in both coordinates (lower is better), by ascending x. Points
/// that are not finite are left out; of equal points the first is kept.
#[must_use]
pub fn frontier(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let finite = |p: &&(f64, f64)| p.0.is_finite() && p.1.is_finite();
    let mut sorted: Vec<_> = points.iter().filter(finite).copied().collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut best = f64::INFINITY;
    sorted.retain(|p| {
        let better = p.1 < best;
        best = best.min(p.1);
        better
    });
    sorted
}

/// The corners of the staircase through `frontier`, in pixels (y grows downwards): from `top` down
/// to its first point and on to `right`, at every cost the lowest error reached so far.
pub(super) fn staircase(frontier: &[(f64, f64)], top: f64, right: f64) -> Vec<(f64, f64)> {
    let mut corners = Vec::with_capacity(2 * frontier.len() + 2);
    let mut level = top;
    for &(x, y) in frontier {
        corners.push((x, level));
        corners.push((x, y));
        level = y;
    }
    if !frontier.is_empty() {
        corners.push((right, level));
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_points_that_none_beats_are_kept() {
        let points = [(3.0, 1.0), (1.0, 5.0), (2.0, 6.0), (f64::NAN, 0.0), (3.0, 2.0), (4.0, 1.0)];
        assert_eq!(frontier(&points), [(1.0, 5.0), (3.0, 1.0)]);
        assert!(frontier(&[]).is_empty());
    }

    #[test]
    fn the_staircase_goes_right_before_it_goes_down() {
        let corners = staircase(&[(1.0, 5.0), (3.0, 8.0)], 0.0, 9.0);
        assert_eq!(corners, [(1.0, 0.0), (1.0, 5.0), (3.0, 5.0), (3.0, 8.0), (9.0, 8.0)]);
    }
}
