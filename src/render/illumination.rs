//! A scene as its kernels see it: lights in the frame of the scratch, and view directions, in f32.
//!
//! The frame: x along the scratch (ξ₁), y across it (ξ₂), z along the normal of the surface. All
//! numbers that a form is given are rounded to f32 here, once, and the references are given the
//! rounded numbers, so that an error is the form's and not the rounding of its input. Sines and
//! cosines are correctly rounded, so that the numbers are the same on every machine.

use std::f64::consts::{PI, TAU};

use crate::measured::{MeasuredError, spectra::Spectra};

use super::error::RenderError;
use super::polygon::{Polygon, PolygonFault};
use super::scene::{Scene, Shape, View};
use super::spectrum::{self, Wave};

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
    /// Turns the lights of `scene` into the frame of its scratch and chooses the wavelengths.
    ///
    /// # Errors
    /// As [`spectrum::waves`]; [`RenderError::Value`] for a polygon that is none once rounded.
    pub fn new(
        scene: &Scene,
        spectra: impl FnOnce() -> Result<Spectra, MeasuredError>,
    ) -> Result<Self, RenderError> {
        let direction_deg = scene.scratch.direction_deg;
        let waves = spectrum::waves(&scene.scratch, &scene.spectrum, spectra)?;
        let (mut spheres, mut polygons) = (Vec::new(), Vec::new());
        for (at, light) in scene.lights.iter().enumerate() {
            let radiance = light.radiance;
            match &light.shape {
                Shape::Sphere { centre, radius } => spheres.push(Sphere {
                    centre: in_scratch_frame(*centre, direction_deg),
                    radius: *radius as f32,
                    radiance,
                }),
                Shape::Polygon(polygon) => {
                    let facets = Facets::new(polygon, direction_deg, radiance);
                    polygons.push(facets.map_err(|fault| RenderError::Value {
                        path: scene.name.clone(),
                        key: format!("light[{at}].vertices"),
                        what: fault.to_string(),
                    })?);
                }
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

/// Direction cosines of the views of some pixels, counted row by row, along and across the scratch.
pub fn directions(
    view: &View,
    direction_deg: f64,
    pixels: std::ops::Range<usize>,
) -> [Vec<f32>; 2] {
    let turn = direction_deg.to_radians();
    let mut columns = [Vec::with_capacity(pixels.len()), Vec::with_capacity(pixels.len())];
    for pixel in pixels {
        let (row, column) = (pixel / view.width, pixel % view.width);
        let polar = 0.5 * PI * (row as f64 + 0.5) / view.height as f64;
        let azimuth = TAU * (column as f64 + 0.5) / view.width as f64 - turn;
        let (sine, (across, along)) = (core_math::sin(polar), core_math::sincos(azimuth));
        columns[0].push((sine * along) as f32);
        columns[1].push((sine * across) as f32);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_scratch_sees_turned_directions() {
        let view = View { width: 8, height: 4, exposure: 1.0 };
        let [along, across] = directions(&view, 45.0, 0..32);
        // 45° is two half pixels of 22.5°: pixel 1 lies at 22.5° + 45° − 45°.
        let polar = 0.5 * PI * 0.125;
        let (sine, cosine) = core_math::sincos(22.5_f64.to_radians());
        assert_eq!(along[1], (core_math::sin(polar) * cosine) as f32);
        assert_eq!(across[1], (core_math::sin(polar) * sine) as f32);
        assert_eq!(along.len(), 32);
    }
}
