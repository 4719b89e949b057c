//! Surfaces with a diffraction table under environments: the ways to convolve an environment with the
//! table, and the sum over the table at every point.

mod angles;
mod kernels;
mod methods;
mod orders;
mod sampling;
mod sums;

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

pub use angles::AngleError;
pub use kernels::DiffractionKernels;
pub use orders::Orders;
pub(in crate::render) use orders::zero_order_shares;
pub use sums::{Sums, integrals};

use super::backend::{Backend, Painter};
use super::error::RenderError;
use super::geometry::Hit;
use super::scene::{Convolution, Diffraction, Light, LightShape, Method, ReferenceMethod, Scene};
use super::shading::{Columns, Details, Moved, Sampler, Shader, Shading, rgb_columns};
use super::sphere_map::{AzimuthalOperator, SphereMap, lookup};
use super::times::TimedPass;
use super::view::Camera;
use crate::document::{Block, PrintedTable};
use crate::gpu::TimingOptions;
use crate::measured::environment::Environment;
use crate::measured::spectra::Spectra;
use crate::project::Project;
use methods::{Lit, Plan};
use sums::timed;

/// Share of the table's energy that sums at every pixel leave out.
const LEFT_OUT: f64 = 1e-4;

/// A diffractive surface before a camera, with a frame per environment.
#[derive(Debug)]
pub(super) struct Surface {
    reference: ReferenceMethod,
    reflectance: [f64; 3],
    convolution: Convolution,
    kernels: DiffractionKernels,
    frames: Vec<Lit>,
    approximations: Vec<(Method, OnceLock<Plan>)>,
    operator: OnceLock<AzimuthalOperator>,
    /// Environments of its lights, and where others are.
    environments: Vec<Environment>,
    data: PathBuf,
}

/// Shades what is met in one frame.
type HitShader<'a> = Box<dyn Fn(&[Hit]) -> Result<Columns, RenderError> + 'a>;

impl Surface {
    /// Loads what `scene` names and finds what its pixels show.
    ///
    /// # Errors
    /// [`RenderError`]: maps or tables that do not load, or a table that cannot be factorised.
    pub(super) fn prepare(
        scene: &Scene,
        (material, convolution): (&Diffraction, Convolution),
        camera: &Camera,
        project: &Project,
    ) -> Result<Self, RenderError> {
        let [width, height] = [scene.view.width, scene.view.height];
        let mut environments = Vec::new();
        for light in &scene.lights {
            if let LightShape::Environment { map, turn_rad } = &light.shape {
                environments.push((light, *turn_rad, environment(map, &project.data())?));
            }
        }
        let across = width * environments.len();
        let mut frames = Vec::with_capacity(environments.len());
        for (place, (light, turn_rad, environment)) in environments.iter().enumerate() {
            let map = radiance(light, environment, convolution.map_width)?;
            let mut lit = Lit::new(camera, [width, height], scene.geometry.turned(*turn_rad), map)?;
            for pixel in &mut lit.pixels {
                *pixel = (*pixel / width) * across + place * width + *pixel % width;
            }
            frames.push(lit);
        }
        let spectra = Spectra::load(&project.data().join("spectra"))?;
        let methods = scene.approximations.iter().map(|of| of.method.clone());
        Ok(Self {
            reference: scene.reference,
            reflectance: material.reflectance,
            convolution,
            kernels: DiffractionKernels::new(&material.table, convolution.align, &spectra)?,
            frames,
            approximations: methods.map(|method| (method, OnceLock::new())).collect(),
            operator: OnceLock::new(),
            environments: environments.into_iter().map(|(.., environment)| environment).collect(),
            data: project.data(),
        })
    }

    /// What an approximation sums, made when it is first asked for.
    fn plan(&self, at: usize) -> Result<&Plan, RenderError> {
        let missing = || RenderError::no_approximation(at);
        let (method, plan) = self.approximations.get(at).ok_or_else(missing)?;
        match plan.get() {
            Some(plan) => Ok(plan),
            None => {
                let environments = |maps: &[String]| match maps {
                    [] => Ok(self.environments.clone()),
                    maps => maps.iter().map(|map| environment(map, &self.data)).collect(),
                };
                let made = Plan::new(method, &self.kernels, environments)?;
                Ok(plan.get_or_init(|| made))
            }
        }
    }

