/// Value at `x` of the piecewise linear curve through (`xs`, `ys`).
///
/// `xs` increases; `xs` and `ys` have one length. Exact at the nodes. `None` outside the nodes, for
/// a NaN, and where there are no nodes.
pub fn linear(xs: &[f64], ys: &[f64], x: f64) -> Option<f64> {
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
