//! WGSL put together for one scene: its lights and wavelengths as constants, and a function of the
//! view direction. The result is a [`Form`], so lanes, device, timing and emission take it as any.
//!
//! The numbers of the scene stand in one constant array, long enough that devices read it from a
//! storage buffer, as an engine would, whatever the number of lights. Lights and wavelengths beyond
//! a bound go to further kernels, whose pictures are added, so that the work of an evaluation is bounded
//! whatever the scene.

use std::fmt::Write;

use crate::form::Form;

use super::error::RenderError;
use super::illumination::{Facets, Illumination, Sphere};
use super::light_form::{LightForm, LightKind};
use super::monte_carlo;
use super::scene::SAMPLES_PER_PASS;
use super::spectrum::Wave;

/// Most wavelengths, spheres or triangles of one kernel.
const MOST: usize = 16;
/// Entries from which `gpu` moves an array into a buffer.
const LEAST_ENTRIES: usize = 32;

/// A kernel of the view direction, and further columns for Monte Carlo, with its constants.
#[derive(Debug, Clone)]
pub struct Kernel {
    /// The form: returns R, G, B.
    pub form: Form,
    /// One value per parameter of the form.
    pub constants: Vec<f32>,
}

/// A triangle of a polygon.
#[derive(Debug, Clone, Copy)]
struct Triangle {
    corners: [[f32; 3]; 3],
    radiance: [f64; 3],
}

/// The kernels whose sum is the picture that the given forms make.
///
/// # Errors
/// [`RenderError::Form`] if the text of a form cannot be put together with the scene's.
pub fn shading(
    lit: &Illumination,
    sphere: Option<&LightForm>,
    polygon: Option<&LightForm>,
) -> Result<Vec<Kernel>, RenderError> {
    let mut kernels = Vec::new();
    for waves in lit.waves.chunks(MOST) {
        if let Some(light_form) = sphere {
            for spheres in lit.spheres.chunks(MOST) {
                let mut data = SceneData::of_waves(waves);
                data.add_spheres(spheres);
                let call = "scene_centre(light), scene_radius(light)";
                let counts = (spheres.len(), waves.len());
                kernels.push(around(light_form, &data.text(), call, counts)?);
            }
        }
        if let Some(light_form) = polygon {
            for triangles in triangles(&lit.polygons).chunks(MOST) {
                let mut data = SceneData::of_waves(waves);
                data.add_triangles(triangles);
                let call = "scene_corner_a(light), scene_corner_b(light), scene_corner_c(light)";
                let counts = (triangles.len(), waves.len());
                kernels.push(around(light_form, &data.text(), call, counts)?);
            }
        }
    }
    Ok(kernels)
}

/// The kernels whose sum is one pass of Monte Carlo over the lights: inputs view, pixel and first
/// sample.
///
/// # Errors
/// [`RenderError::Form`] if the text does not load.
pub fn sampling(lit: &Illumination, seed: u64) -> Result<Vec<Kernel>, RenderError> {
    let mut kernels = Vec::new();
    let mut load =
        |kind: LightKind, waves: &[Wave], first: usize, lights: usize, data: SceneData| {
            let counts = format!(
                "const SCENE_LIGHTS: u32 = {lights}u;\nconst SCENE_WAVES: u32 = {}u;\n\
             const SCENE_FIRST_LIGHT: u32 = {first}u;\nconst SCENE_SEED: u32 = {}u;\n\
             const SCENE_DRAWS: u32 = {SAMPLES_PER_PASS}u;\n",
                waves.len(),
                monte_carlo::seed_word(seed, kind)
            );
            let text = [monte_carlo::text(kind), &counts, &data.text()].concat();
            let origin = format!("monte_carlo_{}.wgsl", kind.word());
            let form = Form::parse(&origin, &text, "radiance")?;
            kernels.push(Kernel { form, constants: Vec::new() });
            Ok::<(), RenderError>(())
        };
    for waves in lit.waves.chunks(MOST) {
        for (at, spheres) in lit.spheres.chunks(MOST).enumerate() {
            let mut data = SceneData::of_waves(waves);
            data.add_spheres(spheres);
            monte_carlo::add_cones(&mut data, spheres);
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

/// The form with the scene around it.
fn around(
    light_form: &LightForm,
    scene: &str,
    light: &str,
    (lights, waves): (usize, usize),
) -> Result<Kernel, RenderError> {
    let function = light_form.form.function();
    let text = format!(
        "{}\n{scene}\
         fn scene_shade(view: vec2<f32>) -> vec3<f32> {{\n\
         \x20   var colour = vec3<f32>(0.0);\n\
         \x20   for (var light = 0u; light < {lights}u; light++) {{\n\
         \x20       for (var wave = 0u; wave < {waves}u; wave++) {{\n\
         \x20           let lobe = {function}(scene_kw(wave), scene_ks(wave), view, {light});\n\
         \x20           colour += lobe * (scene_weight(wave) * scene_radiance(light));\n\
         \x20       }}\n    }}\n    return colour;\n}}\n",
        light_form.form.source()
    );
    let form = Form::parse(light_form.form.origin(), &text, "scene_shade")?;
    let own = light_form.form.parameters();
    let constant = |name: &str| {
        own.iter().zip(&light_form.constants).find(|(p, _)| p.name == name).map(|(_, value)| *value)
    };
    // Every parameter that the shading reaches is one that the form reaches.
    let constants =
        form.parameters().iter().map(|p| constant(&p.name).unwrap_or(f32::NAN)).collect();
    Ok(Kernel { form, constants })
}

fn triangles(polygons: &[Facets]) -> Vec<Triangle> {
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
    fn of_waves(waves: &[Wave]) -> Self {
        let mut data = Self { values: Vec::new(), functions: String::new() };
        data.add_scalars("scene_kw", "wave", waves.iter().map(|wave| wave.kw));
        data.add_scalars("scene_ks", "wave", waves.iter().map(|wave| wave.ks));
        let weights = waves.iter().map(|wave| wave.weight.map(|x| x as f32));
        data.add_vectors("scene_weight", "wave", weights);
        data
    }

    fn add_spheres(&mut self, spheres: &[Sphere]) {
        self.add_scalars("scene_radius", "light", spheres.iter().map(|sphere| sphere.radius));
        self.add_vectors("scene_centre", "light", spheres.iter().map(|sphere| sphere.centre));
        self.add_radiances(spheres.iter().map(|sphere| sphere.radiance));
    }

    fn add_triangles(&mut self, triangles: &[Triangle]) {
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

    fn text(mut self) -> String {
        let length = self.values.len().max(LEAST_ENTRIES);
        self.values.resize(length, 0.0);
        let entries: Vec<String> = self.values.iter().map(|value| format!("{value:e}")).collect();
        let list = entries.join(", ");
        format!("const SCENE_DATA = array<f32, {length}>({list});\n{}", self.functions)
    }
}
