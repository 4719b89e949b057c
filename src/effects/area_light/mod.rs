//! Area lights on a scratch with rectangular profile, in direction-cosine space (velinov2018 §3.4):
//! [`band`] along the lobe of the scratch, [`lights`] in both directions.

pub mod band;
pub mod lights;

pub use lights::{polygon_light, sphere_light};

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Goal};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/area_light/forms");

/// The effect, as registered.
pub const EFFECT: Effect = Effect {
    name: "area_light",
    title: "Area lights",
    description: "Light of an area source that a scratch of width W diffracts towards the eye: \
                  exp(-(k sigma xi_1)^2) sinc^2(kW xi_2/2) integrated over the direction cosines xi that a \
                  sphere or a polygon spans, and sinc^2(kWq/2) over the difference q that it spans \
                  across the scratch.",
    references: &[band::REFERENCE, lights::SPHERE, lights::TRIANGLE],
    forms: || FormText::embedded("src/effects/area_light/forms", &FORMS),
    regions: &{
        let [small_spheres, large_spheres, limbs, grazing_spheres, triangles @ ..] =
            lights::REGIONS;
        let [small_triangles, large_triangles, vertices, grazing_triangles] = triangles;
        [
            band::LOBES,
            band::SCENE_BANDS,
            band::NARROW,
            small_spheres,
            large_spheres,
            limbs,
            grazing_spheres,
            small_triangles,
            large_triangles,
            vertices,
            grazing_triangles,
        ]
    },
    hard_cases: &{
        let [spheres, triangles] = lights::HARD_CASES;
        [band::HARD_CASES, spheres, triangles]
    },
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
    claims: &{
        let [normalisation, whole_lobes, half_lobes, tail, discrepancies] = band::CLAIMS;
        let [
            exponent,
            largest_deviation,
            disc,
            second_root,
            sign_of_zero,
            coherence,
            single_line,
            normalization,
        ] = lights::CLAIMS;
        [
            normalisation,
            whole_lobes,
            half_lobes,
            tail,
            discrepancies,
            exponent,
            largest_deviation,
            disc,
            second_root,
            sign_of_zero,
            coherence,
            single_line,
            normalization,
        ]
    },
    exhibits: |candidates| {
        let mut all = band::exhibits(candidates)?;
        all.extend(lights::exhibits(candidates)?);
        Ok(all)
    },
    ..Effect::EMPTY
};