    fn operator(&self) -> &AzimuthalOperator {
        let width = self.convolution.map_width;
        let made = || AzimuthalOperator::new(&self.kernels.angular.taps(), width, width / 2);
        self.operator.get_or_init(made)
    }

    /// What sums at every pixel keep of the orders of the table.
    fn orders(&self) -> Orders {
        self.kernels.orders.thinned(LEFT_OUT)
    }

    /// Pixels of the picture, from what `shade` says for what a frame shows of them; black where
    /// nothing is met.
    fn shaded(
        &self,
        range: Range<usize>,
        shade: impl Fn(usize, &[usize], &[Hit]) -> Result<Columns, RenderError>,
    ) -> Result<Columns, RenderError> {
        let mut picture = vec![vec![0.0_f32; range.len()]; 3];
        for (frame, lit) in self.frames.iter().enumerate() {
            let (pixels, hits) = lit.within(&range);
            if hits.is_empty() {
                continue;
            }
            let columns = shade(frame, pixels, hits)?.into_iter().zip(self.reflectance);
            for (channel, (column, reflectance)) in picture.iter_mut().zip(columns) {
                for (pixel, value) in pixels.iter().zip(column) {
                    channel[pixel - range.start] = (f64::from(value) * reflectance) as f32;
                }
            }
        }
        Ok(picture)
    }

    /// The picture, from a shader per frame.
    fn over<'a>(
        &'a self,
        shader: impl FnMut(&'a Lit) -> Result<HitShader<'a>, RenderError>,
    ) -> Result<Shader<'a>, RenderError> {
        let shaders = self.frames.iter().map(shader).collect::<Result<Vec<_>, _>>()?;
        Ok(Box::new(move |range| self.shaded(range, |frame, _, hits| shaders[frame](hits))))
    }

    fn first(&self) -> Result<&Lit, RenderError> {
        self.frames.first().ok_or_else(|| RenderError::Unusable("there is no frame".into()))
    }
}

/// Looks a map up in the mirror directions, in the frame of the surface or in that of the world.
fn looked_up<'a>(
    lit: &'a Lit,
    (map, in_object): (SphereMap, bool),
    backend: Backend<'a>,
) -> Result<HitShader<'a>, RenderError> {
    let painter = lookup(&map, backend)?;
    Ok(Box::new(move |hits| painter.colours(&lit.directions(hits, in_object))))
}

/// A map of the project by name, a file, or `white`.
fn environment(name: &str, data: &Path) -> Result<Environment, RenderError> {
    if name == Environment::WHITE {
        return Ok(Environment::white());
    }
    let is_file = Path::new(name).extension().is_some();
    let path = match is_file {
        true => Path::new(name).to_path_buf(),
        false => data.join("environments").join(format!("{name}.exr")),
    };
    Ok(Environment::read(path)?)
}

/// An environment `width` texels around, times the radiance of its light.
fn radiance(
    light: &Light,
    environment: &Environment,
    width: usize,
) -> Result<SphereMap, RenderError> {
    let mut map = SphereMap::from(&environment.resized(width)?);
    for texel in map.rgb.chunks_exact_mut(3) {
        let factors = texel.iter_mut().zip(light.radiance);
        factors.for_each(|(value, factor)| *value *= factor as f32);
    }
    Ok(map)
}

