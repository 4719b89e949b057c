//! Energy: what a mirror with scratches reflects, for every combination of simplifications.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::{TEXTS, grid};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::Exhibit;
use crate::effects::scratch_response::ensemble::{
    Base, Depth, Ends, Lit, Model, Recipe, Sum, all_models, mirror_width, scratches,
    under_normal_light,
};
use crate::effects::scratch_response::surface::{
    Coherence, Directions, StraightScratch, mirror_amplitude,
};

/// Smaller than the paper's 60 µm, as the quadrature over the disc takes (2σk)² points; what counts
/// are widths over σ.
const LIGHT: Coherence = Coherence { wavelength_um: 0.55, sigma_um: 10.0 };
/// Scratches within σ of the shaded point.
const DENSITIES: [f64; 3] = [0.5, 2.0, 8.0];
/// Surfaces per density.
const ENSEMBLES: u64 = 3;
const MODELS: usize = 40;

/// Reflected energies of one density, by model in the order of [`all_models`].
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct EnergyStudy {
    /// Over directions above the surface.
    pub(in super::super) disc: [f64; MODELS],
    /// Over the whole plane; NaN with the depth phase at its angles, which end at the disc.
    pub(in super::super) plane: [f64; MODELS],
    /// Mean of Σ a, the share of the light that falls into scratches.
    pub(in super::super) light_share: f64,
    /// Mean of ρ_c of infinite scratches.
    pub(in super::super) density: f64,
}

impl EnergyStudy {
    /// Mean over surfaces with scratches of W and D uniform from 0.3 to 2 µm.
    pub(in super::super) fn new(per_coherence_area: f64) -> Self {
        let recipe = Recipe {
            sigma_um: LIGHT.sigma_um,
            per_coherence_area,
            size_um: [0.3, 2.0],
            length: [1.0, 20.0],
            spread_rad: PI,
        };
        let all: Vec<Self> =
            (0..ENSEMBLES).into_par_iter().map(|seed| of_surface(recipe, seed)).collect();
        let mean = |of: &dyn Fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        Self {
            disc: std::array::from_fn(|i| mean(&|study| study.disc[i])),
            plane: std::array::from_fn(|i| mean(&|study| study.plane[i])),
            light_share: mean(&|study| study.light_share),
            density: mean(&|study| study.density),
        }
    }

    /// Energy of a model over the disc.
    pub(in super::super) fn of(&self, model: Model) -> f64 {
        of_model(&self.disc, model)
    }
}

/// The energy of a model among those of all.
fn of_model(energies: &[f64; MODELS], model: Model) -> f64 {
    let at = all_models().iter().position(|&other| other == model);
    at.map_or(f64::NAN, |i| energies[i])
}

/// Points of the disc in steps of 1/(σk), their directions under a vertical light, and the area of each.
fn disc() -> (Vec<Directions>, f64) {
    let step = mirror_width(LIGHT);
    let most = (1.0 / step) as i32;
    let points = (-most..=most).flat_map(|i| {
        (-most..=most)
            .filter_map(move |j| under_normal_light([f64::from(i) * step, f64::from(j) * step]))
    });
    (points.collect(), step * step)
}

fn of_surface(recipe: Recipe, seed: u64) -> EnergyStudy {
    let scratches = scratches(recipe, seed);
    let lit = Lit::new(&scratches, LIGHT, 2.0);
    let models = all_models();
    let (points, area) = disc();
    let sums = points
        .par_chunks(2048)
        .map(|chunk| {
            chunk.iter().fold([0.0; MODELS], |mut sums, &directions| {
                let values = lit.svbrdf(&models, directions);
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value);
                sums
            })
        })
        .collect::<Vec<_>>();
    // In the order of the chunks, whatever the number of threads.
    let disc: [f64; MODELS] = std::array::from_fn(|i| sums.iter().map(|part| part[i]).sum());
    let plane = models.map(|model| {
        if model.depth == Depth::Angular {
            return f64::NAN;
        }
        let lobes = lit.lobe_energy(model.ends);
        let crossed = if model.base == Base::Interfering { -lobes } else { 0.0 };
        // Mutual interference is local to the crossing of ridges: the disc holds it.
        let mutual = match model.sum {
            Sum::Coherent => {
                let added = Model { base: Base::Added, ..model };
                let apart = Model { sum: Sum::Incoherent, ..added };
                of_model(&disc, added) - of_model(&disc, apart)
            }
            Sum::Incoherent => 0.0,
        };
        lit.mirror_share(model) + crossed + lobes + mutual
    });
    EnergyStudy {
        disc,
        plane,
        light_share: scratches.iter().map(|s| s.light_share(LIGHT.sigma_um)).sum(),
        density: scratches.iter().map(|s| s.unbounded().density(LIGHT.sigma_um)).sum(),
    }
}

/// The energy of every combination.
pub(super) fn exhibit() -> Section {
    let studies = DENSITIES.map(EnergyStudy::new);
    let (points, area) = disc();
    let mirror: f64 = points.iter().map(|&d| area * mirror_amplitude(LIGHT, d).powi(2)).sum();
    let shares = DENSITIES
        .iter()
        .zip(&studies)
        .map(|(n, study)| [*n, study.light_share, study.density].map(Cell::from).to_vec());
    let columns = ["disc", "plane"]
        .into_iter()
        .flat_map(|place| DENSITIES.map(|n| (format!("{place}, {n} per area"), "1".to_owned())));
    let energy =
        |value: f64| if value.is_finite() { value.into() } else { Cell::text("not defined") };
    let rows = all_models().into_iter().enumerate().map(|(i, model)| {
        let mut row = words(model).map(Cell::text).to_vec();
        row.extend(studies.iter().map(|study| energy(study.disc[i])));
        row.extend(studies.iter().map(|study| energy(study.plane[i])));
        row
    });
    let values = [("mirror", format!("{mirror:.9}")), ("ENSEMBLES", ENSEMBLES.to_string())];
    Exhibit::of(TEXTS, "energy", &values)
        .figure(one_scratch())
        .table(shares)
        .wider_table(columns, rows)
        .section()
}

/// Energy over the plane of a mirror with one infinite scratch, against the wavelength, in closed form.
fn one_scratch() -> [Series; 3] {
    let scratch = StraightScratch::infinite(0.0, 3.0, 0.4);
    let curve = |taken: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        grid(0.38, 0.78, 81)
            .map(|wavelength_um| {
                let light = Coherence { wavelength_um, sigma_um: 60.0 };
                let lobe = scratch.reflected_share(light, 2.0);
                (wavelength_um, 1.0 - taken(lobe) + lobe)
            })
            .collect()
    };
    [
        Series::line("no blend", curve(&|_| 0.0)),
        Series::line("rho_c (eq. 6, 17)", curve(&|_| scratch.density(60.0))).strong(),
        Series::dashed("energy blend (ours)", curve(&|lobe| lobe)),
    ]
}

fn words(model: Model) -> [&'static str; 4] {
    [
        match model.depth {
            Depth::Angular => "at its angles",
            Depth::SmallAngle => "small angles",
        },
        match model.ends {
            Ends::Finite => "finite",
            Ends::Infinite => "infinite",
            Ends::Matched => "matched",
        },
        match model.sum {
            Sum::Coherent => "coherent",
            Sum::Incoherent => "incoherent",
        },
        match model.base {
            Base::Interfering => "cross term",
            Base::Added => "no cross term",
            Base::Density => "rho_c blend",
            Base::Peak => "peak blend (ours)",
            Base::Energy => "energy blend (ours)",
        },
    ]
}
