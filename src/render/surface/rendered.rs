//! A surface scene rendered: the reference, every approximation, how they compare, and which is the
//! cheapest that will do.

use std::path::Path;

use nalgebra::Vector3;

use super::angles::{AngleError, by_angle};
use super::integral::integrals;
use super::material::Material;
use super::methods::{Plan, Surroundings};
use super::scene::{Method, ReferenceMethod, SurfaceScene};
use super::shape::{Frame, Point, Shape};
use super::speed::{self, ConvolutionTimes};
use super::sums::{table_taps, timed};
use crate::measured::environment::Environment;
use crate::measured::spectra::Spectra;
use crate::numeric::measured::Measured;
use crate::render::backend::Backend;
use crate::render::compare::error_map::ErrorMap;
use crate::render::image::Image;
use crate::render::rendered::{Metrics, over_budget};
use crate::render::scene::{self, Budget};
use crate::render::sphere_map::{AzimuthalOperator, SphereMap, TimedPass};
use crate::render::{Event, RenderError, Resources};

/// Share of the table's energy that sums at every pixel leave out.
const LEFT_OUT: f64 = 1e-4;

/// A surface scene with everything that is made once: its table, points and reference.
#[derive(Debug)]
pub struct PreparedSurface {
    /// The scene.
    pub scene: SurfaceScene,
    /// Table and kernels.
    pub material: Material,
    /// The reference, frames beside each other.
    pub reference: Image,
    frames: Vec<Lit>,
    operator: AzimuthalOperator,
}

/// One frame: what is seen of the surface, and what it is lit by.
#[derive(Debug)]
struct Lit {
    /// Pixel and point, where the surface is met.
    pixels: Vec<usize>,
    points: Vec<Point>,
    surroundings: Surroundings,
}

/// Everything that a surface scene asks for.
#[derive(Debug, Clone)]
pub struct RenderedSurface {
    /// The reference, frames beside each other.
    pub reference: Image,
    /// How it was made.
    pub method: ReferenceMethod,
    /// One per approximation, in the order of the scene.
    pub approximations: Vec<SurfaceApproximation>,
    /// What convolutions cost.
    pub times: Measured<ConvolutionTimes>,
    /// What n = ω_o = r_v costs, by incidence angle, in the first frame.
    pub by_angle: Vec<AngleError>,
    /// The cheapest within the limits of the scene, or why there is none.
    pub choice: Option<Result<String, String>>,
    /// R, G, B that the surface returns of a uniform environment.
    pub albedo: [f64; 3],
    /// Directions of the main axes of the table, degrees.
    pub directions_deg: [f64; 2],
    /// Where the kernels ran.
    pub backend: String,
}

/// An approximation, rendered and compared.
#[derive(Debug, Clone)]
pub struct SurfaceApproximation {
    /// Name.
    pub name: String,
    /// How it was made.
    pub method: Method,
    /// Its image.
    pub image: Image,
    /// Where it errs.
    pub error: ErrorMap,
    /// How it differs from the reference.
    pub metrics: Metrics,
    /// ms of the convolution of one frame on the device.
    pub ms: Measured<f64>,
    /// Its budget.
    pub budget: Option<Budget>,
}

impl SurfaceApproximation {
    /// What of its budget is exceeded, in words.
    pub fn over_budget(&self) -> Vec<String> {
        over_budget(&self.name, &self.metrics, self.budget.as_ref())
    }
}

impl PreparedSurface {
    /// Loads what `scene` names and makes its reference.
    ///
    /// # Errors
    /// [`RenderError`]: maps or tables that do not load, or a device that fails.
    pub fn new(
        scene: SurfaceScene,
        resources: Resources<'_>,
        backend: Backend<'_>,
    ) -> Result<Self, RenderError> {
        let spectra = Spectra::load(&resources.data.join("spectra"))?;
        let mut environments = Vec::with_capacity(scene.frames.len());
        for frame in &scene.frames {
            environments.push(environment(&frame.environment, resources.data)?);
        }
        let mut frames = Vec::with_capacity(scene.frames.len());
        for (frame, environment) in scene.frames.iter().zip(&environments) {
            let resized = environment.resized(scene.convolution.map_width)?;
            let mut map = SphereMap::from(&resized);
            map.rgb.iter_mut().for_each(|value| *value *= frame.scale as f32);
            frames.push(Lit::new(&scene, frame.turn_rad, map, backend)?);
        }
        let material = Material::new(&scene, &spectra, environments)?;
        let (width, height) = (scene.convolution.map_width, scene.convolution.map_width / 2);
        let operator = AzimuthalOperator::new(&material.kernel.taps(), width, height);
        let blank = Image::rgb(1, 1, &[[0.0; 3]]);
        let mut prepared = Self { scene, material, reference: blank, frames, operator };
        prepared.reference = prepared.reference(backend)?;
        Ok(prepared)
    }

