//! Taps: where a convolution looks, and with which weight.

use crate::table::Axis;

/// A list of taps: three coordinates each and the weights of R, G, B. In maps the coordinates are the
/// direction in the frame (east, north, outwards), on surfaces the displacement along the two
/// directions and the width of the cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Taps(Vec<[f32; 6]>);

impl Taps {
    /// Appends a tap.
    pub fn push(&mut self, [x, y, z]: [f64; 3], [r, g, b]: [f64; 3]) {
        self.0.push([x, y, z, r, g, b].map(|number| number as f32));
    }

    /// Appends what R, G and B are along a line: a tap per cell of `axis`, which begins where `place`
    /// says for its centre and weighs the value times the step.
    pub fn push_line(
        &mut self,
        axis: &Axis,
        place: impl Fn(f64) -> [f64; 3],
        channels: [&[f64]; 3],
    ) {
        let step = axis.step().abs();
        for (at, centre) in axis.centres().into_iter().enumerate() {
            self.push(place(centre), channels.map(|values| values[at] * step));
        }
    }

    /// Number of taps.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// All numbers, six to a tap.
    pub fn numbers(&self) -> &[f32] {
        self.0.as_flattened()
    }

    /// Place and weight of every tap.
    pub fn iter(&self) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + '_ {
        let wide = |tap: &[f32; 6]| tap.map(f64::from);
        self.0.iter().map(wide).map(|[x, y, z, r, g, b]| ([x, y, z], [r, g, b]))
    }

    /// The taps of both.
    pub fn extend(&mut self, other: &Self) {
        self.0.extend_from_slice(&other.0);
    }

    /// The largest taps that hold all but `share` of the sum of |weights|, in their order.
    #[must_use]
    pub fn thinned(&self, share: f64) -> Self {
        let size = |tap: &[f32; 6]| tap[3..].iter().map(|w| f64::from(w.abs())).sum::<f64>();
        let mut sizes: Vec<f64> = self.0.iter().map(size).collect();
        sizes.sort_by(f64::total_cmp);
        let most = share * sizes.iter().sum::<f64>();
        let mut left_out = 0.0;
        let least = sizes.into_iter().find(|size| {
            left_out += size;
            left_out > most
        });
        let kept = self.0.iter().filter(|tap| size(tap) >= least.unwrap_or(0.0));
        Self(kept.copied().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_largest() {
        let mut taps = Taps::default();
        for (at, weight) in [0.01, 5.0, 0.0, 4.99].into_iter().enumerate() {
            taps.push([at as f64, 0.0, 1.0], [weight, 0.0, 0.0]);
        }
        let kept = taps.thinned(2e-3);
        let places: Vec<f64> = kept.iter().map(|(place, _)| place[0]).collect();
        assert_eq!(places, [1.0, 3.0]);
        let total = |taps: &Taps| taps.iter().map(|(_, weight)| weight[0]).sum::<f64>();
        let left_out = 1.0 - total(&kept) / total(&taps);
        assert!((left_out - 1e-3).abs() < 1e-8);
    }
}
