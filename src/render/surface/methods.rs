//! The ways to shade a surface: maps convolved ahead and looked up, or sums at every point.

use nalgebra::Vector3;

use super::material::Material;
use super::scene::{Method, Straighten};
use super::shape::{Frame, Point};
use super::sums::{surface_sums, timed};
use crate::render::RenderError;
use crate::render::backend::Backend;
use crate::render::sphere_map::{
    AzimuthalOperator, SphereMap, Taps, TimedPass, convolved, looked_up, turned,
};

/// What an approximation sums.
#[derive(Debug, Clone)]
pub enum Plan {
    /// Passes over a map: per term the taps of the first pass and of the second.
    Passes(Vec<(Taps, Taps)>),
    /// One pass over a map.
    Single(Taps),
    /// A sum at every point.
    Sums(Taps),
}

impl Plan {
    /// Of a method.
    ///
    /// # Errors
    /// [`RenderError`] if the material cannot be factorised so.
    pub fn new(method: Method, material: &Material) -> Result<Self, RenderError> {
        Ok(match method {
            Method::TwoPass { rank, factors } => {
                Self::Passes(material.kernel.passes(&material.factors(rank, factors)?))
            }
            Method::Printed { rank } => {
                let factors = material.factors(rank, super::scene::Factors::Svd)?;
                Self::Passes(material.kernel.passes(&factors.cross_rank_printed()))
            }
            Method::Sum => Self::Single(material.blurs()?),
            Method::Line => Self::Sums(material.line()?),
            Method::Reconstructed { rank } => Self::Sums(material.reconstructed(rank)?),
        })
    }

    /// Convolves `map`, in the frame in which it is given; none for sums at points.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile or the device fails.
    pub fn convolved(
        &self,
        map: &SphereMap,
        backend: Backend<'_>,
    ) -> Result<Option<SphereMap>, RenderError> {
        let one = std::slice::from_ref(map);
        let layers = match self {
            Self::Passes(terms) => {
                let (first, second): (Vec<Taps>, Vec<Taps>) = terms.iter().cloned().unzip();
                convolved(&convolved(one, &first, backend)?, &second, backend)?
            }
            Self::Single(taps) => convolved(one, std::slice::from_ref(taps), backend)?,
            Self::Sums(_) => return Ok(None),
        };
        let mut layers = layers.into_iter();
        let Some(mut sum) = layers.next() else { return Ok(None) };
        for layer in layers {
            sum.rgb.iter_mut().zip(layer.rgb).for_each(|(sum, value)| *sum += value);
        }
        Ok(Some(sum))
    }

    /// The kernels to time: passes over `map`, or sums at `points`.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not parse.
    pub fn timed(&self, map: &SphereMap, points: &[Point]) -> Result<Vec<TimedPass>, RenderError> {
        let one = std::slice::from_ref(map);
        Ok(match self {
            Self::Passes(terms) => {
                let (first, second): (Vec<Taps>, Vec<Taps>) = terms.iter().cloned().unzip();
                let layers = vec![map.clone(); terms.len()];
                vec![TimedPass::convolved(one, &first)?, TimedPass::convolved(&layers, &second)?]
            }
            Self::Single(taps) => vec![TimedPass::convolved(one, std::slice::from_ref(taps))?],
            Self::Sums(taps) => vec![timed(map, points, taps)?],
        })
    }

    /// The same with the directions of all taps turned by `angle` about the outward direction.
    fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turn = |taps: &Taps| {
            let mut turned = Taps::default();
            for ([x, y, z], weight) in taps.iter() {
                turned.push([x * cos - y * sin, x * sin + y * cos, z], weight);
            }
            turned
        };
        match self {
            Self::Passes(terms) => {
                Self::Passes(terms.iter().map(|(a, b)| (turn(a), turn(b))).collect())
            }
            Self::Single(taps) => Self::Single(turn(taps)),
            Self::Sums(taps) => Self::Sums(taps.clone()),
        }
    }
}

/// An environment about a surface, in the frame of the world and in that of the surface.
#[derive(Debug, Clone)]
pub struct Surroundings {
    /// In the frame of the world.
    pub world: SphereMap,
    /// The normal at azimuth 0 on the equator, the first tangent its east.
    pub object: SphereMap,
    frame: Frame,
}

impl Surroundings {
    /// Turns `world` into `frame`.
    ///
    /// # Errors
    /// [`RenderError`] if the kernel does not compile or the device fails.
    pub fn new(world: SphereMap, frame: Frame, backend: Backend<'_>) -> Result<Self, RenderError> {
        let rows = frame.rows();
        // A direction d of the object is Σ rows[i] d_i in the world.
        let turn = [0, 1, 2].map(|axis| rows.map(|row| row[axis]));
        let object = turned(&world, turn, backend)?;
        Ok(Self { world, object, frame })
    }

    /// Radiance at `points` by `plan`, for F₀ = 1: columns R, G, B.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile or the device fails.
    pub fn shaded(
        &self,
        plan: &Plan,
        points: &[Point],
        straighten: Straighten,
        backend: Backend<'_>,
    ) -> Result<Vec<Vec<f32>>, RenderError> {
        let reflections = |of: &dyn Fn(&Point) -> Vector3<f64>| -> Vec<Vec<f32>> {
            let column = |axis| points.iter().map(|point| of(point)[axis] as f32).collect();
            (0..3).map(column).collect()
        };
        if let Plan::Sums(taps) = plan {
            return surface_sums(&self.world, points, taps, backend);
        }
        let missing = || RenderError::Simulation("a plan without terms".into());
        let in_world = reflections(&|point| point.reflection);
        if straighten == Straighten::None {
            let plan = plan.turned(self.turn_in_world());
            let map = plan.convolved(&self.world, backend)?.ok_or_else(missing)?;
            return looked_up(&map, &in_world, backend);
        }
        let map = plan.convolved(&self.object, backend)?.ok_or_else(missing)?;
        if straighten == Straighten::Back {
            let rows = self.frame.rows().map(|row| [row.x, row.y, row.z]);
            return looked_up(&turned(&map, rows, backend)?, &in_world, backend);
        }
        looked_up(&map, &self.in_object(points), backend)
    }

    /// Radiance at `points` by the whole kernel under n = ω_o = r_v, in f64 by FFT.
    ///
    /// # Errors
    /// [`RenderError`] if the lookup does not compile or the device fails.
    pub fn shaded_by_all(
        &self,
        operator: &AzimuthalOperator,
        points: &[Point],
        backend: Backend<'_>,
    ) -> Result<Vec<Vec<f32>>, RenderError> {
        looked_up(&operator.apply(&self.object), &self.in_object(points), backend)
    }

    fn in_object(&self, points: &[Point]) -> Vec<Vec<f32>> {
        let column = |axis: &Vector3<f64>| {
            points.iter().map(|point| point.reflection.dot(axis) as f32).collect()
        };
        self.frame.rows().iter().map(column).collect()
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
