//! Seeded scratch ensembles, and their SVBRDF with any of the simplifications of the model.

use std::f64::consts::{PI, SQRT_2};

use nalgebra::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use super::amplitude::{along_factor, depth_factor};
use super::surface::{Coherence, Directions, StraightScratch, mirror_amplitude};

/// Largest offset of a scratch from the shaded point, over σ: the intensity window is 1e-4 there.
const REACH: f64 = 3.0;

/// How an ensemble is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Recipe {
    /// Radius of the coherence area, µm.
    pub(super) sigma_um: f64,
    /// Mean number of scratches whose line passes within σ of the shaded point.
    pub(super) per_coherence_area: f64,
    /// Range of widths and depths, uniform, µm.
    pub(super) size_um: [f64; 2],
    /// Range of lengths, log-uniform, over σ.
    pub(super) length: [f64; 2],
    /// Largest angle between tangents, rad: π for any orientation.
    pub(super) spread_rad: f64,
}

/// The scratches of a recipe; the centres lie within reach along and across them.
pub(super) fn scratches(recipe: Recipe, seed: u64) -> Vec<StraightScratch> {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let count = (REACH * recipe.per_coherence_area).round() as usize;
    let [shortest, longest] = recipe.length;
    let reach = REACH * recipe.sigma_um;
    (0..count)
        .map(|_| {
            let direction_rad = recipe.spread_rad * (rng.random::<f64>() - 0.5);
            let half = 0.5 * recipe.sigma_um * shortest * (longest / shortest).powf(rng.random());
            StraightScratch {
                position_um: [rng.random_range(-reach..reach), rng.random_range(-reach..reach)],
                direction_rad,
                begin_um: -half,
                end_um: half,
                width_um: rng.random_range(recipe.size_um[0]..recipe.size_um[1]),
                depth_um: rng.random_range(recipe.size_um[0]..recipe.size_um[1]),
            }
        })
        .collect()
}

/// Where the depth phase is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Depth {
    /// At the angles.
    Angular,
    /// At normal angles, eq. 4.
    SmallAngle,
}

/// Whether scratches end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// Eq. 5.
    Finite,
    /// Eq. 8.
    Infinite,
    /// A Gaussian of the exact peak and energy, without a phase of its own: for incoherent sums.
    Matched,
}

/// How scratches add up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sum {
    /// |Σ𝒮|², eq. 2.
    Coherent,
    /// Σ|𝒮|², eq. 7.
    Incoherent,
}

/// How the mirror comes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Base {
    /// |ℬ|² − 2 Re ℬ*𝒮, eq. 1.
    Interfering,
    /// |ℬ|², no cross term.
    Added,
    /// (1 − ρ_c)|ℬ|², eq. 6 and 17.
    Density,
    /// (1 − Σ|𝒟|²ρ/2)|ℬ|²: the blend exact at the peak.
    Peak,
    /// (1 − Σ|𝒟|²a)|ℬ|²: the blend that keeps energy.
    Energy,
}

/// A choice of all four.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Model {
    pub(super) depth: Depth,
    pub(super) ends: Ends,
    pub(super) sum: Sum,
    pub(super) base: Base,
}

/// Nothing left out.
pub(super) const REFERENCE: Model = Model {
    depth: Depth::Angular,
    ends: Ends::Finite,
    sum: Sum::Coherent,
    base: Base::Interfering,
};

/// Everything left out, as velinov2018 ships it.
pub(super) const PUBLISHED: Model = Model {
    depth: Depth::SmallAngle,
    ends: Ends::Infinite,
    sum: Sum::Incoherent,
    base: Base::Density,
};

/// An ensemble under one light: its densities, and its amplitudes in any direction.
#[derive(Debug)]
pub(super) struct Lit<'a> {
    scratches: &'a [StraightScratch],
    light: Coherence,
    /// ρ of each blend, by whether the scratches end; the depth phase is the mirror direction's.
    shares: [[f64; 3]; 3],
}

impl<'a> Lit<'a> {
    /// `mirror_mu_sum`: γ + γᵢ in the mirror direction.
    pub(super) fn new(
        scratches: &'a [StraightScratch],
        light: Coherence,
        mirror_mu_sum: f64,
    ) -> Self {
        let shares = [Ends::Finite, Ends::Infinite, Ends::Matched].map(|ends| {
            let taken = |scratch: &StraightScratch| match ends {
                Ends::Finite | Ends::Matched => *scratch,
                Ends::Infinite => scratch.unbounded(),
            };
            let of = |share: &dyn Fn(StraightScratch) -> f64| -> f64 {
                scratches.iter().map(taken).map(share).sum()
            };
            let depth = |scratch: StraightScratch| {
                depth_factor(scratch.depth_um, light.wavelength_um, mirror_mu_sum).norm_sqr()
            };
            [
                of(&|scratch| scratch.density(light.sigma_um)),
                of(&|scratch| 0.5 * depth(scratch) * scratch.density(light.sigma_um)),
                of(&|scratch| scratch.reflected_share(light, mirror_mu_sum)),
            ]
        });
        Self { scratches, light, shares }
    }