    fn reference(&self, backend: Backend<'_>) -> Result<Image, RenderError> {
        let (taps, _) = table_taps(&self.material.table).thinned(LEFT_OUT);
        self.image(|lit| match self.scene.reference {
            ReferenceMethod::Full => {
                lit.surroundings.shaded_by_all(&self.operator, &lit.points, backend)
            }
            ReferenceMethod::Integral => {
                let exact = integrals(&lit.surroundings.world, &lit.points, &taps);
                let channel =
                    |channel: usize| exact.iter().map(|rgb| rgb[channel] as f32).collect();
                Ok((0..3).map(channel).collect())
            }
        })
    }

    /// The frames beside each other, from the columns R, G, B of the points of each.
    fn image(
        &self,
        shade: impl Fn(&Lit) -> Result<Vec<Vec<f32>>, RenderError>,
    ) -> Result<Image, RenderError> {
        let camera = &self.scene.camera;
        let (width, across) = (camera.width, camera.width * self.frames.len());
        let mut colours = vec![[0.0_f32; 3]; across * camera.height];
        for (place, lit) in self.frames.iter().enumerate() {
            let columns = shade(lit)?;
            for (at, pixel) in lit.pixels.iter().enumerate() {
                let to = (pixel / width) * across + place * width + pixel % width;
                let value = |channel: usize| {
                    let column = columns.get(channel).and_then(|column| column.get(at));
                    let value = column.copied().unwrap_or(f32::NAN);
                    (f64::from(value) * self.scene.reflectance[channel]) as f32
                };
                if let Some(colour) = colours.get_mut(to) {
                    *colour = [value(0), value(1), value(2)];
                }
            }
        }
        Ok(Image::rgb(across, camera.height, &colours))
    }

    /// What `method` sums.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn plan(&self, method: Method) -> Result<Plan, RenderError> {
        Plan::new(method, &self.material)
    }

    /// The picture that `plan` makes.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile or the device fails.
    pub fn picture(&self, plan: &Plan, backend: Backend<'_>) -> Result<Image, RenderError> {
        let straighten = self.scene.convolution.straighten;
        self.image(|lit| lit.surroundings.shaded(plan, &lit.points, straighten, backend))
    }

    /// How `image` differs from the reference.
    ///
    /// # Errors
    /// [`RenderError::Compare`] if it has another size.
    pub fn metrics(&self, image: &Image) -> Result<Metrics, RenderError> {
        Metrics::of(image, &self.reference, self.scene.exposure)
    }

    fn times(&self, plans: &[Plan], backend: Backend<'_>) -> Measured<ConvolutionTimes> {
        let Backend::Device(device) = backend else {
            return Measured::NotMeasured("convolutions are timed on the device".into());
        };
        let Some(lit) = self.frames.first() else {
            return Measured::NotMeasured("there is no frame".into());
        };
        let map = &lit.surroundings.object;
        let full = match self.scene.reference {
            ReferenceMethod::Full => {
                TimedPass::convolved(std::slice::from_ref(map), &[self.material.kernel.taps()])
            }
            ReferenceMethod::Integral => timed(map, &lit.points, &table_taps(&self.material.table)),
        };
        let passes = plans.iter().map(|plan| plan.timed(map, &lit.points));
        let found = passes
            .collect::<Result<Vec<_>, _>>()
            .and_then(|passes| speed::times(device, &passes, &[full?]));
        match found {
            Ok(times) => Measured::Value(times),
            Err(error) => Measured::NotMeasured(error.to_string()),
        }
    }
}

