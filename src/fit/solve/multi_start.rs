//! Where the starts of a multi-start fit are.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::fit::bounds::Bounds;

/// The given start and `count − 1` further ones, seeded.
///
/// Between two bounds they are uniform; beyond one bound the distance to it is multiplied by 10^t, t
/// uniform in [−1, 1]; without bounds they are within twice the start's magnitude (or 1, if that is
/// 0) of the start.
pub fn starts(start: &[f64], bounds: &[Bounds], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut all = vec![start.to_vec()];
    while all.len() < count {
        let next = start.iter().zip(bounds).map(|(s, b)| {
            let t: f64 = random.random_range(-1.0..1.0);
            let apart = |bound: f64| if *s == bound { 1.0 } else { *s - bound };
            match (b.lower, b.upper) {
                (Some(low), Some(high)) => low + (high - low) * 0.5 * (1.0 + t),
                (Some(bound), None) | (None, Some(bound)) => {
                    bound
                        + apart(bound).abs().copysign(if b.lower.is_some() { 1.0 } else { -1.0 })
                            * 10f64.powf(t)
                }
                (None, None) => s + 2.0 * t * if *s == 0.0 { 1.0 } else { s.abs() },
            }
        });
        all.push(next.collect());
    }
    all
}
