//! Where the forms are judged: regions of |x|, and points that have broken implementations.
//!
//! Every point is an f32, so that a form evaluated in f32 and the reference in f64 see the same x.

use std::f64::consts::{FRAC_PI_2, PI};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use crate::effect::{Points, points};
use crate::table::{Column, Table};

/// Largest |x| for which forms are judged.
const FARTHEST: f64 = 1e4;
/// |x| up to which eq. 29 was fitted.
const NEAR: f64 = 10.0;

/// Regions of the effect, by name: points that are judged and that are fitted.
pub(super) const REGIONS: &[(&str, Points, Option<Points>)] =
    &[("[-10, 10]", near, None), ("[10, 1e4]", far, None), ("scene", scene, None)];

/// Hard cases, by name.
pub(super) const HARD_CASES: &[(&str, Points)] = &[("hard cases", hard_cases)];

/// Points that have broken implementations, both signs of each.
pub(super) fn hard_cases() -> Table {
    let mut magnitudes: Vec<f32> =
        vec![0.0, 1e-45, 1e-40, f32::MIN_POSITIVE, 1e-30, 1e-10, 1e-5, 1e-3];
    // Branch switches of forms, the largest errors of eq. 29 and of its refits, the last abscissae
    // of the lookups, half a turn and the far end: each with its neighbours.
    for x in [1.0, 2.0, 3.0, 3.55, 3.56, 4.0, 10.0, 10.8, 18.9, 32.9, 13.21, FARTHEST] {
        magnitudes.extend(points::neighbours(x));
    }
    // Zeros of sine and cosine, where phase reduction cancels: all up to 16π, then sparser.
    for k in (1..=32).chain((33..=6366).step_by(127)).chain([6363, 6364, 6365, 6366]) {
        magnitudes.extend(points::neighbours(f64::from(k) * FRAC_PI_2));
    }
    let points = magnitudes.iter().map(|&m| f64::from(m)).filter(|&m| m <= FARTHEST);
    table(points.flat_map(|m| [m, -m]).collect(), "hard cases")
}

/// Hard cases with |x| in [from, to].
fn hard_cases_within(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let all = hard_cases().columns.into_iter().flat_map(|column| column.values);
    all.filter(move |x| (from..=to).contains(&x.abs()))
}

fn near() -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(2018);
    let mut points: Vec<f64> =
        (0..4000).map(|i| -NEAR + (f64::from(i) + 0.5) * (2.0 * NEAR / 4000.0)).collect();
    points.extend((0..2000).map(|_| rng.random_range(-NEAR..NEAR)));
    points.extend(hard_cases_within(0.0, NEAR));
    table(points, "offset grid and seeded draws")
}

fn far() -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(2019);
    let at = |part: f64| NEAR * (FARTHEST / NEAR).powf(part);
    let mut points: Vec<f64> = (0..4000).map(|i| at((f64::from(i) + 0.5) / 4000.0)).collect();
    points.extend((0..2000).map(|_| at(rng.random::<f64>())));
    // The sign alternates: a form is odd or another law says otherwise.
    points.iter_mut().skip(1).step_by(2).for_each(|x| *x = -*x);
    points.extend(hard_cases_within(NEAR, FARTHEST));
    table(points, "offset grid in log x and seeded draws")
}

fn scene() -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(27);
    let points = (0..6000)
        .map(|_| {
            let width_um = rng.random_range(0.8..6.0);
            let wavelength_um = rng.random_range(0.38..0.78);
            let q = rng.random_range(-2.0..2.0);
            2.0 * PI / wavelength_um * width_um * q
        })
        .collect();
    table(points, "seeded draws of W, wavelength and q")
}

/// A table of one column, `x`, rounded to f32.
pub(super) fn table(points: Vec<f64>, origin: &str) -> Table {
    let columns = vec![Column::new("x", "1", points)];
    points::rounded(Table { columns, origin: format!("sine_integral: {origin}") })
}

#[cfg(test)]
mod tests {
    use super::super::EFFECT;
    use super::*;

    #[test]
    fn regions_hold_what_their_descriptions_say() {
        for region in EFFECT.regions {
            let table = (region.points)();
            let x = &table.columns[0].values;
            assert!(x.iter().all(|&x| x == f64::from(x as f32)), "{} is in f32", region.name);
        }
        let magnitudes = |table: Table| -> Vec<f64> {
            let mut m: Vec<f64> = table.columns[0].values.iter().map(|x| x.abs()).collect();
            m.sort_by(f64::total_cmp);
            m
        };
        assert!(magnitudes(near()).last() <= Some(&10.0));
        assert!(magnitudes(far()).first() >= Some(&9.999));
        let scene = magnitudes(scene());
        assert!(scene[scene.len() - 1] < 198.5 && scene[scene.len() - 1] > 170.0);
        assert!((scene[scene.len() / 2] - 30.0).abs() < 1.0, "median {}", scene[scene.len() / 2]);
    }
}
