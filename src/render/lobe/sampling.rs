//! Monte Carlo over the lights of a scratch: kernels of one pass.
//!
//! Directions are uniform in the cone of a sphere, points uniform on the triangles of a polygon.

use super::LightKind;
use super::illumination::{Illumination, Sphere};
use super::kernel::{MOST, SceneData, triangles};
use super::spectrum::Wave;
use crate::form::Form;
use crate::render::RenderError;
use crate::render::backend::Kernel;
use crate::render::monte_carlo::{RANDOM, seed_word};
use crate::render::scene::SAMPLES_PER_PASS;

/// The kernels whose sum is one pass of Monte Carlo over the lights: inputs view, pixel and first
/// sample.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub(super) fn kernels(lit: &Illumination, seed: u64) -> Result<Vec<Kernel>, RenderError> {
    let mut kernels = Vec::new();
    let mut load =
        |kind: LightKind, waves: &[Wave], first: usize, lights: usize, data: SceneData| {
            let counts = format!(
                "const SCENE_LIGHTS: u32 = {lights}u;\nconst SCENE_WAVES: u32 = {}u;\n\
             const SCENE_FIRST_LIGHT: u32 = {first}u;\nconst SCENE_SEED: u32 = {}u;\n\
             const SCENE_DRAWS: u32 = {SAMPLES_PER_PASS}u;\n",
                waves.len(),
                seed_word(seed, salt(kind))
            );
            let text = [text(kind), RANDOM, LOBE, &counts, &data.text()].concat();
            let origin = format!("monte_carlo_{}.wgsl", kind.word());
            let form = Form::parse(&origin, &text, "radiance")?;
            kernels.push(Kernel { form, constants: Vec::new() });
            Ok::<(), RenderError>(())
        };
    for waves in lit.waves.chunks(MOST) {
        for (at, spheres) in lit.spheres.chunks(MOST).enumerate() {
            let mut data = SceneData::of_waves(waves);
            data.add_spheres(spheres);
            add_cones(&mut data, spheres);
            load(LightKind::Sphere, waves, at * MOST, spheres.len(), data)?;
        }
        for (at, triangles) in triangles(&lit.polygons).chunks(MOST).enumerate() {
            let mut data = SceneData::of_waves(waves);
            data.add_triangles(triangles);
            load(LightKind::Polygon, waves, at * MOST, triangles.len(), data)?;
        }
    }
    Ok(kernels)
}

/// The lobe of a scratch in a direction.
const LOBE: &str = include_str!("monte_carlo_lobe.wgsl");

/// The text around the scene's constants for one kind of light.
fn text(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Sphere => include_str!("monte_carlo_sphere.wgsl"),
        LightKind::Polygon => include_str!("monte_carlo_polygon.wgsl"),
    }
}

/// What keeps the random numbers of spheres and polygons apart.
fn salt(kind: LightKind) -> u32 {
    match kind {
        LightKind::Sphere => 0x9e37_79b9,
        LightKind::Polygon => 0x7f4a_7c15,
    }
}

/// Adds the axes of the cones that spheres fill, and 1 − cos of their half-angles.
fn add_cones(data: &mut SceneData, spheres: &[Sphere]) {
    let cones: Vec<Cone> = spheres.iter().map(Cone::of).collect();
    data.add_scalars("scene_cone", "light", cones.iter().map(|cone| cone.versine));
    for (at, name) in ["scene_axis", "scene_tangent", "scene_bitangent"].into_iter().enumerate() {
        data.add_vectors(name, "light", cones.iter().filter_map(|cone| cone.axes.get(at).copied()));
    }
}

/// The cone of directions in which a sphere is seen from the origin.
struct Cone {
    versine: f32,
    axes: [[f32; 3]; 3],
}

impl Cone {
    fn of(sphere: &Sphere) -> Self {
        let centre = nalgebra::Vector3::from(sphere.centre.map(f64::from));
        let axis = centre.normalize();
        let sine = f64::from(sphere.radius) / centre.norm();
        // 1 − cos = sin² / (1 + cos) keeps its digits for small lights.
        let versine = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
        let side = if axis.x.abs() < 0.5 { nalgebra::Vector3::x() } else { nalgebra::Vector3::y() };
        let tangent = side.cross(&axis).normalize();
        let axes = [axis, tangent, axis.cross(&tangent)];
        Self { versine: versine as f32, axes: axes.map(|v| v.map(|x| x as f32).into()) }
    }
}
