//! Eq. 3 of toisoul2017 in f64: the reference of what is summed on the device.

use rayon::prelude::*;

use crate::render::geometry::Hit;
use crate::render::sphere_map::{SphereMap, Taps};

/// Radiance R, G, B at each hit, for F₀ = 1.
///
/// `taps`: displacement along the two directions of a hit, width of the cell, and the table times
/// the area of the cell. The sum over cells of ((1 + ω_i·ω_o)²/4)/((n·ω_o) μ_i), with the mean of
/// 1/μ_i over the ring of each cell; what lies beyond the horizon is left out. Bilinear in `map`.
pub fn integrals(map: &SphereMap, hits: &[Hit], taps: &Taps) -> Vec<[f64; 3]> {
    hits.par_iter().map(|hit| integral(map, hit, taps)).collect()
}

fn integral(map: &SphereMap, hit: &Hit, taps: &Taps) -> [f64; 3] {
    let Hit { frame, reflection, .. } = hit;
    let [first, beside] = frame.tangents;
    let mu_o = reflection.dot(&frame.normal).max(1e-4);
    let mirror = [reflection.dot(&first), reflection.dot(&beside)];
    let mut sum = [0.0; 3];
    for ([along, across, cell], weight) in taps.iter() {
        let (u, v) = (mirror[0] + along, mirror[1] + across);
        let radius = u.hypot(v);
        if radius >= 1.0 {
            continue;
        }
        let (inner, outer) = ((radius - 0.5 * cell).max(0.0), (radius + 0.5 * cell).min(1.0));
        let per_mu = 2.0 / ((1.0 - inner * inner).sqrt() + (1.0 - outer * outer).sqrt());
        let mu_i = (1.0 - radius * radius).sqrt();
        let cosine = mu_o * mu_i - mirror[0] * u - mirror[1] * v;
        let factor = 0.25 * (1.0 + cosine) * (1.0 + cosine) / mu_o * per_mu;
        let incident = first * u + beside * v + frame.normal * mu_i;
        let radiance = map.bilinear(incident.into());
        for ((sum, weight), radiance) in sum.iter_mut().zip(weight).zip(radiance) {
            *sum += weight * factor * radiance;
        }
    }
    sum
}
