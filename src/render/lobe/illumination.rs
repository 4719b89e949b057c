//! A scene as its kernels see it: lights in the frame of the scratch, in f32.
//!
//! The frame: x along the scratch (ξ₁), y across it (ξ₂), z along the normal of the surface. All
//! numbers that a form is given are rounded to f32 here, once, and the references are given the
//! rounded numbers, so that an error is the form's and not the rounding of its input. Sines and
//! cosines are correctly rounded, so that the numbers are the same on every machine.

use super::spectrum::Wave;
use crate::render::RenderError;
use crate::render::polygon::{Polygon, PolygonFault};
use crate::render::scene::{LightShape, Scene};

/// The lights of a scene in the frame of its scratch, with the wavelengths to render.
#[derive(Debug, Clone, PartialEq)]
pub struct Illumination {
    /// The wavelengths.
    pub waves: Vec<Wave>,
    /// The spheres.
    pub spheres: Vec<Sphere>,
    /// The polygons.
    pub polygons: Vec<Facets>,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub centre: [f32; 3],
    /// Radius.
    pub radius: f32,
    /// Radiance in R, G, B.
    pub radiance: [f64; 3],
}

/// A polygon, whole and in triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Facets {
    /// The vertices.
    pub vertices: Vec<[f32; 3]>,
    /// The triangles.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// Radiance in R, G, B.
    pub radiance: [f64; 3],
}

impl Illumination {
    /// Turns the lights of `scene` into the frame of a scratch with the azimuth `direction_deg`.
    ///
    /// # Errors
    /// [`RenderError::Value`] for a polygon that is none once rounded.
    pub fn new(scene: &Scene, direction_deg: f64, waves: Vec<Wave>) -> Result<Self, RenderError> {
        let (mut spheres, mut polygons) = (Vec::new(), Vec::new());
        for (at, light) in scene.lights.iter().enumerate() {
            let radiance = light.radiance;
            match &light.shape {
                LightShape::Sphere { centre, radius } => spheres.push(Sphere {
                    centre: in_scratch_frame(*centre, direction_deg),
                    radius: *radius as f32,
                    radiance,
                }),
                LightShape::Polygon(polygon) => {
                    let facets = Facets::new(polygon, direction_deg, radiance);
                    polygons.push(facets.map_err(|fault| RenderError::Value {
                        path: scene.origin.clone(),
                        key: format!("light[{at}].vertices"),
                        what: fault.to_string(),
                    })?);
                }
                // A checked scene has none of them here.
                LightShape::Environment { .. } => {}
            }
        }
        Ok(Self { waves, spheres, polygons })
    }
}

impl Facets {
    /// The polygon in the frame of the scratch, rounded, and then checked and cut into triangles.
    ///
    /// # Errors
    /// [`PolygonFault`] if what is left after rounding is no polygon.
    pub fn new(
        polygon: &Polygon,
        direction_deg: f64,
        radiance: [f64; 3],
    ) -> Result<Self, PolygonFault> {
        let turned = |vertex: &[f64; 3]| in_scratch_frame(*vertex, direction_deg);
        let vertices: Vec<[f32; 3]> = polygon.vertices().iter().map(turned).collect();
        let rounded: Vec<[f64; 3]> = vertices.iter().map(|v| v.map(f64::from)).collect();
        // The conversion back is exact: the corners are the rounded vertices.
        let corners = |corners: [[f64; 3]; 3]| corners.map(|corner| corner.map(|x| x as f32));
        let triangles = Polygon::new(&rounded)?.triangles().map(corners).collect();
        Ok(Self { vertices, triangles, radiance })
    }
}

/// A point in the frame of a scratch with the azimuth `direction_deg`, rounded.
fn in_scratch_frame([x, y, z]: [f64; 3], direction_deg: f64) -> [f32; 3] {
    let (sine, cosine) = core_math::sincos(direction_deg.to_radians());
    [(cosine * x + sine * y) as f32, (cosine * y - sine * x) as f32, z as f32]
}