impl Lit {
    fn new(
        scene: &SurfaceScene,
        turn_rad: f64,
        map: SphereMap,
        backend: Backend<'_>,
    ) -> Result<Self, RenderError> {
        let shape = turned(&scene.shape, turn_rad);
        let frame = *shape.frame();
        let camera = &scene.camera;
        let position = Vector3::from(camera.position);
        let hits = (0..camera.width * camera.height)
            .filter_map(|pixel| Some((pixel, shape.hit(position, camera.direction(pixel))?)));
        let (pixels, points) = hits.unzip();
        Ok(Self { pixels, points, surroundings: Surroundings::new(map, frame, backend)? })
    }
}

/// The shape turned about its normal.
fn turned(shape: &Shape, turn_rad: f64) -> Shape {
    let old = shape.frame();
    let turned = Frame::new(old.normal.into(), old.tangents[0].into(), turn_rad);
    let mut shape = *shape;
    match &mut shape {
        Shape::Sphere { frame, .. }
        | Shape::Rectangle { frame, .. }
        | Shape::Disc { frame, .. } => *frame = turned,
    }
    shape
}

/// A map of the project by name, or a file.
fn environment(name: &str, data: &Path) -> Result<Environment, RenderError> {
    let is_file = Path::new(name).extension().is_some();
    let path = if is_file {
        Path::new(name).to_path_buf()
    } else {
        data.join("environments").join(format!("{name}.exr"))
    };
    Ok(Environment::read(path)?)
}

/// Renders `scene`: the reference and every approximation; `watch` sees images as they are finished.
///
/// # Errors
/// [`RenderError`]: what does not load, and a device that fails.
pub fn render_surface(
    scene: &SurfaceScene,
    resources: Resources<'_>,
    backend: Backend<'_>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<RenderedSurface, RenderError> {
    let prepared = PreparedSurface::new(scene.clone(), resources, backend)?;
    let reference = &prepared.reference;
    watch(Event::Image { name: scene::REFERENCE, image: reference, whole: true });
    let mut plans = Vec::with_capacity(scene.approximations.len());
    let mut approximations = Vec::with_capacity(scene.approximations.len());
    for approximation in &scene.approximations {
        let plan = prepared.plan(approximation.method)?;
        let image = prepared.picture(&plan, backend)?;
        watch(Event::Image { name: &approximation.name, image: &image, whole: true });
        plans.push(plan);
        approximations.push(SurfaceApproximation {
            name: approximation.name.clone(),
            method: approximation.method,
            error: ErrorMap::relative(&image, reference, None)?,
            metrics: prepared.metrics(&image)?,
            image,
            ms: Measured::NotMeasured("not timed".into()),
            budget: scene.budget.get(&approximation.name).copied(),
        });
    }
    let times = prepared.times(&plans, backend);
    for (at, approximation) in approximations.iter_mut().enumerate() {
        let ms = match &times {
            Measured::Value(times) => times.approximations_ms.get(at).cloned(),
            Measured::NotMeasured(reason) => Some(Measured::NotMeasured(reason.clone())),
        };
        approximation.ms = ms.unwrap_or(Measured::NotMeasured("not timed".into()));
    }
    let by_angle = match prepared.frames.first() {
        Some(lit) => by_angle(&lit.surroundings, &prepared.material, &prepared.operator, backend)?,
        None => Vec::new(),
    };
    let directions = prepared.material.kernel.directions;
    Ok(RenderedSurface {
        choice: scene.choice.as_ref().map(|limits| choice(&approximations, limits)),
        approximations,
        method: scene.reference,
        times,
        by_angle,
        albedo: prepared.material.kernel.albedo(),
        directions_deg: directions.map(|d| d[1].atan2(d[0]).to_degrees()),
        backend: backend.description(),
        reference: prepared.reference,
    })
}

/// The cheapest approximation within `limits`; of those that were not timed the first.
fn choice(approximations: &[SurfaceApproximation], limits: &Budget) -> Result<String, String> {
    let within =
        |a: &&SurfaceApproximation| over_budget(&a.name, &a.metrics, Some(limits)).is_empty();
    let cost = |a: &SurfaceApproximation| a.ms.value().copied().unwrap_or(f64::INFINITY);
    let cheapest = approximations
        .iter()
        .filter(within)
        .min_by(|a, b| cost(a).total_cmp(&cost(b)))
        .map(|found| found.name.clone());
    cheapest.ok_or_else(|| "no approximation is within the limits of the scene".to_owned())
}
