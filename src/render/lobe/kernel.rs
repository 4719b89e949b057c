//! WGSL put together for one scene: its lights and wavelengths as constants, and a function of the
//! view direction. The result is a [`Form`], so lanes, device, timing and emission take it as any.
//!
//! The numbers of the scene stand in one constant array, long enough that devices read it from a
//! storage buffer, as an engine would, whatever the number of lights. Lights and wavelengths beyond
//! a bound go to further kernels, whose pictures are added, so that the work of an evaluation is bounded
//! whatever the scene.

use std::fmt::Write;

use super::illumination::{Illumination, Sphere, Triangle};
use super::spectrum::Wave;
use super::{Forms, LightKind};
use crate::effect::Candidate;
use crate::form::Form;
use crate::render::RenderError;
use crate::render::backend::Kernel;

/// Most wavelengths, spheres or triangles of one kernel.
const MOST: usize = 16;
/// Entries from which `gpu` moves an array into a buffer.
const LEAST_ENTRIES: usize = 32;

/// What one kernel adds up: lights of one kind, so that the other list is empty, and wavelengths.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    pub(super) kind: LightKind,
    pub(super) spheres: &'a [Sphere],
    pub(super) triangles: &'a [Triangle],
    /// Place of the first light among those of its kind.
    pub(super) first: usize,
    pub(super) waves: &'a [Wave],
}

impl Part<'_> {
    /// Number of lights.
    pub(super) fn count(&self) -> usize {
        self.spheres.len() + self.triangles.len()
    }
}

/// A scene in parts that a kernel can take each.
pub(super) fn parts(lit: &Illumination) -> impl Iterator<Item = Part<'_>> {
    lit.waves.chunks(MOST).flat_map(|waves| {
        let none = Part { kind: LightKind::Sphere, spheres: &[], triangles: &[], first: 0, waves };
        let spheres = lit.spheres.chunks(MOST).enumerate();
        let triangles = lit.triangles.chunks(MOST).enumerate();
        let spheres = spheres.map(move |(at, spheres)| Part { spheres, first: at * MOST, ..none });
        spheres.chain(triangles.map(move |(at, triangles)| Part {
            kind: LightKind::Polygon,
            triangles,
            first: at * MOST,
            ..none
        }))
    })
}

/// The kernels whose sum is the picture that the given forms make.
///
/// # Errors
/// [`RenderError::Form`] if the text of a form cannot be put together with the scene's.
pub(super) fn shading(lit: &Illumination, forms: &Forms) -> Result<Vec<Kernel>, RenderError> {
    let of = |part: Part<'_>| Some(around(forms.of(part.kind)?, &part));
    parts(lit).filter_map(of).collect()
}

/// The form with the scene around it.
fn around(candidate: &Candidate, part: &Part<'_>) -> Result<Kernel, RenderError> {
    let light = match part.kind {
        LightKind::Sphere => "scene_centre(light), scene_radius(light)",
        LightKind::Polygon => "scene_corner_a(light), scene_corner_b(light), scene_corner_c(light)",
    };
    let text = format!(
        "{}\n{scene}\
         fn scene_shade(view: vec2<f32>) -> vec3<f32> {{\n\
         \x20   var colour = vec3<f32>(0.0);\n\
         \x20   for (var light = 0u; light < {lights}u; light++) {{\n\
         \x20       for (var wave = 0u; wave < {waves}u; wave++) {{\n\
         \x20           let lobe = {function}(scene_kw(wave), scene_ks(wave), view, {light});\n\
         \x20           colour += lobe * (scene_weight(wave) * scene_radiance(light));\n\
         \x20       }}\n    }}\n    return colour;\n}}\n",
        candidate.form.source(),
        scene = SceneData::of(part).text(),
        lights = part.count(),
        waves = part.waves.len(),
        function = candidate.form.function(),
    );
    let form = Form::parse(candidate.form.origin(), &text, "scene_shade")?;
    let own = candidate.form.parameters().iter().zip(&candidate.constants_f32);
    // Every parameter that the shading reaches is one that the form reaches.
    let constant =
        |name: &str| own.clone().find(|(p, _)| p.name == name).map_or(f32::NAN, |c| *c.1);
    let constants = form.parameters().iter().map(|p| constant(&p.name)).collect();
    Ok(Kernel { form, constants })
}

/// The numbers of a scene in one array, and the functions that read them.
#[derive(Default)]
pub(super) struct SceneData {
    values: Vec<f32>,
    functions: String,
}

impl SceneData {
    pub(super) fn of(part: &Part<'_>) -> Self {
        let narrow = |rgb: [f64; 3]| rgb.map(|x| x as f32);
        let mut data = Self::default();
        data.add_scalars("scene_kw", "wave", part.waves.iter().map(|wave| wave.kw));
        data.add_scalars("scene_ks", "wave", part.waves.iter().map(|wave| wave.ks));
        data.add_vectors("scene_weight", "wave", part.waves.iter().map(|wave| narrow(wave.weight)));
        if part.kind == LightKind::Sphere {
            data.add_scalars("scene_radius", "light", part.spheres.iter().map(|s| s.radius));
            data.add_vectors("scene_centre", "light", part.spheres.iter().map(|s| s.centre));
        } else {
            let names = ["scene_corner_a", "scene_corner_b", "scene_corner_c"];
            for (corner, name) in names.into_iter().enumerate() {
                let corners = part.triangles.iter().map(|triangle| triangle.corners[corner]);
                data.add_vectors(name, "light", corners);
            }
        }
        let radiances = part.spheres.iter().map(|sphere| sphere.radiance);
        let radiances = radiances.chain(part.triangles.iter().map(|triangle| triangle.radiance));
        data.add_vectors("scene_radiance", "light", radiances.map(narrow));
        data
    }

    /// Adds a number per index, read by the function `name`.
    pub(super) fn add_scalars(
        &mut self,
        name: &str,
        index: &str,
        values: impl Iterator<Item = f32>,
    ) {
        let first = self.values.len();
        self.values.extend(values);
        // Writing to a String cannot fail.
        let _ = writeln!(
            self.functions,
            "fn {name}({index}: u32) -> f32 {{ return SCENE_DATA[{first}u + {index}]; }}"
        );
    }

    /// Adds a vector per index, read by the function `name`.
    pub(super) fn add_vectors(
        &mut self,
        name: &str,
        index: &str,
        values: impl Iterator<Item = [f32; 3]>,
    ) {
        let first = self.values.len();
        self.values.extend(values.flatten());
        let [x, y, z] = [0, 1, 2].map(|c| format!("SCENE_DATA[{}u + 3u * {index}]", first + c));
        let _ = writeln!(
            self.functions,
            "fn {name}({index}: u32) -> vec3<f32> {{ return vec3<f32>({x}, {y}, {z}); }}"
        );
    }

    pub(super) fn text(mut self) -> String {
        let length = self.values.len().max(LEAST_ENTRIES);
        self.values.resize(length, 0.0);
        let entries: Vec<String> = self.values.iter().map(|value| format!("{value:e}")).collect();
        let list = entries.join(", ");
        format!("const SCENE_DATA = array<f32, {length}>({list});\n{}", self.functions)
    }
}
