//! The ways to shade a surface: maps convolved ahead and looked up, or sums at every point.

use nalgebra::Vector3;

use super::kernels::DiffractionKernels;
use super::sums::timed;
use crate::render::RenderError;
use crate::render::backend::Backend;
use crate::render::geometry::{Frame, Hit};
use crate::render::scene::{Factors, Method, Straighten};
use crate::render::shading::Columns;
use crate::render::sphere_map::{SphereMap, Taps, convolved, turned};
use crate::render::times::TimedPass;

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
    /// [`RenderError`] if the table cannot be factorised so, or forms shade and nothing is summed.
    pub fn new(method: &Method, kernels: &DiffractionKernels) -> Result<Self, RenderError> {
        let passes = |factors| Self::Passes(kernels.angular.passes(&factors));
        Ok(match method {
            Method::TwoPass { rank, factors } => passes(kernels.factors(*rank, *factors)?),
            Method::Printed { rank } => {
                passes(kernels.factors(*rank, Factors::Svd)?.cross_rank_printed())
            }
            Method::Sum => Self::Single(kernels.blurs()?),
            Method::Line => Self::Sums(kernels.line()?),
            Method::Reconstructed { rank } => Self::Sums(kernels.reconstructed(*rank)?),
            Method::Forms { .. } => {
                return Err(RenderError::Simulation("forms sum no diffraction table".into()));
            }
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

    /// The kernels to time: passes over `map`, or sums at `hits`.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not parse.
    pub fn timed(&self, map: &SphereMap, hits: &[Hit]) -> Result<Vec<TimedPass>, RenderError> {
        let one = std::slice::from_ref(map);
        Ok(match self {
            Self::Passes(terms) => {
                let (first, second): (Vec<Taps>, Vec<Taps>) = terms.iter().cloned().unzip();
                let layers = vec![map.clone(); terms.len()];
                vec![TimedPass::convolved(one, &first)?, TimedPass::convolved(&layers, &second)?]
            }
            Self::Single(taps) => vec![TimedPass::convolved(one, std::slice::from_ref(taps))?],
            Self::Sums(taps) => vec![timed(map, hits, taps)?],
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
    /// Turns `world` into `frame`, on the CPU.
    ///
    /// # Errors
    /// [`RenderError`] if the kernel does not compile.
    pub fn new(world: SphereMap, frame: Frame) -> Result<Self, RenderError> {
        let rows = frame.rows();
        // A direction d of the object is Σ rows[i] d_i in the world.
        let turn = [0, 1, 2].map(|axis| rows.map(|row| row[axis]));
        let object = turned(&world, turn, Backend::Lanes)?;
        Ok(Self { world, object, frame })
    }

    /// The map convolved by `plan`, and whether it is looked up in the frame of the surface.
    ///
    /// # Errors
    /// [`RenderError`] if a kernel does not compile, the device fails, or the plan sums at points.
    pub fn convolved(
        &self,
        plan: &Plan,
        straighten: Straighten,
        backend: Backend<'_>,
    ) -> Result<(SphereMap, bool), RenderError> {
        let missing = || RenderError::Simulation("a plan without passes over a map".into());
        if straighten == Straighten::None {
            let plan = plan.turned(self.turn_in_world());
            return Ok((plan.convolved(&self.world, backend)?.ok_or_else(missing)?, false));
        }
        let map = plan.convolved(&self.object, backend)?.ok_or_else(missing)?;
        if straighten == Straighten::Lookup {
            return Ok((map, true));
        }
        let rows = self.frame.rows().map(|row| [row.x, row.y, row.z]);
        Ok((turned(&map, rows, backend)?, false))
    }

    /// Mirror directions of hits in the frame of the world.
    pub fn in_world(&self, hits: &[Hit]) -> Columns {
        let column = |axis| hits.iter().map(|hit| hit.reflection[axis] as f32).collect();
        (0..3).map(column).collect()
    }

    /// Mirror directions of hits in the frame of the surface.
    pub fn in_object(&self, hits: &[Hit]) -> Columns {
        let column =
            |axis: &Vector3<f64>| hits.iter().map(|hit| hit.reflection.dot(axis) as f32).collect();
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
