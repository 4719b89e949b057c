//! Reflectances as scalars, with their domains: what `striae eval` computes and forms are judged by.

use super::EFFECT;
use super::surface::{Coherence, Directions, StraightScratch, coherent_amplitude, svbrdf};
use crate::effect::{DomainError, Scalar};

const POSITIVE: &str = "finite, > 0";
const NOT_NEGATIVE: &str = "finite, >= 0";
const END: &str = "begin <= end; infinite for no end";
const COSINES: &str = "[0, 2]";

/// What each reference returns.
pub(super) const REFERENCES: &[(&str, Scalar)] = &[
    // |𝒮|²/(πσ²λ²) of one finite scratch.
    (SCRATCH, |arguments| {
        let (scratch, light, directions) = one(SCRATCH, arguments)?;
        Ok(scratch.amplitude(light, directions).norm_sqr())
    }),
    // |ℬ − 𝒮|²/(πσ²λ²) of one finite scratch in a smooth mirror.
    (SCRATCHED_MIRROR, |arguments| {
        let (scratch, light, directions) = one(SCRATCHED_MIRROR, arguments)?;
        Ok(svbrdf(&[scratch], light, directions))
    }),
    // |𝒮₁ + 𝒮₂|²/(πσ²λ²) of two infinite scratches.
    (PAIR, |arguments| {
        let (scratches, light, directions) = pair(arguments)?;
        Ok(coherent_amplitude(&scratches, light, directions).norm_sqr())
    }),
    // ρ_c of one finite scratch.
    (DENSITY, |arguments| {
        let [width_um, sigma_um, offset_um, begin_um, end_um] = values(DENSITY, arguments)?;
        let scratch =
            StraightScratch::along_first_axis(width_um, 0.0, offset_um, [begin_um, end_um]);
        Ok(scratch.density(sigma_um))
    }),
];

const SCRATCH: &str = "scratch_reflectance";
const SCRATCHED_MIRROR: &str = "scratched_mirror_reflectance";
const PAIR: &str = "scratch_pair_reflectance";
const DENSITY: &str = "scratch_density";

fn one(
    reference: &str,
    arguments: &[f64],
) -> Result<(StraightScratch, Coherence, Directions), DomainError> {
    let [width_um, depth_um, wavelength_um, sigma_um, along, across, offset_um, begin, end, mu_sum] =
        values(reference, arguments)?;
    Ok((
        StraightScratch::along_first_axis(width_um, depth_um, offset_um, [begin, end]),
        Coherence { wavelength_um, sigma_um },
        Directions { xi: [along, across], mu_sum },
    ))
}

fn pair(arguments: &[f64]) -> Result<([StraightScratch; 2], Coherence, Directions), DomainError> {
    let [
        width_um,
        depth_um,
        wavelength_um,
        sigma_um,
        along,
        across,
        offset_um,
        mu_sum,
        width,
        depth,
        offset,
        turn,
    ] = values(PAIR, arguments)?;
    let first = StraightScratch::infinite(offset_um, width_um, depth_um);
    let (sin, cos) = core_math::sincos(turn);
    let second = StraightScratch {
        position_um: [-offset * sin, offset * cos],
        direction_rad: turn,
        width_um: width,
        depth_um: depth,
        ..first
    };
    Ok((
        [first, second],
        Coherence { wavelength_um, sigma_um },
        Directions { xi: [along, across], mu_sum },
    ))
}

/// The arguments of `reference`, each inside its domain.
fn values<const N: usize>(reference: &str, arguments: &[f64]) -> Result<[f64; N], DomainError> {
    let values: [f64; N] = std::array::from_fn(|i| arguments.get(i).copied().unwrap_or(f64::NAN));
    let mut begin = f64::NEG_INFINITY;
    for (&value, quantity) in values.iter().zip(EFFECT.reference(reference).arguments) {
        let inside = match quantity.domain {
            POSITIVE => value.is_finite() && value > 0.0,
            NOT_NEGATIVE => value.is_finite() && value >= 0.0,
            COSINES => (0.0..=2.0).contains(&value),
            END => value >= std::mem::replace(&mut begin, value),
            _ => value.is_finite(),
        };
        DomainError::unless(inside, quantity.name, value, quantity.domain)?;
    }
    Ok(values)
}
