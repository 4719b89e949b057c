//! Area lights on a scratch with rectangular profile, in direction-cosine space (velinov2018 §3.4):
//! [`band`] along the lobe of the scratch, [`lights`] in both directions.

pub mod band;
pub mod lights;

pub use lights::{polygon_light, sphere_light};

use crate::effect::{Effect, Goal};

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "area_light",
    title: "Area lights",
    description: "Light of an area source that a scratch of width W diffracts towards the eye: \
                  exp(-(k sigma xi_1)^2) sinc^2(kW xi_2/2) integrated over the direction cosines xi that a \
                  sphere or a polygon spans, and sinc^2(kWq/2) over the difference q that it spans \
                  across the scratch.",
    references: &[band::REFERENCE, lights::SPHERE, lights::TRIANGLE],
    forms: &joined::<_, 8, 28, 36>(
        [
            band::PRINTED,
            band::PRINTED_SMALL,
            band::PRINTED_MEDIUM,
            band::PRINTED_LEAN,
            band::PRINTED_LARGE,
            band::LEAN,
            band::MEDIUM,
            band::LARGE,
        ],
        lights::FORMS,
    ),
    simulators: &[],
    families: &[],
    regions: &joined::<_, 3, 8, 11>(
        [band::LOBES, band::SCENE_BANDS, band::NARROW],
        lights::REGIONS,
    ),
    hard_cases: &joined::<_, 1, 2, 3>([band::HARD_CASES], lights::HARD_CASES),
    laws: &[
        band::ANTISYMMETRIC,
        band::POSITIVE,
        band::EVEN,
        band::ADDITIVE,
        band::TOTAL,
        lights::NOT_NEGATIVE,
    ],
    goals: &[
        Goal {
            fit: "area_light/band_medium",
            region: "lobes",
            error: 1e-3,
            cost: 1.5,
            why: "every side lobe and half lobe to n = 1000 in f32, at no more than half as much \
                  again as eq. 27 with eq. 29",
        },
        Goal {
            fit: "area_light/band_large",
            region: "lobes",
            error: 1e-3,
            cost: 1.5,
            why: "the same, to a few ulp",
        },
        Goal {
            fit: "area_light/band_lean",
            region: "lobes",
            error: 1e-3,
            cost: 1.0,
            why: "the same for less than eq. 27 with eq. 29 costs",
        },
    ],
    baselines: &[
        "area_light/band_printed",
        "area_light/sphere_line_printed",
        "area_light/triangle_line_printed",
    ],
    claims: &joined::<_, 5, 8, 13>(band::CLAIMS, lights::CLAIMS),
    exhibits: |candidates| {
        let mut all = band::exhibits(candidates)?;
        all.extend(lights::exhibits(candidates)?);
        Ok(all)
    },
};

/// The entries of both lists, A + B = N.
const fn joined<T: Copy, const A: usize, const B: usize, const N: usize>(
    first: [T; A],
    second: [T; B],
) -> [T; N] {
    assert!(A + B == N);
    let mut all = [first[0]; N];
    let mut at = 0;
    while at < N {
        all[at] = if at < A { first[at] } else { second[at - A] };
        at += 1;
    }
    all
}
