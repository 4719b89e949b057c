//! Monte Carlo over the lights of a scratch: kernels of one pass.
//!
//! Directions are uniform in the cone of a sphere, points uniform on the triangles of a polygon.

use super::LightKind;
use super::illumination::{Illumination, Sphere};
use super::kernel::{SceneData, parts};
use crate::form::Form;
use crate::render::RenderError;
use crate::render::backend::Kernel;
use crate::render::monte_carlo::{RANDOM, seed_word};
use crate::render::scene::SAMPLES_PER_PASS;

/// The lobe of a scratch in a direction.
const LOBE: &str = include_str!("monte_carlo_lobe.wgsl");

/// The kernels whose sum is one pass of Monte Carlo over the lights: inputs view, pixel and first
/// sample.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub(super) fn kernels(lit: &Illumination, seed: u64) -> Result<Vec<Kernel>, RenderError> {
    parts(lit)
        .map(|part| {
            // The text around the constants, and what keeps the random numbers of both kinds apart.
            let (text, salt) = match part.kind {
                LightKind::Sphere => (include_str!("monte_carlo_sphere.wgsl"), 0x9e37_79b9),
                LightKind::Polygon => (include_str!("monte_carlo_polygon.wgsl"), 0x7f4a_7c15),
            };
            let counts = format!(
                "const SCENE_LIGHTS: u32 = {}u;\nconst SCENE_WAVES: u32 = {}u;\n\
                 const SCENE_FIRST_LIGHT: u32 = {}u;\nconst SCENE_SEED: u32 = {}u;\n\
                 const SCENE_DRAWS: u32 = {SAMPLES_PER_PASS}u;\n",
                part.count(),
                part.waves.len(),
                part.first,
                seed_word(seed, salt)
            );
            let mut data = SceneData::of(&part);
            if part.kind == LightKind::Sphere {
                add_cones(&mut data, part.spheres);
            }
            let text = [text, RANDOM, LOBE, &counts, &data.text()].concat();
            let origin = format!("monte_carlo_{}.wgsl", part.kind.word());
            let form = Form::parse(&origin, &text, "radiance")?;
            Ok(Kernel { form, constants: Vec::new() })
        })
        .collect()
}

/// Adds the axes of the cones of directions in which spheres are seen from the origin, and 1 − cos of
/// their half-angles.
fn add_cones(data: &mut SceneData, spheres: &[Sphere]) {
    let versine = |sphere: &Sphere| {
        let centre = nalgebra::Vector3::from(sphere.centre.map(f64::from));
        let sine = f64::from(sphere.radius) / centre.norm();
        // 1 − cos = sin² / (1 + cos) keeps its digits for small lights.
        (sine * sine / (1.0 + (1.0 - sine * sine).sqrt())) as f32
    };
    data.add_scalars("scene_cone", "light", spheres.iter().map(versine));
    let axes = |sphere: &Sphere| -> [[f32; 3]; 3] {
        let axis = nalgebra::Vector3::from(sphere.centre.map(f64::from)).normalize();
        let side = if axis.x.abs() < 0.5 { nalgebra::Vector3::x() } else { nalgebra::Vector3::y() };
        let tangent = side.cross(&axis).normalize();
        [axis, tangent, axis.cross(&tangent)].map(|v| v.map(|x| x as f32).into())
    };
    for (at, name) in ["scene_axis", "scene_tangent", "scene_bitangent"].into_iter().enumerate() {
        data.add_vectors(name, "light", spheres.iter().map(|sphere| axes(sphere)[at]));
    }
}
