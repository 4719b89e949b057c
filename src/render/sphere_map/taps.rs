//! Taps: where a convolution looks, and with which weight.

/// A list of taps: three coordinates each and the weights of R, G, B. In maps the coordinates are the
/// direction in the frame (east, north, outwards), on surfaces the displacement along the two
/// directions and the width of the cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Taps {
    numbers: Vec<f32>,
}

impl Taps {
    /// Numbers per tap.
    pub const WIDTH: usize = 6;

    /// Appends a tap.
    pub fn push(&mut self, place: [f64; 3], weight: [f64; 3]) {
        self.numbers.extend(place.iter().chain(&weight).map(|number| *number as f32));
    }

    /// Number of taps.
    pub fn count(&self) -> usize {
        self.numbers.len() / Self::WIDTH
    }

    /// All numbers, tap by tap.
    pub fn numbers(&self) -> &[f32] {
        &self.numbers
    }

    /// Place and weight of every tap.
    pub fn iter(&self) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + '_ {
        self.numbers.chunks_exact(Self::WIDTH).map(|tap| {
            let three = |from: usize| [0, 1, 2].map(|at| f64::from(tap[from + at]));
            (three(0), three(3))
        })
    }

    /// The taps of both.
    pub fn extend(&mut self, other: &Self) {
        self.numbers.extend_from_slice(&other.numbers);
    }

    /// The largest taps that hold all but `share` of the sum of |weights|, in their order, and the
    /// share that was left out.
    pub fn thinned(&self, share: f64) -> (Self, f64) {
        let size = |tap: &[f32]| tap[3..].iter().map(|w| f64::from(w.abs())).sum::<f64>();
        let mut sizes: Vec<f64> = self.numbers.chunks_exact(Self::WIDTH).map(size).collect();
        sizes.sort_by(f64::total_cmp);
        let total: f64 = sizes.iter().sum();
        let (mut left_out, mut least) = (0.0, 0.0);
        for size in sizes {
            if left_out + size > share * total {
                least = size;
                break;
            }
            left_out += size;
        }
        let kept = self.numbers.chunks_exact(Self::WIDTH).filter(|tap| size(tap) >= least);
        let numbers = kept.flatten().copied().collect();
        (Self { numbers }, if total > 0.0 { left_out / total } else { 0.0 })
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
        let (kept, left_out) = taps.thinned(2e-3);
        let places: Vec<f64> = kept.iter().map(|(place, _)| place[0]).collect();
        assert_eq!(places, [1.0, 3.0]);
        assert!((left_out - 1e-3).abs() < 1e-8);
    }
}
