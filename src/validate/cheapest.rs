//! The cheapest form for an error, region by region.

use serde::Serialize;

use crate::effect::Yardstick;
use crate::validate::cost::{Cost, Costs};
use crate::validate::study::Study;

/// Relative errors that are asked for.
pub const LIMITS: [f64; 3] = [0.1, 0.01, 0.001];

/// The cheapest forms of one reference in one region.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cheapest {
    /// The region.
    pub region: String,
    /// The fit that renderers ship.
    pub baseline: String,
    /// For each of [`LIMITS`] the cheapest fit whose error in f32 is not above it and its cost
    /// relative to the baseline; none if no fit reaches it.
    pub fits: [Option<(String, f64)>; LIMITS.len()],
}

/// For every region in which forms are compared by a relative error: who reaches 10 %, 1 % and 0.1 %
/// at the least cost, on the device or, where there is none, on f32 lanes.
pub fn cheapest(study: &Study, costs: &Costs) -> Vec<Cheapest> {
    let mut found: Vec<Cheapest> = Vec::new();
    for fit in &study.candidates {
        let Some(cost) = costs.forms.iter().find(|cost| cost.name == fit.name) else {
            continue;
        };
        let of_baseline = costs.forms.iter().find(|other| other.name == cost.baseline);
        let unit = of_baseline.map_or(f64::NAN, Cost::nanoseconds);
        for (region, accuracy) in &fit.regions {
            if accuracy.yardstick == Yardstick::MaxAbs {
                continue;
            }
            let known =
                found.iter().position(|c| c.region == *region && c.baseline == cost.baseline);
            let place = known.unwrap_or_else(|| {
                found.push(Cheapest {
                    region: region.clone(),
                    baseline: cost.baseline.clone(),
                    fits: [const { None }; LIMITS.len()],
                });
                found.len() - 1
            });
            let ratio = cost.nanoseconds() / unit;
            for (best, limit) in found[place].fits.iter_mut().zip(LIMITS) {
                let cheaper = best.as_ref().is_none_or(|(_, least)| ratio < *least);
                if accuracy.headline() <= limit && cheaper {
                    *best = Some((cost.name.clone(), ratio));
                }
            }
        }
    }
    found
}
