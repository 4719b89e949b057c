//! Where the forms are judged, and points that break careless implementations.

use crate::effect::{Points, points};
use crate::table::{Column, Table};

/// Forms that take F₀ are judged on the held-out points of their family; only the weight, which
/// takes mu alone, has a region.
pub(super) const REGIONS: &[(&str, Points, Option<Points>)] = &[("[0, 1]", all_angles, None)];

/// Hard cases, by name.
pub(super) const HARD_CASES: &[(&str, Points)] = &[("hard cases", hard_cases)];

/// Interfaces whose curves are hardest: index n and k.
const INTERFACES: [(f64, f64); 9] = [
    // n < 0.1: the dip is shallow and reflectance at normal incidence is near 1.
    (0.04, 4.0),
    (0.02, 6.0),
    // k > 6: the pseudo-Brewster dip lies within ten degrees of grazing.
    (1.4, 7.5),
    (2.7, 8.4),
    // Strong dip at moderate reflectance: silicon in the ultraviolet.
    (5.6, 0.4),
    // Glass, and glass from the inside: Brewster's and the critical angle.
    (1.5, 0.0),
    (1.0 / 1.5, 0.0),
    // Next to index 1, where reflectance is a small difference.
    (1.0 + 1e-9, 0.0),
    (1.0, 1e-6),
];

fn all_angles() -> Table {
    let even = (0..1000).map(|i| (f64::from(i) + 0.5) / 1000.0);
    let grazing = (0..=12).map(|i| 10f64.powf(-4.0 + f64::from(i) / 4.0));
    let mu = even.chain(grazing).chain([0.0, 1.0]).collect();
    let columns = vec![Column::new("mu", "1", mu)];
    Table { columns, origin: "region [0, 1] of fresnel".into() }
}

/// Every interface at grazing and normal incidence, in between, and about its (pseudo-)Brewster
/// angle. Columns `mu`, `n`, `k`, and `eta`, which is n: the absorbing ones enter as dielectrics
/// too.
fn hard_cases() -> Table {
    let mut rows: Vec<[f64; 4]> = Vec::new();
    for (n, k) in INTERFACES {
        // Where Re(mu^2 (m^2 + 1)) = 1 for k = 0; near the minimum of R_p otherwise.
        let brewster = 1.0 / (1.0 + n.mul_add(n, k * k)).sqrt();
        let critical = ((1.0 - n) * (1.0 + n)).max(0.0).sqrt();
        for mu in [0.0, 1e-8, 1e-4, 0.01, brewster, critical, 0.5, 1.0 - f64::EPSILON / 2.0, 1.0] {
            rows.push([mu, n, k, n]);
        }
    }
    let columns = ["mu", "n", "k", "eta"].map(|name| (name, "1"));
    points::of_rows(columns, &rows, "hard cases of fresnel".into())
}
