//! WGSL put together for one scene: its lights and wavelengths as constants, and a function of the
//! view direction. The result is a [`Form`], so lanes, device, timing and emission take it as any.
//!
//! The numbers of the scene stand in one constant array, long enough that devices read it from a
//! storage buffer, as an engine would, whatever the number of lights. Lights and wavelengths beyond
//! a bound go to further kernels, whose pictures are added, so that the work of an evaluation is bounded
//! whatever the scene.

use std::fmt::Write;

use super::illumination::{Facets, Illumination, Sphere};
use super::spectrum::Wave;
use crate::effect::Candidate;
use crate::form::Form;
use crate::render::RenderError;
use crate::render::backend::Kernel;

/// Most wavelengths, spheres or triangles of one kernel.
pub(super) const MOST: usize = 16;
/// Entries from which `gpu` moves an array into a buffer.
const LEAST_ENTRIES: usize = 32;

/// A triangle of a polygon.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    corners: [[f32; 3]; 3],
    radiance: [f64; 3],
}

/// The kernels whose sum is the picture that the given forms make.
///
/// # Errors
/// [`RenderError::Form`] if the text of a form cannot be put together with the scene's.
pub(super) fn shading(
    lit: &Illumination,
    sphere: Option<&Candidate>,
    polygon: Option<&Candidate>,
) -> Result<Vec<Kernel>, RenderError> {
    let mut kernels = Vec::new();
    for waves in lit.waves.chunks(MOST) {
        if let Some(candidate) = sphere {
            for spheres in lit.spheres.chunks(MOST) {
                let mut data = SceneData::of_waves(waves);
                data.add_spheres(spheres);
                let call = "scene_centre(light), scene_radius(light)";
                let counts = (spheres.len(), waves.len());
                kernels.push(around(candidate, &data.text(), call, counts)?);
            }
        }
        if let Some(candidate) = polygon {
            for triangles in triangles(&lit.polygons).chunks(MOST) {
                let mut data = SceneData::of_waves(waves);
                data.add_triangles(triangles);
                let call = "scene_corner_a(light), scene_corner_b(light), scene_corner_c(light)";
                let counts = (triangles.len(), waves.len());
                kernels.push(around(candidate, &data.text(), call, counts)?);
            }
        }
    }
    Ok(kernels)
}

/// The form with the scene around it.
fn around(
    candidate: &Candidate,
    scene: &str,
    light: &str,
    (lights, waves): (usize, usize),
) -> Result<Kernel, RenderError> {
    let function = candidate.form.function();
    let text = format!(
        "{}\n{scene}\
         fn scene_shade(view: vec2<f32>) -> vec3<f32> {{\n\
         \x20   var colour = vec3<f32>(0.0);\n\
         \x20   for (var light = 0u; light < {lights}u; light++) {{\n\
         \x20       for (var wave = 0u; wave < {waves}u; wave++) {{\n\
         \x20           let lobe = {function}(scene_kw(wave), scene_ks(wave), view, {light});\n\
         \x20           colour += lobe * (scene_weight(wave) * scene_radiance(light));\n\
         \x20       }}\n    }}\n    return colour;\n}}\n",
        candidate.form.source()
    );
    let form = Form::parse(candidate.form.origin(), &text, "scene_shade")?;
    let own = candidate.form.parameters();
    let constant = |name: &str| {
        own.iter()
            .zip(&candidate.constants_f32)
            .find(|(p, _)| p.name == name)
            .map(|(_, value)| *value)
    };
    // Every parameter that the shading reaches is one that the form reaches.
    let constants =
        form.parameters().iter().map(|p| constant(&p.name).unwrap_or(f32::NAN)).collect();
    Ok(Kernel { form, constants })
}

pub(super) fn triangles(polygons: &[Facets]) -> Vec<Triangle> {
    let of = |polygon: &Facets| {
        let radiance = polygon.radiance;
        let corners = polygon.triangles.clone();
        corners.into_iter().map(move |corners| Triangle { corners, radiance })
    };
    polygons.iter().flat_map(of).collect()
}

/// The numbers of a scene in one array, and the functions that read them.
pub(super) struct SceneData {
    values: Vec<f32>,
    functions: String,
}

impl SceneData {
    pub(super) fn of_waves(waves: &[Wave]) -> Self {
        let mut data = Self { values: Vec::new(), functions: String::new() };
        data.add_scalars("scene_kw", "wave", waves.iter().map(|wave| wave.kw));
        data.add_scalars("scene_ks", "wave", waves.iter().map(|wave| wave.ks));
        let weights = waves.iter().map(|wave| wave.weight.map(|x| x as f32));
        data.add_vectors("scene_weight", "wave", weights);
        data
    }

    pub(super) fn add_spheres(&mut self, spheres: &[Sphere]) {
        self.add_scalars("scene_radius", "light", spheres.iter().map(|sphere| sphere.radius));
        self.add_vectors("scene_centre", "light", spheres.iter().map(|sphere| sphere.centre));
        self.add_radiances(spheres.iter().map(|sphere| sphere.radiance));
    }

    pub(super) fn add_triangles(&mut self, triangles: &[Triangle]) {
        let names = ["scene_corner_a", "scene_corner_b", "scene_corner_c"];
        for (corner, name) in names.into_iter().enumerate() {
            let points = triangles.iter().filter_map(|t| t.corners.get(corner).copied());
            self.add_vectors(name, "light", points);
        }
        self.add_radiances(triangles.iter().map(|triangle| triangle.radiance));
    }

    fn add_radiances(&mut self, radiances: impl Iterator<Item = [f64; 3]>) {
        self.add_vectors("scene_radiance", "light", radiances.map(|rgb| rgb.map(|x| x as f32)));
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
        let component = |c: usize| format!("SCENE_DATA[{}u + 3u * {index}]", first + c);
        let _ = writeln!(
            self.functions,
            "fn {name}({index}: u32) -> vec3<f32> {{ return vec3<f32>({}, {}, {}); }}",
            component(0),
            component(1),
            component(2)
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
