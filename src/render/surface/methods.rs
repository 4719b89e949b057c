//! The ways to shade a surface: maps convolved ahead and looked up, or sums at every point.

use std::ops::Range;

use nalgebra::Vector3;

use super::kernels::DiffractionKernels;
use super::orders::Orders;
use super::sums::{columns, timed};
use crate::measured::environment::Environment;
use crate::render::RenderError;
use crate::render::backend::Backend;
use crate::render::geometry::{Frame, Geometry, Hit};
use crate::render::scene::{Factors, Method, Straighten};
use crate::render::shading::Columns;
use crate::render::sphere_map::{self, SphereMap, Taps, turned};
use crate::render::times::TimedPass;
use crate::render::view::Camera;

/// What an approximation sums.
#[derive(Debug, Clone)]
pub(super) enum Plan {
    /// Passes over maps, one after the other: the taps of every layer in each.
    Passes(Vec<Vec<Taps>>),
    /// A sum at every point.
    Sums(Orders),
}

impl Plan {
    /// Of a method; `environments` reads those that factors are fitted to.
    ///
    /// # Errors
    /// [`RenderError`] if the table cannot be factorised so, or forms shade and nothing is summed.
    pub(super) fn new(
        method: &Method,
        kernels: &DiffractionKernels,
        environments: impl Fn(&[String]) -> Result<Vec<Environment>, RenderError>,
    ) -> Result<Self, RenderError> {
        let two = |factors| Self::Passes(kernels.angular.passes(&factors).into());
        Ok(match method {
            Method::TwoPass { rank, factors: Factors::Svd } => two(kernels.factors(*rank)?),
            Method::TwoPass { rank, factors: Factors::Convolution(maps) } => {
                two(kernels.factors_after_convolution(*rank, &environments(maps)?)?)
            }
            Method::Printed { rank } => two(kernels.factors(*rank)?.cross_rank_printed()),
            Method::Sum => Self::Passes(vec![vec![kernels.blurs()?]]),
            Method::Line => Self::Sums(kernels.line()?),
            Method::Reconstructed { rank } => Self::Sums(kernels.reconstructed(*rank)?),
            Method::Forms { .. } => {
                return Err(RenderError::Unusable("forms sum no diffraction table".into()));
            }
        })
    }

    /// The kernels to time: passes over `map`, or sums at `hits`.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not parse.
    pub(super) fn timed(
        &self,
        map: &SphereMap,
        hits: &[Hit],
    ) -> Result<Vec<TimedPass>, RenderError> {
        let passes = match self {
            Self::Passes(passes) => passes,
            Self::Sums(orders) => return Ok(vec![timed(map, hits, orders)?]),
        };
        let mut layers = vec![map.clone()];
        let mut timed = Vec::with_capacity(passes.len());
        for lists in passes {
            timed.push(TimedPass::convolved(&layers, lists)?);
            layers.resize(lists.len(), map.clone());
        }
        Ok(timed)
    }
}

/// `map` after passes, in the frame in which it is given: the sum of what they make of it.
fn convolved(
    map: &SphereMap,
    passes: &[Vec<Taps>],
    backend: Backend<'_>,
) -> Result<SphereMap, RenderError> {
    let mut layers = vec![map.clone()];
    for lists in passes {
        layers = sphere_map::convolved(&layers, lists, backend)?;
    }
    let mut sum = layers.remove(0);
    for layer in layers {
        sum.rgb.iter_mut().zip(layer.rgb).for_each(|(sum, value)| *sum += value);
    }
    Ok(sum)
}

/// `taps` with their directions turned by `angle` about the outward direction.
fn turned_taps(taps: &Taps, angle: f64) -> Taps {
    let (sin, cos) = angle.sin_cos();
    let mut turned = Taps::default();
    for ([x, y, z], weight) in taps.iter() {
        turned.push([x * cos - y * sin, x * sin + y * cos, z], weight);
    }
    turned
}

/// What is seen of a surface in one frame, and what it is lit by.
#[derive(Debug)]
pub(super) struct Lit {
    /// Pixels of the picture, in order, where the surface is met, and what is met there.
    pub(super) pixels: Vec<usize>,
    pub(super) hits: Vec<Hit>,
    /// The environment in the frame of the world.
    pub(super) world: SphereMap,
    /// And in that of the surface: the normal at azimuth 0 on the equator, the first tangent its east.
    pub(super) object: SphereMap,
    frame: Frame,
}

impl Lit {
    /// What a picture of `size` shows of `shape` under `world`, which is turned on the CPU.
    ///
    /// # Errors
    /// [`RenderError`] if the kernel does not compile.
    pub(super) fn new(
        camera: &Camera,
        size: [usize; 2],
        shape: Geometry,
        world: SphereMap,
    ) -> Result<Self, RenderError> {
        let hits = (0..size[0] * size[1])
            .filter_map(|pixel| Some((pixel, shape.hit(&camera.ray(size, pixel))?)));
        let (pixels, hits) = hits.unzip();
        let rows = shape.frame.rows();
        // A direction d of the object is Σ rows[i] d_i in the world.
        let turn = [0, 1, 2].map(|axis| rows.map(|row| row[axis]));
        let object = turned(&world, turn, Backend::Lanes)?;
        Ok(Self { pixels, hits, world, object, frame: shape.frame })
    }

    /// What pixels of a range show.
    pub(super) fn within(&self, range: &Range<usize>) -> (&[usize], &[Hit]) {
        let place = |pixel: usize| self.pixels.partition_point(|other| *other < pixel);
        let part = place(range.start)..place(range.end);
        (&self.pixels[part.clone()], &self.hits[part])
    }

    /// The map after `passes`, and whether it is looked up in the frame of the surface.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile or the device fails.
    pub(super) fn convolved(
        &self,
        passes: &[Vec<Taps>],
        straighten: Straighten,
        backend: Backend<'_>,
    ) -> Result<(SphereMap, bool), RenderError> {
        if straighten == Straighten::None {
            let angle = self.turn_in_world();
            let turn = |lists: &Vec<Taps>| lists.iter().map(|of| turned_taps(of, angle)).collect();
            let passes: Vec<Vec<Taps>> = passes.iter().map(turn).collect();
            return Ok((convolved(&self.world, &passes, backend)?, false));
        }
        let map = convolved(&self.object, passes, backend)?;
        if straighten == Straighten::Lookup {
            return Ok((map, true));
        }
        Ok((turned(&map, self.frame.rows().map(Into::into), backend)?, false))
    }

    /// Mirror directions of hits in the frame of the world, or in that of the surface.
    pub(super) fn directions(&self, hits: &[Hit], in_object: bool) -> Columns {
        if !in_object {
            return columns(hits, |hit| hit.reflection);
        }
        let rows = self.frame.rows();
        columns(hits, |hit| rows.map(|row| hit.reflection.dot(&row)).into())
    }

    /// Angle from the east of the world at the normal to the first tangent.
    fn turn_in_world(&self) -> f64 {
        let normal = self.frame.normal;
        let east = Vector3::new(-normal.y, normal.x, 0.0);
        let east = if east.norm() < 1e-9 { Vector3::y() } else { east.normalize() };
        let north = normal.cross(&east);
        let tangent = self.frame.tangents[0];
        tangent.dot(&north).atan2(tangent.dot(&east))
    }
}
