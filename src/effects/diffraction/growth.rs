//! How the orders of a surface grow with w, beside its zero order.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | k, w | | rad/nm, 1 | 2π/λ and ω_i·n + ω_o·n |
//! | h, a | [`PreparedHeights`] | nm, 1 | heights and amplitudes |
//! | Z(kw) | | 1 | share of the zero order: |Σ a e^(−ikwh)|²/(Σ a)² |
//! | W_c(λ) | `weights` | 1 | weights of the wavelengths in a channel, of sum 1 |
//!
//! A phase screen sends the share Z into its zero order and 1 − Z, whatever w, into all others. A table
//! has one w for all pairs of directions. Its orders at another w are taken as those of the table times
//! (1 − Z(w))/(1 − Z(w_table)), the means of a channel: exact at one wavelength where heights have two
//! levels, and where they are shallow; elsewhere the sum over orders holds and their proportions are
//! those of the table.

use super::preparation::PreparedHeights;

/// Places on [0, 2] where w is tabulated.
const NODES: usize = 129;
/// Largest w.
const MOST_W: f64 = 2.0;
/// Classes of height. Each holds its mean, so that what is left is of the second order in its width.
const CLASSES: usize = 1024;

/// What the orders of a table are at any w, over what they are in the table.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderGrowth {
    /// Share of the zero order in the table: R, G, B.
    pub zero_order: [f64; 3],
    factors: Vec<[f64; 3]>,
}

impl OrderGrowth {
    /// Of a table whose heights are not known: its orders are the same at every w, and its zero order is
    /// what lies in its middle.
    pub fn unknown() -> Self {
        Self { zero_order: [0.0; 3], factors: vec![[1.0; 3]; 2] }
    }

    /// Of a table made of `surface` at `w`, with R, G, B `weights` of wavelengths in nm, of sum 1.
    pub fn of_surface(
        surface: &PreparedHeights,
        wavelengths_nm: &[f64],
        weights: &[[f64; 3]],
        w: f64,
    ) -> Self {
        let classes = classes(surface);
        let zero_order = |w: f64| {
            let mut sums = [0.0; 3];
            for (wavelength, weights) in wavelengths_nm.iter().zip(weights) {
                let share = coherent(&classes, std::f64::consts::TAU / wavelength * w);
                sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * share);
            }
            sums
        };
        let of_table = zero_order(w);
        let factors = (0..NODES).map(|node| {
            let share = zero_order(MOST_W * node as f64 / (NODES - 1) as f64);
            [0, 1, 2].map(|channel| {
                let others = 1.0 - of_table[channel];
                // A mirror has no order that could grow.
                if others > 1e-9 { (1.0 - share[channel]) / others } else { 1.0 }
            })
        });
        Self { zero_order: of_table, factors: factors.collect() }
    }

    /// The factor of R, G, B at `w` in [0, 2]; linear between what is tabulated.
    pub fn at(&self, w: f64) -> [f64; 3] {
        let last = self.factors.len() - 1;
        let place = (w / MOST_W * last as f64).clamp(0.0, last as f64);
        let node = (place as usize).min(last.saturating_sub(1));
        let (low, high, t) = (self.factors[node], self.factors[node + 1], place - node as f64);
        [0, 1, 2].map(|channel| low[channel] + t * (high[channel] - low[channel]))
    }

    /// The factors at equal steps of w over [0, 2].
    pub fn factors(&self) -> &[[f64; 3]] {
        &self.factors
    }
}

/// Amplitudes and mean heights in nm of classes of equal width.
fn classes(surface: &PreparedHeights) -> Vec<[f64; 2]> {
    let heights = || surface.height_nm.iter().copied();
    let (low, high) =
        heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), h| (a.min(h), b.max(h)));
    let per_nm = if high > low { (CLASSES - 1) as f64 / (high - low) } else { 0.0 };
    let mut sums = vec![[0.0; 2]; CLASSES];
    for (height, amplitude) in heights().zip(&surface.amplitude) {
        if let Some([all, moment]) = sums.get_mut(((height - low) * per_nm).round() as usize) {
            *all += amplitude;
            *moment += amplitude * height;
        }
    }
    let occupied = sums.into_iter().filter(|[all, _]| *all > 0.0);
    occupied.map(|[all, moment]| [all, moment / all]).collect()
}

/// |Σ a e^(−iqh)|²/(Σ a)².
fn coherent(classes: &[[f64; 2]], q: f64) -> f64 {
    let (mut real, mut imaginary, mut all) = (0.0, 0.0, 0.0);
    for [amplitude, height] in classes {
        let (sin, cos) = core_math::sincos(q * height);
        real += amplitude * cos;
        imaginary += amplitude * sin;
        all += amplitude;
    }
    (real * real + imaginary * imaginary) / (all * all)
}

#[cfg(test)]
mod tests {
    use super::super::preparation::{Detrend, Preparation, USUAL, Window, prepared};
    use super::super::surfaces::{Grating, Patch, Profile, grating};
    use super::super::{rectangular_order_power, sinusoid_order_power};
    use super::*;
    use std::f64::consts::TAU;

    const NM: f64 = 550.0;

    fn growth(profile: Profile) -> OrderGrowth {
        let patch = Patch { samples: 512, side_um: 51.2, line: false };
        let heights = grating(Grating { period_um: 3.2, angle: 0.0, profile }, patch);
        // The mean plane of a sinusoid is not level.
        let (window, detrend) = (Window::Rectangle, Detrend::Piston);
        let whole = Preparation { window, detrend, ..USUAL };
        let surface = prepared(&heights, whole).expect("a surface");
        OrderGrowth::of_surface(&surface, &[NM], &[[1.0; 3]], 2.0)
    }

    #[test]
    fn two_levels_grow_as_their_orders_do() {
        let depth_nm = 120.0;
        let growth = growth(Profile::Rectangle { depth_nm, duty: 0.5 });
        let power = |order, w: f64| {
            rectangular_order_power(order, 0.5, TAU / NM * w * depth_nm).expect("in the domain")
        };
        assert!((growth.zero_order[0] - power(0, 2.0)).abs() < 1e-3);
        for w in [0.3, 1.0, 1.7, 2.0] {
            let exact = power(1, w) / power(1, 2.0);
            assert!((growth.at(w)[0] / exact - 1.0).abs() < 1e-3, "{w}");
        }
    }

    #[test]
    fn the_shares_of_a_sinusoid_sum_to_one_at_every_w() {
        let amplitude_nm = 60.0;
        let growth = growth(Profile::Sinusoid { amplitude_nm });
        for w in [0.5, 1.0, 1.5, 2.0] {
            let zero = sinusoid_order_power(0, TAU / NM * w * amplitude_nm).expect("in the domain");
            let others = growth.at(w)[0] * (1.0 - growth.zero_order[0]);
            assert!((zero + others - 1.0).abs() < 1e-3, "{w}: {zero} and {others}");
        }
    }

    #[test]
    fn a_mirror_is_a_mirror_at_every_w() {
        let growth = growth(Profile::Sinusoid { amplitude_nm: 0.0 });
        assert!((growth.zero_order[0] - 1.0).abs() < 1e-12);
        assert_eq!(growth.at(0.4), [1.0; 3]);
    }
}
