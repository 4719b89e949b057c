//! A scene as its kernels see it: lights in the frame of the scratch, in f32; and the reference image
//! under them, the semi-analytic integrals of `area_light` in f64.
//!
//! The frame: x along the scratch (ξ₁), y across it (ξ₂), z along the normal of the surface. All
//! numbers that a form is given are rounded to f32 here, once, and the references are given the
//! rounded numbers, so that an error is the form's and not the rounding of its input. Sines and
//! cosines are correctly rounded, so that the numbers are the same on every machine.

use rayon::prelude::*;

use super::spectrum::Wave;
use crate::effect::DomainError;
use crate::effects::area_light;
use crate::render::RenderError;
use crate::render::polygon::{Polygon, PolygonFault};
use crate::render::scene::{LightShape, Scene};
use crate::render::shading::{Columns, rgb_columns};

/// The lights of a scene in the frame of its scratch, with the wavelengths to render.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Illumination {
    pub(super) waves: Vec<Wave>,
    pub(super) spheres: Vec<Sphere>,
    /// The polygons, for the reference, and their triangles, for the forms.
    polygons: Vec<Vertices>,
    pub(super) triangles: Vec<Triangle>,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sphere {
    pub(super) centre: [f32; 3],
    pub(super) radius: f32,
    /// Radiance in R, G, B.
    pub(super) radiance: [f64; 3],
}

/// A polygon: vertices and radiance.
type Vertices = (Vec<[f64; 3]>, [f64; 3]);

/// A triangle of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Triangle {
    pub(super) corners: [[f32; 3]; 3],
    /// Radiance in R, G, B.
    pub(super) radiance: [f64; 3],
}

impl Illumination {
    /// Turns the lights of `scene` into the frame of a scratch with the azimuth `direction_deg`.
    ///
    /// # Errors
    /// [`RenderError::Value`] for a polygon that is none once rounded.
    pub(super) fn new(
        scene: &Scene,
        direction_deg: f64,
        waves: Vec<Wave>,
    ) -> Result<Self, RenderError> {
        let (spheres, polygons, triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut lit = Self { waves, spheres, polygons, triangles };
        for (at, light) in scene.lights.iter().enumerate() {
            let radiance = light.radiance;
            match &light.shape {
                LightShape::Sphere { centre, radius } => lit.spheres.push(Sphere {
                    centre: in_scratch_frame(*centre, direction_deg),
                    radius: *radius as f32,
                    radiance,
                }),
                LightShape::Polygon(polygon) => {
                    let turned =
                        turned(polygon, direction_deg).map_err(|fault| RenderError::Value {
                            path: scene.origin.clone(),
                            key: format!("light[{at}].vertices"),
                            what: fault.to_string(),
                        })?;
                    // The conversion back is exact: the corners are the rounded vertices.
                    let narrow = |corners: [[f64; 3]; 3]| corners.map(|c| c.map(|x| x as f32));
                    let corners = turned.triangles().map(narrow);
                    lit.triangles.extend(corners.map(|corners| Triangle { corners, radiance }));
                    lit.polygons.push((turned.vertices().to_vec(), radiance));
                }
                // A checked scene has none of them here.
                LightShape::Environment { .. } => {}
            }
        }
        Ok(lit)
    }

    /// Columns R, G, B towards the directions of view in two columns; shared out among the threads.
    ///
    /// # Errors
    /// [`RenderError::Unusable`] where an integral has no value.
    pub(super) fn colours(&self, views: &[Vec<f32>]) -> Result<Columns, RenderError> {
        let [along, across] = views else { return Ok(Vec::new()) };
        let views = along.par_iter().zip(across);
        let colours = views.map(|(x, y)| self.radiance([f64::from(*x), f64::from(*y)]));
        Ok(rgb_columns(&colours.collect::<Result<Vec<_>, _>>()?))
    }

    /// Radiance in R, G, B towards a view direction in the frame of the scratch.
    fn radiance(&self, view: [f64; 2]) -> Result<[f64; 3], RenderError> {
        let failed = |error: DomainError| {
            let [along, across] = view;
            let what = format!("reference at view direction ({along}, {across}): {error}");
            RenderError::Unusable(what)
        };
        let mut colour = [0.0; 3];
        for wave in &self.waves {
            let (kw, ks) = (f64::from(wave.kw), f64::from(wave.ks));
            let mut add = |lobe: f64, radiance: [f64; 3]| {
                for ((sum, weight), light) in colour.iter_mut().zip(wave.weight).zip(radiance) {
                    *sum += lobe * weight * light;
                }
            };
            for sphere in &self.spheres {
                let (centre, radius) = (sphere.centre.map(f64::from), f64::from(sphere.radius));
                let lobe = area_light::sphere_light(kw, ks, view, centre, radius);
                add(lobe.map_err(failed)?, sphere.radiance);
            }
            for (vertices, radiance) in &self.polygons {
                let lobe = area_light::polygon_light(kw, ks, view, vertices);
                add(lobe.map_err(failed)?, *radiance);
            }
        }
        Ok(colour)
    }
}

/// The polygon in the frame of a scratch with the azimuth `direction_deg`, rounded and then checked.
///
/// # Errors
/// [`PolygonFault`] if what is left after rounding is no polygon.
pub(in crate::render) fn turned(
    polygon: &Polygon,
    direction_deg: f64,
) -> Result<Polygon, PolygonFault> {
    let vertices = polygon.vertices().iter();
    let rounded = vertices.map(|v| in_scratch_frame(*v, direction_deg).map(f64::from));
    Polygon::new(&rounded.collect::<Vec<_>>())
}

/// A point in the frame of a scratch with the azimuth `direction_deg`, rounded.
fn in_scratch_frame([x, y, z]: [f64; 3], direction_deg: f64) -> [f32; 3] {
    let (sine, cosine) = core_math::sincos(direction_deg.to_radians());
    [(cosine * x + sine * y) as f32, (cosine * y - sine * x) as f32, z as f32]
}
