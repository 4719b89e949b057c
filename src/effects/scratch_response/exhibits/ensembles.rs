//! Ensembles of scratches in a mirror: what each simplification costs on its own and all together.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use rayon::prelude::*;

use super::TEXTS;
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::Exhibit;
use crate::effects::scratch_response::ensemble::{
    Base, Depth, Ends, Lit, Model, PUBLISHED, REFERENCE, Recipe, Sum, mirror_width, scratches,
    under_normal_light,
};
use crate::effects::scratch_response::surface::{Coherence, StraightScratch};

/// Scratches per coherence area of the study.
const DENSITIES: [f64; 6] = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
/// Ensembles per density, and directions per ensemble and kind.
const ENSEMBLES: u64 = 20;
const DIRECTIONS: usize = 100;
const LIGHT: Coherence = Coherence { wavelength_um: 0.55, sigma_um: 60.0 };

/// The models of the study; the reference comes first.
const MODELS: [(&str, Model); 11] = [
    ("reference", REFERENCE),
    ("small angles alone", Model { depth: Depth::SmallAngle, ..REFERENCE }),
    ("infinite scratches alone", Model { ends: Ends::Infinite, ..REFERENCE }),
    ("incoherent sum alone", Model { sum: Sum::Incoherent, ..REFERENCE }),
    ("no cross term alone", Model { base: Base::Added, ..REFERENCE }),
    ("density blend alone", Model { base: Base::Density, ..REFERENCE }),
    ("all together (ships)", PUBLISHED),
    ("all together, energy blend", Model { base: Base::Energy, ..PUBLISHED }),
    ("matched ends and rho_c (ours)", Model { ends: Ends::Matched, ..PUBLISHED }),
    (
        "matched ends, energy blend (ours)",
        Model { base: Base::Energy, ends: Ends::Matched, ..PUBLISHED },
    ),
    (
        "matched ends, peak blend (ours)",
        Model { base: Base::Peak, ends: Ends::Matched, ..PUBLISHED },
    ),
];

/// Errors of every model at one density and kind of direction.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct EnsembleStudy {
    /// RMS error over RMS of the reference, by model.
    pub(in super::super) rms: [f64; MODELS.len()],
    /// Mean over the mean of the reference, by model.
    pub(in super::super) mean: [f64; MODELS.len()],
}

/// Where an ensemble is seen.
#[derive(Debug, Clone, Copy)]
pub(in super::super) enum Seen {
    /// In the lobe of one of its scratches, beyond the mirror's.
    Scratch,
    /// In the mirror's lobe.
    Mirror,
}

impl EnsembleStudy {
    /// Of scratches within `spread_rad` of each other.
    pub(in super::super) fn new(per_coherence_area: f64, spread_rad: f64, seen: Seen) -> Self {
        let recipe = Recipe {
            sigma_um: LIGHT.sigma_um,
            per_coherence_area,
            size_um: [0.8, 6.0],
            length: [1.0, 20.0],
            spread_rad,
        };
        let values: Vec<Vec<[f64; MODELS.len()]>> =
            (0..ENSEMBLES).into_par_iter().map(|seed| of_ensemble(recipe, seed, seen)).collect();
        let (mut error, mut total) = ([0.0; MODELS.len()], [0.0; MODELS.len()]);
        let mut norm = 0.0;
        for values in values.iter().flatten() {
            norm += values[0] * values[0];
            for (i, value) in values.iter().enumerate() {
                error[i] += (value - values[0]).powi(2);
                total[i] += value;
            }
        }
        Self { rms: error.map(|e: f64| (e / norm).sqrt()), mean: total.map(|t| t / total[0]) }
    }
}

fn of_ensemble(recipe: Recipe, seed: u64, seen: Seen) -> Vec<[f64; MODELS.len()]> {
    let scratches = scratches(recipe, seed);
    let lit = Lit::new(&scratches, LIGHT, 2.0);
    let mut rng = ChaCha12Rng::seed_from_u64(seed + 1000);
    let models = MODELS.map(|(_, model)| model);
    (0..DIRECTIONS)
        .filter_map(|_| under_normal_light(direction(&mut rng, &scratches, seen)))
        .map(|directions| lit.svbrdf(&models, directions))
        .collect()
}

fn direction(rng: &mut ChaCha12Rng, scratches: &[StraightScratch], seen: Seen) -> [f64; 2] {
    let width = mirror_width(LIGHT);
    let mut within = || width * rng.random_range(-1.5..1.5);
    let (along, other) = (within(), within());
    match (seen, scratches) {
        (Seen::Mirror, _) | (_, []) => [along, other],
        (Seen::Scratch, all) => {
            let (sin, cos) = all[rng.random_range(0..all.len())].direction_rad.sin_cos();
            let across = rng.random_range(8.0 * width..0.5) * if rng.random() { 1.0 } else { -1.0 };
            [along * cos - across * sin, along * sin + across * cos]
        }
    }
}

/// Errors against scratches per coherence area.
pub(super) fn exhibit() -> Section {
    let any = std::f64::consts::PI;
    let brushed = 2.0_f64.to_radians();
    let scratch = DENSITIES.map(|n| EnsembleStudy::new(n, any, Seen::Scratch));
    let parallel = DENSITIES.map(|n| EnsembleStudy::new(n, brushed, Seen::Scratch));
    let mirror = DENSITIES.map(|n| EnsembleStudy::new(n, any, Seen::Mirror));
    let in_mirror = [2, 3, 4, 5, 6, 8, 9, 10];
    let values = [("ENSEMBLES", ENSEMBLES.to_string()), ("DIRECTIONS", DIRECTIONS.to_string())];
    Exhibit::of(TEXTS, "ensembles", &values)
        .figure(curves(&scratch, &[1, 2, 3, 6, 8]))
        .figure(curves(&mirror, &in_mirror))
        .wider_table(columns(), rows(&scratch))
        .wider_table(columns(), rows(&parallel))
        .wider_table(columns(), rows(&mirror))
        .section()
}

/// Errors of some models over the densities.
fn curves(studies: &[EnsembleStudy], models: &[usize]) -> Vec<Series> {
    let curve = |&i: &usize| {
        let points = DENSITIES.iter().zip(studies).map(|(n, study)| (*n, study.rms[i]));
        let series = Series::line(MODELS[i].0, points);
        if i == 6 { series.strong() } else { series }
    };
    models.iter().map(curve).collect()
}

/// The densities, of the errors and of the means.
fn columns() -> impl Iterator<Item = (String, String)> {
    let of = |number| DENSITIES.map(|n| (format!("{number}, {n} per area"), "1".to_owned()));
    ["RMS", "mean"].into_iter().flat_map(of)
}

/// Errors of every model, and means over that of the reference.
fn rows(studies: &[EnsembleStudy]) -> impl Iterator<Item = Vec<Cell>> {
    (1..MODELS.len()).map(|i| {
        let rms = studies.iter().map(|study| study.rms[i]);
        let numbers = rms.chain(studies.iter().map(|study| study.mean[i])).map(Cell::from);
        [Cell::text(MODELS[i].0)].into_iter().chain(numbers).collect()
    })
}
