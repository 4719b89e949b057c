//! Reflectances as scalars, with their domains: what `striae eval` computes and forms are judged by.

use super::surface::{Coherence, Directions, StraightScratch, coherent_amplitude, svbrdf};
use crate::effect::{DomainError, Evaluate, Quantity, Reference};

const fn quantity(name: &'static str, unit: &'static str, domain: &'static str) -> Quantity {
    Quantity { name, unit, domain }
}

const POSITIVE: &str = "finite, > 0";
const NOT_NEGATIVE: &str = "finite, >= 0";
const FINITE: &str = "finite";
const END: &str = "begin <= end; infinite for no end";
const COSINES: &str = "[0, 2]";

/// One scratch: arguments of [`SCRATCH`] and [`SCRATCHED_MIRROR`].
const ONE: &[Quantity] = &[
    quantity("width_um", "um", POSITIVE),
    quantity("depth_um", "um", NOT_NEGATIVE),
    quantity("wavelength_um", "um", POSITIVE),
    quantity("sigma_um", "um", POSITIVE),
    quantity("xi_along", "1", FINITE),
    quantity("xi_across", "1", FINITE),
    quantity("offset_um", "um", FINITE),
    quantity("begin_um", "um", END),
    quantity("end_um", "um", END),
    quantity("mu_sum", "1", COSINES),
];

const PAIR_ARGUMENTS: &[Quantity] = &[
    quantity("width_um", "um", POSITIVE),
    quantity("depth_um", "um", NOT_NEGATIVE),
    quantity("wavelength_um", "um", POSITIVE),
    quantity("sigma_um", "um", POSITIVE),
    quantity("xi_along", "1", FINITE),
    quantity("xi_across", "1", FINITE),
    quantity("offset_um", "um", FINITE),
    quantity("mu_sum", "1", COSINES),
    quantity("second_width_um", "um", POSITIVE),
    quantity("second_depth_um", "um", NOT_NEGATIVE),
    quantity("second_offset_um", "um", FINITE),
    quantity("turn_rad", "rad", FINITE),
];

const DENSITY_ARGUMENTS: &[Quantity] = &[
    quantity("width_um", "um", POSITIVE),
    quantity("sigma_um", "um", POSITIVE),
    quantity("offset_um", "um", FINITE),
    quantity("begin_um", "um", END),
    quantity("end_um", "um", END),
];

const ACCURACY: &str = "error <= 1e-12 of the largest value over all directions, for depths up to 100 wavelengths \
     (tests/scratch_response.rs)";

/// |𝒮|²/(πσ²λ²) of one finite scratch.
pub(super) const SCRATCH: Reference = Reference {
    name: "scratch_reflectance",
    description: "reflectance |S|^2/(pi sigma^2 lambda^2) of one finite scratch, with the depth phase \
                  at its angles",
    arguments: ONE,
    unit: "1/sr",
    accuracy: ACCURACY,
    source: "velinov2018 eq. 2, 3, 5; fig. 3 for the depth phase",
    evaluate: Evaluate::Scalar(|arguments| {
        let (scratch, light, directions) = one(arguments)?;
        Ok(scratch.amplitude(light, directions).norm_sqr())
    }),
};

/// |ℬ − 𝒮|²/(πσ²λ²) of one finite scratch in a smooth mirror.
pub(super) const SCRATCHED_MIRROR: Reference = Reference {
    name: "scratched_mirror_reflectance",
    description: "reflectance |B - S|^2/(pi sigma^2 lambda^2) of a smooth mirror with one finite scratch, \
                  interference included",
    arguments: ONE,
    unit: "1/sr",
    accuracy: ACCURACY,
    source: "velinov2018 eq. 1 with B = 2 pi sigma^2 exp(-sigma^2 k^2 |xi|^2 / 2)",
    evaluate: Evaluate::Scalar(|arguments| {
        let (scratch, light, directions) = one(arguments)?;
        Ok(svbrdf(&[scratch], light, directions))
    }),
};

/// |𝒮₁ + 𝒮₂|²/(πσ²λ²) of two infinite scratches.
pub(super) const PAIR: Reference = Reference {
    name: "scratch_pair_reflectance",
    description: "reflectance |S + S'|^2/(pi sigma^2 lambda^2) of two infinite scratches, the second turned \
                  counterclockwise by turn_rad; xi is in the frame of the first",
    arguments: PAIR_ARGUMENTS,
    unit: "1/sr",
    accuracy: ACCURACY,
    source: "velinov2018 eq. 2, 3, 8; fig. 3 for the depth phase",
    evaluate: Evaluate::Scalar(|arguments| {
        let (scratches, light, directions) = pair(arguments)?;
        Ok(coherent_amplitude(&scratches, light, directions).norm_sqr())
    }),
};

/// ρ_c of one finite scratch.
pub(super) const DENSITY: Reference = Reference {
    name: "scratch_density",
    description: "scratch area density rho_c: W/(pi sigma^2) times the length of a finite scratch under \
                  the Gaussian window",
    arguments: DENSITY_ARGUMENTS,
    unit: "1",
    accuracy: "error <= 1e-12 of the infinite scratch's (tests/scratch_response.rs)",
    source: "velinov2018 eq. 17, first line",
    evaluate: Evaluate::Scalar(|arguments| {
        let [width_um, sigma_um, offset_um, begin_um, end_um] =
            values(arguments, DENSITY_ARGUMENTS)?;
        let scratch = along_first_axis(width_um, 0.0, offset_um, [begin_um, end_um]);
        Ok(scratch.density(sigma_um))
    }),
};

/// A scratch along the first axis, in whose frame ξ is then given.
fn along_first_axis(
    width_um: f64,
    depth_um: f64,
    offset_um: f64,
    ends: [f64; 2],
) -> StraightScratch {
    let [begin_um, end_um] = ends;
    StraightScratch {
        position_um: [0.0, offset_um],
        direction_rad: 0.0,
        begin_um,
        end_um,
        width_um,
        depth_um,
    }
}

fn one(arguments: &[f64]) -> Result<(StraightScratch, Coherence, Directions), DomainError> {
    let [width_um, depth_um, wavelength_um, sigma_um, along, across, offset_um, begin, end, mu_sum] =
        values(arguments, ONE)?;
    Ok((
        along_first_axis(width_um, depth_um, offset_um, [begin, end]),
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
    ] = values(arguments, PAIR_ARGUMENTS)?;
    let first = along_first_axis(width_um, depth_um, offset_um, [0.0; 2]).unbounded();
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

/// The arguments, each inside its domain.
fn values<const N: usize>(
    arguments: &[f64],
    quantities: &[Quantity],
) -> Result<[f64; N], DomainError> {
    let values: [f64; N] = std::array::from_fn(|i| arguments.get(i).copied().unwrap_or(f64::NAN));
    let mut begin = f64::NEG_INFINITY;
    for (&value, quantity) in values.iter().zip(quantities) {
        let inside = match quantity.domain {
            POSITIVE => value.is_finite() && value > 0.0,
            NOT_NEGATIVE => value.is_finite() && value >= 0.0,
            COSINES => (0.0..=2.0).contains(&value),
            END => value >= std::mem::replace(&mut begin, value),
            _ => value.is_finite(),
        };
        if !inside {
            return Err(DomainError {
                quantity: quantity.name,
                expected: quantity.domain,
                got: value,
            });
        }
    }
    Ok(values)
}
