//! Where forms of order powers are judged. Every phase is an f32.

use std::f64::consts::TAU;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use crate::effect::{Points, points};
use crate::table::{Column, Table};

/// Phase of a disc's pits: k w D/2 for D = 120 nm at 450 nm, w = 2.
const DISC: f64 = 1.676;

/// Regions of the effect, by name: points that are judged and that are fitted.
pub(super) const REGIONS: &[(&str, Points, Option<Points>)] = &[
    ("one turn", || up_to(TAU, 2018), None),
    ("discs", || up_to(DISC, 2019), None),
    ("shallow", || up_to(0.3, 2020), None),
];

/// Hard cases, by name.
pub(super) const HARD_CASES: &[(&str, Points)] =
    &[("hard cases", || table(hard_cases(), "hard cases"))];

/// Zeros of J_0 and J_1 and their extrema up to a turn (DLMF §10.21), phases of a disc.
const SPECIAL: [f64; 8] = [
    2.404825557695773,
    5.520078110286311,
    3.831705970207512,
    1.8411837813406593,
    5.3314427735250325,
    DISC,
    1.0,
    3.0,
];

/// Phases that have broken implementations.
pub(super) fn hard_cases() -> Vec<f64> {
    let mut phases: Vec<f32> = vec![0.0, 1e-45, 1e-30, f32::MIN_POSITIVE, 1e-10, 1e-4, 0.01];
    for phase in SPECIAL {
        phases.extend(points::neighbours(phase));
    }
    // The f32 below a turn: beyond, forms stand still.
    let turn = TAU as f32;
    phases.extend([turn.next_down().next_down(), turn.next_down(), 6.0, 6.25]);
    phases.into_iter().map(f64::from).collect()
}

fn up_to(to: f64, seed: u64) -> Table {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let mut phases: Vec<f64> = (0..2000).map(|i| to * (f64::from(i) + 0.5) / 2000.0).collect();
    phases.extend((0..1000).map(|_| rng.random_range(0.0..to)));
    phases.extend(hard_cases().into_iter().filter(|phase| *phase <= to));
    table(phases, "spaced and seeded phases")
}

pub(super) fn table(phases: Vec<f64>, origin: &str) -> Table {
    let columns = vec![Column::new("phase", "rad", phases)];
    points::rounded(Table { columns, origin: format!("{origin} of diffraction") })
}