impl Shading for Surface {
    fn exact(&self) -> Result<Shader<'_>, RenderError> {
        if self.reference == ReferenceMethod::Full {
            let map = |lit: &Lit| self.operator().apply(&lit.object);
            return self.over(|lit| looked_up(lit, (map(lit), true), Backend::Lanes));
        }
        let orders = Arc::new(self.orders());
        self.over(|lit| {
            let orders = Arc::clone(&orders);
            Ok(Box::new(move |hits| Ok(rgb_columns(&integrals(&lit.world, hits, &orders)))))
        })
    }

    fn picture<'a>(
        &'a self,
        at: usize,
        _: Option<Moved<'_>>,
        backend: Backend<'a>,
    ) -> Result<Shader<'a>, RenderError> {
        let straighten = self.convolution.straighten;
        match self.plan(at)? {
            Plan::Sums(orders) => self.over(|lit| {
                let sums = Sums::new(&lit.world, orders, backend)?;
                Ok(Box::new(move |hits| sums.at(hits)))
            }),
            Plan::Passes(passes) => self
                .over(|lit| looked_up(lit, lit.convolved(passes, straighten, backend)?, backend)),
        }
    }

    fn sampler<'a>(&'a self, seed: u64, backend: Backend<'a>) -> Result<Sampler<'a>, RenderError> {
        let orders = self.orders();
        let mut painters = Vec::with_capacity(self.frames.len());
        for lit in &self.frames {
            let kernel = sampling::kernel(&lit.world, &orders, seed)?;
            painters.push(Painter::new(vec![kernel], backend)?);
        }
        Ok(Box::new(move |range, first| {
            self.shaded(range, |frame, pixels, hits| {
                painters[frame].colours(&sampling::draws(pixels, hits, first))
            })
        }))
    }

    fn timed(&self, at: usize) -> Result<Vec<TimedPass>, RenderError> {
        let lit = self.first()?;
        self.plan(at)?.timed(&lit.object, &lit.hits)
    }

    fn timed_in_full(&self) -> Result<Vec<TimedPass>, RenderError> {
        let lit = self.first()?;
        let map = &lit.object;
        let pass = match self.reference {
            ReferenceMethod::Full => {
                TimedPass::convolved(std::slice::from_ref(map), &[self.kernels.angular.taps()])
            }
            _ => timed(map, &lit.hits, &self.kernels.orders),
        };
        Ok(vec![pass?])
    }

    fn timed_sampler(&self, seed: u64) -> Result<Vec<TimedPass>, RenderError> {
        let lit = self.first()?;
        Ok(vec![TimedPass {
            kernel: sampling::kernel(&lit.world, &self.orders(), seed)?,
            inputs: sampling::draws(&lit.pixels, &lit.hits, 0),
            evaluations: lit.hits.len(),
        }])
    }

    /// A pass may take a thousand taps per point: few points, and one evaluation of each.
    fn timing(&self) -> TimingOptions {
        TimingOptions { points: 256, repeats: 1, ..TimingOptions::default() }
    }

    fn details(&self) -> Result<Details, RenderError> {
        let by_angle = angles::by_angle(&self.first()?.object, &self.kernels, self.operator())?;
        let albedo = self.kernels.angular.albedo();
        let directions_deg = self.kernels.angular.directions.map(|d| d[1].atan2(d[0]).to_degrees());
        let ([first, second], [r, g, b]) = (directions_deg, albedo);
        let table = PrintedTable::over(
            "What n = ω_o = r_v costs in the first frame: the convolution with the whole table against \
             the sum over the table at 24 azimuths per angle of incidence, on a plane.",
            &by_angle,
        )
        .number("incidence", "°", |of| of.angle_deg)
        .number("relative RMS", "1", |of| of.relative_rms)
        .number("mean over that of the sum", "1", |of| of.mean_ratio);
        let text = format!(
            "The axes of the factors lie along {first:.2}° and {second:.2}° of the table. Of a uniform \
             environment the kernel returns {r:.3}, {g:.3}, {b:.3} in R, G, B."
        );
        let figures = [
            ("albedo", serde_json::json!(albedo)),
            ("directions_deg", serde_json::json!(directions_deg)),
            ("by_incidence_angle", serde_json::json!(by_angle)),
        ];
        Ok(Details {
            blocks: vec![Block::Paragraph(text.into()), table.into()],
            figures: figures.map(|(name, value)| (name.to_owned(), value)).into_iter().collect(),
        })
    }
}