    /// What the blend leaves of the mirror's energy; 1 where there is none.
    pub(super) fn mirror_share(&self, model: Model) -> f64 {
        let [density, peak, energy] = self.shares[model.ends as usize];
        match model.base {
            Base::Interfering | Base::Added => 1.0,
            Base::Density => 1.0 - density,
            Base::Peak => 1.0 - peak,
            Base::Energy => 1.0 - energy,
        }
    }

    /// Σ|𝒟|²a: energy of the lobes over the whole plane at a fixed depth phase, and what the cross
    /// term with the mirror removes.
    pub(super) fn lobe_energy(&self, ends: Ends) -> f64 {
        self.shares[ends as usize][2]
    }

    /// f_r of each model in one direction.
    pub(super) fn svbrdf<const N: usize>(
        &self,
        models: &[Model; N],
        directions: Directions,
    ) -> [f64; N] {
        let mirror = mirror_amplitude(self.light, directions);
        // By depth and by ends: the sum of amplitudes, and that of their squares.
        let mut parts = [[(Complex::default(), 0.0); 3]; 2];
        for &scratch in self.scratches {
            let profile = scratch.profile(self.light, directions.xi);
            let (q, [begin, end]) = (profile.wavenumber_sigma, profile.ends);
            let infinite = Complex::from(core_math::exp(-0.5 * q * q));
            let along =
                [along_factor(q, begin, end), infinite, matched_factor(q, begin, end).into()];
            for (mu_sum, parts) in [directions.mu_sum, 2.0].into_iter().zip(&mut parts) {
                let depth = depth_factor(scratch.depth_um, self.light.wavelength_um, mu_sum);
                for (along, (sum, lobes)) in along.iter().zip(parts) {
                    let amplitude: Complex<f64> = depth * profile.amplitude * along;
                    *sum += amplitude;
                    *lobes += amplitude.norm_sqr();
                }
            }
        }
        models.map(|model| {
            let by_depth = parts[usize::from(model.depth == Depth::SmallAngle)];
            let (amplitude, lobes) = by_depth[model.ends as usize];
            let scattered = match model.sum {
                Sum::Coherent => amplitude.norm_sqr(),
                Sum::Incoherent => lobes,
            };
            let crossed = match model.base {
                Base::Interfering => -2.0 * mirror * amplitude.re,
                _ => 0.0,
            };
            self.mirror_share(model) * mirror * mirror + crossed + scattered
        })
    }
}

/// The root of the Gaussian that has the peak and the energy of a finite scratch (form `matched_ends`).
fn matched_factor(q: f64, begin: f64, end: f64) -> f64 {
    let window = core_math::exp(-0.5 * q * q);
    // Both ends beyond 8σ, where p = q = 1 to rounding.
    if begin < -8.0 && end > 8.0 {
        return window;
    }
    let peak = along_factor(0.0, begin, end).re;
    let energy = along_factor(0.0, SQRT_2 * begin, SQRT_2 * end).re;
    if energy == 0.0 {
        return 0.0;
    }
    let narrowing = peak * peak / energy * q;
    peak * core_math::exp(-0.5 * narrowing * narrowing)
}

/// Every model of the paper's factors and the blends: two depths, two kinds of ends, two sums, five bases.
pub(super) fn all_models() -> [Model; 40] {
    std::array::from_fn(|i| Model {
        depth: [Depth::Angular, Depth::SmallAngle][i % 2],
        ends: [Ends::Finite, Ends::Infinite][i / 2 % 2],
        sum: [Sum::Coherent, Sum::Incoherent][i / 4 % 2],
        base: [Base::Interfering, Base::Added, Base::Density, Base::Peak, Base::Energy][i / 8],
    })
}

/// Directions of a vertical light: exitance at ξ.
pub(super) fn under_normal_light(xi: [f64; 2]) -> Option<Directions> {
    let beyond = xi[0] * xi[0] + xi[1] * xi[1];
    (beyond < 1.0).then(|| Directions { xi, mu_sum: 1.0 + (1.0 - beyond).sqrt() })
}

/// Width of the mirror's lobe, 1/(σk).
pub(super) fn mirror_width(light: Coherence) -> f64 {
    light.wavelength_um / (2.0 * PI * light.sigma_um)
}
